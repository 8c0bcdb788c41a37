/* main.js - the state, what the library has answered to it, and what is drawn when. Two workers: `exact` answers at once
 * and tells the sampled solutions next to its curve, the motion, transients and errors; `sampled`, which may take long,
 * the whole sampled curve and its motion. While one drags, only what answers at once is asked.
 *   seen {exact, sampled, neighbours: {text, curve, specials, transients}, motion, errors}: the newest answers; text:
 *   their case */
'use strict';

const problems = [];
window.addEventListener('error', event => problems.push(event.message));

let state = null;
const seen = {exact: null, sampled: null, neighbours: null, motion: null, errors: null};
const times = {asked: 0, drawn: []}; /* [ms] from a change to everything of it drawn, the newest last; read by tests */
let moving = false;
let workers = null;
let dirty = new Set();
let libraryIsThere = false;
let resting = 400; /* [ms] without a change, though the hand is still on: then the rest is asked, too; set by tests */
let restTimer = 0;

/* ---- asking ---- */

/* The case without what only the drawings use. */
const textNow = () => questionText(Object.assign({}, state, {title: '', sampled: false}));

function askAll() {
  const whole = wholeSampled(), neighbour = state.sampled && !whole;
  const job = {text: textNow(), omega: state.omega, near: state.near, samples: state.N, shown: shownHarmonics(state), more: !moving};
  times.asked = performance.now();
  workers.exact.ask(Object.assign({force: labForce.exact, motion: !state.sampled || neighbour, neighbour}, job));
  if (!moving || whole) workers.sampled.ask(Object.assign({force: labForce.sampled, motion: state.sampled}, job));
  clearTimeout(restTimer);
  if (moving) restTimer = setTimeout(rest, resting);
}

function rest() {
  moving = false;
  askAll();
  mark('motion');
}

/* The state is changed by change(state) and drawn anew; rebuild: there are other fields than before. */
function alter(change, isMoving, rebuild) {
  const before = caseText(state);
  change(state);
  if (caseText(state) !== before) {
    if (!state.title.endsWith(', changed')) state.title += ', changed';
    $('preset').selectedIndex = 0;
  }
  moving = isMoving;
  const [low, high] = [state.from, state.to].sort((a, b) => a - b);
  state.omega = Math.min(high, Math.max(low, state.omega));
  state.look = Math.max(0, Math.min(state.look, state.contacts.length - 1));
  $('title').textContent = state.title || 'A case without a title';
  if (rebuild) buildAll();
  else showFields(state);
  askAll();
  mark('curve');
  if (!moving) keepSoon();
}

/* Another case altogether; preset: its number, where it is one. */
function take(other, preset) {
  state = other;
  $('preset').value = preset === undefined ? '' : preset;
  alter(() => {}, false, true);
}

function buildAll() {
  buildFields(state, alter);
  $('look').replaceChildren(...state.contacts.map((c, i) => new Option('contact ' + (i + 1), i)));
}

/* ---- answers ---- */

function onExact(part) {
  const take = {
    curve: () => Object.assign(seen, {exact: {text: part.text, curve: part.curve}}),
    specials: () => seen.exact && (seen.exact.specials = part.specials),
    transients: () => seen.exact && (seen.exact.transients = part.transients),
    neighbours: () => (seen.neighbours = {text: part.text, curve: part.curve}),
    motion: () => part.neighbour && wholeSampled() || (seen.motion = part),
    errors: () => (seen.errors = part),
    read: () => afterReading(part),
    lesson: () => afterLesson(part),
    ready: () => {
      libraryIsThere = true;
      drawEverything();
    },
    refused: () => say(part.message, 'bad')
  }[part.part];
  if (take) take();
  if (part.part === 'drawn') tellTime();
  mark({curve: 'curve', specials: 'curve', transients: 'curve', neighbours: 'curve', motion: 'motion', errors: 'errors'}[part.part]);
}

function onSampled(part) {
  if (part.part === 'curve') seen.sampled = {text: part.text, curve: part.curve};
  if (part.part === 'specials' && seen.sampled) seen.sampled.specials = part.specials;
  const better = part.chosen >= 0 || !(seen.motion && seen.motion.neighbour); /* than what is next to an exact solution */
  if (part.part === 'motion' && better) seen.motion = part;
  mark({curve: 'curve', specials: 'curve', motion: 'motion'}[part.part]);
}

let speakTimer = 0;

/* For screen readers the same, when it has stood still: not every step of a drag. */
function say(text, kind) {
  $('status').className = 'verdict ' + (kind || '');
  $('status').textContent = text;
  clearTimeout(speakTimer);
  speakTimer = setTimeout(() => ($('spoken').textContent = text), 700);
}

/* Why a drawing of the motion is empty. */
function whyNothing(motion) {
  if (!libraryIsThere) return 'The library is starting.';
  return motion ? `No solution at omega = ${show(motion.omega)}.` : 'Computing.';
}

