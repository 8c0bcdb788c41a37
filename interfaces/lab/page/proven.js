/* proven.js - periodic orbits of the exact law that `hbmcheck prove` has certified for the cases the page carries
 * (proven.txt, made and tested by proven.py): the badge of a case, and its marks on the response curve. */
'use strict';

const caseNumbers = state => [state.mass, state.damping, state.stiffness, state.force]
  .concat(...state.contacts.map(c => contactKeys.map(key => c[key])));

/* Each case once: {key, orbits [{omega, amplitude, stable}]}. */
function provenCases(text) {
  const cases = [];
  for (const line of text.trim().split('\n')) {
    const words = line.split(/[ =|]+/).filter(word => word);
    if (line.startsWith('==')) cases.push({key: words.map(Number).join(), orbits: []});
    else if (cases.length) cases[cases.length - 1].orbits.push({omega: Number(words[0]), amplitude: Number(words[1]), stable: words[2]});
  }
  return cases;
}

let provenOnes = null;

/* Those of the state's numbers, whatever H, N and harmonic 0 are: the orbits are of the equation of motion itself. */
function provenOrbits(state) {
  provenOnes = provenOnes || provenCases(document.getElementById('proven').textContent);
  const key = caseNumbers(state).join(), found = provenOnes.find(one => one.key === key);
  return found ? found.orbits : [];
}

/* The frequency next to the state's at which orbits are proven; NaN: there is none. */
const provenOmega = state => provenOrbits(state).reduce((best, {omega}) =>
  (Math.abs(omega - state.omega) < Math.abs(best - state.omega) || isNaN(best) ? omega : best), NaN);

/* What is proven at the state's omega, or next to it; '' where the case is none of those. */
function provenWords(state, motion) {
  const omega = provenOmega(state), there = provenOrbits(state).filter(orbit => orbit.omega === omega);
  if (isNaN(omega)) return '';
  const list = there.map(orbit => `${show(orbit.amplitude, 8)} (${orbit.stable})`).join(', ');
  const row = omega === state.omega && motion && motion.omega === omega && motion.solutions && motion.solutions[motion.chosen];
  const off = row ? Math.min(...there.map(orbit => Math.abs(row.amplitude / orbit.amplitude - 1))) : NaN;
  return `Proven at omega = ${show(omega, 6)}: the equation of motion has a periodic orbit of amplitude ${list}.` +
    (isFinite(off) ? ` The solution shown is ${percent(off)} off.` : '');
}

if (typeof exports !== 'undefined') Object.assign(exports, {provenCases, caseNumbers});
