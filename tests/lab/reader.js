/* reader.js CHROMIUM LAB_HTML - what the page says and shows, in headless Chromium: while the library starts; with samples while one drags; to a screen reader
 * (Chromium's accessibility tree): every control has a name of its own, every drawing a name and a description, its numbers a table; mistakes in words; fields and
 * curve together on wide screens and on a phone. Exit 1: something does not hold. */
'use strict';
const path = require('path');
const {open} = require('./chromium.js');
const {until, still, exactDrawn, middleOf} = require('./page.js');

const [chromium, page] = process.argv.slice(2);
const address = 'file://' + path.resolve(page);
let failed = 0;

function check(good, words) {
  if (good) return;
  ++failed;
  console.log('NOT SO: ' + words);
}

/* ---- starting ---- */

/* Workers that hear nothing until letGo(). */
const heldWorkers = `const held = [], Real = Worker;
window.Worker = class extends Real { postMessage(m) { held ? held.push([this, m]) : super.postMessage(m); } };
window.letGo = () => { window.Worker = Real; for (const [worker, m] of held.splice(0)) Real.prototype.postMessage.call(worker, m); };`;

async function startingIsSaid() {
  const p = await open(chromium, address, {before: heldWorkers});
  await until(p, 'typeof workers !== "undefined" && workers && !dirty.size');
  const text = await p.evaluate('document.querySelector("main").innerText + $("status").innerText + Array.from(document.querySelectorAll("svg"), s => s.textContent).join()');
  for (const id of ['status', 'motion-words', 'loop-words', 'spectrum-words', 'curve-words', 'draw-signal', 'draw-loop', 'draw-spectrum', 'draw-error-n', 'draw-error-h'])
    check(await p.evaluate(`$('${id}').textContent === 'The library is starting.'`), id + ' says that the library is starting');
  check(!/no solution|no contact|nothing/i.test(text), 'nothing is said to be missing while the library starts');
  await p.evaluate('letGo()');
  await still(p);
  check(!/starting/.test(await p.evaluate('document.body.innerText')), 'it has started');
  await p.close();
}

/* ---- samples while one drags ---- */

const sampledPath = 'document.querySelector("#draw-curve path.sampled:not(.old)")';

async function samplesFollowTheHand(p) {
  for (const sampled of [false, true]) {
    await p.evaluate(`take(Object.assign(copyOf(firstState), {sampled: ${sampled}}))`);
    await still(p);
    await p.evaluate('resting = 1e6');
    const at = await middleOf(p, 'contact-0-kn-slider');
    await p.pointer('mousePressed', at.x, at.y);
    for (let i = 1; i <= 5; ++i) await p.pointer('mouseMoved', at.x + 4 * i, at.y);
    await until(p, 'moving && seen.neighbours && seen.neighbours.text === textNow() && !dirty.size', 'the sampled solutions next to the exact ones are there while dragging');
    check(await p.evaluate(`!current(seen.sampled) && !!${sampledPath}`), 'and they are drawn before the whole curve is there');
    if (sampled) check(await p.evaluate('seen.motion.neighbour && seen.motion.chosen >= 0 && seen.motion.spectrum.rows > 10'), 'so is the motion with samples');
    await p.evaluate('resting = 400');
    await p.pointer('mouseMoved', at.x + 22, at.y); /* and there the hand rests, still on the slider */
    await still(p);
    check(await p.evaluate('seen.sampled.curve.rows > seen.exact.curve.rows && !moving'), 'then the whole curve comes');
    if (sampled) await until(p, 'seen.motion && !seen.motion.neighbour && seen.motion.chosen >= 0', 'and its motion');
    await p.pointer('mouseReleased', at.x + 20, at.y);
    await still(p);
  }
  await p.evaluate('take(copyOf(firstState))');
  await still(p);
}