/* The sampled curve and the errors may be on their way: this is what a drag waits for. */
function tellTime() {
  draw();
  times.drawn.push(performance.now() - times.asked);
  if (times.drawn.length > 500) times.drawn.shift();
}

/* ---- drawing: once a frame at most ---- */

function mark(what) {
  if (!what) return;
  if (!dirty.size) requestAnimationFrame(draw);
  dirty.add(what);
  if (what === 'motion') dirty.add('curve');
}

function draw() {
  const what = dirty;
  dirty = new Set();
  if (what.has('curve')) drawResponse();
  if (what.has('motion')) drawMotion();
  if (what.has('errors')) drawErrors();
  drawLesson();
}

const countFound = curve => curve.list.filter(row => isFinite(row.amplitude)).length;
const countFolds = specials => (specials ? specials.list.filter(row => row.kind === 'turning point').length : NaN);

function drawResponse() {
  curvePanel = drawCurve($('draw-curve'), state, seen, textNow());
  const slider = $('draw-curve'), motion = seen.motion;
  const chosen = motion && motion.solutions && motion.solutions[motion.chosen];
  const amplitude = chosen ? `, amplitude ${show(chosen.amplitude)}` : '';
  slider.setAttribute('aria-valuemin', Math.min(state.from, state.to));
  slider.setAttribute('aria-valuemax', Math.max(state.from, state.to));
  slider.setAttribute('aria-valuenow', state.omega);
  slider.setAttribute('aria-valuetext', `omega ${show(state.omega)}${amplitude}`);
  if (document.activeElement !== $('omega')) $('omega').value = +state.omega.toPrecision(6);
  $('curve-words').textContent = curveWords();
  $('proven-words').textContent = provenWords(state, motion);
  $('proven-badge').hidden = !$('proven-words').textContent;
  $('go-proven').hidden = provenOmega(state) === state.omega;
  const row = (name, of, table, ms) => `<tr><td>${name}</td><td>${of && table ? table.rows : '-'}</td>` +
    `<td>${show(countFolds(of && of.specials))}</td><td>${show(ms, 3)}</td></tr>`;
  const {exact, errors} = seen, sampled = current(seen.sampled), neighbours = current(seen.neighbours);
  $('cost').tBodies[0].innerHTML = [
    row('curve, exact forces', exact, exact && exact.curve, exact && exact.curve.ms),
    row(`whole curve, N = ${state.N}`, sampled, sampled && sampled.curve, sampled && sampled.curve.ms),
    row(`N = ${state.N}, next to the exact solutions`, neighbours, neighbours && {rows: countFound(neighbours.curve)}, neighbours && neighbours.curve.ms),
    row('steady states by time integration, exact law in closed form', null, null, exact && exact.transients && exact.transients.ms)
      .replace('<td>-</td>', `<td>${exact && exact.transients ? exact.transients.rows : '-'}</td>`),
    row('the motion shown: solving, forces, spectrum', null, null, seen.motion && seen.motion.ms),
    row('all errors over N and H', null, null, errors && errors.errors.ms)
  ].join('');
  drawCurveNumbers(seen);
}

/* What is of the case as it is now. */
const current = one => (one && one.text === textNow() ? one : null);

/* The sampled curve, if it went to its end. */
function wholeSampled() {
  const one = current(seen.sampled);
  return one && one.curve.status === 0 ? one : null;
}

function curveWords() {
  const exact = current(seen.exact), sampled = current(seen.sampled), {motion} = seen, words = [];
  if (!exact) return libraryIsThere ? 'The curve is on its way.' : whyNothing(null);
  if (state.N < 2 * state.H + 2) return `${state.N} samples cannot tell ${state.H} harmonics apart: at least 2 H + 2 = ${2 * state.H + 2} are needed.`;
  if (!sampled) words.push('With samples, the solutions next to the exact ones are drawn; the whole curve, with what else it may have, is on its way.');
  if (exact.curve.status !== 0) words.push(`The exact curve ends early: ${exact.curve.message}.`);
  if (sampled && sampled.curve.status !== 0) words.push(`The sampled curve ends early: ${sampled.curve.message}. Beyond, the solutions next to the exact ones are drawn.`);
  const [a, b] = [exact, sampled].map(one => countFolds(one && one.specials));
  if (b > a) words.push(`The sampled curve has ${b} folds, the exact one ${a}: the others are of the samples, not of the oscillator.`);
  if (motion && motion.chosen < 0) words.push(`No solution at omega = ${show(motion.omega)}.`);
  return words.join(' ');
}

