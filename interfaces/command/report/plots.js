/* plots.js - what every plot of the report has: colours, zoom, legend, paper. Followed in the same script by
 * response.js (section 2), errors.js (3 and 4), structure.js (5 of structures), aliasing.js and aliasing_plots.js (5
 * of the others), selftest.js and start.js. They read the data block:
 *   cycles    the sweep is in cycles: so are all axes and words
 *   response  {curve, turned: columns omega, amplitude, harmonic_1, mean, mean_free, branch, stable (yes, no, unknown),
 *             contact; mean_kept; transient, specials: rows}
 *   structure null, or {names, responses, dofs, contacts, solutions}: see structure.h
 *   budget    rows {omega, branch, response (0 where it is not there), a part each}
 *   accuracy  rows {harmonics, samples (0: exact forces), errors}
 *   aliasing  {omega, first, harmonics, samples, stiffness, the_case, steps, curves}: see aliasing.js */
'use strict';
const problems = [];
window.addEventListener('error', e => problems.push(e.message));

const data = JSON.parse(document.getElementById('data').textContent);
const $ = id => document.getElementById(id);
const charts = {};
const units = data.units;

const show = (v, digits) =>
  v === null || v === undefined || !isFinite(v) ? '-' : String(+Number(v).toPrecision(digits || 6));
const percent = v => show(100 * v, 2) + ' %';

/* omega as the sweep has it, on axes and in words. */
const along = omega => (data.cycles ? omega / (2 * Math.PI) : omega);
const alongName = data.cycles ? 'frequency' : 'omega';
const alongTitle = alongName + (data.cycles ? ' [cycles/' : ' [rad/') + units.time + ']';
const where = (omega, digits) => alongName + ' ' + show(along(omega), digits || 7);

/* ---- colours: of the reader's scheme, and of paper ------------------------------------------------------------- */

const light = {
  ink: '#3a4048',
  grid: 'rgba(60,70,80,.13)',
  colours: ['#3572b0', '#d9822b', '#3a9a5b', '#b04a9a', '#c0392b', '#7a6a58', '#16909e', '#8a8f98']
};
const dark = {
  ink: '#c8ced6',
  grid: 'rgba(160,170,180,.18)',
  colours: ['#6ea8e0', '#eda35a', '#62c484', '#d884c4', '#f0776b', '#b8a48c', '#4cc3d0', '#9aa0aa']
};
const wantsDark = matchMedia('(prefers-color-scheme: dark)');
let theme = wantsDark.matches ? dark : light;
const colour = i => theme.colours[i % theme.colours.length];

function useTheme(chosen) {
  theme = chosen;
  Chart.defaults.color = theme.ink;
  Chart.defaults.borderColor = theme.grid;
  Object.keys(charts).forEach(redraw);
}

useTheme(theme);
Chart.defaults.animation = false;
Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
Chart.defaults.maintainAspectRatio = false;

/* ---- paper: every plot is drawn anew, in the colours of paper and this large; page.css scales it to the sheet ---- */

const paperWidth = 680; /* [CSS px] a little less than A4 and Letter have between their margins */
const paperHeight = {response: 400};
const otherPaperHeight = 310;
let onPaper = false;

function toPaper() {
  if (onPaper) return;
  onPaper = true;
  useTheme(light);
  for (const [name, chart] of Object.entries(charts)) chart.resize(paperWidth, paperHeight[name] || otherPaperHeight);
}

function toScreen() {
  if (!onPaper) return;
  onPaper = false;
  useTheme(wantsDark.matches ? dark : light);
  Object.values(charts).forEach(chart => chart.resize());
}

function followScheme() {
  wantsDark.addEventListener('change', e => onPaper || useTheme(e.matches ? dark : light));
  window.addEventListener('beforeprint', toPaper);
  window.addEventListener('afterprint', toScreen);
  matchMedia('print').addEventListener('change', e => (e.matches ? toPaper() : toScreen()));
}

/* ---- zoom: drag a frame, wheel (with Ctrl, or after a click), keys + - 0, double click -------------------------- */