/* This contact jams the continuation of samples; should it not do so any more, another one has to be found for this test. */
async function samplesGoOnWhereTheirCurveEnds(p) {
  await p.evaluate('take(Object.assign(copyOf(firstState), {sampled: true, omega: 12, contacts: [Object.assign({}, someContact, {kn: 5031})]}))');
  await still(p);
  check(await p.evaluate('seen.sampled.curve.status !== 0'), 'the sampled curve ends early');
  await until(p, '/ends early: .* Beyond, /.test($("curve-words").textContent)', 'that is told');
  await until(p, 'seen.motion.omega === 12 && seen.motion.chosen >= 0 && seen.motion.neighbour', 'the motion beyond is there');
  check(await p.evaluate('Math.max(...Array.from(document.querySelectorAll("#draw-curve path.sampled:not(.old)"), path => path.getBBox().x + path.getBBox().width)) > 0.95 * curvePanel.box.right'), 'and drawn to the end of the sweep');
  await p.evaluate('alter(s => (s.omega = 13), false)');
  await until(p, 'seen.motion.omega === 13 && seen.motion.chosen >= 0', 'and moves with omega');
  await p.evaluate('take(copyOf(firstState))');
  await still(p);
}

/* ---- a screen reader ---- */

const controls = ['button', 'textbox', 'spinbutton', 'slider', 'combobox', 'MenuListPopup', 'link', 'DisclosureTriangle', 'Pre', 'checkbox', 'radio'];
const named = [...controls, 'table', 'region', 'image', 'img', 'group', 'navigation', 'form'];
const valueOf = field => (field ? String(field.value).trim() : '');

async function everythingHasAName(p) {
  const nodes = (await p.tree()).filter(node => !node.ignored), role = node => valueOf(node.role);
  const own = nodes.filter(node => controls.includes(role(node)) && role(node) !== 'MenuListPopup');
  check(own.length > 40, own.length + ' controls in the tree');
  for (const node of nodes.filter(n => named.includes(role(n)) && !['group', 'form', 'MenuListPopup'].includes(role(n))))
    check(valueOf(node.name), `a ${role(node)} without a name: ${JSON.stringify(node.properties)}`);
  const names = own.map(node => role(node) + ' ' + valueOf(node.name));
  const twice = names.filter((name, i) => names.indexOf(name) !== i);
  check(!twice.length, 'two controls of one name: ' + twice.join('; '));
  const drawings = nodes.filter(node => /^ima?ge?$/.test(role(node)) || valueOf(node.name) === 'omega on the response curve');
  check(drawings.length === 6, drawings.length + ' drawings');
  for (const node of drawings) check(valueOf(node.description).length > 20, `the drawing "${valueOf(node.name)}" has a description: "${valueOf(node.description)}"`);
  check(nodes.filter(node => role(node) === 'heading').length >= 10, 'headings');
  check(nodes.some(node => role(node) === 'status'), 'a live region');
  const slider = nodes.find(node => valueOf(node.name) === 'omega on the response curve');
  const words = await p.evaluate('$("draw-curve").getAttribute("aria-valuetext")'); /* the tree has it empty, of every slider */
  check(role(slider) === 'slider' && valueOf(slider.value) === '7' && /^omega 7, amplitude 1\.44/.test(words), 'omega as a slider has a value in words: ' + words);
}

/* What is spoken is the state when it stands still, not each step. */
async function stepsAreNotSpoken(p) {
  await p.evaluate('window.spoken = []; new MutationObserver(() => spoken.push($("spoken").textContent)).observe($("spoken"), {childList: true, characterData: true, subtree: true})');
  for (const omega of [5, 5.5, 6, 6.5]) {
    await p.evaluate(`alter(s => (s.omega = ${omega}), true)`);
    await exactDrawn(p);
  }
  await until(p, 'spoken.length && spoken[spoken.length - 1] === $("status").textContent && /omega = 6.5/.test($("status").textContent)', 'the last step is spoken');
  check(await p.evaluate('spoken.length < 4'), 'not every step: ' + await p.evaluate('spoken.join("; ")'));
}

/* The page as it opens: friction works, an orbit is proven, and the lesson's first step shows its own case. */
async function itOpensOnAContactThatSlips(p) {
  check(await p.evaluate('seen.motion.work.values[5] > 2 && presets[$("preset").value].name === state.title'), 'the traction loop has an area');
  check(/^Proven at omega = 6.719: .* 1.2502111 \(stable\)\.$/.test(await p.evaluate('$("proven-words").textContent')), 'an orbit is proven nearby');
  check(/The difference, of complex numbers .* is 0\.0285, 0\.13 % of it/.test(await p.evaluate('$("spectrum-words").textContent')), 'a difference of complex numbers');
  await p.evaluate('$("go-proven").click()');
  await still(p);
  check(/ The solution shown is [0-9.e-]+ % off\.$/.test(await p.evaluate('$("proven-words").textContent')) && await p.evaluate('$("go-proven").hidden'), 'and how far HBM is off');
  await p.evaluate('alter(s => (s.mass *= 1.1), false)');
  await still(p);
  check(await p.evaluate('$("proven-badge").hidden'), 'of another case nothing is proven');
  await p.evaluate('$("prediction").value = 2; $("step-show").click()');
  await until(p, '/^You said 2, and so it is/.test($("step-answer").textContent) && state.N === 16 && state.omega === 6', 'the first step shows its case');
  await p.evaluate('take(copyOf(openingState))');
  await still(p);
}