function drawMotion() {
  const {motion} = seen;
  drawSignal($('draw-signal'), state, motion);
  drawLoop($('draw-loop'), state, motion);
  drawSpectrum($('draw-spectrum'), state, motion);
  $('loop-words').textContent = loopWords(state, motion);
  $('spectrum-words').textContent = spectrumWords(state, motion);
  $('harmonics').tBodies[0].innerHTML = harmonicRows(state, motion);
  $('motion-words').textContent = motionWords(motion);
  drawMotionNumbers(state, motion);
  if (document.activeElement !== $('harmonic')) $('harmonic').value = state.harmonic;
  $('look').value = state.look;
  showSolutions(motion);
  if (motion && motion.chosen >= 0) say(motion.message ? motion.message : statusWords(motion), motion.message ? 'open' : '');
}

const solutionName = row => `amplitude ${show(row.amplitude)}, ${{yes: 'stable', no: 'unstable'}[row.stable] || 'stability unknown'}`;

const statusWords = motion => `At omega = ${show(motion.omega)}: ${motion.solutions.length === 1 ? 'one solution' : motion.solutions.length + ' solutions'}; ` +
  `shown is the one of ${solutionName(motion.solutions[motion.chosen])}.`;

function motionWords(motion) {
  if (!motion || motion.chosen < 0) return whyNothing(motion);
  const row = motion.solutions[motion.chosen];
  return `${state.sampled ? `Solved with ${state.N} samples` : 'Solved with exact forces'}, H = ${state.H}, omega = ${show(motion.omega)}: ` +
    `amplitude ${show(row.amplitude, 6)}, mean ${show(row.mean, 4)}, largest Floquet multiplier ${show(row.multiplier, 4)}; ` +
    `the strongest that happens at a contact: ${row.contact}.`;
}

function showSolutions(motion) {
  const select = $('solution');
  if (!motion || document.activeElement === select) return;
  select.replaceChildren(...motion.solutions.map((row, i) => new Option(`${i + 1}: ${solutionName(row)}`, i)));
  select.selectedIndex = motion.chosen;
}

function drawErrors() {
  const measure = $('measure').value, errors = seen.errors && seen.errors.errors;
  drawErrorOverN($('draw-error-n'), state, errors, measure);
  drawErrorOverH($('draw-error-h'), state, errors);
  $('error-words').textContent = errorWords(state, seen.errors, measure);
  const table = errorTable(errors, measure), caption = $('error-table').caption;
  caption.textContent = $('measure').selectedOptions[0].textContent + ', relative error of the amplitude';
  $('error-table').tHead.innerHTML = table.head;
  $('error-table').tBodies[0].innerHTML = table.body;
}

const drawEverything = () => ['curve', 'motion', 'errors'].forEach(mark);

/* ---- keeping ---- */

let keepTimer = 0;

function keepSoon() {
  clearTimeout(keepTimer);
  keepTimer = setTimeout(keep, 300);
}

function keep() {
  history.replaceState(null, '', addressOf(state));
  if (document.activeElement !== $('case')) $('case').value = caseText(state);
}

/* Tells in the element `where` what has become of it. */
function copy(text, where, words) {
  const area = document.createElement('textarea'); /* navigator.clipboard is not there from file:// everywhere */
  area.value = text;
  document.body.append(area);
  area.select();
  const done = document.execCommand('copy');
  area.remove();
  $(where).textContent = done ? words : 'The browser does not let this page copy: select the text yourself.';
}

/* The worker has been at the lesson's cases: it is told this one again, for the errors it may not have come to. */
function afterLesson(part) {
  lastTold = {step: part.step, number: part.told.number};
  tellStep(part.step, part.told);
  askAll();
}

let lastTold = null; /* {step, number}: read by tests */

let readOwn = null; /* what the next case read is to have of its own: a preset's number, H, N, mean */

function readCaseText(text, own) {
  readOwn = own || null;
  clearTimeout(keepTimer); /* the text that is read stays until it has been */
  workers.exact.ask({read: text});
}

function afterReading(part) {
  tellReading(part.message || 'Read. Only what this page has fields for is kept.', Boolean(part.message));
  if (part.message) return showMistake(part.message);
  const {preset, ...own} = readOwn || {};
  take(Object.assign({}, part.state, own), preset);
}

function tellReading(words, wrong) {
  $('case-words').className = wrong ? 'verdict bad' : 'hint';
  $('case-words').textContent = words;
}

/* The line that the message names (case:LINE:COLUMN: ...) is selected in the text that was read. */
function showMistake(message) {
  const [line, column] = (message.match(/^case:(\d+):(\d+):/) || []).slice(1).map(Number);
  const lines = $('case').value.split('\n');
  if (!line || line > lines.length) return;
  const from = lines.slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0);
  $('case').focus({preventScroll: true});
  $('case').setSelectionRange(from + column - 1, from + lines[line - 1].length);
  $('case-words').scrollIntoView({block: 'nearest'});
}