/* The value at the fraction f of an axis. */
function toScale(scale, f) {
  if (scale.type !== 'logarithmic') return scale.min + f * (scale.max - scale.min);
  const [a, b] = [Math.log10(scale.min), Math.log10(scale.max)];
  return Math.pow(10, a + f * (b - a));
}

/* An axis from and to there: undefined is "as the data are". */
function setRange(chart, name, [from, to]) {
  chart.options.scales[name].min = from;
  chart.options.scales[name].max = to;
}

/* Another home for an axis, and there at once. */
function setHome(chart, name, range) {
  chart.home[name] = range;
  setRange(chart, name, range);
}

/* frame: fractions of both axes, {x: [from, to], y: [from, to]} */
function zoomTo(chart, frame) {
  for (const name of ['x', 'y']) {
    const range = frame[name].map(f => toScale(chart.scales[name], f));
    if (range[1] > range[0]) setRange(chart, name, range);
  }
  chart.update();
}

function zoomBy(chart, factor, at) {
  const c = at || {x: 0.5, y: 0.5};
  const around = f => [f - f * factor, f + (1 - f) * factor];
  zoomTo(chart, {x: around(c.x), y: around(c.y)});
}

function zoomReset(chart) {
  for (const name of ['x', 'y']) setRange(chart, name, chart.home[name]);
  chart.update();
}

function fractions(chart, event) {
  const box = chart.canvas.getBoundingClientRect();
  const area = chart.chartArea;
  const clip = f => Math.min(1, Math.max(0, f));
  return {
    x: clip((event.clientX - box.left - area.left) / (area.right - area.left)),
    y: clip((area.bottom - (event.clientY - box.top)) / (area.bottom - area.top))
  };
}

const frameDrawing = {
  id: 'frame',
  afterDraw(chart) {
    const f = chart.frame;
    const area = chart.chartArea;
    if (!f) return;
    const px = x => area.left + x * (area.right - area.left);
    const py = y => area.bottom - y * (area.bottom - area.top);
    const box = [px(f.x[0]), py(f.y[1]), px(f.x[1]) - px(f.x[0]), py(f.y[0]) - py(f.y[1])];
    chart.ctx.save();
    chart.ctx.fillStyle = 'rgba(90,130,180,.2)';
    chart.ctx.strokeStyle = 'rgba(90,130,180,.9)';
    chart.ctx.fillRect(...box);
    chart.ctx.strokeRect(...box);
    chart.ctx.restore();
  }
};

function addFrame(chart) {
  const canvas = chart.canvas;
  const sorted = (a, b) => (a < b ? [a, b] : [b, a]);
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
    if (f && f.x[1] - f.x[0] > 0.01 && f.y[1] - f.y[0] > 0.01) zoomTo(chart, f);
    else chart.draw();
  });
}

function addKeys(chart) {
  const canvas = chart.canvas;
  const onWheel = e => {
    if (!e.ctrlKey && document.activeElement !== canvas) return;
    e.preventDefault();
    zoomBy(chart, e.deltaY < 0 ? 0.8 : 1.25, fractions(chart, e));
  };
  canvas.addEventListener('wheel', onWheel, {passive: false});
  canvas.addEventListener('dblclick', () => zoomReset(chart));
  canvas.addEventListener('keydown', e => {
    if (e.key === '+' || e.key === '=') zoomBy(chart, 0.8);
    else if (e.key === '-') zoomBy(chart, 1.25);
    else if (e.key === '0') zoomReset(chart);
  });
}

function addButtons(chart) {
  const buttons = document.createElement('div');
  const add = (text, label, act) => {
    const b = document.createElement('button');
    b.type = 'button';
    b.textContent = text;
    b.setAttribute('aria-label', label);
    b.title = label + ' (drag a frame, wheel after a click, keys + - 0)';
    b.addEventListener('click', act);
    buttons.append(b);
  };
  buttons.className = 'zoom';
  add('+', 'Zoom in', () => zoomBy(chart, 0.7));
  add('\u2212', 'Zoom out', () => zoomBy(chart, 1.4));
  add('reset', 'Whole plot', () => zoomReset(chart));
  chart.canvas.parentNode.append(buttons);
}

/* ---- plots in general ------------------------------------------------------------------------------------------ */