const numbersOf = (p, id) => p.evaluate(`Array.from($('${id}').tBodies[0].rows, row => Array.from(row.cells, cell => cell.textContent))`);

async function drawingsHaveTheirNumbers(p) {
  check((await numbersOf(p, 'curve-table')).length === 0, 'a closed table is not filled');
  await p.evaluate('document.querySelectorAll("details").forEach(one => (one.open = true))');
  await until(p, '$("curve-table").tBodies[0].rows.length && $("motion-table").tBodies[0].rows.length', 'tables are filled when opened');
  const curve = await numbersOf(p, 'curve-table'), specials = await numbersOf(p, 'special-table'), motion = await numbersOf(p, 'motion-table');
  check(curve.length === await p.evaluate('seen.exact.curve.rows'), 'a row for each point of the curve');
  const heads = await p.evaluate('Array.from($("curve-table").tHead.rows[0].cells, cell => cell.textContent)');
  const names = await p.evaluate('seen.exact.curve.names.filter((name, c) => seen.exact.curve.kinds[c] !== "series")');
  check(heads.length === names.length + 1 && names.every(name => heads.some(head => head.includes(name))), `all columns of results, and that with samples: ${heads}`);
  check(heads.every((head, c) => curve.some(row => row[c] && row[c] !== '-')), 'no column is empty');
  const sampled = curve.filter(row => row[2] !== '-'), off = sampled.map(row => Math.abs(row[2] - row[1]) / row[1]);
  check(sampled.length > 0.9 * curve.length && Math.max(...off) < 0.5 && Math.max(...off) > 1e-3, 'amplitudes with samples beside the exact ones');
  check(specials.filter(row => row[0] === 'fold').length === 2, 'two folds: ' + specials.map(row => row[0]).join());
  check(motion.length === 32 && motion.every(row => row.length === 5 && row.every(cell => isFinite(cell))), 'the motion and the loop in numbers');
  check(Math.max(...motion.map(row => row[3])) > 1000 && motion.some(row => row[3] === '0'), 'a contact that opens and closes');
  await p.evaluate('document.querySelectorAll("details").forEach(one => (one.open = false))');
}

/* ---- mistakes ---- */

async function mistakesAreToldInWords(p) {
  await p.evaluate('$("field-mass").focus(); $("field-mass").select()');
  await p.key('-', 'Minus', '-');
  await p.key('1', 'Digit1', '1');
  check(await p.evaluate('$("field-mass-mistake").textContent') === 'Wanted is a number above 0.', 'a mistake in a field is told in words');
  check(await p.evaluate('$("field-mass").getAttribute("aria-invalid") === "true" && state.mass === 1'), 'and not taken');
  await p.evaluate('$("field-mass").value = "1"; $("field-mass").dispatchEvent(new Event("input"))');
  check(await p.evaluate('$("field-mass-mistake").textContent === "" && $("field-mass").getAttribute("aria-invalid") === "false"'), 'it goes when it is mended');
  await p.evaluate('take(Object.assign(copyOf(firstState), {N: 16}))');
  await until(p, '/2 H \\+ 2 = 22/.test($("curve-words").textContent)', 'too few samples for H are told');
  await p.evaluate('take(copyOf(firstState))');
  await still(p);
}

