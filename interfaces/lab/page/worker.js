/* worker.js - the library in a worker, after lab.js, lab_client.js, state.js, case_text.js and lesson_numbers.js. A job is
 *   {number, text, force, motion, omega, near, samples, shown, more}   or {number, read: text} or {number, lesson}
 * and is answered by parts {number, part, ...}: `curve` where the case is another than before; with `motion`, what the
 * solution at omega with the amplitude next to `near` is like, of `force` or, with `neighbour`, the sampled one next to
 * an exact one; of exact forces the `neighbours` with samples; `drawn`; and with `more`, unless a newer job has come,
 * `specials`, `transients` and `errors`; `end`. The first part ever is `ready`. */
'use strict';

const shownInstants = 512, transientPoints = 14;
let lab = null, waiting = null, running = false;
const known = {text: null, curve: null, neighbours: null, more: null};

const forget = () => Object.keys(known).forEach(key => (known[key] = null));

const say = (job, part, more) => postMessage(Object.assign({number: job.number, part}, more));

function timed(f) {
  const from = performance.now(), answer = f();
  return Object.assign(answer, {ms: performance.now() - from});
}

/* Is the job's case read, and its curve there? */
function readCase(job) {
  if (known.text === job.text) return true;
  forget();
  const read = lab.read(job.text);
  if (read.status === 0) known.text = job.text;
  else say(job, 'refused', {message: read.message});
  return read.status === 0;
}

function traceCurve(job) {
  if (known.curve) return;
  known.curve = timed(() => lab.curve(job.force));
  say(job, 'curve', {text: job.text, curve: known.curve});
}

/* The sampled solutions next to the points of the exact curve: much sooner there than the sampled curve. */
function followSamples(job) {
  if (known.neighbours) return;
  known.neighbours = timed(() => lab.neighbours());
  say(job, 'neighbours', {text: job.text, curve: known.neighbours});
}

/* The number of the row whose amplitude is next to `near`; Infinity: of the largest. */
function nearest(rows, near) {
  const off = row => (near === Infinity ? -row.amplitude : Math.abs(row.amplitude - near));
  return rows.reduce((best, row, i) => (best < 0 || off(row) < off(rows[best]) ? i : best), -1);
}

function describeMotion(job) {
  const from = performance.now();
  const at = job.neighbour ? lab.neighboursAt(job.omega) : lab.curveAt(job.force, job.omega);
  const solutions = at.list.filter(row => isFinite(row.amplitude));
  const chosen = nearest(solutions, job.near);
  const common = {omega: job.omega, solutions, chosen, neighbour: job.neighbour};
  if (chosen < 0) return say(job, 'motion', Object.assign(common, {message: at.message}));
  lab.motion(solutions[chosen].coefficients);
  const exact = lab.signal(labForce.exact, shownInstants), samples = lab.signal(labForce.sampled, job.samples);
  const spectrum = lab.spectrum(job.samples, job.shown), work = lab.work();
  const message = [exact, samples, spectrum, work].map(answer => answer.message).find(text => text) || '';
  say(job, 'motion', Object.assign(common, {message, exact, samples, spectrum, work, ms: performance.now() - from}));
}

function sayMore(job) {
  if (known.more) return;
  known.more = true;
  say(job, 'specials', {specials: lab.specials(job.force)});
}

/* Omegas over the curve: where something goes on it has more points. */
function transientOmegas() {
  const omegas = known.curve.list.map(row => row.omega).sort((a, b) => a - b);
  const at = Array.from({length: transientPoints}, (_, i) => omegas[Math.round(((omegas.length - 1) * i) / (transientPoints - 1))]);
  return at.filter((omega, i) => omega !== at[i - 1]);
}

const breath = () => new Promise(done => setTimeout(done, 0));

async function answer(job) {
  if (job.read !== undefined) return readForeign(job);
  if (job.lesson !== undefined) return tellLesson(job);
  if (!readCase(job)) return;
  traceCurve(job);
  if (job.motion) describeMotion(job);
  if (job.force === labForce.exact) followSamples(job);
  say(job, 'drawn');
  if (!job.more) return;
  await breath();
  if (waiting) return;
  const first = !known.more;
  sayMore(job);
  await breath();
  if (job.force !== labForce.exact) return;
  if (first && known.curve.rows && !waiting) say(job, 'transients', {transients: timed(() => lab.transients(transientOmegas()))});
  else if (first) known.more = null; /* asked for again */
  await breath();
  if (!waiting) tellErrors(job);
}

/* Of the solution at omega, the exact one even where the sampled one is shown. */
function tellErrors(job) {
  const at = lab.curveAt(labForce.exact, job.omega), chosen = nearest(at.list, job.near);
  if (chosen < 0) return say(job, 'errors', {omega: job.omega, errors: at});
  lab.motion(at.list[chosen].coefficients);
  say(job, 'errors', {omega: job.omega, errors: timed(() => lab.errors(job.omega))});
}

function readForeign(job) {
  forget();
  const read = lab.read(job.read);
  if (read.status !== 0) return say(job, 'read', {message: read.message});
  say(job, 'read', {message: '', state: stateOfCase(lab.caseTable(), lab.title())});
}

function tellLesson(job) {
  forget();
  say(job, 'lesson', {step: job.lesson, told: lessonNumbers[job.lesson](lab)});
}

async function begin(job) {
  lab = labClient(await hbmcheckLab());
  say(job, 'ready');
}

async function run() {
  running = true;
  while (waiting) {
    const job = waiting;
    waiting = null;
    try {
      if (!lab) await begin(job);
      await answer(job);
    } catch (error) {
      lab = null; /* whatever it has left behind: a new one for the next job */
      forget();
      say(job, 'refused', {message: String(error.message || error)});
    }
    say(job, 'end');
  }
  running = false;
}

onmessage = event => {
  waiting = event.data;
  if (!running) run();
};
