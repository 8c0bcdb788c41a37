/* ---- 5 aliasing: between precomputed states --------------------------------------------------------------------------------------- */

const alias = data.aliasing;

/* |F_h| from a list [a0, a1, b1, ...] of integers in `step` of the scale. */
function sizes(list, unit) {
  const out = [Math.abs(list[0]) * unit];
  for (let h = 1; 2 * h < list.length; h++) out.push(Math.hypot(list[2 * h - 1], list[2 * h]) * unit);
  return out;
}

/* The state the sliders stand on. true: |F_h|; sampled: |F_h| from N samples, h <= H; null where there is none. */
function aliasState() {
  const i = +$('alias-omega').value, k = +$('alias-k').value, h = +$('alias-h').value, n = +$('alias-n').value;
  const state = alias.states[i][k][h], at = {omega: alias.omega[i], factor: alias.factors[k], H: alias.harmonics[h], N: alias.samples[n], state, row: alias.states[i][k]};
  if (!state || !state.scale) return at;
  at.trueParts = state.true.map(v => v * alias.steps[1] * state.scale);
  at.trueSizes = sizes(state.true, alias.steps[1] * state.scale);
  at.force = state.force.map(v => v * alias.steps[0] * state.scale);
  const s = state.sampled[n];
  if (!s) return at;
  at.difference = s.difference.map(v => v * alias.steps[2] * state.scale);
  at.sampledParts = at.difference.map((d, j) => d + at.trueParts[j]);
  at.sampledSizes = sizes(at.sampledParts, 1);
  at.folds = s.folds.map(v => v * alias.steps[2] * state.scale);
  at.amplitude = s.amplitude;
  return at;
}

const foldOf = (h, N) => { const r = h % N; return Math.min(r, N - r); };  /* where harmonic h lands */
const series = (parts, th) => { let f = parts[0]; for (let h = 1; 2 * h < parts.length; h++) f += parts[2 * h - 1] * Math.cos(h * th) + parts[2 * h] * Math.sin(h * th); return f; };

/* |F_j| of a true harmonic as far as it is known: from the spectrum, or among what folds first. */
function trueSize(at, j) {
  if (j < at.trueSizes.length) return at.trueSizes[j];
  if (at.folds && Math.abs(j - at.N) <= at.H) return at.folds[2 * Math.abs(j - at.N) + (j > at.N ? 1 : 0)];
  return null;
}

function forceSets(at) {
  const n = at.force.length, fine = at.force.map((f, i) => ({x: i / n, y: f})).concat([{x: 1, y: at.force[0]}]);
  const sets = [line('true force', fine, colours[0])], step = Math.max(1, n / at.N);
  const rebuilt = parts => Array.from({length: n + 1}, (_, i) => ({x: i / n, y: series(parts, 2 * Math.PI * i / n)}));
  sets.push(line('its true harmonics 0..H', rebuilt(at.trueParts.slice(0, 2 * at.H + 1)), colours[2], {borderWidth: 1.5, borderDash: [5, 3]}));
  if (at.sampledParts) sets.push(line('sampled harmonics 0..H', rebuilt(at.sampledParts), colours[4], {borderWidth: 1.5, borderDash: [2, 3]}));
  const dots = [];
  for (let i = 0; i <= n; i += step) dots.push({x: i / n, y: at.force[i % n]});
  sets.push(marks(at.N > n ? 'samples (every ' + at.N / n + 'th drawn)' : 'samples', dots, colours[1], 'circle', {pointRadius: at.N > 64 ? 2 : 4, order: -1}));
  return sets;
}

function spectrumSets(at) {
  const floor = alias.steps[1] * at.state.scale * .5, look = +$('alias-look').value;
  const bar = (label, values, colour) => ({type: 'bar', label, data: values.map((y, x) => ({x, y: y > floor ? y : NaN})), base: floor, backgroundColor: colour, barPercentage: 1, categoryPercentage: .85, grouped: true, maxBarThickness: 9});
  const lands = h => h > at.H && foldOf(h, at.N) <= at.H;
  const sets = [bar('true', at.trueSizes, at.trueSizes.map((v, h) => foldOf(h, at.N) === look && h !== look ? colours[4] : lands(h) ? colours[1] : h <= at.H ? colours[0] : colours[7] + '90'))];
  if (at.sampledSizes) sets.push(bar('from ' + at.N + ' samples', at.sampledSizes, colours[2]));
  return sets;
}

