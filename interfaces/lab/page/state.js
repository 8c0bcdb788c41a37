/* state.js - what the page shows, as plain data, and as words of its address.
 *   state {title, mass, damping, stiffness, force, from, to, H, N, mean, sampled, restart, contacts, omega, near, look,
 *         harmonic}, of contacts {kt, kn, mu, angle, gap}, {law: 'polynomial', k2, k3, k5, k7} or {law: 'table', points},
 *         points as a case file has them
 * sampled: the motion shown is the sampled equations' solution, not the exact ones'; near: the solution shown is the one
 * with the amplitude next to it, omega [rad/time]; look: the contact whose forces are shown; harmonic: the one looked at.
 * Followed by case_text.js to main.js in the same script, and shared with the worker. */
'use strict';

const mostContacts = 16; /* SCENE_MAX_CONTACTS of model/casefile/scene.h */
const scalars = ['mass', 'damping', 'stiffness', 'force', 'from', 'to', 'H', 'N', 'omega', 'near', 'look', 'harmonic'];
const contactKeys = ['kt', 'kn', 'mu', 'angle', 'gap'];
const someContact = {kt: 100, kn: 1000, mu: 0.3, angle: 45, gap: -5};
const powers = [2, 3, 5, 7]; /* of a polynomial that have fields */
const powerKeys = powers.map(p => 'k' + p);

/* The polynomial's highest power; 0: of another law. */
const degreeOf = c => (c.law === 'polynomial' ? Math.max(2, ...powers.filter(p => c['k' + p] !== 0)) : 0);

/* The points of a table as [[d, f], ...]; null: they are none. */
function pointsOf(text) {
  let list = null;
  try {
    list = JSON.parse(text);
  } catch (error) {
    return null;
  }
  const good = Array.isArray(list) && list.length >= 2 && list.length <= 32 &&
    list.every((p, i) => Array.isArray(p) && p.length === 2 && p.every(Number.isFinite) && (i === 0 || p[0] > list[i - 1][0]));
  return good ? list : null;
}

/* One of that law where there was another, in the size of the state's motion and stiffness. */
function contactOfLaw(law, state) {
  const k = state.stiffness || 1, d = +(state.force / k || 1).toPrecision(3);
  if (law === 'polynomial') return {law, k2: 0, k3: +(0.2 * k / (d * d)).toPrecision(3), k5: 0, k7: 0};
  return law === 'table' ? {law, points: JSON.stringify([[-2 * d, -5 * k * d], [-d, 0], [d, 0], [2 * d, 5 * k * d]])} : someContact;
}

/* Case 2 of the paper: cases/paper/case2.yaml. */
const firstState = {title: 'Case 2, intermittent contact', mass: 1, damping: 0.4, stiffness: 40, force: 100, from: 3,
  to: 20, H: 10, N: 64, mean: true, sampled: false, restart: 'interpolated', contacts: [someContact], omega: 7,
  near: Infinity, look: 0, harmonic: 1};

/* What the page opens with: a contact that slips and lifts off, cases/paper/fig08_f0_10.yaml. */
const openingState = Object.assign({}, firstState, {title: 'A contact that slips and lifts off, as it should be solved', force: 10,
  contacts: [{kt: 100, kn: 200, mu: 0.3, angle: 45, gap: -0.5}]});

const copyOf = state => Object.assign({}, state, {contacts: state.contacts.map(c => Object.assign({}, c))});

function addressOf(state) {
  const words = new URLSearchParams();
  for (const key of scalars) if (isFinite(state[key])) words.set(key, +Number(state[key]).toPrecision(10));
  words.set('mean', state.mean ? 1 : 0);
  words.set('sampled', state.sampled ? 1 : 0);
  words.set('restart', state.restart);
  for (const c of state.contacts)
    words.append('contact', c.law ? [c.law].concat(c.law === 'table' ? JSON.parse(c.points).flat() : powerKeys.map(key => c[key])).join(',') :
      contactKeys.map(key => c[key]).join(','));
  words.set('title', state.title);
  return '#' + words.toString();
}

/* Where harmonic h lands when sampled N times a period. */
function foldOf(h, N) {
  const rest = h % N;
  return Math.min(rest, N - rest);
}

/* Of numbers with a law before them, if it is not friction and gap; null: they are none. */
function contactOfWords(words, number) {
  const law = words[0] === 'polynomial' || words[0] === 'table' ? words.shift() : undefined, list = words.map(number);
  if (!list.every(isFinite)) return null;
  const of = keys => (list.length === keys.length ? Object.fromEntries(keys.map((key, i) => [key, list[i]])) : null);
  if (law === 'polynomial') return of(powerKeys) && Object.assign({law}, of(powerKeys));
  if (!law) return of(contactKeys);
  const points = JSON.stringify(list.flatMap((d, i) => (i % 2 ? [] : [[d, list[i + 1]]])));
  return pointsOf(points) && {law, points};
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
  state.contacts = words.getAll('contact').map(text => contactOfWords(text.split(','), number)).filter(c => c).slice(0, mostContacts);
  return state;
}

/* {text, own} of an address `#case=TEXT&omega=...`, as a report links to: a case file, and what the state has of its own; null: none. */
function caseOfAddress(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, '')), omega = Number(words.get('omega'));
  return words.get('case') ? {text: words.get('case'), own: omega > 0 && isFinite(omega) ? {omega} : {}} : null;
}

if (typeof exports !== 'undefined') Object.assign(exports, {foldOf, firstState, copyOf, addressOf, stateOfAddress, caseOfAddress, contactKeys, mostContacts, powers, degreeOf, pointsOf});
