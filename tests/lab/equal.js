/* equal.js LAB_ASKED LAB [SCENES [SEED [CHROMIUM]]] - the module's answers against those of the native program, to 1e-12. LAB is the module, lab.js, asked in node; or
 * with CHROMIUM the page, lab.html, whose own library is asked in a worker of the page, from disk. Random cases (seeded) and what the command line adds are put to both:
 * the same questions go to lab_asked and to the module. Exit 1: an answer differs, or the page said or asked for something. */
'use strict';
const fs = require('fs'), path = require('path');
const {labClient, labForce} = require(path.join(__dirname, '../../interfaces/lab/lab_client.js'));
const {clientOf} = require('./native.js'), {open} = require('./chromium.js'), {libraryOf} = require('./page_library.js');

const [native, labPath, scenes = '50', seed = '1', chromium] = process.argv.slice(2);
const limit = 1e-12;
const limitOfMultipliers = 1e-10; /* a derivative: next to a grazing it is a hundred times as sensitive as the motion */

/* ---- cases ---- */

/* Numbers 0..1, the same for the same seed (mulberry32). */
function randomNumbers(state) {
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

function randomCase(random) {
  const between = (a, b) => a + (b - a) * random(), log = (a, b) => a * Math.pow(b / a, random());
  const pick = list => list[Math.floor(random() * list.length)];
  const mass = log(0.1, 10), omega = log(0.5, 50), stiffness = mass * omega * omega;
  const force = log(0.1, 100), length = force / stiffness;
  const contacts = Array.from({length: pick([1, 1, 1, 2, 3])}, () =>
    `  - {tangential_stiffness: ${log(0.1, 10) * stiffness}, normal_stiffness: ${log(0.3, 20) * stiffness}, ` +
    `friction: ${between(0.05, 1)}, angle_deg: ${pick([0, 30, 45, between(5, 85), 90])}, gap: ${between(-3, 3) * length}}`);
  if (random() < 0.2) contacts.push(`  - {law: table, points: [[${-length}, ${-stiffness * length}], [0, 0], [${length}, ${2 * stiffness * length}]]}`);
  const n = pick([1, 2, 3, 5, 7, 10]);
  return [`oscillator: {mass: ${mass}, damping: ${between(0.02, 0.2) * mass * omega}, stiffness: ${stiffness}}`,
    `forcing: {amplitude: ${force}}`, 'contacts:', ...contacts, `sweep: {omega: [${0.4 * omega}, ${2.5 * omega}]}`,
    `hbm: {harmonics: ${n}, samples: ${pick([32, 63, 64, 100, 128, 256, 1000, 1024])}, static: ${pick([true, true, false])}, tolerance: 1e-14}`,
    'transient: {tolerance: 1e-13, start: rest}',
    'compare: {harmonics: [1, 3, 5], samples: [16, 64, 256]}', ''].join('\n');
}

/* ---- the questions ---- */

const forces = ['exact', 'sampled'];

/* Where it is asked: the points of the module's own curve, this many of them; the first one's solution is the motion. */
const ASKED = 8, SAMPLES = 64, SHOWN = 40;

async function asked(lab) {
  const curve = await lab.curve(labForce.exact);
  const at = i => curve.list[Math.floor((curve.rows - 1) * ((i + ASKED / 2) % ASKED) / ASKED)];
  return {omegas: Array.from({length: ASKED}, (_, i) => at(i).omega), X: at(0).coefficients};
}

async function answersOf(lab, {omegas, X}) {
  const all = {};
  for (const force of forces) {
    all['curve ' + force] = await lab.curve(labForce[force]);
    all['specials ' + force] = await lab.specials(labForce[force]);
    for (const [i, omega] of omegas.entries()) all[`at ${force} ${i}`] = await lab.curveAt(labForce[force], omega);
  }
  for (const [i, omega] of omegas.entries()) all[`near ${i}`] = await lab.neighboursAt(omega);
  await lab.motion(X);
  all['signal exact'] = await lab.signal(labForce.exact, SAMPLES);
  all['signal sampled'] = await lab.signal(labForce.sampled, SAMPLES);
  all.spectrum = await lab.spectrum(SAMPLES, SHOWN);
  all.work = await lab.work();
  all.errors = await lab.errors(omegas[0]);
  all.transients = await lab.transients(omegas);
  return all;
}

async function nativeAnswers(text, questions) {
  const lab = clientOf(native, true);
  lab.read(text);
  const all = await answersOf(lab, questions);
  lab.answerAll();
  return all;
}

/* ---- the difference ---- */

/* What is not held against each other. Rounding errors differ (FFTW's vector instructions, libm), and decide where a
 * curve has its points and how many false turning points of samples it passes; solutions at a given omega do not depend
 * on that. Iterations, residuals, steps and periods until something settles count rounding errors; the strongest regime and
 * the multiplier of a motion that just reaches a limit, or just touches, are theirs to decide. */
const notCompared = [/^curve /, /^specials /];
const rounded = ['branch', 'contact', 'iterations', 'residual'];
const unmeasured = {at: rounded, near: rounded, errors: [5], transients: ['multiplier', 'contact', 'periods', 'closure', 'steps', 'lyapunov']};
/* Columns of one size: of results the measures, and a series, which is last. */
const sharing = (kind, {names}) => (kind === 'spectrum' ? [[1, 3], [3, 5]] :
  names.includes('amplitude') ? [[names.indexOf('amplitude'), names.indexOf('harmonic_1') + 1], [names.length - 1]] : []);

/* Of each column; X is the motion that was asked about. */
function sizesOf(kind, a, X) {
  const sizes = new Array(a.columns).fill(0);
  a.values.forEach((value, i) => {
    if (isFinite(value)) sizes[i % a.columns] = Math.max(sizes[i % a.columns], Math.abs(value));
  });
  if (kind === 'errors') sizes[4] = 1; /* relative already */
  if (kind === 'work') { /* slip paths and work come from differences of displacements */
    sizes[4] = Math.max(...X.map(Math.abs));
    sizes[5] = sizes[3] * sizes[4];
  }
  for (const [from, to = a.columns] of sharing(kind, a)) sizes.fill(Math.max(...sizes.slice(from, to)), from, to);
  return sizes;
}

/* Largest |a - b| of row i of one table and row j of another, over the columns' sizes; a multiplier counts by its own limit. NaN equals NaN alone. */
function distance(kind, sizes, a, i, b, j) {
  const settled = kind !== 'transients' || b.list[j].status === 'ok';
  const cell = (table, row, c) => (table.kinds[c] === 'text' ? table.list[row][table.names[c]] : table.values[row * table.columns + c]);
  let worst = 0;
  for (let c = 0; c < a.columns; ++c) {
    const name = a.names[c] || c, value = cell(a, i, c), other = cell(b, j, c);
    if (!settled && !['omega', 'status'].includes(name)) continue;
    if ((unmeasured[kind] || []).includes(name) || Object.is(value, other) || value === other) continue;
    const own = name === 'multiplier' ? limitOfMultipliers / limit : 1;
    const d = Math.abs(value - other) / sizes[c] / own;
    if (!(d <= worst)) worst = isNaN(d) ? Infinity : d;
  }
  return worst;
}

/* Of two tables, row by row. */
function difference(kind, sizes, a, b) {
  if (!a || !b || a.status !== b.status || a.rows !== b.rows || a.columns !== b.columns || `${a.names} ${a.kinds}` !== `${b.names} ${b.kinds}`) return Infinity;
  let worst = 0;
  for (let i = 0; i < a.rows; ++i) worst = Math.max(worst, distance(kind, sizes, a, i, b, i));
  return worst;
}

/* Has every row all columns by name, texts in words, the numbers those of the table? */
const listed = ({rows, columns, names, kinds, words, values, list}) => list.length === (names.length ? rows : 0) && list.every((row, i) =>
  Object.keys(row).join() === names.join() && names.every((name, c) => {
    const value = values[i * columns + c];
    if (kinds[c] === 'text') return isNaN(value) ? row[name] === undefined : row[name] === words[value];
    return kinds[c] === 'series' ? row[name].every((v, k) => v === values[i * columns + c + k]) && (isNaN(value) || row[name].length > 2) : Object.is(row[name], value);
  }));

/* ---- where rounding decides ---- */

/* A case as it is to a computer that rounds otherwise: its numbers changed by up to 1e-14, what the force of 1024 samples carries after ten stages of a
 * Fourier transform, each of some four roundings. Both programs answer exactly to some such case. What the native answer does under such changes, the module's
 * may do: a curve of samples, whose false folds are narrower than its steps, passes two more solutions or not; a slider that slips for the last time comes to
 * rest elsewhere; next to a fold or a grazing a solution moves more than the case. */
const REWRITTEN = 32, rewriting = 1e-14;
const sameAnswer = 1e-9; /* two rows nearer than this are the same answer to two such cases: a case changed by 1e-14 moves it by 1e5 as much at most */

const rewritten = (text, random) => text.replace(/(mass|damping|stiffness|amplitude|friction|gap): (-?[\d.e-]+)/g,
  (all, key, value) => `${key}: ${Number(value) * (1 + rewriting * (2 * random() - 1))}`);

/* Is each row of `a` an answer to one of the cases, to the limit and what that answer moves among them; and is there, of solutions, each that all cases have? */
function isAmong(kind, sizes, a, all) {
  const others = all.filter(b => a.status === b.status && a.columns === b.columns); /* Newton's methods may fail in two ways */
  if (!others.length) return false;
  const anywhere = ['at', 'near'].includes(kind); /* rows are found or not; else each has its place */
  if (!anywhere && !others.every(b => a.rows === b.rows)) return false;
  const rows = others.flatMap(b => Array.from({length: b.rows}, (_, j) => ({b, j})));
  const from = (row, other) => distance(kind, sizes, row.b, row.j, other.b, other.j);
  const placed = row => rows.filter(other => anywhere || other.j === row.j);
  const moves = row => Math.max(0, ...placed(row).map(other => from(row, other)).filter(d => d <= sameAnswer));
  const own = Array.from({length: a.rows}, (_, j) => ({b: a, j}));
  const meets = (row, other) => from(row, other) <= limit + moves(other);
  const known = own.every(row => placed(row).some(other => meets(row, other)));
  const first = Array.from({length: others[0].rows}, (_, j) => ({b: others[0], j}));
  const inAll = row => others.every(b => Array.from({length: b.rows}, (_, j) => ({b, j})).some(other => from(row, other) <= sameAnswer));
  return known && first.filter(inAll).every(row => own.some(other => meets(other, row)));
}

/* ---- */

/* {lab, close, said}: the module in node, or the page's library in Chromium; said: what came on the console, and what was asked for. */
async function start() {
  if (!chromium) return {lab: labClient(await require(path.resolve(labPath))()), close() {}, said: () => []};
  const p = await open(chromium, 'file://' + path.resolve(labPath));
  for (const end = Date.now() + 60000; !(await p.evaluate('typeof seen !== "undefined" && !!seen.errors'));)
    if (Date.now() > end) throw new Error('the page does not start');
  return {lab: await libraryOf(p), close: () => p.close(), said: () => [...p.lines, ...p.requests]};
}

async function main() {
  const {lab, close, said} = await start();
  const random = randomNumbers(Number(seed)), worst = {};
  let failed = 0, answers = 0, decided = 0;
  for (let i = 0; i < Number(scenes); ++i) {
    const text = randomCase(random);
    if ((await lab.read(text)).status !== 0) throw new Error('not a case: ' + text);
    const questions = await asked(lab), ours = await answersOf(lab, questions), theirs = await nativeAnswers(text, questions);
    let others = null;
    for (const question of new Set([...Object.keys(ours), ...Object.keys(theirs)])) {
      if (!listed(ours[question])) {
        console.log(`scene ${i}: ${question}: the rows by name are not those of the table`);
        ++failed;
      }
      if (notCompared.some(pattern => pattern.test(question))) continue;
      const kind = question.split(' ')[0], name = question.replace(/ \d+$/, '');
      const [a, b] = [ours[question], theirs[question]], sizes = b && sizesOf(kind, b, questions.X), d = difference(kind, sizes, a, b);
      ++answers;
      if (d <= limit) {
        worst[name] = Math.max(worst[name] || 0, d);
        continue;
      }
      if (!others) {
        const change = randomNumbers(i);
        others = [theirs];
        while (others.length <= REWRITTEN) others.push(await nativeAnswers(rewritten(text, change), questions));
      }
      const good = a && b && isAmong(kind, sizes, a, others.map(all => all[question]));
      console.log(`scene ${i}: ${question}: ${d.toExponential(1)}, ${good ? 'as the native answer to a case changed by ' + rewriting : 'NOT SO natively'}`);
      if (good) ++decided;
      else ++failed;
      if (process.env.LAB_KEEP) fs.writeFileSync(path.join(process.env.LAB_KEEP, `scene${i}.yaml`), text);
    }
  }
  await lab.free();
  const heard = said();
  await close();
  for (const question in worst) console.log(`${question}: largest difference ${worst[question].toExponential(2)}`);
  console.log(`${scenes} scenes, ${answers} answers: ${decided} that rounding decides, ${failed} differ by more than ${limit}`);
  if (heard.length) console.log('the page: ' + heard.join('\n').slice(0, 2000));
  /* of well-posed questions rounding decides few; seen: 3 of 1500 at the most */
  process.exit(failed || heard.length || decided > answers / 100 ? 1 : 0);
}

main().catch(error => {
  console.log(error.stack);
  process.exit(1);
});
