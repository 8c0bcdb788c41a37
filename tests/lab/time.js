/* time.js LAB_JS CASE - how long the module takes over a case's curve, and over the other questions: processor time, median
 * of 21. Prints; fails where an answer does. */
'use strict';
const fs = require('fs'), path = require('path');
const {labClient, labForce} = require(path.join(__dirname, '../../interfaces/lab/lab_client.js'));

const clock = () => {
  const {user, system} = process.cpuUsage();
  return (user + system) / 1000;
};

function median(f) {
  const times = Array.from({length: 21}, () => {
    const from = clock();
    const answer = f();
    if (answer.status !== 0) throw new Error(answer.message);
    return clock() - from;
  });
  return times.sort((a, b) => a - b)[10];
}

async function main() {
  const [modulePath, caseFile] = process.argv.slice(2);
  const begun = clock();
  const lab = labClient(await require(path.resolve(modulePath))());
  const ready = clock() - begun;
  const text = fs.readFileSync(caseFile, 'utf8');
  const read = lab.read(text);
  if (read.status !== 0) throw new Error(read.message);
  const show = (what, ms) => console.log(`${what}: ${ms.toFixed(1)} ms`);
  show('module ready', ready);
  show('curve exact', median(() => lab.curve(labForce.exact)));
  show('curve sampled', median(() => lab.curve(labForce.sampled)));
  const curve = lab.curve(labForce.exact), middle = curve.list[Math.floor(curve.rows / 2)];
  console.log(`${curve.rows} points`);
  lab.motion(middle.coefficients);
  show('specials', median(() => lab.specials(labForce.exact)));
  show('signal', median(() => lab.signal(labForce.exact, 512)));
  show('spectrum', median(() => lab.spectrum(64, 100)));
  show('work', median(() => lab.work()));
  show('errors', median(() => lab.errors(middle.omega)));
  show('5 transients', median(() => lab.transients([5, 6, 7, 8, 9])));
}
main();
