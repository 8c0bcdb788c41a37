/* draw_error.js - section 4: relative errors of the amplitude over N and over H, both axes logarithmic, with slopes. */
'use strict';

const drawnHarmonics = state => inOrder([1, 3, 5, 10, state.H]);

/* {H, N, amplitude, error, aliasing} of lab_errors; N = 0: exact forces. */
function errorRows(errors) {
  const rows = Array.from({length: errors.rows}, (_, i) => {
    const [H, N, , amplitude, error, solves] = errors.values.subarray(6 * i, 6 * i + 6);
    return {H, N, amplitude, error, solves};
  });
  const exact = H => rows.find(r => r.H === H && r.N === 0);
  return rows.map(r => Object.assign(r, {aliasing: r.N ? Math.abs(r.amplitude - exact(r.H).amplitude) / exact(r.H).amplitude : NaN}));
}

/* The power p of N^-p that fits best; NaN with fewer than three errors. */
function fallOverN(rows, measure) {
  const good = rows.filter(r => r.N && r[measure] > 1e-12);
  return good.length < 3 ? NaN : fallOf(good.map(r => r.N), good.map(r => r[measure]));
}

const decadesAround = values => {
  const good = values.filter(v => v > 1e-13);
  if (!good.length) return [1e-6, 1];
  return [Math.pow(10, Math.floor(Math.log10(Math.min(...good)))), Math.pow(10, Math.ceil(Math.log10(Math.max(...good)) + 1e-9))];
};

/* A straight line of slope -power through (x, y) to the axis' end, with its name. */
function slopeLine(p, x, y, power, end, name) {
  const there = y * Math.pow(end / x, -power);
  return lineOf(p, [[x, y], [end, there]], 'slope') + `<text x="${round(p.sx(end)) - 4}" y="${round(Math.min(p.sy(there), p.box.bottom) - 5)}" text-anchor="end">${name}</text>`;
}

function drawErrorOverN(svg, state, errors, measure) {
  const box = boxOf(svg, 320), rows = errors ? errorRows(errors) : [];
  const [low, high] = decadesAround(rows.filter(r => r.N).map(r => r[measure]));
  const samples = inOrder(rows.filter(r => r.N).map(r => r.N));
  if (!samples.length) return putWords(svg, box, errors ? 'Nothing to measure against.' : whyNothing(null));
  const first = samples[0], last = samples[samples.length - 1];
  const ticks = samples.filter(n => Number.isInteger(Math.log2(n)) && Math.log2(n) % 2 === 0);
  const p = panel(box, {from: first, to: last, log: true, title: 'samples N', ticks}, {from: low, to: high, log: true, title: 'relative error'});
  const lines = drawnHarmonics(state).map((H, i) => {
    const own = rows.filter(r => r.H === H && r.N && r[measure] > 0).map(r => [r.N, r[measure]]);
    return lineOf(p, own, 'curve line-' + i) + marksOf(p, own.filter(([n]) => n === state.N), 'square', 4, 'fill-ink');
  });
  const slopes = slopeLine(p, first, high, 1, last, '1/N') + slopeLine(p, first, high, 2, last, '1/N\u00b2');
  put(svg, box, p.svg + clipped(p, slopes + lines.join('')) + keysOf(p, drawnHarmonics(state).map(H => 'H = ' + H)));
}

/* A line and a word for each, below left. */
function keysOf(p, words) {
  return words.map((word, i) => {
    const y = p.box.bottom - 8 - 15 * (words.length - 1 - i), x = p.box.left + 8;
    return `<path class="curve line-${i}" d="M${x} ${y - 4}h18"/><text x="${x + 23}" y="${y}">${word}</text>`;
  }).join('');
}

function drawErrorOverH(svg, state, errors) {
  const box = boxOf(svg, 320), rows = errors ? errorRows(errors).filter(r => !r.N) : [];
  if (!rows.some(r => r.error > 0)) return putWords(svg, box, errors ? 'Nothing to measure against.' : whyNothing(null));
  const [low, high] = decadesAround(rows.map(r => r.error)), all = rows.map(r => r.H);
  const p = panel(box, {from: Math.min(...all), to: Math.max(...all), log: true, title: 'harmonics H', ticks: all},
    {from: low, to: high, log: true, title: 'relative error'});
  const points = rows.filter(r => r.error > 0).map(r => [r.H, r.error]);
  put(svg, box, p.svg + clipped(p, lineOf(p, points, 'curve exact') + marksOf(p, points, 'dot', 3.5, 'fill-exact')));
}

function errorWords(state, seen, measure) {
  if (!seen) return '';
  if (!seen.errors.rows) return `At omega = ${show(seen.omega)} there is no orbit of the exact law next to this solution to measure errors against: ${seen.errors.message || 'none was found'}.`;
  const rows = errorRows(seen.errors), own = rows.filter(r => r.H === state.H), at = own.find(r => r.N === state.N), exact = own.find(r => !r.N);
  const fall = fallOverN(own, 'aliasing');
  const parts = [`At omega = ${show(seen.omega)}, H = ${state.H}: with exact forces the amplitude is off by ${percent(exact ? exact.error : NaN)}`];
  parts.push(at && isFinite(at.error) ? `, with ${state.N} samples by ${percent(at.error)}; sampling alone moves it by ${percent(at.aliasing)}` : `; with ${state.N} samples no solution was found next to it`);
  parts.push(isFinite(fall) ? `, which falls like 1/N to the power ${show(fall, 2)} over the N shown.` : '.');
  return parts.join('');
}

/* Head and rows of the table: an H a column, an N a row. */
function errorTable(errors, measure) {
  const rows = errors ? errorRows(errors) : [], H = inOrder(rows.map(r => r.H)), N = inOrder(rows.map(r => r.N));
  const value = (h, n) => {
    const r = rows.find(at => at.H === h && at.N === n);
    return show(r ? (n ? r[measure] : r.error) : NaN, 2);
  };
  const head = '<tr><th scope="col">N</th>' + H.map(h => `<th scope="col">H = ${h}</th>`).join('') + '</tr>';
  const body = N.map(n => `<tr><td>${n || 'exact forces, whole error'}</td>` + H.map(h => `<td>${value(h, n)}</td>`).join('') + '</tr>').join('');
  return {head, body};
}