function foldSets(at) {
  const most = Math.min(2 * at.N + at.H, 8 * at.N), points = [], lands = [], looked = [], look = +$('alias-look').value;
  for (let j = 0; j <= 5; j++) if (j * at.N / 2 <= most) points.push({x: j * at.N / 2, y: j % 2 ? at.N / 2 : 0});
  if (points.length && points[points.length - 1].x < most) points.push({x: most, y: foldOf(most, at.N)});
  for (let m = 0; m <= 2; m++)
    for (let h = -at.H; h <= at.H; h++) {
      const j = m * at.N + h;
      if (j < 0 || j > most) continue;
      (Math.abs(h) === look ? looked : lands).push({x: j, y: Math.abs(h), size: trueSize(at, j)});
    }
  return [line('where true harmonic h lands', points, colours[7], {borderWidth: 1}), marks('lands on a kept harmonic', lands, colours[1], 'circle', {pointRadius: 3}),
    marks('lands on harmonic ' + look, looked, colours[4], 'circle', {pointRadius: 6, order: -1}),
    line('H, the last one kept', [{x: 0, y: at.H}, {x: most, y: at.H}], colours[2], {borderWidth: 1, borderDash: [4, 4]})];
}

function effectSets(at) {
  const points = alias.samples.map((n, i) => ({x: n, y: at.state.sampled[i] && at.state.sampled[i].amplitude !== null ? at.state.sampled[i].amplitude : NaN}));
  const ends = [alias.samples[0], alias.samples[alias.samples.length - 1]], sets = [line('sampled', points, colours[1], {pointRadius: 4})];
  sets.push(line('exact forces, same H', ends.map(x => ({x, y: at.state.amplitude})), colours[2], {borderDash: [5, 4], borderWidth: 1.5}));
  const rows = data.response.transient.filter(t => t.omega === at.omega || Math.abs(t.omega - at.omega) < 1e-6 * at.omega);
  if (at.factor === 1 && rows.length) {
    const top = Math.max(...rows.map(t => t.amplitude));
    sets.push(line('time integration', ends.map(x => ({x, y: top})), colours[0], {borderDash: [1, 3]}));
  }
  sets.push(marks('N = ' + at.N, at.amplitude === null || at.amplitude === undefined ? [] : [{x: at.N, y: at.amplitude}], colours[4], 'circle', {pointRadius: 8, borderWidth: 2, backgroundColor: 'transparent', order: -1}));
  return sets;
}

/* ---- words and table -------------------------------------------------------------------------------------------------------------- */

function aliasWords(at) {
  const where = 'At omega ' + show(at.omega, 6) + ', H = ' + at.H + ': ';
  if (!at.state) return where + 'no solution on this stiffness\'s response curve.';
  if (!at.state.scale) return where + 'no contact does anything at this stiffness: nothing to sample.';
  if (!at.sampledParts) return where + at.N + ' samples cannot tell ' + at.H + ' harmonics apart: at least ' + (2 * at.H + 2) + ' are needed.';
  const worst = Math.max(...sizes(at.difference, 1)) / at.state.scale;
  const force = at.N + ' samples miss the harmonics of the contact force by up to ' + percent(worst) + ' of the largest force. ';
  if (at.amplitude === null) return where + force + 'The sampled equations have no solution next to the true one.';
  return where + force + 'The amplitude comes out as ' + show(at.amplitude) + ' instead of ' + show(at.state.amplitude) + ' ' + units.length + ': ' + percent(Math.abs(at.amplitude - at.state.amplitude) / at.state.amplitude) + ' off.';
}

function aliasTable(at) {
  const box = $('alias-table');
  box.textContent = '';
  if (!at.sampledParts) return;
  const table = document.createElement('table'), look = +$('alias-look').value;
  const add = (row, tag, text) => { const c = document.createElement(tag); c.textContent = text; row.append(c); };
  table.createCaption().textContent = 'Sizes of force harmonics [' + units.force + ']. What folds onto h comes from N - h, N + h, 2N - h, ...; the first two are usually most of it.';
  const head = table.createTHead().insertRow();
  for (const text of ['h', 'true |F(h)|', 'sampled |F(h)|', '|sampled - true|', 'of the largest force', 'folds from N - h', '|F(N - h)|', 'and from N + h', '|F(N + h)|']) add(head, 'th', text);
  const body = table.createTBody(), difference = sizes(at.difference, 1);
  for (let h = 0; h <= at.H; h++) {
    const row = body.insertRow();
    if (h === look) row.className = 'looked';
    const texts = [h, show(at.trueSizes[h]), show(at.sampledSizes[h]), show(difference[h], 3), percent(difference[h] / at.state.scale), at.N - h, show(at.folds[2 * h], 3), h ? at.N + h : '', h ? show(at.folds[2 * h + 1], 3) : ''];
    texts.forEach(text => add(row, 'td', text));
  }
  box.append(table);
}

/* ---- drawing ---------------------------------------------------------------------------------------------------------------------- */

function redraw(name, datasets, homes) {
  const chart = charts[name], hidden = chart.data.datasets.map((set, i) => chart.isDatasetVisible(i) ? null : set.tag).filter(tag => tag !== null);
  datasets.forEach((set, i) => { set.tag = i; });
  chart.data.datasets = datasets;
  datasets.forEach((set, i) => chart.setDatasetVisibility(i, !hidden.includes(i)));
  for (const axisName of Object.keys(homes)) setHome(chart, axisName, homes[axisName][0], homes[axisName][1]);
  chart.update();
}

