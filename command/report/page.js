/* page.js - the plots of the report. Reads the data block, draws with Chart.js; zoom, toggles and the aliasing sliders are here.
 *   response  {curve, turned: columns omega, amplitude, harmonic_1, mean, branch, stable (1, 0, -1), contact; hbm, transient, specials: rows}
 *   budget    rows {omega, branch, a part each}             accuracy  rows {harmonics, samples (0: exact forces), errors}
 *   aliasing  {omega, harmonics, samples, factors, kn, first, steps, states[omega][kn][H]}, a state {amplitude, scale, force[], true[],
 *             sampled[N] {amplitude, difference[], folds[]}}; force, true, and the last two are integers in steps[0..2] of scale.
 * Followed in the same script by aliasing.js and start.js. */
'use strict';
const problems = [];
window.addEventListener('error', e => problems.push(e.message));

const data = JSON.parse(document.getElementById('data').textContent);
const $ = id => document.getElementById(id);
const dark = matchMedia('(prefers-color-scheme: dark)').matches && !matchMedia('print').matches;
const colours = ['#3572b0', '#d9822b', '#3a9a5b', '#b04a9a', '#c0392b', '#7a6a58', '#16909e', '#8a8f98'];
const ink = dark ? '#c8ced6' : '#3a4048', grid = dark ? 'rgba(160,170,180,.18)' : 'rgba(60,70,80,.13)';
const units = data.units, omegaTitle = 'omega [rad/' + units.time + ']';
const charts = {};
Chart.defaults.animation = false;
Chart.defaults.color = ink;
Chart.defaults.borderColor = grid;
Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
Chart.defaults.maintainAspectRatio = false;

const show = (v, digits) => v === null || v === undefined || !isFinite(v) ? '-' : String(+Number(v).toPrecision(digits || 6));
const percent = v => show(100 * v, 2) + ' %';

/* ---- zoom: drag a frame, wheel (with Ctrl, or after a click), keys + - 0, double click ------------------------------------------- */

function toScale(scale, f) {                      /* the value at the fraction f of an axis */
  const log = scale.type === 'logarithmic', a = log ? Math.log10(scale.min) : scale.min, b = log ? Math.log10(scale.max) : scale.max;
  return log ? Math.pow(10, a + f * (b - a)) : a + f * (b - a);
}

function zoomTo(chart, frame) {                   /* frame: fractions of both axes, {x: [from, to], y: [from, to]} */
  for (const name of ['x', 'y']) {
    const scale = chart.scales[name], from = toScale(scale, frame[name][0]), to = toScale(scale, frame[name][1]);
    if (!(to > from)) continue;
    chart.options.scales[name].min = from;
    chart.options.scales[name].max = to;
  }
  chart.update();
}

function zoomBy(chart, factor, at) {
  const c = at || {x: .5, y: .5};
  zoomTo(chart, {x: [c.x - c.x * factor, c.x + (1 - c.x) * factor], y: [c.y - c.y * factor, c.y + (1 - c.y) * factor]});
}

function zoomReset(chart) {
  for (const name of ['x', 'y']) {
    const home = chart.home[name];
    chart.options.scales[name].min = home[0];
    chart.options.scales[name].max = home[1];
  }
  chart.update();
}

function fractions(chart, event) {
  const box = chart.canvas.getBoundingClientRect(), area = chart.chartArea;
  const clip = f => Math.min(1, Math.max(0, f));
  return {x: clip((event.clientX - box.left - area.left) / (area.right - area.left)), y: clip((area.bottom - (event.clientY - box.top)) / (area.bottom - area.top))};
}

const frameDrawing = {
  id: 'frame',
  afterDraw(chart) {
    const f = chart.frame, area = chart.chartArea;
    if (!f) return;
    const px = x => area.left + x * (area.right - area.left), py = y => area.bottom - y * (area.bottom - area.top);
    chart.ctx.save();
    chart.ctx.fillStyle = 'rgba(90,130,180,.2)';
    chart.ctx.strokeStyle = 'rgba(90,130,180,.9)';
    chart.ctx.fillRect(px(f.x[0]), py(f.y[1]), px(f.x[1]) - px(f.x[0]), py(f.y[0]) - py(f.y[1]));
    chart.ctx.strokeRect(px(f.x[0]), py(f.y[1]), px(f.x[1]) - px(f.x[0]), py(f.y[0]) - py(f.y[1]));
    chart.ctx.restore();
  }
};

