/* lab_client.js - the questions of lab.h for JavaScript, put to a module that hbmcheckLab() of lab.js has made. Every
 * one answers {status, message, rows, columns, values}: status 0 is HC_OK, values[row * columns + column] is a
 * Float64Array of the caller's own; and of results {names, kinds, words, list}: list[i] is row i by names, {omega: 7,
 * stable: 'yes', coefficients: Float64Array, ...}, NaN what is not there, undefined if a text. */
'use strict';

const labForce = {exact: 0, sampled: 1};
const labLaw = {law: 10, polynomial: 1, table: 3, points: 11};

/* The table with its list; text, integer, real, series: lab_kind. */
function labTable(table) {
  const {rows, columns, names, kinds, words, values} = table;
  const cell = (kind, row, c) => {
    if (kind !== 'series') return kind === 'text' ? words[row[c]] : row[c];
    const end = row.findIndex((v, i) => i >= c && isNaN(v));
    return row.subarray(c, end < 0 ? columns : end);
  };
  table.list = names.length === 0 ? [] : Array.from({length: rows}, (_, i) => {
    const row = values.subarray(i * columns, (i + 1) * columns);
    return Object.fromEntries(names.map((name, c) => [name, cell(kinds[c], row, c)]));
  });
  return table;
}

function labClient(module) {
  const lab = module._lab_new();
  if (!lab) throw new Error('out of memory');

  /* f(lab, 0), f(lab, 1), ... until there is none. */
  const texts = f => {
    const list = [];
    for (let text; (text = f(lab, list.length));) list.push(module.UTF8ToString(text));
    return list;
  };

  const answer = status => {
    const rows = module._lab_rows(lab), columns = module._lab_columns(lab);
    const from = module._lab_values(lab) / 8; /* rows that cannot be: no memory to look at */
    return labTable({status, message: module.UTF8ToString(module._lab_message(lab)), rows, columns, names: texts(module._lab_name),
      kinds: texts(module._lab_kind), words: texts(module._lab_word), values: module.HEAPF64.slice(from, from + rows * columns)});
  };

  /* f(address) with room for `bytes`. */
  const withRoom = (bytes, f) => {
    const address = module._malloc(bytes);
    if (!address) throw new Error('out of memory');
    try {
      return f(address);
    } finally {
      module._free(address);
    }
  };

  return {
    read(text) {
      const bytes = module.lengthBytesUTF8(text) + 1;
      return withRoom(bytes, address => {
        module.stringToUTF8(text, address, bytes);
        return answer(module._lab_read(lab, address));
      });
    },
    caseTable: () => answer(module._lab_case(lab)),
    title: () => module.UTF8ToString(module._lab_title(lab)),
    curve: force => answer(module._lab_curve(lab, force)),
    curveAt: (force, omega) => answer(module._lab_curve_at(lab, force, omega)),
    neighbours: () => answer(module._lab_neighbours(lab)),
    neighboursAt: omega => answer(module._lab_neighbours_at(lab, omega)),
    specials: force => answer(module._lab_specials(lab, force)),
    /* X: of 2 H + 1 coefficients, what signal, spectrum, work and errors are asked about. */
    motion(X) {
      const address = module._lab_motion(lab, (X.length - 1) / 2);
      if (address) module.HEAPF64.set(X, address / 8);
    },
    signal: (force, n) => answer(module._lab_signal(lab, force, n)),
    spectrum: (n, shown) => answer(module._lab_spectrum(lab, n, shown)),
    work: () => answer(module._lab_work(lab)),
    transients: omega =>
      withRoom(8 * omega.length, address => {
        module.HEAPF64.set(omega, address / 8);
        return answer(module._lab_transients(lab, omega.length, address));
      }),
    errors: omega => answer(module._lab_errors(lab, omega)),
    free: () => module._lab_free(lab)
  };
}

if (typeof exports !== 'undefined') Object.assign(exports, {labClient, labTable, labForce, labLaw});
