/* lesson.js LAB_ASKED LAB_JS - the number that each step of the page's lesson asks for, and those in the words that follow, by the native library and by the
 * module in node: equal. By the page: browser.js. Exit 1: one is not. */
'use strict';
const path = require('path');
const {clientOf} = require('./native.js'), {labClient, lessonOf, limitOfStep} = require('./lesson_steps.js');

async function main() {
  const [native, modulePath] = process.argv.slice(2);
  const ours = lessonOf(clientOf(native)), theirs = lessonOf(labClient(await require(path.resolve(modulePath))()));
  const values = told => [told.number, ...Object.values(told.facts)];
  let failed = 0;
  ours.forEach((a, i) => {
    const b = values(theirs[i]), equal = values(a).every((v, j) => Math.abs(v - b[j]) <= limitOfStep(i) * Math.abs(v));
    console.log(`step ${i + 1}: ${values(a).join(' ')}${equal ? '' : ' NOT ' + b.join(' ')}`);
    if (!equal) ++failed;
  });
  process.exit(failed || ours.length !== 7 ? 1 : 0);
}
main();
