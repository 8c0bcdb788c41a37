/* case_text.js - a state as a case file for the library, and a state from the library's table of a case it has read. */
'use strict';

const errorHarmonics = [1, 2, 3, 5, 7, 10, 15, 20];
const errorSamples = [16, 32, 64, 128, 256, 512, 1024, 2048, 4096];

const inOrder = list => Array.from(new Set(list)).sort((a, b) => a - b);

const contactText = c => c.law === 'table' ? `  - {law: table, points: ${c.points}}` :
  c.law === 'polynomial' ? `  - {law: polynomial, coefficients: {${powers.filter(p => c['k' + p] !== 0 || p === 3).map(p => p + ': ' + c['k' + p]).join(', ')}}}` :
  `  - {tangential_stiffness: ${c.kt}, normal_stiffness: ${c.kn}, friction: ${c.mu}, ` +
  `angle_deg: ${c.angle}, gap: ${c.gap}}`;

/* What a person keeps. */
const caseText = state => [
  `title: ${JSON.stringify(state.title)}`,
  `oscillator: {mass: ${state.mass}, damping: ${state.damping}, stiffness: ${state.stiffness}}`,
  `forcing: {amplitude: ${state.force}}`,
  state.contacts.length ? 'contacts:' : 'contacts: []',
  ...state.contacts.map(contactText),
  `sweep: {omega: [${state.from}, ${state.to}]}`,
  `hbm: {harmonics: ${state.H}, samples: ${state.N}, static: ${state.mean}, ` +
    `force: ${state.sampled ? 'sampled' : 'exact'}, slider_restart: ${state.restart}}`,
  ''
].join('\n');

/* The same with the H and N of the drawing of errors. */
function questionText(state) {
  const harmonics = inOrder(errorHarmonics.concat(state.H)).join(', ');
  const samples = inOrder(errorSamples.concat(state.N)).join(', ');
  return caseText(state) + `compare: {harmonics: [${harmonics}], samples: [${samples}]}\n`;
}

/* table, title: of lab_case and lab_title (lab.h). Where the case leaves a choice to the program: the page's own. */
function stateOfCase(table, title) {
  const [mass, damping, stiffness, force, from, to, H, N, mean, sampled, sample] = table.values;
  const contacts = [];
  for (let row = 1; row < table.rows; ++row) {
    const one = table.values.subarray(row * table.columns, (row + 1) * table.columns), [kt, kn, mu, angle, gap] = one;
    const given = Array.from(one.subarray(labLaw.points)).filter(v => !isNaN(v));
    contacts.push({[labLaw.polynomial]: Object.assign({law: 'polynomial'}, ...powers.map(p => ({['k' + p]: one[p - 2]}))),
      [labLaw.table]: {law: 'table', points: JSON.stringify(given.flatMap((d, i) => (i % 2 ? [] : [[d, given[i + 1]]])))}
    }[one[labLaw.law]] || {kt, kn, mu, angle, gap});
  }
  return Object.assign({}, firstState, {title, mass, damping, stiffness, force, from, to, H: H || 10, N: N || 1024,
    mean: mean !== 0, sampled: sampled !== 0, restart: sample ? 'sample' : 'interpolated', contacts,
    omega: Math.min(from, to) + 0.25 * Math.abs(to - from)});
}

if (typeof exports !== 'undefined') Object.assign(exports, {caseText, questionText, stateOfCase});