function addZoom(chart) {
  const canvas = chart.canvas, sorted = (a, b) => a < b ? [a, b] : [b, a];
  let start = null;
  canvas.addEventListener('pointerdown', e => {
    if (e.button !== 0 || e.pointerType === 'touch') return;
    start = fractions(chart, e);
    canvas.focus({preventScroll: true});
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener('pointermove', e => {
    if (!start) return;
    const now = fractions(chart, e);
    chart.frame = {x: sorted(start.x, now.x), y: sorted(start.y, now.y)};
    chart.draw();
  });
  canvas.addEventListener('pointerup', () => {
    const f = chart.frame;
    start = null;
    chart.frame = null;
    if (f && f.x[1] - f.x[0] > .01 && f.y[1] - f.y[0] > .01) zoomTo(chart, f);
    else chart.draw();
  });
  canvas.addEventListener('wheel', e => {
    if (!e.ctrlKey && document.activeElement !== canvas) return;
    e.preventDefault();
    zoomBy(chart, e.deltaY < 0 ? .8 : 1.25, fractions(chart, e));
  }, {passive: false});
  canvas.addEventListener('dblclick', () => zoomReset(chart));
  canvas.addEventListener('keydown', e => {
    if (e.key === '+' || e.key === '=') zoomBy(chart, .8);
    else if (e.key === '-') zoomBy(chart, 1.25);
    else if (e.key === '0') zoomReset(chart);
  });
  const buttons = document.createElement('div');
  buttons.className = 'zoom';
  for (const [text, label, act] of [['+', 'Zoom in', () => zoomBy(chart, .7)], ['\u2212', 'Zoom out', () => zoomBy(chart, 1.4)], ['reset', 'Whole plot', () => zoomReset(chart)]]) {
    const b = document.createElement('button');
    b.type = 'button';
    b.textContent = text;
    b.setAttribute('aria-label', label);
    b.title = label + ' (drag a frame, wheel after a click, keys + - 0)';
    b.addEventListener('click', act);
    buttons.append(b);
  }
  canvas.parentNode.append(buttons);
}

/* ---- plots in general ------------------------------------------------------------------------------------------------------------- */

/* On a logarithmic axis whole decades only, unless there are few. */
function tickText(value, i, ticks) {
  if (this.type !== 'logarithmic') return show(value, 6);
  const whole = Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9, decades = Math.log10(this.max / this.min);
  if (!whole && decades > 2) return '';
  return value >= 1e5 || value < 1e-3 ? value.toExponential(decades > 2 ? 0 : 1).replace('e+', 'e') : show(value, 4);
}

const axis = (title, type, more) => Object.assign({type: type || 'linear', title: {display: true, text: title}, grid: {color: grid}}, more || {}, {ticks: Object.assign({callback: tickText, includeBounds: false}, more && more.ticks)});

/* A round mark as a picture: the legend would stretch a circle to the length of its lines. */
function disc(colour) {
  const picture = document.createElement('canvas'), context = picture.getContext('2d');
  picture.width = picture.height = 10;
  context.fillStyle = colour;
  context.arc(5, 5, 4.5, 0, 2 * Math.PI);
  context.fill();
  return picture;
}

/* The legend shows a line as a line, dashes and all. */
function legendLabels(chart) {
  return Chart.defaults.plugins.legend.labels.generateLabels(chart).map(label => {
    const set = chart.data.datasets[label.datasetIndex], isLine = set.showLine || set.type === 'line';
    if (isLine) Object.assign(label, {pointStyle: 'line', lineDash: set.borderDash || [], lineWidth: 2, strokeStyle: set.borderColor});
    else label.pointStyle = set.pointStyle === 'circle' ? disc(set.borderColor) : set.pointStyle || 'rect';
    return label;
  });
}

function plot(name, type, datasets, scales, tooltip, more) {
  const chart = new Chart($('plot-' + name), {
    type, data: {datasets}, plugins: [frameDrawing],
    options: Object.assign({
      parsing: false, normalized: false, scales,
      layout: {padding: {top: 26}},
      interaction: {mode: 'nearest', intersect: false},
      plugins: {legend: {position: 'bottom', labels: {usePointStyle: true, pointStyleWidth: 26, boxHeight: 7, generateLabels: legendLabels}}, tooltip: {callbacks: {title: () => '', label: tooltip}}}
    }, more || {})
  });
  chart.home = {};
  for (const axisName of ['x', 'y']) chart.home[axisName] = [scales[axisName].min, scales[axisName].max];
  addZoom(chart);
  charts[name] = chart;
  return chart;
}

/* Ticks at these numbers of samples and nowhere else. */
const ticksAt = values => ({ticks: {callback: v => v}, afterBuildTicks: a => { a.ticks = values.filter(n => n >= a.min && n <= a.max).map(value => ({value})); }});

/* Another home for an axis, and there at once: undefined is "as the data are". */
function setHome(chart, name, from, to) {
  chart.home[name] = [from, to];
  chart.options.scales[name].min = from;
  chart.options.scales[name].max = to;
}

const line = (label, points, colour, more) => Object.assign({type: 'scatter', showLine: true, label, data: points, borderColor: colour, backgroundColor: colour, borderWidth: 2, pointRadius: 0, pointHitRadius: 6, tension: 0}, more || {});
const marks = (label, points, colour, style, more) => Object.assign({type: 'scatter', showLine: false, label, data: points, borderColor: colour, backgroundColor: colour, pointRadius: 5, pointStyle: style}, more || {});

/* ---- 2 response ------------------------------------------------------------------------------------------------------------------- */

/* A curve's points of one stability, in the curve's order; a gap (NaN) between runs, and a run begins where the one before it ends. */
function runs(curve, quantity, wanted) {
  const out = [], n = curve.omega ? curve.omega.length : 0;
  const at = i => ({x: curve.omega[i], y: curve[quantity][i], branch: curve.branch[i], stable: curve.stable[i], contact: curve.contact[i]});
  for (let i = 0; i < n; i++) {
    const here = wanted === null || curve.stable[i] === wanted;
    const before = i > 0 && (wanted === null || curve.stable[i - 1] === wanted);
    if (here && !before && i > 0) out.push({x: NaN, y: NaN});
    if (here) out.push(at(i));
    else if (before) out.push(Object.assign(at(i), {stable: wanted}));
  }
  return out;
}

const verdictStyle = {match: ['circle', 2], differs: ['triangle', 4], other_branch: ['rect', 1], unstable: ['rectRot', 3], aperiodic: ['star', 4], not_settled: ['cross', 5], solver_failed: ['crossRot', 4]};

function responseSets() {
  const r = data.response, q = $('quantity').value, sets = [];
  const tagged = (tag, set) => Object.assign(set, {tag});
  sets.push(tagged('stable', line('HBM, stable', runs(r.curve, q, 1), colours[0])));
  sets.push(tagged('unstable', line('HBM, unstable', runs(r.curve, q, -1), colours[4], {borderDash: [6, 4]})));
  const unknown = runs(r.curve, q, 0);
  if (unknown.length) sets.push(tagged('stable', line('HBM, stability unknown', unknown, colours[7], {borderDash: [2, 3]})));
  sets.push(tagged('turned', line(r.mean_kept ? 'HBM without harmonic 0' : 'HBM with harmonic 0', runs(r.turned, q, null), colours[5], {borderWidth: 1.5, borderDash: [10, 3, 2, 3]})));
  for (const verdict of [...new Set(r.transient.map(t => t.verdict))]) {
    const style = verdictStyle[verdict] || ['star', 6];
    sets.push(tagged('transient', marks('transient: ' + verdict, r.transient.filter(t => t.verdict === verdict).map(t => ({x: t.omega, y: t[q], row: t})), colours[style[1]], style[0], {borderWidth: 2, order: verdict === 'unstable' ? -1 : verdict === 'match' ? -1.2 : -1.5}))); /* the rare on top */
  }
  if (q === 'amplitude') sets.push(tagged('special', marks('turning points and the like', r.specials.map(s => ({x: s.omega, y: s.amplitude, what: s.what, branch: s.branch})), ink, 'crossRot', {pointRadius: 4, borderWidth: 1.5, order: -2})));
  return sets;
}

function responseWords(item) {
  const p = item.raw, q = $('quantity').value, head = 'omega ' + show(p.x, 7) + ', ' + q + ' ' + show(p.y, 7) + ' ' + units.length;
  if (p.row) return [head, 'transient started on branch ' + p.row.branch + ': ' + p.row.verdict, 'relative error of the amplitude ' + show(p.row.error, 3)];
  if (p.what) return [p.what, head, 'branch ' + p.branch];
  return [head, 'branch ' + p.branch + ', ' + ({'1': 'stable', '-1': 'unstable', '0': 'stability unknown'})[p.stable] + ', ' + p.contact];
}

function toggleResponse() {
  const chart = charts.response, on = {stable: true, unstable: $('show-unstable').checked, transient: $('show-transient').checked, special: $('show-special').checked, turned: $('show-turned').checked};
  chart.data.datasets.forEach((set, i) => chart.setDatasetVisibility(i, on[set.tag]));
  chart.update();
}

function drawResponse() {
  const chart = charts.response, title = $('quantity').selectedOptions[0].textContent + ' [' + units.length + ']';
  chart.data.datasets = responseSets();
  chart.options.scales.y.type = $('log-amplitude').checked ? 'logarithmic' : 'linear';
  chart.options.scales.y.title.text = title;
  setHome(chart, 'y', undefined, undefined);
  setHome(chart, 'x', ...rangeOf($('range').value));
  toggleResponse();
}

/* The omegas of the whole curve, or of the part with at least a tenth of the largest amplitude and something around it. */
function rangeOf(which) {
  const w = data.response.curve.omega || [0, 1], a = data.response.curve.amplitude || [0, 0], top = Math.max(...a);
  const near = which === 'whole' ? w : w.filter((x, i) => a[i] >= .1 * top), from = Math.min(...near), to = Math.max(...near), more = which === 'whole' ? 0 : .25 * (to - from);
  return [Math.max(from - more, Math.min(...w)), Math.min(to + more, Math.max(...w))];
}

function startResponse() {
  const [from, to] = rangeOf('whole'), peak = rangeOf('peak');
  $('range').value = peak[1] - peak[0] < .2 * (to - from) ? 'peak' : 'whole';
  plot('response', 'scatter', [], {x: axis(omegaTitle, 'linear', {min: from, max: to}), y: axis('amplitude')}, responseWords);
  $('turned-name').textContent = data.response.mean_kept ? 'without harmonic 0 (the paper\'s mode)' : 'with harmonic 0';
  $('quantity').addEventListener('change', drawResponse);
  $('log-amplitude').addEventListener('change', drawResponse);
  $('range').addEventListener('change', drawResponse);
  for (const id of ['show-unstable', 'show-transient', 'show-special', 'show-turned']) $(id).addEventListener('change', toggleResponse);
  drawResponse();
}

/* ---- 3 budget --------------------------------------------------------------------------------------------------------------------- */

const parts = ['aliasing', 'truncation', 'regularisation', 'integration', 'settling'];
const least = 1e-12;

function startBudget() {
  const labels = data.budget.map(r => show(r.omega, 7) + ' (' + r.branch + ')');
  const sets = parts.map((part, i) => ({label: part, data: data.budget.map((r, j) => ({x: j, y: r[part] > least ? r[part] : NaN})), backgroundColor: colours[i], barPercentage: 1, categoryPercentage: .8, base: least}));
  const gate = {type: 'line', label: 'gate', data: labels.map((l, j) => ({x: j, y: data.gate})), borderColor: ink, borderDash: [5, 4], borderWidth: 1, pointRadius: 0};
  const chart = plot('budget', 'bar', sets.concat([gate]), {
    x: {type: 'category', labels, title: {display: true, text: 'omega [rad/' + units.time + '] (branch)'}, grid: {display: false}, min: 0, max: Math.max(0, labels.length - 1)},
    y: axis('part of the relative error [1]', 'logarithmic', {min: least, max: 1})
  }, item => item.dataset.label + ' ' + show(item.raw.y, 3) + ' at ' + labels[item.raw.x]);
  chart.update();
}

/* ---- 4 accuracy ------------------------------------------------------------------------------------------------------------------- */

function sampleRange() {
  const all = data.accuracy.filter(r => r.samples).map(r => r.samples);
  return all.length ? [Math.min(...all), Math.max(...all)] : [1, 2];
}

function accuracySets() {
  const q = $('measure').value, sets = [], harmonics = [...new Set(data.accuracy.map(r => r.harmonics))];
  const shown = v => v === null ? NaN : q === 'false_turning_points' ? v : v > 0 ? v : NaN;
  const all = data.accuracy.filter(r => r.samples), [from, to] = sampleRange();
  harmonics.forEach((h, i) => {
    const rows = data.accuracy.filter(r => r.harmonics === h && r.samples), plain = data.accuracy.find(r => r.harmonics === h && !r.samples);
    sets.push(line('H = ' + h, rows.map(r => ({x: r.samples, y: shown(r[q])})), colours[i % colours.length], {pointRadius: 4}));
    if (plain && all.length && shown(plain[q]) > 0) sets.push(line('H = ' + h + ', exact forces', [from, to].map(n => ({x: n, y: plain[q]})), colours[i % colours.length], {borderDash: [4, 4], borderWidth: 1.2}));
  });
  return sets;
}

function drawAccuracy() {
  const chart = charts.accuracy, count = $('measure').value === 'false_turning_points';
  chart.data.datasets = accuracySets();
  chart.options.scales.y.type = count ? 'linear' : 'logarithmic';
  chart.options.scales.y.title.text = count ? 'false turning points' : 'relative error [1]';
  zoomReset(chart);
}

function startAccuracy() {
  const [from, to] = sampleRange();
  plot('accuracy', 'scatter', [], {x: axis('samples per period N', 'logarithmic', Object.assign({min: from / 1.3, max: to * 1.3}, ticksAt([...new Set(data.accuracy.map(r => r.samples))].filter(n => n > 0)))), y: axis('relative error [1]', 'logarithmic')},
    item => item.dataset.label + ', N = ' + item.raw.x + ': ' + show(item.raw.y, 3));
  $('measure').addEventListener('change', drawAccuracy);
  drawAccuracy();
}