/* Of a case that is read: in words, and the place is selected. */
async function mistakesInACaseAreShown(p) {
  await p.evaluate('$("case").value = caseText(state).replace("damping: 0.4", "dampening: 0.4"); $("read-case").click()');
  await until(p, '/^case:2:23: unknown key `dampening`/.test($("case-words").textContent)', 'the mistake in a case is told');
  check(await p.evaluate('document.activeElement === $("case") && $("case").value.slice($("case").selectionStart).startsWith("dampening: 0.4, ")'), 'and its place selected');
  check(await p.evaluate('(() => { const b = $("case-words").getBoundingClientRect(); return b.top >= 0 && b.bottom <= innerHeight; })()'), 'both on the screen');
  await p.evaluate('$("case").value = $("case").value.replace("dampening", "damping"); $("read-case").click()');
  await until(p, '/^Read\\./.test($("case-words").textContent)', 'the mended case is read');
  await p.evaluate('$("copy-address").click()');
  check(await p.evaluate('/copied|copy/.test($("address-words").textContent)'), 'what became of copying is told beside the button');
}

/* ---- the lesson and the presets ---- */

async function theAnswerBringsItsDrawing(p) {
  for (let step = 0; step < 7; ++step) {
    await p.evaluate(`$("steps").children[${step}].click()`);
    check(await p.evaluate('$("step-drawing").hidden'), `step ${step + 1}: no drawing before a prediction`);
    await p.evaluate('$("prediction").value = "1e9"; $("step-show").click()');
    await until(p, '!$("step-drawing").hidden && $("draw-lesson").querySelectorAll("path").length > 5', `step ${step + 1}: the answer has its drawing`);
    const [name, words] = await p.evaluate('[$("draw-lesson").getAttribute("aria-label"), $("step-answer").textContent]');
    check(name.length > 10 && /^You said 1000000000; it is something else: /.test(words), `step ${step + 1}: ${name}: ${words}`);
  }
}

async function presetsAreNamedAsLongAsTheyStand(p) {
  await p.evaluate('$("preset").selectedIndex = 5; $("preset").dispatchEvent(new Event("change"))');
  await until(p, 'state.title === presets[4].name && $("preset").selectedIndex === 5', 'the preset is read, and named');
  check(await p.evaluate('state.restart === "sample" && !state.mean'), 'with the paper\'s settings');
  await p.evaluate('alter(s => (s.mass *= 1.1), false)');
  check(await p.evaluate('$("preset").selectedIndex === 0 && $("title").textContent.endsWith(", changed")'), 'and no longer when it is changed');
}

/* ---- together on the screen ---- */

async function fieldsAndCurveAreTogether(width, height) {
  const p = await open(chromium, address, {width, height});
  await until(p, 'typeof seen !== "undefined" && seen.motion && !dirty.size');
  check(await p.evaluate('document.querySelector("main").firstElementChild.id') === (width < 1024 ? 'lesson' : 'fields'), `${width} px: on a phone the lesson comes first`);
  for (const id of ['field-mass', 'field-N', 'contact-0-mu-slider', 'contact-0-gap']) {
    await p.evaluate(`$('${id}').focus(); $('${id}').scrollIntoView({block: 'nearest'})`);
    const [field, curve] = await p.evaluate(`['${id}', 'draw-curve'].map(one => { const b = $(one).getBoundingClientRect(); return {top: b.top, bottom: b.bottom, left: b.left, right: b.right}; })`);
    check(curve.top >= 0 && curve.bottom <= height + 1 && field.top >= 0 && field.bottom <= height, `${width} px: ${id} and the curve are both on the screen`);
    check(field.bottom <= curve.top || field.right <= curve.left, `${width} px: the curve does not hide ${id}`);
  }
  await p.close();
}

async function main() {
  await startingIsSaid();
  const p = await open(chromium, address);
  await until(p, 'typeof seen !== "undefined"');
  await still(p);
  await everythingHasAName(p);
  await itOpensOnAContactThatSlips(p);
  await stepsAreNotSpoken(p);
  await p.evaluate('take(copyOf(firstState))');
  await still(p);
  await drawingsHaveTheirNumbers(p);
  await mistakesAreToldInWords(p);
  await mistakesInACaseAreShown(p);
  await samplesFollowTheHand(p);
  await samplesGoOnWhereTheirCurveEnds(p);
  await theAnswerBringsItsDrawing(p);
  await presetsAreNamedAsLongAsTheyStand(p);
  check(!p.lines.length, 'on the console: ' + p.lines.join('\n').slice(0, 2000));
  await p.close();
  await fieldsAndCurveAreTogether(380, 700);
  await fieldsAndCurveAreTogether(1400, 900);
  console.log(failed ? failed + ' things do not hold' : 'all holds');
  process.exit(failed ? 1 : 0);
}

main().catch(error => {
  console.log(error.stack);
  process.exit(1);
});
