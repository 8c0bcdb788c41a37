/* draw_curve.js - section 2: response curves, special points, transients, and omega to be dragged along. */
'use strict';

const regimes = ['linear', 'stick', 'slip', 'separation', 'smooth'];

/* Rows of a curve as runs of one stability: [{stable, points}], neighbours share a point. */
function runsOf(curve) {
  const runs = [];
  for (let i = 0; i < curve.rows; ++i) {
    const row = curve.values.subarray(i * curve.columns), point = [row[labColumn.omega], row[labColumn.amplitude]];
    const stable = row[labColumn.stable] >= 0, last = runs[runs.length - 1];
    if (last && last.branch === row[labColumn.branch]) last.points.push(point);
    if (!last || last.branch !== row[labColumn.branch] || last.stable !== stable)
      runs.push({stable, branch: row[labColumn.branch], points: [point]});
  }
  return runs;
}

const curveLines = (p, curve, classes) =>
  runsOf(curve).map(run => lineOf(p, run.points, classes + (run.stable ? '' : ' unstable'))).join('');

/* Points of hbm_special_kind: folds, other stability limits, contact changes. */
function specialMarks(p, specials, only) {
  const points = kinds => Array.from({length: specials.rows}, (_, i) => specials.values.subarray(6 * i, 6 * i + 6))
    .filter(row => kinds.includes(row[3])).map(row => [row[0], row[1]]);
  const folds = marksOf(p, points([0]), 'diamond', only ? 3 : 5, only ? 'fill-sampled' : 'fill-folded');
  return only ? folds : marksOf(p, points([2]), 'tick', 6, 'tick') + marksOf(p, points([1, 3]), 'square', 4, 'fill-other') + folds;
}

function transientMarks(p, transients) {
  const points = [];
  for (let i = 0; i < transients.rows; ++i) {
    const row = transients.values.subarray(i * transients.columns);
    if (row[1] === 0) points.push([row[0], row[2]]);
  }
  return marksOf(p, points, 'cross', 4, 'cross');
}

/* Sampled curves drawn: the whole one; where it is not there, or ends early, the one next to the exact one, too; else that
 * of a case before. */
function samplesShown(seen, text) {
  const now = one => (one && one.text === text ? one : null), whole = now(seen.sampled), beside = now(seen.neighbours);
  const drawn = [whole && whole.curve.status === 0 ? null : beside, whole].filter(one => one);
  return drawn.length ? drawn : [seen.sampled || seen.neighbours].filter(one => one);
}

/* Amplitudes shown: all of the exact curve, and of the sampled one what does not shrink that to a line. */
function amplitudesOf(seen, samples) {
  const largest = table => (table ? columnOf(table, labColumn.amplitude).reduce((a, b) => (b > a ? b : a), 0) : 0);
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
  const point = row => [motion.omega, row[labColumn.amplitude]];
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
