/* lesson.js LAB_ASKED LAB_JS HBMCHECK CASE - the number that each step of the page's lesson asks for, and those in the words that follow, by the native library and by the
 * module in node: equal. By the page: browser.js. Both go through the page's script, so what it makes of the answers is held against what the command says of
 * CASE (case 2 of the paper), where the command says it. Exit 1: one is not. */
'use strict';
const {execFileSync} = require('child_process');
const path = require('path');
const {clientOf} = require('./native.js'), {labClient, lessonOf, limitOfStep} = require('./lesson_steps.js');

const [native, modulePath, hbmcheck, caseFile] = process.argv.slice(2);
const limitOfCommand = 1e-6; /* relative: Newton stops at 1e-10 of the forces, 3e-8 of an error of 0.4 %, and an amplitude may follow the force thirtyfold */
let failed = 0;

function check(good, words) {
  if (good) return;
  ++failed;
  console.log('NOT SO: ' + words);
}

/* ---- by the command ---- */

/* Amplitudes of all solutions or steady states at omega. */
function amplitudes(command, omega, ...set) {
  const args = [command, caseFile, '--at', omega, '--format', 'json', '-q', ...set.flatMap(one => ['--set', one])];
  return JSON.parse(execFileSync(hbmcheck, args, {stdio: ['ignore', 'pipe', 'ignore']})).rows.map(row => row.amplitude);
}
const largest = list => Math.max(...list);
const nearest = (list, to) => list.reduce((a, b) => (Math.abs(b - to) < Math.abs(a - to) ? b : a));
const sampled = (H, N) => [`hbm.harmonics=${H}`, `hbm.samples=${N}`, 'hbm.force=sampled'];

/* Step 3: of H = 20 and 64 samples, next to the solution of exact forces, against the exact law's orbit. */
function errorOfMoreHarmonics() {
  const orbit = largest(amplitudes('transient', 9, 'transient.law=exact', 'transient.method=closed_form'));
  const exact = largest(amplitudes('frf', 9, 'hbm.harmonics=20'));
  return (100 * Math.abs(nearest(amplitudes('frf', 9, ...sampled(20, 64)), exact) - orbit)) / orbit;
}

function costOfHarmonicZero() {
  const [kept, dropped] = ['true', 'false'].map(mean => largest(amplitudes('frf', 7, 'hbm.harmonics=10', 'hbm.static=' + mean)));
  return (100 * (dropped - kept)) / kept;
}

/* Step 7: how far N samples are from exact forces. */
function offBySampling(N) {
  const exact = largest(amplitudes('frf', 9, 'hbm.harmonics=10'));
  return Math.abs(nearest(amplitudes('frf', 9, ...sampled(10, N)), exact) - exact) / exact;
}

function theCommandSaysSo(numbers) {
  const same = (a, b) => Math.abs(a - b) <= limitOfCommand * Math.abs(b);
  check(numbers[1] === 16 - 11, 'harmonic 11 of 16 samples');
  check(same(numbers[2], errorOfMoreHarmonics()), `step 3: ${numbers[2]} is ${errorOfMoreHarmonics()}`);
  check(same(numbers[4], costOfHarmonicZero()), `step 5: ${numbers[4]} is ${costOfHarmonicZero()}`);
  check(offBySampling(numbers[6]) <= 1e-6 && offBySampling(numbers[6] / 2) > 1e-6, `step 7: ${numbers[6]} samples suffice, half do not`);
}

/* ---- by both libraries ---- */

async function main() {
  const ours = lessonOf(clientOf(native)), theirs = lessonOf(labClient(await require(path.resolve(modulePath))()));
  const values = told => [told.number, ...Object.values(told.facts)];
  check(ours.length === 7, ours.length + ' steps');
  ours.forEach((a, i) => {
    const b = values(theirs[i]);
    console.log(`step ${i + 1}: ${values(a).join(' ')}`);
    check(values(a).every((v, j) => Math.abs(v - b[j]) <= limitOfStep(i) * Math.abs(v)), `step ${i + 1} of the module: ${b.join(' ')}`);
  });
  theCommandSaysSo(ours.map(told => told.number));
  process.exit(failed ? 1 : 0);
}
main();
