/* browser.js CHROMIUM LAB_HTML LAB_ASKED [FOLDER] - the page in headless Chromium, from disk, the network off: every field moves the drawings, the curve is
 * dragged, the keyboard alone does the lesson, whose numbers are those of the native library; address and case files keep the state; nothing is wider than
 * the screen, nothing comes on the console, nothing is asked for. Prints times; into FOLDER pictures of three widths in both schemes, and the print. Exit 1: something does not hold. */
'use strict';
const fs = require('fs'), path = require('path');
const {open} = require('./chromium.js');
const {clientOf} = require('./native.js'), {lessonOf, limitOfStep} = require('./lesson_steps.js');
const {until, still, exactDrawn, median, middleOf, drag, tabTo} = require('./page.js');

const [chromium, page, native, folder] = process.argv.slice(2);
const address = 'file://' + path.resolve(page);
const mostBytes = 3e6;
let failed = 0;

function check(good, words) {
  if (good) return;
  ++failed;
  console.log('NOT SO: ' + words);
}

/* Of the page and its workers. */
function nothingWasHeard(p) {
  check(!p.lines.length, 'on the console: ' + p.lines.join('\n').slice(0, 2000));
  check(!p.requests.length, 'asked for: ' + p.requests.join('\n').slice(0, 2000));
}

/* ---- */

/* The drawings of section 3 and the exact curve, as text. */
const drawn = 'JSON.stringify([seen.exact.curve.values.join(), ...["draw-signal", "draw-loop", "draw-spectrum"].map(d => $(d).innerHTML.replace(/clip-\\d+/g, ""))])';

/* Of a contact that slips: case 2's sticks, and whatever its friction is, nothing changes. */
const slipping = 'take(Object.assign(copyOf(firstState), {contacts: [Object.assign({}, someContact, {mu: 0.05})]}))';

async function everyFieldMovesTheDrawings(p) {
  await p.evaluate(slipping);
  await still(p);
  const sliders = await p.evaluate('Array.from(document.querySelectorAll("input[type=range]")).map(s => s.id)');
  check(sliders.length === 13, 'a slider for each of 13 fields: ' + sliders.length);
  for (const id of sliders) {
    const before = await p.evaluate(drawn);
    await p.evaluate(`(() => { const s = $('${id}'); s.value = Number(s.value) + 12; s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change')); })()`);
    await exactDrawn(p);
    check(before !== await p.evaluate(drawn), id + ' changes the drawings');
    check(Number(await p.evaluate(`$('${id}').value`)) > 0, id + ' stays where it was put');
  }
  await p.evaluate('take(copyOf(firstState))'); /* one that sticks again: it starts from where its slider is put */
  await still(p);
  for (const id of ['field-mean', 'field-restart', 'field-sampled']) {
    const before = await p.evaluate(drawn);
    await p.evaluate(`(() => { const s = $('${id}'); s.selectedIndex = 1 - s.selectedIndex; s.dispatchEvent(new Event('change')); })()`);
    await still(p);
    await until(p, `${drawn} !== ${JSON.stringify(before)}`, id + ' changes the drawings');
  }
  await p.evaluate(slipping);
  await still(p);
  await p.evaluate('$("add-contact").click()');
  await exactDrawn(p);
  check(await p.evaluate('state.contacts.length === 2 && document.querySelectorAll("fieldset").length === 2 && seen.motion.work.rows === 2'), 'a second contact');
  await p.evaluate('document.querySelectorAll("fieldset button")[1].click()');
  await p.evaluate('take(copyOf(firstState))');
  await still(p);
}

