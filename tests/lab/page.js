/* page.js - what the tests of the lab's page do in a page of chromium.js: wait, point, drag, press Tab. */
'use strict';

/* Until the expression is true in the page. */
async function until(p, expression, words = expression) {
  const end = Date.now() + 60000;
  while (Date.now() < end) {
    if (await p.evaluate(`!!(${expression})`)) return;
    await new Promise(done => setTimeout(done, 30));
  }
  throw new Error('waited in vain: ' + words);
}

const still = p => until(p, 'seen.errors && seen.exact && seen.exact.text === textNow() && seen.sampled && seen.sampled.text === textNow() && ' +
  '(state.sampled || seen.errors.omega === state.omega) && !dirty.size', 'everything is drawn');
const exactDrawn = p => until(p, '!workers.exact.busy() && seen.exact && seen.exact.text === textNow() && !dirty.size', 'the exact curve is drawn');
const median = list => list.slice().sort((a, b) => a - b)[Math.floor(list.length / 2)];
const middleOf = (p, id) => p.evaluate(`(() => { $('${id}').scrollIntoView({block: 'center'}); const b = $('${id}').getBoundingClientRect(); return {x: b.left + b.width / 2, y: b.top + b.height / 2, width: b.width}; })()`);

/* A motion is there after each of n steps of a drag from `from` to `to` [CSS px] before the next is made. */
async function drag(p, from, to, n) {
  await p.evaluate('times.drawn.length = 0');
  await p.pointer('mousePressed', from.x, from.y);
  for (let i = 1; i <= n; ++i) {
    const f = i / n, count = await p.evaluate('times.drawn.length');
    await p.pointer('mouseMoved', from.x + f * (to.x - from.x), from.y + f * (to.y - from.y));
    await until(p, `times.drawn.length > ${count} || !workers.exact.busy()`);
  }
  await p.pointer('mouseReleased', to.x, to.y);
  return median(await p.evaluate('times.drawn'));
}

/* Tab until the expression holds of `at`, the element that has the focus. */
async function tabTo(p, expression) {
  for (let i = 0; i < 80; ++i) {
    if (await p.evaluate(`!!document.activeElement && (() => { const at = document.activeElement; return ${expression}; })()`)) return;
    await p.key('Tab');
  }
  throw new Error('Tab does not reach ' + expression);
}

module.exports = {until, still, exactDrawn, median, middleOf, drag, tabTo};