function fillLook(at) {
  const look = $('alias-look'), before = Math.min(look.value === '' ? 1 : +look.value, at.H);
  look.textContent = '';
  for (let h = 0; h <= at.H; h++) look.append(new Option(h === 0 ? '0 (mean)' : String(h), h));
  look.value = before;
}

function drawAliasing() {
  let at = aliasState();
  fillLook(at);
  $('alias-n-value').textContent = at.N;
  $('alias-h-value').textContent = at.H;
  $('alias-k-value').textContent = show(alias.kn * at.factor, 4) + ' ' + units.force + '/' + units.length + (at.factor === 1 ? ' (the case)' : ' (case \u00d7 ' + at.factor + ')');
  for (const [id, text] of [['alias-n', at.N], ['alias-h', at.H], ['alias-k', $('alias-k-value').textContent]]) $(id).setAttribute('aria-valuetext', text);
  const words = $('alias-words');
  words.textContent = aliasWords(at);
  words.className = 'verdict ' + (!at.sampledParts || at.amplitude === null ? 'open' : Math.abs(at.amplitude - at.state.amplitude) <= data.gate * at.state.amplitude ? 'good' : 'bad');
  aliasTable(at);
  if (!at.trueSizes) { for (const name of ['force', 'spectrum', 'fold', 'effect']) redraw(name, [], {}); return; }
  const last = Math.min(at.trueSizes.length - 1, Math.max(24, Math.min(2 * at.N + at.H, 4 * at.H + 20)));
  redraw('force', forceSets(at), {y: [undefined, undefined], x: [0, 1]});
  redraw('spectrum', spectrumSets(at), {x: [-.6, last + .6], y: [alias.steps[1] * at.state.scale * .5, 2 * at.state.scale]});
  redraw('fold', foldSets(at), {x: [0, 2 * at.N + at.H], y: [0, Math.min(at.N / 2, 2 * at.H + 6)]});
  redraw('effect', effectSets(at), {});
}

function startAliasing() {
  if (!alias) { $('aliasing-none').hidden = false; $('aliasing-body').hidden = true; return; }
  alias.omega.forEach((w, i) => $('alias-omega').append(new Option(show(w, 6), i)));
  $('alias-omega').value = alias.first;
  for (const [id, n, at] of [['alias-n', alias.samples.length, 0], ['alias-h', alias.harmonics.length, 2], ['alias-k', alias.factors.length, alias.factors.indexOf(1)]]) {
    $(id).max = n - 1;
    $(id).value = at;
  }
  const y = '|F| [' + units.force + ']';
  plot('force', 'scatter', [], {x: axis('time / period [1]', 'linear', {min: 0, max: 1}), y: axis('contact force [' + units.force + ']')}, item => item.dataset.label + ': ' + show(item.raw.y) + ' at ' + show(item.raw.x, 4) + ' of the period');
  plot('spectrum', 'bar', [], {x: axis('harmonic', 'linear', {ticks: {precision: 0, callback: v => Number.isInteger(v) ? v : ''}, grid: {color: grid, offset: false}}), y: axis(y, 'logarithmic')}, item => [item.dataset.label + ' |F(' + item.raw.x + ')| = ' + show(item.raw.y, 5)].concat(item.datasetIndex === 0 && item.raw.x > alias.harmonics[+$('alias-h').value] ? ['with N samples it looks like harmonic ' + foldOf(item.raw.x, alias.samples[+$('alias-n').value])] : []));
  plot('fold', 'scatter', [], {x: axis('true harmonic', 'linear', {min: 0}), y: axis('lands on harmonic', 'linear', {min: 0})}, item => 'true harmonic ' + show(item.raw.x) + ' looks like ' + show(item.raw.y) + (item.raw.size === undefined || item.raw.size === null ? '' : ', size ' + show(item.raw.size, 3) + ' ' + units.force));
  plot('effect', 'scatter', [], {x: axis('samples per period N', 'logarithmic', Object.assign({min: alias.samples[0] / 1.3, max: alias.samples[alias.samples.length - 1] * 1.3}, ticksAt(alias.samples))), y: axis('amplitude [' + units.length + ']')}, item => item.dataset.label + (item.dataset.showLine && item.datasetIndex > 0 ? '' : ', N = ' + item.raw.x) + ': ' + show(item.raw.y) + ' ' + units.length);
  for (const id of ['alias-omega', 'alias-look']) $(id).addEventListener('change', drawAliasing);
  for (const id of ['alias-n', 'alias-h', 'alias-k']) $(id).addEventListener('input', drawAliasing);
  drawAliasing();
}
