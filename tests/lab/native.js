/* native.js - the native library, asked as lab_client.js asks the module. */
'use strict';
const {execFileSync} = require('child_process');

const run = (program, args, input) => execFileSync(program, args, {input, maxBuffer: 1 << 28}).toString().trimEnd().split('\n');
const numbersOf = lines => Float64Array.from(lines.flatMap(line => line.split(' ').map(parseFloat)));

/* lab_answers: the tables of all questions to a case file, by name. */
function answersOf(program, text, {omegas, X}) {
  const lines = run(program, [X.join(), omegas.join()], text), all = {};
  for (let at = 0; at < lines.length;) {
    const [, question, ...head] = lines[at++].match(/^(.*) (\d+) (\d+) (\d+)$/), [status, rows, columns] = head.map(Number);
    all[question] = {status, rows, columns, values: numbersOf(lines.slice(at, at += rows))};
  }
  return all;
}

/* lab_asked: the questions that the lesson puts. All since the case was read are put again with each, and the last one's answer is taken. */
function clientOf(program) {
  let asked = '';
  const put = line => {
    asked += line + '\n';
    const [head, ...lines] = run(program, [], asked), [status, rows, columns] = head.split(' ').map(Number);
    return {status, message: '', rows, columns, values: numbersOf(lines)};
  };
  return {
    read(text) {
      asked = '';
      return put(`read ${Buffer.byteLength(text)}\n${text}`);
    },
    motion: X => void (asked += `motion ${(X.length - 1) / 2} ${Array.from(X).join(' ')}\n`),
    curve: force => put(`curve ${force}`),
    curveAt: (force, omega) => put(`at ${force} ${omega}`),
    signal: (force, n) => put(`signal ${force} ${n}`),
    spectrum: (n, shown) => put(`spectrum ${n} ${shown}`),
    errors: omega => put(`errors ${omega}`)
  };
}

module.exports = {answersOf, clientOf};
