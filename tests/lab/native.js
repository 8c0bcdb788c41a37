/* native.js - the native library, asked as lab_client.js asks the module. */
'use strict';
const {execFileSync} = require('child_process'), path = require('path');
const {labTable} = require(path.join(__dirname, '../../interfaces/lab/lab_client.js'));

/* answer becomes the table that begins at lines[at] (lab_asked.c); returns the place after it. */
function fill(answer, lines, at) {
  const [status, rows, columns] = lines[at].split(' ').map(Number), end = at + 4 + rows;
  const [names, kinds, words] = lines.slice(at + 1, at + 4).map(line => (line ? line.split('\t') : []));
  const values = Float64Array.from(lines.slice(at + 4, end).flatMap(line => line.split(' ').map(parseFloat)));
  labTable(Object.assign(answer, {status, message: '', rows, columns, names, kinds, words, values}));
  return end;
}

/* By lab_asked, to which all questions since the case was read are put: with each, and every answer is there at once; or, later, by answerAll(). */
function clientOf(program, later) {
  let asked = '', answers = [];
  const answerAll = () => {
    const lines = execFileSync(program, {input: asked, maxBuffer: 1 << 28}).toString().split('\n');
    answers.reduce((at, answer) => fill(answer, lines, at), 0);
  };
  const put = line => {
    asked += line + '\n';
    answers.push({});
    if (!later) answerAll();
    return answers[answers.length - 1];
  };
  return {
    read(text) {
      asked = '';
      answers = [];
      return put(`read ${Buffer.byteLength(text)}\n${text}`);
    },
    motion: X => void (asked += `motion ${(X.length - 1) / 2} ${Array.from(X).join(' ')}\n`),
    curve: force => put(`curve ${force}`),
    curveAt: (force, omega) => put(`at ${force} ${omega}`),
    specials: force => put(`specials ${force}`),
    neighboursAt: omega => put(`near ${omega}`),
    signal: (force, n) => put(`signal ${force} ${n}`),
    spectrum: (n, shown) => put(`spectrum ${n} ${shown}`),
    work: () => put('work'),
    errors: omega => put(`errors ${omega}`),
    transients: omega => put(`transients ${omega.length} ${omega.join(' ')}`),
    answerAll
  };
}

module.exports = {clientOf};
