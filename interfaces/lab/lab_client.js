/* lab_client.js - the questions of lab.h for JavaScript, put to a module that hbmcheckLab() of lab.js has made. Every
 * one answers {status, message, rows, columns, values}: status 0 is HC_OK, values[row * columns + column] is a
 * Float64Array of the caller's own. Enumerations are those of lab.h. */
'use strict';

const labForce = {exact: 0, sampled: 1};
const labColumn = {omega: 0, branch: 1, amplitude: 2, max: 3, min: 4, rms: 5, mean: 6, harmonic1: 7, stable: 8,
  multiplier: 9, contact: 10, iterations: 11, residual: 12, harmonics: 13, solution: 14};
const labLaw = {law: 10, polynomial: 1, table: 3, points: 11};

function labClient(module) {
  const lab = module._lab_new();
  if (!lab) throw new Error('out of memory');

  const answer = status => {
    const rows = module._lab_rows(lab), columns = module._lab_columns(lab);
    const from = module._lab_values(lab) / 8; /* rows that cannot be: no memory to look at */
    return {status, message: module.UTF8ToString(module._lab_message(lab)), rows, columns,
      values: module.HEAPF64.slice(from, from + rows * columns)};
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

if (typeof exports !== 'undefined') Object.assign(exports, {labClient, labForce, labColumn, labLaw});
