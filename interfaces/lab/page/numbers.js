/* numbers.js - the numbers of the response curve and of one motion as tables, for those who do not see the drawings, and
 * to be copied. They are filled when they are opened. */
'use strict';

const shownInTable = 32; /* instants of a period */
const cellsOf = list => '<tr>' + list.map(cell => `<td>${cell}</td>`).join('') + '</tr>';

/* Head and body of a table of results: the columns `first` {name: its head}, then all others that rows have, by name; no series. */
function tableOfResults(rows, first) {
  const others = Object.keys(rows[0] || {}).filter(name => !(name in first) && !ArrayBuffer.isView(rows[0][name]));
  const names = Object.keys(first).concat(others), cell = v => (typeof v === 'string' ? plain(v) : show(v, 6));
  return {head: '<tr>' + names.map(name => `<th scope="col">${first[name] || name}</th>`).join('') + '</tr>',
    body: rows.map(row => cellsOf(names.map(name => cell(row[name])))).join('')};
}

/* Points of the exact curve, each with the sampled solution next to it where neighbours, of the same case, has one. */
function curveTable(exact, neighbours) {
  const beside = exact && neighbours && neighbours.text === exact.text ? neighbours.curve.list : [];
  const rows = exact ? exact.curve.list.map((row, i) => Object.assign({sampled: (beside[i] || {}).amplitude}, row)) : [];
  return tableOfResults(rows, {omega: 'omega', amplitude: 'amplitude, exact', sampled: 'with N samples', stable: 'stable',
    multiplier: 'largest multiplier', contact: 'strongest at a contact'});
}

/* Special points of the exact curve. */
function specialTable(exact) {
  const rows = exact && exact.specials ? exact.specials.list.map(row => Object.assign({}, row, {kind: row.kind.replace('turning point', 'fold')})) : [];
  return tableOfResults(rows, {kind: 'what', omega: 'omega', amplitude: 'amplitude', before: 'contact before', after: 'after'});
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

/* content() into the table where the details around it are open; head: where it is not the page's. */
function fillOpen(table, content) {
  if (!$(table).closest('details').open) return;
  const {head, body} = content();
  if (head) $(table).tHead.innerHTML = head;
  $(table).tBodies[0].innerHTML = body;
}

function drawCurveNumbers(seen) {
  fillOpen('curve-table', () => curveTable(seen.exact, seen.neighbours));
  fillOpen('special-table', () => specialTable(seen.exact));
}

const drawMotionNumbers = (state, motion) => fillOpen('motion-table', () => ({body: motionRows(state, motion)}));
