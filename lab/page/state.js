/* state.js - what the page shows, as plain data, and as words of its address.
 *   state {title, mass, damping, stiffness, force, from, to, H, N, mean, sampled, restart, contacts [{kt, kn, mu, angle,
 *         gap}], omega, near, look, harmonic}
 * sampled: the motion shown is the sampled equations' solution, not the exact ones'; near: the solution shown is the one
 * with the amplitude next to it, omega [rad/time]; look: the contact whose forces are shown; harmonic: the one looked at.
 * Followed by case_text.js to main.js in the same script, and shared with the worker. */
'use strict';

const mostContacts = 16; /* SCENE_MAX_CONTACTS of casefile/scene.h */
const scalars = ['mass', 'damping', 'stiffness', 'force', 'from', 'to', 'H', 'N', 'omega', 'near', 'look', 'harmonic'];
const contactKeys = ['kt', 'kn', 'mu', 'angle', 'gap'];
const someContact = {kt: 100, kn: 1000, mu: 0.3, angle: 45, gap: -5};

/* Case 2 of the paper: cases/paper/case2.yaml. */
const firstState = {title: 'Case 2, intermittent contact', mass: 1, damping: 0.4, stiffness: 40, force: 100, from: 3,
  to: 20, H: 10, N: 64, mean: true, sampled: false, restart: 'interpolated', contacts: [someContact], omega: 7,
  near: Infinity, look: 0, harmonic: 1};

const copyOf = state => Object.assign({}, state, {contacts: state.contacts.map(c => Object.assign({}, c))});

function addressOf(state) {
  const words = new URLSearchParams();
  for (const key of scalars) if (isFinite(state[key])) words.set(key, +Number(state[key]).toPrecision(10));
  words.set('mean', state.mean ? 1 : 0);
  words.set('sampled', state.sampled ? 1 : 0);
  words.set('restart', state.restart);
  for (const c of state.contacts) words.append('contact', contactKeys.map(key => c[key]).join(','));
  words.set('title', state.title);
  return '#' + words.toString();
}

/* Where harmonic h lands when sampled N times a period. */
function foldOf(h, N) {
  const rest = h % N;
  return Math.min(rest, N - rest);
}

/* The state of an address, what it does not say as in `base`; null: it says nothing. Numbers that are none are not taken. */
function stateOfAddress(hash, base) {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  if (!words.has('mass')) return null;
  const state = copyOf(base);
  const number = text => (text === null || text.trim() === '' ? NaN : Number(text));
  state.near = Infinity;
  for (const key of scalars) if (isFinite(number(words.get(key)))) state[key] = number(words.get(key));
  state.mean = words.get('mean') !== '0';
  state.sampled = words.get('sampled') === '1';
  state.restart = words.get('restart') === 'sample' ? 'sample' : 'interpolated';
  state.title = words.get('title') || '';
  const lists = words.getAll('contact').map(text => text.split(',').map(number));
  state.contacts = lists.filter(list => list.length === 5 && list.every(isFinite)).slice(0, mostContacts)
    .map(list => Object.fromEntries(contactKeys.map((key, i) => [key, list[i]])));
  return state;
}

/* {text, own} of an address `#case=TEXT&omega=...`, as a report links to: a case file, and what the state has of its own; null: none. */
function caseOfAddress(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, '')), omega = Number(words.get('omega'));
  return words.get('case') ? {text: words.get('case'), own: omega > 0 && isFinite(omega) ? {omega} : {}} : null;
}

if (typeof exports !== 'undefined') Object.assign(exports, {foldOf, firstState, copyOf, addressOf, stateOfAddress, caseOfAddress, contactKeys, mostContacts});
