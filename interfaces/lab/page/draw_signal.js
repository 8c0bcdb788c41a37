/* draw_signal.js - one period: x above, normal and friction force of a contact below, each with its samples. */
'use strict';

/* Of a signal's table, column c over th in periods; `closed` repeats the first instant at the end. */
function seriesOf(table, c, closed) {
  const points = Array.from({length: table.rows}, (_, i) => [i / table.rows, table.values[i * table.columns + c]]);
  return closed && points.length ? points.concat([[1, points[0][1]]]) : points;
}

const columnsOf = contact => ({u: 2 + 4 * contact, N: 4 + 4 * contact, T: 5 + 4 * contact});

function drawSignal(svg, state, motion) {
  const box = boxOf(svg, 360), cut = 120;
  if (!motion || !motion.exact) return putWords(svg, box, whyNothing(motion));
  const {exact, samples} = motion, dots = samples.rows > 256 ? 1.5 : samples.rows > 64 ? 2.2 : 3.5;
  const [low, high] = rangeOf(columnOf(exact, 1));
  const upper = panel(Object.assign({}, box, {bottom: cut}), {from: 0, to: 1, hidden: true}, {from: low, to: high, title: 'x'});
  let content = upper.svg + clipped(upper, lineOf(upper, seriesOf(exact, 1, true), 'curve exact') +
    marksOf(upper, seriesOf(samples, 1), 'dot', dots, 'fill-sampled'));
  if (state.contacts.length) {
    const at = columnsOf(state.look), values = [at.N, at.T].flatMap(c => columnOf(exact, c).concat(columnOf(samples, c)));
    const [least, most] = rangeOf(values);
    const lower = panel(Object.assign({}, box, {top: cut + 16}), {from: 0, to: 1, title: 'omega t, in periods'},
      {from: least, to: most, title: 'N and T'});
    content += lower.svg + clipped(lower, lineOf(lower, seriesOf(exact, at.N, true), 'curve exact') +
      lineOf(lower, seriesOf(exact, at.T, true), 'curve traction') +
      [at.N, at.T].map(c => marksOf(lower, seriesOf(samples, c), 'dot', dots, 'fill-sampled')).join(''));
  }
  put(svg, box, content);
}
