/* lesson.js LAB_ASKED LAB_JS - the number that each step of the page's lesson asks for, by the native library and by the module: equal. Exit 1: one is not. */
'use strict';
const {execFileSync} = require('child_process');
const fs = require('fs'), path = require('path'), vm = require('vm');

const [native, modulePath] = process.argv.slice(2);
/* Equal to 1e-9; step 4 tells slopes of errors down to 5e-9 of the forces, which are equal to 1e-13: 2e-5 of such an error, over seven
 * e-foldings of N, among eleven errors. */
const limitOf = step => (step === 3 ? 1e-6 : 1e-9);

/* The questions of lab_client.js that the lesson puts, to the native program: all since the case was read, and the last one's answer. */
function nativeClient() {
  let asked = '';
  const put = line => {
    asked += line + '\n';
    const [head, ...rows] = execFileSync(native, [], {input: asked, maxBuffer: 1 << 28}).toString().trimEnd().split('\n');
    const [status, n, columns] = head.split(' ').map(Number);
    return {status, message: '', rows: n, columns, values: Float64Array.from(rows.flatMap(row => row.split(' ').map(parseFloat)))};
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

async function main() {
  const context = vm.createContext({});
  const parts = ['lab_client.js', 'page/state.js', 'page/case_text.js', 'page/lesson_numbers.js'];
  vm.runInContext(parts.map(name => fs.readFileSync(path.join(__dirname, '../../lab', name), 'utf8')).join('\n') + '\nvar all = {labClient, lessonNumbers};', context);
  const ours = nativeClient(), theirs = context.all.labClient(await require(path.resolve(modulePath))());
  let failed = 0;
  context.all.lessonNumbers.forEach((step, i) => {
    const [a, b] = [ours, theirs].map(lab => step(lab));
    const values = told => [told.number, ...Object.values(told.facts)];
    const equal = values(a).every((v, j) => Math.abs(v - values(b)[j]) <= limitOf(i) * Math.abs(v));
    console.log(`step ${i + 1}: ${values(a).join(' ')}${equal ? '' : ' NOT ' + values(b).join(' ')}`);
    if (!equal) ++failed;
  });
  process.exit(failed || context.all.lessonNumbers.length !== 7 ? 1 : 0);
}
main();