/* On a logarithmic axis whole decades only, unless there are few. */
function tickText(value) {
  if (this.type !== 'logarithmic') return show(value, 6);
  const whole = Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9;
  const decades = Math.log10(this.max / this.min);
  if (!whole && decades > 2) return '';
  return value >= 1e5 || value < 1e-3 ? value.toExponential(decades > 2 ? 0 : 1).replace('e+', 'e') : show(value, 4);
}

function axis(title, type, more) {
  const ticks = Object.assign({callback: tickText, includeBounds: false}, more && more.ticks);
  return Object.assign({type: type || 'linear', title: {display: true, text: title}}, more, {ticks});
}

/* Ticks at these numbers of samples and nowhere else. */
const ticksAt = values => ({
  ticks: {callback: v => v},
  afterBuildTicks: a => {
    a.ticks = values.filter(n => n >= a.min && n <= a.max).map(value => ({value}));
  }
});

/* A round mark as a picture: the legend would stretch a circle to the length of its lines. */
function disc(fill) {
  const picture = document.createElement('canvas');
  const context = picture.getContext('2d');
  picture.width = picture.height = 10;
  context.fillStyle = fill;
  context.arc(5, 5, 4.5, 0, 2 * Math.PI);
  context.fill();
  return picture;
}

/* The legend shows a line as a line, dashes and all; on paper it leaves out what is hidden. */
function legendLabels(chart) {
  const labels = Chart.defaults.plugins.legend.labels.generateLabels(chart);
  return labels.filter(label => !(onPaper && label.hidden)).map(label => {
    const set = chart.data.datasets[label.datasetIndex];
    const asLine = {pointStyle: 'line', lineDash: set.borderDash || [], lineWidth: 2, strokeStyle: set.borderColor};
    if (set.showLine || set.type === 'line') return Object.assign(label, asLine);
    label.pointStyle = set.pointStyle === 'circle' ? disc(set.borderColor) : set.pointStyle || 'rect';
    return label;
  });
}

/* A plot into #plot-name: sets() gives its curves whenever it is drawn, words(item) what hovering says. */
function plot(name, type, sets, scales, words) {
  const labels = {usePointStyle: true, pointStyleWidth: 26, boxHeight: 7, generateLabels: legendLabels};
  const options = {
    parsing: false,
    normalized: false,
    scales,
    layout: {padding: {top: 26}},
    interaction: {mode: 'nearest', intersect: false},
    plugins: {legend: {position: 'bottom', labels}, tooltip: {callbacks: {title: () => '', label: words}}}
  };
  const chart = new Chart($('plot-' + name), {type, data: {datasets: []}, plugins: [frameDrawing], options});
  chart.sets = sets;
  chart.home = {x: [scales.x.min, scales.x.max], y: [scales.y.min, scales.y.max]};
  addFrame(chart);
  addKeys(chart);
  addButtons(chart);
  charts[name] = chart;
  redraw(name);
}

/* Curves that the reader has hidden stay so: they are known by their key, or where they have none by their label. */
const keyOf = set => set.key || set.label;

function redraw(name) {
  const chart = charts[name];
  for (const axisOptions of Object.values(chart.options.scales)) {
    axisOptions.ticks.color = axisOptions.title.color = theme.ink; /* Chart.js has copied the default of then */
    axisOptions.grid.color = axisOptions.grid.borderColor = theme.grid;
  }
  const hidden = chart.data.datasets.filter((set, i) => !chart.isDatasetVisible(i)).map(keyOf);
  chart.data.datasets = chart.sets();
  chart.data.datasets.forEach((set, i) => chart.setDatasetVisibility(i, !hidden.includes(keyOf(set))));
  chart.update();
}

const line = (label, points, stroke, more) => {
  const plain = {borderWidth: 2, pointRadius: 0, pointHitRadius: 6, tension: 0};
  const set = {type: 'scatter', showLine: true, label, data: points, borderColor: stroke, backgroundColor: stroke};
  return Object.assign(set, plain, more);
};

const marks = (label, points, stroke, pointStyle, more) => {
  const set = {type: 'scatter', showLine: false, label, data: points, borderColor: stroke, backgroundColor: stroke};
  return Object.assign(set, {pointRadius: 5, pointStyle}, more);
};
