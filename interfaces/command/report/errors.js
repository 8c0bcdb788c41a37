/* ---- 3 budget -------------------------------------------------------------------------------------------------- */

const parts = ['aliasing', 'truncation', 'regularisation', 'integration', 'settling'];
const least = 1e-12;
const budgetRows = () => data.budget.filter(r => (r.response || 0) === chosenResponse());
const budgetLabels = () => budgetRows().map(r => show(along(r.omega), 7) + ' (' + r.branch + ')');

function budgetSets() {
  const bars = parts.map((part, i) => ({
    label: part,
    data: budgetRows().map((r, j) => ({x: j, y: r[part] > least ? r[part] : NaN})),
    backgroundColor: colour(i),
    barPercentage: 1,
    categoryPercentage: 0.8,
    base: least
  }));
  const gate = budgetLabels().map((l, x) => ({x, y: data.gate}));
  const look = {type: 'line', borderColor: theme.ink, borderDash: [5, 4], borderWidth: 1, pointRadius: 0};
  return bars.concat([Object.assign({label: 'gate', data: gate}, look)]);
}

function startBudget() {
  const title = {display: true, text: alongTitle + ' (branch)'};
  const x = {type: 'category', labels: budgetLabels(), title, grid: {display: false}, min: 0};
  x.max = Math.max(0, budgetLabels().length - 1);
  const y = axis('part of the relative error [1]', 'logarithmic', {min: least, max: 1});
  const words = item => item.dataset.label + ' ' + show(item.raw.y, 3) + ' at ' + budgetLabels()[item.raw.x];
  plot('budget', 'bar', budgetSets, {x, y}, words);
}

/* ---- 4 accuracy ------------------------------------------------------------------------------------------------ */

const sampled = data.accuracy.filter(r => r.samples);
const sampleCounts = [...new Set(sampled.map(r => r.samples))];
const sampleRange = sampled.length ? [Math.min(...sampleCounts), Math.max(...sampleCounts)] : [1, 2];
const isCount = () => $('measure').value === 'false_turning_points';

function accuracySets() {
  const q = $('measure').value;
  const sets = [];
  const shown = v => (v === null || !(v > 0 || isCount()) ? NaN : v);
  [...new Set(data.accuracy.map(r => r.harmonics))].forEach((h, i) => {
    const points = sampled.filter(r => r.harmonics === h).map(r => ({x: r.samples, y: shown(r[q])}));
    const exact = data.accuracy.find(r => r.harmonics === h && !r.samples);
    const ends = exact && sampled.length && shown(exact[q]) > 0 ? sampleRange.map(x => ({x, y: exact[q]})) : [];
    sets.push(line('H = ' + h, points, colour(i), {pointRadius: 4}));
    const look = {borderDash: [4, 4], borderWidth: 1.2};
    if (ends.length) sets.push(line('H = ' + h + ', exact forces', ends, colour(i), look));
  });
  return sets;
}

function drawAccuracy() {
  const y = charts.accuracy.options.scales.y;
  y.type = isCount() ? 'linear' : 'logarithmic';
  y.title.text = isCount() ? 'false turning points' : 'relative error [1]';
  redraw('accuracy');
  zoomReset(charts.accuracy);
}

function startAccuracy() {
  const range = {min: sampleRange[0] / 1.3, max: sampleRange[1] * 1.3};
  const x = axis('samples per period N', 'logarithmic', Object.assign(range, ticksAt(sampleCounts)));
  const words = item => item.dataset.label + ', N = ' + item.raw.x + ': ' + show(item.raw.y, 3);
  plot('accuracy', 'scatter', accuracySets, {x, y: axis('relative error [1]', 'logarithmic')}, words);
  $('measure').addEventListener('change', drawAccuracy);
  drawAccuracy();
}
