/* lesson_numbers.js - the number that each step of the lesson asks for, from questions to the library (lab_client.js):
 * the page's worker puts them to the module, a test to the native program. Nothing of the page.
 * Every function answers {number, facts}: facts stand in the words that follow the answer (lesson.js). */
'use strict';

const lessonBase = {mass: 1, damping: 0.4, stiffness: 40, force: 100, from: 3, to: 20, H: 10, N: 64, mean: true,
  sampled: false, restart: 'interpolated', title: 'lesson'};
const lessonContact = {kt: 100, kn: 1000, mu: 0.3, angle: 45, gap: -5};

/* The states of the seven steps. */
const lessonStates = [
  {omega: 6, N: 16, H: 7},
  {omega: 6, N: 16, H: 7, harmonic: 5},
  {omega: 9, N: 64, H: 5},
  {omega: 6, N: 256, H: 10, restart: 'sample'},
  {omega: 7, N: 64, H: 10, mean: false},
  {omega: 7, N: 128, H: 10, kn: 1e5},
  {omega: 9, N: 64, H: 10}
].map(step => {
  const {kn, ...own} = step;
  return Object.assign({}, lessonBase, {near: Infinity, look: 0, harmonic: 1}, own,
    {contacts: [Object.assign({}, lessonContact, kn ? {kn} : {})]});
});

/* Of the largest exact solution of the state, which becomes the lab's motion. */
function lessonMotion(lab, state, compare) {
  const read = lab.read(caseText(state) + (compare || ''));
  if (read.status !== 0) throw new Error(read.message);
  lab.curve(labForce.exact);
  const best = lab.curveAt(labForce.exact, state.omega).list.reduce((a, b) => (a && a.amplitude >= b.amplitude ? a : b), null);
  if (!best) throw new Error('no solution at omega ' + state.omega);
  lab.motion(best.coefficients);
  return best.amplitude;
}

/* Instants out of n at which the contact is pressed, of the lab's motion. */
function pressed(lab, force, n) {
  const signal = lab.signal(force, n);
  let count = 0;
  for (let i = 0; i < n; ++i) if (signal.values[i * signal.columns + 4] > 0) ++count;
  return count;
}

/* Largest difference between sampled and true harmonics 0..H of the force, over the largest of them. */
function foldedPart(lab, n, H) {
  const {values} = lab.spectrum(n, H);
  let off = 0, size = 0;
  for (let h = 0; h <= H; ++h) {
    const [, a, b, sampledA, sampledB] = values.subarray(5 * h, 5 * h + 5);
    off = Math.max(off, Math.hypot(a - sampledA, b - sampledB));
    size = Math.max(size, Math.hypot(a, b));
  }
  return off / size;
}

/* -d log y/d log x of the straight line through them. */
function fallOf(x, y) {
  const [lx, ly] = [x, y].map(list => list.map(Math.log));
  const mean = list => list.reduce((a, b) => a + b, 0) / list.length;
  const [mx, my] = [mean(lx), mean(ly)];
  const top = lx.reduce((sum, v, i) => sum + (v - mx) * (ly[i] - my), 0);
  return -top / lx.reduce((sum, v) => sum + (v - mx) * (v - mx), 0);
}

const powersOfTwo = (from, to) => Array.from({length: to - from + 1}, (_, i) => Math.pow(2, from + i));

/* {amplitude, error} of lab_errors at H and N (0: exact). */
function errorAt(errors, H, N) {
  for (let i = 0; i < errors.rows; ++i) {
    const [h, n, , amplitude, error] = errors.values.subarray(6 * i, 6 * i + 6);
    if (h === H && n === N) return {amplitude, error};
  }
  return {amplitude: NaN, error: NaN};
}

const lessonNumbers = [
  lab => { /* 1: how many of 16 samples lie in contact */
    lessonMotion(lab, lessonStates[0]);
    return {number: pressed(lab, labForce.sampled, 16), facts: {share: pressed(lab, labForce.exact, 4096) / 4096}};
  },
  lab => { /* 2: where harmonic 11 of 16 samples goes */
    lessonMotion(lab, lessonStates[1]);
    const {values} = lab.spectrum(16, 40), size = (h, at) => Math.hypot(values[5 * h + at], values[5 * h + at + 1]);
    return {number: foldOf(11, 16), facts: {five: size(5, 1), sampled: size(5, 3), eleven: size(11, 1)}};
  },
  lab => { /* 3: error of the amplitude at N = 64 with H = 20, in per cent */
    lessonMotion(lab, Object.assign({}, lessonStates[2], {H: 10}), 'compare: {harmonics: [5, 20], samples: [64]}\n');
    const errors = lab.errors(9);
    const at = (H, N) => 100 * errorAt(errors, H, N).error;
    return {number: at(20, 64), facts: {five: at(5, 64), exactFive: at(5, 0), exactTwenty: at(20, 0)}};
  },
  lab => { /* 4: the power of 1/N with which the error falls when the slider restarts on a sample */
    const samples = powersOfTwo(6, 16);
    const fall = restart => {
      lessonMotion(lab, Object.assign({}, lessonStates[3], {restart}));
      return fallOf(samples, samples.map(n => foldedPart(lab, n, 10)));
    };
    return {number: fall('sample'), facts: {interpolated: fall('interpolated')}};
  },
  lab => { /* 5: how much the amplitude is off without harmonic 0, in per cent */
    const kept = lessonMotion(lab, Object.assign({}, lessonStates[4], {mean: true}));
    const dropped = lessonMotion(lab, lessonStates[4]);
    return {number: (100 * (dropped - kept)) / kept, facts: {kept, dropped}};
  },
  lab => { /* 6: samples until nothing folds beyond a thousandth, kn = 1e5 */
    const needed = state => {
      lessonMotion(lab, state);
      return powersOfTwo(5, 16).find(n => foldedPart(lab, n, 10) <= 1e-3);
    };
    const soft = Object.assign({}, lessonStates[5], {contacts: [lessonContact]});
    return {number: needed(lessonStates[5]), facts: {soft: needed(soft)}};
  },
  lab => { /* 7: samples until the amplitude is that of exact forces to 1e-6 */
    const samples = powersOfTwo(6, 15);
    lessonMotion(lab, lessonStates[6], `compare: {harmonics: [10], samples: [${samples.join(', ')}]}\n`);
    const errors = lab.errors(9), exact = errorAt(errors, 10, 0);
    const off = n => Math.abs(errorAt(errors, 10, n).amplitude - exact.amplitude) / exact.amplitude;
    let needed = NaN; /* and stays there */
    for (let i = samples.length - 1; i >= 0 && off(samples[i]) <= 1e-6; --i) needed = samples[i];
    return {number: needed, facts: {amplitude: exact.amplitude, error: 100 * exact.error}};
  }
];

if (typeof exports !== 'undefined') Object.assign(exports, {lessonNumbers, lessonStates});