/* ---- controls ---- */

/* The solution above or below the one shown. */
function otherSolution(direction) {
  const {motion} = seen;
  if (!motion || motion.chosen < 0) return;
  const list = motion.solutions.map(row => row.amplitude).sort((a, b) => a - b);
  const at = list.indexOf(motion.solutions[motion.chosen].amplitude) + direction;
  if (at >= 0 && at < list.length) alter(s => (s.near = list[at]), false);
}

/* Along the branch shown, not to another where the amplitude changes. */
function moveOmega(steps) {
  const {motion} = seen, chosen = motion && motion.solutions && motion.solutions[motion.chosen];
  const step = Math.abs(state.to - state.from) / 400;
  alter(s => {
    s.omega = +(s.omega + steps * step).toPrecision(6);
    if (chosen) s.near = chosen.amplitude;
  }, false);
}

function onCurveKey(event) {
  const far = event.shiftKey ? 10 : 1;
  const act = {ArrowLeft: () => moveOmega(-far), ArrowRight: () => moveOmega(far), PageDown: () => moveOmega(-20), PageUp: () => moveOmega(20),
    ArrowUp: () => otherSolution(1), ArrowDown: () => otherSolution(-1)}[event.key];
  if (!act) return;
  event.preventDefault();
  act();
}

function startControls() {
  $('preset').append(new Option('a case of the paper', ''), ...presets.map((p, i) => new Option(p.name, i)));
  $('preset').addEventListener('change', () => {
    const p = presets[$('preset').value];
    if (p) readCaseText(presetText(p.file), Object.assign({title: p.name, preset: $('preset').value}, p.own));
  });
  $('add-contact').addEventListener('click', () => alter(s => s.contacts.push(Object.assign({}, s.contacts[s.contacts.length - 1] || someContact)), false, true));
  dragCurve($('draw-curve'), (to, isMoving) => alter(s => Object.assign(s, to), isMoving));
  $('draw-curve').addEventListener('keydown', onCurveKey);
  $('omega').addEventListener('input', () => Number($('omega').value) > 0 && alter(s => (s.omega = Number($('omega').value)), false));
  $('go-proven').addEventListener('click', () => alter(s => (s.omega = provenOmega(s)), false));
  $('omega').addEventListener('blur', () => mark('curve')); /* it may lie outside the sweep */
  $('solution').addEventListener('change', () => alter(s => (s.near = seen.motion.solutions[$('solution').selectedIndex].amplitude), false));
  $('look').addEventListener('change', () => alter(s => (s.look = Number($('look').value)), false));
  $('harmonic').addEventListener('input', () => {
    const h = Number($('harmonic').value);
    if (Number.isInteger(h) && h >= 0 && h <= mostShown) alter(s => (s.harmonic = h), false);
  });
  document.querySelectorAll('details').forEach(one => one.addEventListener('toggle', drawEverything));
  $('measure').addEventListener('change', () => mark('errors'));
  $('copy-address').addEventListener('click', () => {
    keep();
    copy(location.href, 'address-words', 'The address is copied.');
  });
  $('copy-case').addEventListener('click', () => copy($('case').value, 'case-words', 'The case is copied.'));
  $('read-case').addEventListener('click', () => readCaseText($('case').value));
  $('case-file').addEventListener('change', async () => {
    const [file] = $('case-file').files;
    if (!file) return;
    $('case').value = await file.text(); /* where a mistake is then shown */
    readCaseText($('case').value);
  });
  document.querySelectorAll('[data-go]').forEach(link => link.addEventListener('click', event => {
    const heading = $(link.dataset.go).querySelector('h2');
    event.preventDefault(); /* the address is the state's */
    heading.scrollIntoView();
    heading.focus({preventScroll: true});
  }));
}

function start() {
  const address = workerAddress();
  workers = {exact: asker(address, onExact), sampled: asker(address, onSampled)};
  startControls();
  startLesson(step => workers.exact.ask({lesson: step}), (other, title) => take(Object.assign(other, {title})));
  window.addEventListener('resize', drawEverything);
  window.addEventListener('beforeprint', drawEverything);
  window.addEventListener('hashchange', () => {
    const other = stateOfAddress(location.hash, firstState), file = caseOfAddress(location.hash);
    if (other) take(other);
    else if (file) readCaseText(file.text, file.own);
  });
  const addressed = stateOfAddress(location.hash, firstState), file = caseOfAddress(location.hash) || {text: $('case-given').textContent};
  if (matchMedia('(max-width: 63.99rem)').matches) document.querySelector('main').prepend($('lesson')); /* on a phone the lesson comes first */
  if (addressed) take(addressed);
  else take(copyOf(openingState), presets.findIndex(p => p.name === openingState.title));
  drawEverything();
  if (!addressed && file.text.trim()) readCaseText(file.text, file.own);
}

start();
