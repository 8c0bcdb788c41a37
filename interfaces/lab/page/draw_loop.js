/* draw_loop.js - friction force over tangential motion: the area is the work of a period. */
'use strict';

function drawLoop(svg, state, motion) {
  const box = boxOf(svg, 360);
  if (!motion || !motion.exact) return putWords(svg, box, whyNothing(motion));
  if (!state.contacts.length) return putWords(svg, box, 'There is no contact.');
  const columns = columnsOf(state.look), {exact, samples} = motion, elastic = state.contacts[state.look].law;
  const at = elastic ? {u: 1, T: columns.N} : columns; /* f over d */
  const pairs = table => Array.from({length: table.rows}, (_, i) => [table.values[i * table.columns + at.u], table.values[i * table.columns + at.T]]);
  const loop = pairs(exact), [from, to] = rangeOf(loop.map(p => p[0])), [low, high] = rangeOf(loop.concat(pairs(samples)).map(p => p[1]));
  const p = panel(box, {from, to, title: elastic ? 'd' : 'tangential motion u'}, {from: low, to: high, title: elastic ? 'force f' : 'friction force T'});
  const closed = loop.concat(loop.slice(0, 1));
  put(svg, box, p.svg + clipped(p, lineOf(p, closed, 'area') + lineOf(p, closed, 'curve traction') +
    marksOf(p, pairs(samples), 'dot', samples.rows > 64 ? 2 : 3.5, 'fill-sampled')));
}

/* Work, slip path and forces of the contact shown. */
function loopWords(state, motion) {
  if (!motion || !motion.work) return whyNothing(motion);
  if (state.look >= motion.work.rows) return 'There is no contact.';
  const [regime, least, most, traction, path, work] = motion.work.values.subarray(6 * state.look, 6 * state.look + 6);
  if (state.contacts[state.look].law) return `An elastic force from ${show(least, 4)} to ${show(most, 4)}, without work.`;
  const what = ['touches without friction', 'sticks', 'slips', 'separates'][regime];
  return `The contact ${what}; N from ${show(least, 4)} to ${show(most, 4)}, |T| to ${show(traction, 4)}, slip path ${show(path, 4)}, ` +
    `work per period ${show(work, 5)} (length, force and their product in the case's units).`;
}
