/* numbers.js - the numbers of the response curve and of one motion as tables, for those who do not see the drawings, and
 * to be copied. They are filled when they are opened. */
'use strict';

const shownInTable = 32; /* instants of a period */
const specialNames = ['fold', 'period doubling', 'contact changes', 'Neimark-Sacker', 'symmetry breaking'];
const stableName = v => (v > 0 ? 'yes' : v < 0 ? 'no' : 'unknown');
const cellsOf = list => '<tr>' + list.map(cell => `<td>${cell}</td>`).join('') + '</tr>';

/* Rows of the exact curve, each with the sampled solution next to it where neighbours, of the same case, has one. */
function curveRows(exact, neighbours) {
  if (!exact) return '';
  const {rows, columns, values} = exact.curve;
  const amplitude = i => (neighbours && neighbours.text === exact.text && i < neighbours.curve.rows ?
    neighbours.curve.values[i * neighbours.curve.columns + labColumn.amplitude] : NaN);
  return Array.from({length: rows}, (_, i) => {
    const row = values.subarray(i * columns, (i + 1) * columns);
    return cellsOf([show(row[labColumn.omega], 6), show(row[labColumn.amplitude], 6), show(amplitude(i), 6), stableName(row[labColumn.stable]),
      show(row[labColumn.multiplier], 4), regimes[row[labColumn.contact]]]);
  }).join('');
}

/* Special points of the exact curve. */
function specialRows(exact) {
  if (!exact || !exact.specials) return '';
  const {rows, columns, values} = exact.specials;
  return Array.from({length: rows}, (_, i) => {
    const [omega, amplitude, , kind, before, after] = values.subarray(i * columns, (i + 1) * columns);
    return cellsOf([specialNames[kind], show(omega, 6), show(amplitude, 6), regimes[before], regimes[after]]);
  }).join('');
}

/* Some instants of the motion: x, and of the contact looked at u, N and T by the exact law. */
function motionRows(state, motion) {
  if (!motion || !motion.exact) return '';
  const {rows, columns, values} = motion.exact, at = columnsOf(state.look), touches = state.contacts.length > 0;
  return Array.from({length: shownInTable}, (_, i) => {
    const from = Math.round((i * rows) / shownInTable), row = values.subarray(from * columns, (from + 1) * columns);
    const contact = touches ? [at.u, at.N, at.T].map(c => show(row[c], 5)) : ['-', '-', '-'];
    return cellsOf([show(from / rows, 5), show(row[1], 6), ...contact]);
  }).join('');
}

/* rows() into the table's body where the details around it are open. */
function fillOpen(table, rows) {
  const body = $(table).tBodies[0];
  if ($(table).closest('details').open) body.innerHTML = rows();
}

function drawCurveNumbers(seen) {
  fillOpen('curve-table', () => curveRows(seen.exact, seen.neighbours));
  fillOpen('special-table', () => specialRows(seen.exact));
}

const drawMotionNumbers = (state, motion) => fillOpen('motion-table', () => motionRows(state, motion));
