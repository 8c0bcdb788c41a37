/* ---- 2 response ------------------------------------------------------------------------------------------------ */

const verdictStyle = {
  match: ['circle', 2],
  differs: ['triangle', 4],
  other_branch: ['rect', 1],
  unstable: ['rectRot', 3],
  aperiodic: ['star', 4],
  not_settled: ['cross', 5],
  solver_failed: ['crossRot', 4],
  undecided: ['star', 5]
};
const responseToggles = ['unstable', 'transient', 'special', 'turned'];

const quantity = () => $('quantity').value;
const isLogarithmic = () => $('log-amplitude').checked;

/* A value as it is drawn: a mean may be negative, which a logarithmic axis cannot show. */
const drawn = v => (v === null ? NaN : !isLogarithmic() ? v : v === 0 ? NaN : Math.abs(v));

/* What each point of a curve is drawn as. */
function kindsOf(curve, q) {
  const kinds = {yes: 'stable', unknown: 'unknown', no: 'unstable'};
  return (curve.stable || []).map((s, i) => (q === 'mean' && curve.mean_free[i] === 'yes' ? 'open' : kinds[s]));
}

/* The points of a curve that are drawn as `wanted` (null: all), in the curve's order; a gap (NaN) between runs, and a
 * run goes on to where the next one begins. */
function runs(curve, q, wanted) {
  const out = [];
  const kinds = kindsOf(curve, q);
  const isHere = i => wanted === null || kinds[i] === wanted;
  kinds.forEach((kind, i) => {
    const before = i > 0 && isHere(i - 1);
    const value = curve[q][i];
    const point = {x: along(curve.omega[i]), y: drawn(value), value};
    Object.assign(point, {branch: curve.branch[i], contact: curve.contact[i]});
    if (isHere(i) && !before && i > 0) out.push({x: NaN, y: NaN});
    if (isHere(i) || before) out.push(Object.assign(point, {kind: isHere(i) ? kind : wanted}));
  });
  return out;
}

function transientSets(q) {
  const rows = data.response.transient;
  return [...new Set(rows.map(t => t.verdict))].map(verdict => {
    const [style, tint] = verdictStyle[verdict] || ['star', 6];
    const order = verdict === 'unstable' ? -1 : verdict === 'match' ? -1.2 : -1.5; /* the rare on top */
    const shown = rows.filter(t => t.verdict === verdict && !(q === 'mean' && t.mean_free));
    const points = shown.map(t => ({x: along(t.omega), y: drawn(t[q]), value: t[q], row: t}));
    return marks('transient: ' + verdict, points, colour(tint), style, {borderWidth: 2, order, tag: 'transient'});
  });
}

function responseSets() {
  const r = data.response;
  const q = quantity();
  const sets = [line('HBM, stable', runs(r.curve, q, 'stable'), colour(0))];
  const add = (tag, label, points, tint, more) =>
    points.length && sets.push(line(label, points, colour(tint), Object.assign({tag}, more)));
  add('unstable', 'HBM, unstable', runs(r.curve, q, 'unstable'), 4, {borderDash: [6, 4]});
  add('stable', 'HBM, stability unknown', runs(r.curve, q, 'unknown'), 7, {borderDash: [2, 3]});
  add('stable', 'HBM, mean open: a matter of history', runs(r.curve, q, 'open'), 7, {borderDash: [1, 5]});
  const turned = r.mean_kept ? 'HBM without harmonic 0' : 'HBM with harmonic 0';
  add('turned', turned, runs(r.turned, q, null), 5, {borderWidth: 1.5, borderDash: [10, 3, 2, 3]});
  sets.push(...transientSets(q));
  if (q !== 'amplitude') return sets;
  const specials = r.specials.map(s => Object.assign({x: along(s.omega), y: s.amplitude, value: s.amplitude}, s));
  const look = {pointRadius: 4, borderWidth: 1.5, order: -2, tag: 'special'};
  return sets.concat([marks('turning points and the like', specials, theme.ink, 'crossRot', look)]);
}

function responseWords(item) {
  const p = item.raw;
  const head = alongName + ' ' + show(p.x, 7) + ', ' + quantity() + ' ' + show(p.value, 7) + ' ' + units.length;
  if (p.what) return [p.what, head, 'branch ' + p.branch];
  if (p.row) {
    const started = 'transient started on branch ' + p.row.branch + ': ' + p.row.verdict;
    return [head, started, 'relative error of the amplitude ' + show(p.row.error, 3)];
  }
  const kinds = {unknown: 'stability unknown', open: 'any mean between the slider\'s ends of stick would do'};
  return [head, 'branch ' + p.branch + ', ' + (kinds[p.kind] || p.kind) + ', contact: ' + p.contact];
}

function toggleResponse() {
  const chart = charts.response;
  const off = responseToggles.filter(tag => !$('show-' + tag).checked);
  chart.data.datasets.forEach((set, i) => chart.setDatasetVisibility(i, !off.includes(set.tag)));
  chart.update();
}

function drawResponse() {
  const chart = charts.response;
  const name = $('quantity').selectedOptions[0].textContent;
  const sign = isLogarithmic() && quantity() === 'mean';
  chart.options.scales.y.type = isLogarithmic() ? 'logarithmic' : 'linear';
  chart.options.scales.y.title.text = (sign ? '|' + name + '|' : name) + ' [' + units.length + ']';
  setHome(chart, 'y', [undefined, undefined]);
  setHome(chart, 'x', rangeOf($('range').value));
  redraw('response');
  toggleResponse();
}

/* Of the whole curve, or of the part with at least a tenth of the largest amplitude and something around it. */
function rangeOf(which) {
  const w = (data.response.curve.omega || [0, 1]).map(along);
  const a = data.response.curve.amplitude || [0, 0];
  const top = Math.max(...a);
  const near = which === 'whole' ? w : w.filter((x, i) => a[i] >= 0.1 * top);
  const [from, to] = [Math.min(...near), Math.max(...near)];
  const more = which === 'whole' ? 0 : 0.25 * (to - from);
  return [Math.max(from - more, Math.min(...w)), Math.min(to + more, Math.max(...w))];
}

function startResponse() {
  const [from, to] = rangeOf('whole');
  const peak = rangeOf('peak');
  $('range').value = peak[1] - peak[0] < 0.2 * (to - from) ? 'peak' : 'whole';
  const scales = {x: axis(alongTitle, 'linear', {min: from, max: to}), y: axis('amplitude')};
  plot('response', 'scatter', responseSets, scales, responseWords);
  $('turned-name').textContent = data.response.mean_kept ? "without harmonic 0 (the paper's mode)" : 'with harmonic 0';
  $('show-turned').parentNode.hidden = !data.response.turned.omega;
  for (const id of ['quantity', 'log-amplitude', 'range']) $(id).addEventListener('change', drawResponse);
  for (const tag of responseToggles) $('show-' + tag).addEventListener('change', toggleResponse);
  drawResponse();
}
