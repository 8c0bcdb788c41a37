/* draw_curve.js - section 2: response curves, special points, transients, and omega to be dragged along. */
'use strict';

/* Rows of a curve as runs of one stability: [{stable, points}], neighbours share a point. */
function runsOf(curve) {
  const runs = [];
  for (const {omega, amplitude, branch, stable: verdict} of curve.list) {
    const stable = verdict !== 'no', last = runs[runs.length - 1];
    if (last && last.branch === branch) last.points.push([omega, amplitude]);
    if (!last || last.branch !== branch || last.stable !== stable) runs.push({stable, branch, points: [[omega, amplitude]]});
  }
  return runs;
}

const curveLines = (p, curve, classes) =>
  runsOf(curve).map(run => lineOf(p, run.points, classes + (run.stable ? '' : ' unstable'))).join('');

/* Folds, other stability limits, contact changes. */
function specialMarks(p, specials, only) {
  const points = (...kinds) => specials.list.filter(row => kinds.includes(row.kind)).map(row => [row.omega, row.amplitude]);
  const folds = marksOf(p, points('turning point'), 'diamond', only ? 3 : 5, only ? 'fill-sampled' : 'fill-folded');
  return only ? folds : marksOf(p, points('contact change'), 'tick', 6, 'tick') +
    marksOf(p, points('period doubling', 'Neimark-Sacker'), 'square', 4, 'fill-other') + folds;
}

const transientMarks = (p, transients) =>
  marksOf(p, transients.list.filter(row => row.status === 'ok').map(row => [row.omega, row.amplitude]), 'cross', 4, 'cross');

/* Sampled curves drawn: the whole one; where it is not there, or ends early, the one next to the exact one, too; else that
 * of a case before. */
function samplesShown(seen, text) {
  const now = one => (one && one.text === text ? one : null), whole = now(seen.sampled), beside = now(seen.neighbours);
  const drawn = [whole && whole.curve.status === 0 ? null : beside, whole].filter(one => one);
  return drawn.length ? drawn : [seen.sampled || seen.neighbours].filter(one => one);
}

/* Amplitudes shown: all of the exact curve, and of the sampled one what does not shrink that to a line. */
function amplitudesOf(seen, samples) {
  const largest = table => (table ? table.list.reduce((most, row) => (row.amplitude > most ? row.amplitude : most), 0) : 0);
  const exact = largest(seen.exact && seen.exact.curve), sampled = Math.max(0, ...samples.map(one => largest(one.curve)));
  return 1.06 * (exact ? Math.max(exact, Math.min(sampled, 1.6 * exact)) : sampled) || 1;
}

/* The panel drawn. seen: the answers so far, see main.js; text: the case as it is now: what answers another one is drawn
 * faint. */
function drawCurve(svg, state, seen, text) {
  const box = boxOf(svg, Math.max(220, Math.min(400, 0.5 * boxOf(svg, 0).width, 0.42 * innerHeight)));
  const [from, to] = [state.from, state.to].sort((a, b) => a - b);
  const samples = samplesShown(seen, text), highest = amplitudesOf(seen, samples);
  const p = panel(box, {from, to, title: 'omega [rad per unit time]'}, {from: 0, to: highest, title: 'amplitude of x'});
  const old = answer => (answer.text === text ? '' : ' old');
  let inside = lineOf(p, [[state.omega, 0], [state.omega, highest]], 'cursor');
  for (const one of samples) {
    inside += curveLines(p, one.curve, 'curve thin sampled' + old(one));
    if (one.specials) inside += `<g class="${old(one)}">${specialMarks(p, one.specials, true)}</g>`;
  }
  if (seen.exact && seen.exact.curve) {
    inside += curveLines(p, seen.exact.curve, 'curve exact' + old(seen.exact));
    if (seen.exact.specials) inside += specialMarks(p, seen.exact.specials);
    if (seen.exact.transients) inside += transientMarks(p, seen.exact.transients);
  }
  inside += marksOf(p, provenOrbits(state).map(orbit => [orbit.omega, orbit.amplitude]), 'dot', 7, 'proven');
  inside += solutionMarks(p, seen.motion);
  put(svg, box, p.svg + clipped(p, inside));
  return p;
}

function solutionMarks(p, motion) {
  if (!motion || !motion.solutions) return '';
  const point = row => [motion.omega, row.amplitude];
  const others = motion.solutions.filter((row, i) => i !== motion.chosen).map(point);
  const chosen = motion.solutions.slice(motion.chosen, motion.chosen + 1).map(point);
  return marksOf(p, others, 'dot', 4, 'hollow') + marksOf(p, motion.chosen < 0 ? [] : chosen, 'dot', 6, 'fill-exact');
}

let curvePanel = null; /* of section 2, as drawn last */

/* onMove({omega, near}, moving): the pointer is there; moving until it is let go. */
function dragCurve(svg, onMove) {
  let dragging = false;
  const there = event => {
    const frame = svg.getBoundingClientRect(), {box, sx, sy} = curvePanel, scale = box.width / frame.width;
    const clip = (v, a, b) => Math.min(b, Math.max(a, v));
    const x = clip((event.clientX - frame.left) * scale, box.left, box.right);
    const y = clip((event.clientY - frame.top) * scale, box.top, box.bottom);
    return {omega: +sx.back(x).toPrecision(5), near: sy.back(y)};
  };
  svg.addEventListener('pointerdown', event => {
    if (!curvePanel || event.button !== 0) return;
    dragging = true;
    svg.setPointerCapture(event.pointerId);
    onMove(there(event), true);
  });
  svg.addEventListener('pointermove', event => dragging && onMove(there(event), true));
  const end = event => {
    if (dragging) onMove(there(event), false);
    dragging = false;
  };
  svg.addEventListener('pointerup', end);
  svg.addEventListener('pointercancel', () => (dragging = false));
}
