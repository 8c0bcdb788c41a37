/* equal.js LAB_ANSWERS LAB_JS [SCENES [SEED]] - the module's answers against those of the native program, to 1e-12.
 * Random cases (seeded) and what the command line adds are put to both: lab_answers prints every question's table, and
 * the same questions go to the module by lab_client.js. Exit 1: an answer differs. */
'use strict';
const {execFileSync} = require('child_process');
const fs = require('fs'), path = require('path');
const {labClient, labForce, labColumn} = require(path.join(__dirname, '../../lab/lab_client.js'));

const [native, modulePath, scenes = '50', seed = '1'] = process.argv.slice(2);
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
  const n = pick([1, 2, 3, 5, 7, 10]);
  return [`oscillator: {mass: ${mass}, damping: ${between(0.02, 0.2) * mass * omega}, stiffness: ${stiffness}}`,
    `forcing: {amplitude: ${force}}`, 'contacts:', ...contacts, `sweep: {omega: [${0.4 * omega}, ${2.5 * omega}]}`,
    `hbm: {harmonics: ${n}, samples: ${pick([32, 63, 64, 100, 128, 256, 1000, 1024])}, static: ${pick([true, true, false])}, tolerance: 1e-14}`,
    'transient: {tolerance: 1e-13, start: rest}',
    'compare: {harmonics: [1, 3, 5], samples: [16, 64, 256]}', ''].join('\n');
}

/* ---- the questions of lab_answers.c ---- */

const forces = ['exact', 'sampled'];

/* Where it is asked: the points of the module's own curve, this many of them; the first one's solution is the motion. */
const ASKED = 8, SAMPLES = 64, SHOWN = 40;

function asked(lab) {
  const curve = lab.curve(labForce.exact);
  const row = k => curve.values.subarray(k * curve.columns, (k + 1) * curve.columns);
  const at = i => row(Math.floor((curve.rows - 1) * ((i + ASKED / 2) % ASKED) / ASKED));
  const omegas = Array.from({length: ASKED}, (_, i) => at(i)[labColumn.omega]);
  return {omegas, X: at(0).slice(labColumn.solution, labColumn.solution + 2 * at(0)[labColumn.harmonics] + 1)};
}

function moduleAnswers(lab, {omegas, X}) {
  const all = {};
  for (const force of forces) {
    all['curve ' + force] = lab.curve(labForce[force]);
    all['specials ' + force] = lab.specials(labForce[force]);
    omegas.forEach((omega, i) => (all[`at ${force} ${i}`] = lab.curveAt(labForce[force], omega)));
  }
  omegas.forEach((omega, i) => (all[`near ${i}`] = lab.neighboursAt(omega)));
  lab.motion(X);
  all['signal exact'] = lab.signal(labForce.exact, SAMPLES);
  all['signal sampled'] = lab.signal(labForce.sampled, SAMPLES);
  all.spectrum = lab.spectrum(SAMPLES, SHOWN);
  all.work = lab.work();
  all.errors = lab.errors(omegas[0]);
  all.transients = lab.transients(omegas);
  return all;
}

function nativeAnswers(text, {omegas, X}) {
  const lines = execFileSync(native, [X.join(), omegas.join()], {input: text, maxBuffer: 1 << 28}).toString().split('\n');
  const all = {};
  for (let at = 0; at < lines.length && lines[at];) {
    const head = lines[at++].match(/^(.*) (\d+) (\d+) (\d+)$/);
    const [status, rows, columns] = head.slice(2).map(Number);
    const values = Float64Array.from(lines.slice(at, at += rows).flatMap(line => line.split(' ').map(parseFloat)));
    all[head[1]] = {status, rows, columns, values};
  }
  return all;
}

/* ---- the difference ---- */

/* What is not held against each other. Rounding errors differ (FFTW's vector instructions, libm), and decide where a
 * curve has its points and how many false turning points of samples it passes; solutions at a given omega do not depend
 * on that. Iterations, residuals and periods until something settles count rounding errors; the strongest regime and the
 * multiplier of a motion that just reaches a limit, or just touches, are theirs to decide. */
const notCompared = [/^curve /, /^specials /];
const rounded = [labColumn.branch, labColumn.contact, labColumn.iterations, labColumn.residual];
const unmeasured = {at: rounded, near: rounded, errors: [5], transients: [9, 11]};
/* Columns of one size. */
const sharing = {at: [[2, 8], [14]], near: [[2, 8], [14]], transients: [[2, 8], [13]], spectrum: [[1, 3], [3, 5]]};

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
  for (const [from, to = a.columns] of sharing[kind] || []) sizes.fill(Math.max(...sizes.slice(from, to)), from, to);
  return sizes;
}

/* Largest |a - b| over the column's size, where a multiplier counts by its own limit. NaN equals NaN alone. */
function difference(question, a, b, X) {
  const kind = question.split(' ')[0];
  if (!a || !b || a.status !== b.status || a.rows !== b.rows || a.columns !== b.columns)
    return {worst: Infinity, where: a && b ? `status ${a.status} ${b.status}, rows ${a.rows} ${b.rows}` : 'not asked'};
  const sizes = sizesOf(kind, b, X);
  let found = {worst: 0, where: ''};
  a.values.forEach((value, i) => {
    const c = i % a.columns, other = b.values[i];
    if (kind === 'transients' && c > 1 && b.values[i - c + 1] !== 0) return; /* it did not settle */
    if ((unmeasured[kind] || []).includes(c) || Object.is(value, other) || value === other) return;
    const own = ['at', 'near'].includes(kind) && c === labColumn.multiplier ? limitOfMultipliers / limit : 1;
    const d = Math.abs(value - other) / sizes[c] / own;
    if (!(d <= found.worst)) found = {worst: isNaN(d) ? Infinity : d, where: `row ${Math.floor(i / a.columns)} of ${a.rows} column ${c}: ${value} ${other}`};
  });
  return found;
}

/* ---- */

async function main() {
  const hbmcheckLab = require(path.resolve(modulePath));
  const lab = labClient(await hbmcheckLab());
  const random = randomNumbers(Number(seed)), worst = {};
  let failed = 0;
  for (let i = 0; i < Number(scenes); ++i) {
    const text = randomCase(random);
    if (lab.read(text).status !== 0) throw new Error('not a case: ' + text);
    const questions = asked(lab), ours = moduleAnswers(lab, questions), theirs = nativeAnswers(text, questions);
    for (const question of new Set([...Object.keys(ours), ...Object.keys(theirs)])) {
      if (notCompared.some(pattern => pattern.test(question))) continue;
      const d = difference(question, ours[question], theirs[question], questions.X);
      const kind = question.replace(/ \d+$/, '');
      worst[kind] = Math.max(worst[kind] || 0, d.worst);
      if (d.worst <= limit) continue;
      ++failed;
      console.log(`scene ${i}: ${question}: ${d.worst.toExponential(1)} at ${d.where}`);
      if (process.env.LAB_KEEP) fs.writeFileSync(path.join(process.env.LAB_KEEP, `scene${i}.yaml`), text);
    }
  }
  for (const question in worst) console.log(`${question}: largest difference ${worst[question].toExponential(2)}`);
  console.log(`${scenes} scenes, ${failed} answers differ by more than ${limit}`);
  lab.free();
  process.exitCode = failed ? 1 : 0;
}
main();