/* A polynomial's enough samples are said; a table is typed; the address keeps both. */
async function otherLawsHaveFields(p) {
  const choose = i => p.evaluate(`(() => { const s = $('contact-0-law'); s.selectedIndex = ${i}; s.dispatchEvent(new Event('change')); })()`);
  const kept = 'JSON.stringify(stateOfAddress(addressOf(state), firstState).contacts) === JSON.stringify(state.contacts)';
  const type = text => p.evaluate(`(() => { const s = $('contact-0-points'); s.value = '${text}'; s.dispatchEvent(new Event('input')); })()`);
  for (const [N, words] of [[41, '41 is enough'], [40, '40 is too few']]) {
    if (N === 41) await choose(1);
    await p.evaluate(`alter(s => (s.N = ${N}), false)`);
    await still(p);
    await until(p, `$('spectrum-words').textContent.includes('= 41 samples are exact for the force and its Jacobian, and N = ${words}')`, words);
  }
  check(await p.evaluate(kept), 'the address keeps a polynomial');
  await choose(2);
  await type('[[0, 0], [0, 1]]');
  check((await p.evaluate('$("contact-0-points-mistake").textContent')).includes('d ascending'), 'points that are none');
  await type('[[-3, -50], [-2, 0], [2, 0], [3, 80]]');
  await still(p);
  check(await p.evaluate('state.contacts[0].points === "[[-3,-50],[-2,0],[2,0],[3,80]]" && seen.motion.work.rows === 1'), 'points are typed');
  check(await p.evaluate(kept), 'the address keeps a table');
  await p.evaluate('take(copyOf(firstState))');
  await still(p);
}

async function draggingIsQuick(p) {
  const curve = await middleOf(p, 'draw-curve'), before = await p.evaluate('state.omega');
  const alongCurve = await drag(p, {x: curve.x - 0.3 * curve.width, y: curve.y}, {x: curve.x, y: curve.y}, 25);
  check(await p.evaluate('state.omega') !== before, 'omega is dragged along the curve');
  await still(p);
  const slider = await middleOf(p, 'contact-0-kn-slider');
  const alongSlider = await drag(p, {x: slider.x, y: slider.y}, {x: slider.x + 0.2 * slider.width, y: slider.y}, 25);
  await p.evaluate('take(copyOf(firstState))');
  await still(p);
  const traced = await p.evaluate(`new Promise(done => {
    const list = [], worker = asker(workerAddress(), part => {
      if (part.part === 'curve' && part.curve.status === 0 && part.curve.rows > 50) list.push(part.curve.ms);
      if (part.part === 'refused') done([]);
      if (part.part !== 'end') return;
      if (list.length === 21) return done(list);
      worker.ask({text: textNow() + ' '.repeat(list.length + 1), force: 0, more: false});
    });
    worker.ask({text: textNow(), force: 0, more: false});
  })`);
  console.log(`median times on the clock: curve of case 2, H = 10, in the worker ${median(traced).toFixed(1)} ms; from a change to motion, curve and spectrum drawn: ` +
    `dragging omega ${alongCurve.toFixed(1)} ms, a stiffness ${alongSlider.toFixed(1)} ms; sampled curve, N = 64: ${(await p.evaluate('seen.sampled.curve.ms')).toFixed(0)} ms`);
}

/* ---- the lesson ---- */

async function theKeyboardDoesTheLesson(p) {
  const numbers = lessonOf(clientOf(native)).map(told => told.number);
  check(numbers.length === 7, numbers.length + ' steps');
  await p.evaluate('document.activeElement.blur(); window.scrollTo(0, 0)');
  await tabTo(p, 'at.dataset.go === "lesson"');
  await p.key('Enter');
  await tabTo(p, 'at.parentNode.id === "steps"');
  for (let i = 0; i < numbers.length; ++i) {
    await p.key('Enter');
    check(await p.evaluate(`lessonAt === ${i} && document.activeElement.id === 'prediction'`), `step ${i + 1} asks`);
    await p.key('7', 'Digit7', '7');
    await p.key('Enter');
    await until(p, '!$("step-answer").hidden && $("step-answer").textContent.startsWith("You said 7")', 'step ' + (i + 1) + ' is answered');
    const told = await p.evaluate('lastTold');
    check(told.step === i && Math.abs(told.number - numbers[i]) <= limitOfStep(i) * Math.abs(numbers[i]), `step ${i + 1}: ${told.number} is ${numbers[i]}`);
    check(!/NaN|undefined|Infinity/.test(await p.evaluate('$("step-answer").textContent')), 'words of step ' + (i + 1));
    if (i + 1 < numbers.length) await tabTo(p, 'at.id === "step-next"');
  }
  console.log('the lesson: ' + numbers.map(n => +n.toPrecision(6)).join(', '));
}

