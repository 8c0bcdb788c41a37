/* presets.js LAB_JS - the page's presets, put to the module as the page does: each has its case and solves it, and shows what the paper's figure shows, by the
 * numbers of docs/measurements/paper.txt. Exit 1: one does not. */
'use strict';
const fs = require('fs'), path = require('path'), vm = require('vm');

const root = path.join(__dirname, '../..'), cases = path.join(root, 'cases/paper');
let failed = 0;

function check(good, words) {
  if (good) return;
  ++failed;
  console.log('NOT SO: ' + words);
}

/* What the page carries, as join.cmake puts it there. */
const carried = fs.readdirSync(cases).filter(name => name.endsWith('.yaml')).map(name => `== ${path.basename(name, '.yaml')}\n${fs.readFileSync(path.join(cases, name), 'utf8')}`);
const context = vm.createContext({document: {getElementById: () => ({textContent: '\n' + carried.join('')})}});
const parts = ['lab_client.js', 'page/state.js', 'page/case_text.js', 'page/presets.js'].map(name => fs.readFileSync(path.join(root, 'interfaces/lab', name), 'utf8'));
vm.runInContext(parts.join('\n') + '\nvar all = {labClient, labForce, presets, presetText, questionText, stateOfCase};', context);
const {labClient, labForce, presets, presetText, questionText, stateOfCase} = context.all;

/* The preset's case and settings, read. */
function begin(lab, preset) {
  const read = lab.read(presetText(preset.file));
  check(read.status === 0, `${preset.name}: ${read.message}`);
  const state = Object.assign(stateOfCase(lab.caseTable(), lab.title()), preset.own);
  check(lab.read(questionText(state)).status === 0, `${preset.name}: its state is a case`);
  return state;
}

const column = (table, name) => table.list.map(row => row[name]);

/* Of the curve: its end, its largest amplitude at points and folds, the folds' omegas. */
function looked(lab, force) {
  const curve = lab.curve(force), specials = lab.specials(force);
  const folds = specials.list.filter(row => row.kind === 'turning point'), omegas = column(curve, 'omega');
  return {status: curve.status, end: omegas[omegas.length - 1], peak: Math.max(...column(curve, 'amplitude'), ...folds.map(row => row.amplitude)), folds: folds.map(row => row.omega)};
}

/* By name: what the exact curve of each is. */
function solveAll(lab) {
  const all = {};
  for (const preset of presets) {
    const state = begin(lab, preset), exact = looked(lab, labForce.exact), near = column(lab.neighbours(), 'amplitude');
    check(exact.status === 0 && exact.end === state.to, `${preset.name}: the exact curve ends at ${exact.end}`);
    check(near.filter(isFinite).length >= 0.9 * near.length, `${preset.name}: samples beside ${near.filter(isFinite).length} of ${near.length} points`);
    check(!/^Figure/.test(preset.name) || (!state.mean && state.restart === 'sample'), `${preset.name}: the paper's settings`);
    all[preset.name] = exact;
  }
  return all;
}

const numbered = (all, figure) => Object.keys(all).filter(name => name.startsWith(figure));

/* Largest amplitudes are those of the points that a curve happens to have: next to the peak of a curve, up to 0.5 % below it. */
const peakOff = (found, said) => Math.abs(found - said) / said;

function figuresShowWhatTheyShow(all) {
  for (const figure of ['Figure 7:', 'Figure 11:', 'Figure 13:', 'Figure 14:'])
    for (const name of numbered(all, figure)) check(all[name].folds.length === 0, `${name}: with preload the curve has no folds`);
  check(all['Figure 8: clearance, 1 N'].folds.length === 0 && all['Figure 8: clearance, 10 N'].folds.length === 2, 'figure 8: two folds where the force closes the gap');
  for (const [H, said] of [[1, 18.43], [5, 16.85], [10, 16.84]])
    for (const [figure, N] of [[15, 256], [16, 1024]])
      check(peakOff(all[`Figure ${figure}: case 2, H = ${H}, N = ${N}`].peak, said) < 5e-3, `figure ${figure}: the peak with H = ${H} is ${all[`Figure ${figure}: case 2, H = ${H}, N = ${N}`].peak}`);
  const stiff = numbered(all, 'Figure 17:').map(name => all[name]);
  check(stiff.every((one, i) => i === 0 || (one.peak < stiff[i - 1].peak && Math.max(...one.folds) > Math.max(...stiff[i - 1].folds))), 'figure 17: stiffer contact, lower peak, fold further up');
  check(Math.abs(Math.max(...stiff[stiff.length - 1].folds) - 31.7) < 0.05, 'figure 17: the fold moves up to 31.7');
}

/* Sampled curves: the paper's failures and oscillations, and those that are smooth. */
function samplesShowWhatTheyShow(lab) {
  const sampled = name => {
    begin(lab, presets.find(preset => preset.name === name));
    return looked(lab, labForce.sampled);
  };
  const five = sampled('Figure 11: case 1, H = 1, N = 5'), smooth = [16, 32, 64, 128].map(N => sampled(`Figure 11: case 1, H = 1, N = ${N}`));
  check(five.folds.length === 4 && Math.abs(five.peak - 1.212) < 1e-3, `figure 11: N = 5 has 4 folds and its peak at 1.212: ${five.folds.length}, ${five.peak}`);
  check(smooth.every(one => one.folds.length === 0), 'figure 11: from 16 samples on no folds');
  for (const name of ['Figure 12: case 2, H = 1, N = 64', 'Figure 12: case 2, H = 1, N = 256', 'Figure 17: normal stiffness 3e3'])
    check(sampled(name).folds.length > 10, `${name}: sampling makes it jagged`);
  check(Math.abs(sampled('Figure 9: gap -5').folds.length - 54) <= 4, 'figures 9 and 12: some 54 folds with 2^7 samples; steps pass over a pair or two');
}

async function main() {
  const lab = labClient(await require(path.resolve(process.argv[2]))());
  figuresShowWhatTheyShow(solveAll(lab));
  samplesShowWhatTheyShow(lab);
  console.log(`${presets.length} presets: ` + (failed ? failed + ' things do not hold' : 'all holds'));
  process.exit(failed ? 1 : 0);
}
main();
