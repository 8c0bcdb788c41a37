/* lesson_steps.js - the lesson's numbers outside the page: lessonOf(lab) answers every step's {number, facts} as interfaces/lab/page/lesson_numbers.js has them, asking `lab`. */
'use strict';
const fs = require('fs'), path = require('path'), vm = require('vm');

const parts = ['lab_client.js', 'page/state.js', 'page/case_text.js', 'page/lesson_numbers.js'];
const context = vm.createContext({});
vm.runInContext(parts.map(name => fs.readFileSync(path.join(__dirname, '../../interfaces/lab', name), 'utf8')).join('\n') + '\nvar all = {labClient, lessonNumbers};', context);

/* Equal to 1e-9, relative; step 4 tells slopes of errors down to 5e-9 of the forces, which are equal to 1e-13: 2e-5 of such an error, over seven
 * e-foldings of N, among eleven errors. */
const limitOfStep = step => (step === 3 ? 1e-6 : 1e-9);

module.exports = {labClient: context.all.labClient, lessonOf: lab => context.all.lessonNumbers.map(step => step(lab)), limitOfStep};