/* ---- */

/* What is said of the sampled curve is of the case as it is now, or that it is on its way. */
async function nothingOldIsTold(p) {
  await p.evaluate('take(Object.assign(copyOf(firstState), {H: 9, N: 100}))');
  await until(p, '/on its way/.test($("curve-words").textContent) && $("cost").rows[2].cells[1].textContent === "-"', 'the sampled curve is on its way');
  await still(p);
  await until(p, '!/on its way/.test($("curve-words").textContent) && Number($("cost").rows[2].cells[1].textContent) > 50', 'the sampled curve is there');
}

async function addressesAndCasesKeepTheState(p) {
  await p.evaluate('take(Object.assign(copyOf(firstState), {mass: 1.25, H: 7, N: 77, mean: false, omega: 8, restart: "sample", title: "A & B: \\"C\\""}))');
  await still(p);
  await until(p, 'location.hash.includes("mass=1.25")');
  const same = 'JSON.stringify(Object.assign({}, state, {near: 0}))', before = await p.evaluate(same);
  check(await p.evaluate('JSON.stringify(Object.assign({}, stateOfAddress(location.hash, firstState), {near: 0}))') === before, 'the address is the state');
  const text = await p.evaluate('$("case").value');
  await p.evaluate('take(copyOf(firstState)); $("case").value = "oscillator: {mass: -1}"; $("read-case").click()');
  await until(p, '$("case-words").textContent.startsWith("case:1:20: ")', 'the mistake is named');
  await p.evaluate(`$("case").value = ${JSON.stringify(text)}; $("read-case").click()`);
  await until(p, 'state.mass === 1.25 && state.H === 7 && state.N === 77 && !state.mean && state.restart === "sample"', 'the case is read');
  check(await p.evaluate('caseText(state)') === text, 'a case read is written the same: ' + await p.evaluate('caseText(state)'));
  check(await p.evaluate('presets.every(one => presetText(one.file).includes("oscillator:"))'), 'every preset has its case');
  await p.evaluate('$("preset").selectedIndex = 4; $("preset").dispatchEvent(new Event("change"))');
  await until(p, 'state.force === 1 && state.H === 1 && !state.mean', 'a preset is read');
}

async function fits(width, dark) {
  const p = await open(chromium, address, {width, dark});
  await until(p, 'typeof seen !== "undefined"');
  await still(p);
  const wide = await p.evaluate('document.documentElement.scrollWidth');
  check(wide <= width, `${wide} px wide on a screen of ${width}`);
  if (folder) await p.picture(path.join(folder, `lab_${width}_${dark ? 'dark' : 'light'}.png`));
  nothingWasHeard(p);
  await p.close();
}

async function main() {
  check(fs.statSync(page).size < mostBytes, `${fs.statSync(page).size} bytes`);
  console.log(`${(fs.statSync(page).size / 1e6).toFixed(2)} MB`);
  const p = await open(chromium, address);
  await until(p, 'typeof seen !== "undefined"');
  await still(p);
  await everyFieldMovesTheDrawings(p);
  await otherLawsHaveFields(p);
  await draggingIsQuick(p);
  await theKeyboardDoesTheLesson(p);
  await nothingOldIsTold(p);
  await addressesAndCasesKeepTheState(p);
  if (folder) await p.paper(path.join(folder, 'lab.pdf'));
  nothingWasHeard(p);
  await p.close();
  for (const width of folder ? [380, 800, 1400] : [380]) for (const dark of folder ? [false, true] : [true]) await fits(width, dark);
  console.log(failed ? failed + ' things do not hold' : 'all holds');
  process.exit(failed ? 1 : 0);
}

main().catch(error => {
  console.log(error.stack);
  process.exit(1);
});
