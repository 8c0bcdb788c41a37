/* presets.js - the paper's figures: cases of cases/paper, which the page carries as files, with its settings: H and N of
 * the figure, without harmonic 0, the slider restarted on a sample; and the same cases as they should be solved. */
'use strict';

const presets = [
  {name: 'Case 2, as it should be solved', file: 'case2', own: {H: 10, N: 64, mean: true}},
  {name: 'Case 1, preload, as it should be solved', file: 'case1', own: {H: 10, N: 64, mean: true}},
  {name: 'A contact that slips and lifts off, as it should be solved', file: 'fig08_f0_10', own: {H: 10, N: 64, mean: true}},
  {name: 'Figure 7: preload, 1 N', file: 'fig07_f0_1', own: {H: 1, N: 128, mean: false, restart: 'sample'}},
  {name: 'Figure 7: preload, 10 N', file: 'fig07_f0_10', own: {H: 1, N: 128, mean: false, restart: 'sample'}},
  {name: 'Figure 8: clearance, 1 N', file: 'fig08_f0_1', own: {H: 1, N: 128, mean: false, restart: 'sample'}},
  {name: 'Figure 8: clearance, 10 N', file: 'fig08_f0_10', own: {H: 1, N: 128, mean: false, restart: 'sample'}},
  ...[['-5', 'm5'], ['-3', 'm3'], ['-1', 'm1'], ['0', '0'], ['1', 'p1'], ['3', 'p3']].map(([gap, word]) =>
    ({name: 'Figure 9: gap ' + gap, file: 'fig09_gap_' + word, own: {H: 1, N: 128, mean: false, restart: 'sample'}})),
  ...[5, 16, 32, 64, 128].map(N => ({name: `Figure 11: case 1, H = 1, N = ${N}`, file: 'case1', own: {H: 1, N, mean: false, restart: 'sample'}})),
  ...[64, 256, 1024, 4096].map(N => ({name: `Figure 12: case 2, H = 1, N = ${N}`, file: 'case2', own: {H: 1, N, mean: false, restart: 'sample'}})),
  ...[1, 2, 3].map(H => ({name: `Figure 13: case 1, H = ${H}, N = 16`, file: 'case1', own: {H, N: 16, mean: false, restart: 'sample'}})),
  ...[1, 5, 7, 10].map(H => ({name: `Figure 14: case 1, H = ${H}, N = 128`, file: 'case1', own: {H, N: 128, mean: false, restart: 'sample'}})),
  ...[1, 5, 7, 10].map(H => ({name: `Figure 15: case 2, H = ${H}, N = 256`, file: 'case2', own: {H, N: 256, mean: false, restart: 'sample'}})),
  ...[1, 5, 7, 10].map(H => ({name: `Figure 16: case 2, H = ${H}, N = 1024`, file: 'case2', own: {H, N: 1024, mean: false, restart: 'sample'}})),
  ...['200', '1e3', '3e3', '5e3', '1e4', '5e4', '1e5'].map(kn =>
    ({name: 'Figure 17: normal stiffness ' + kn, file: 'fig17_kn_' + kn, own: {H: 1, N: 512, mean: false, restart: 'sample'}})),
  ...['200', '1e3', '1e4'].map(kt =>
    ({name: 'Figure 18: tangential stiffness ' + kt, file: 'fig18_kt_' + kt, own: {H: 1, N: 128, mean: false, restart: 'sample'}})),
  {name: 'Figure 20a: stiff, preload', file: 'table10_case1', own: {H: 1, N: 128, mean: false, restart: 'sample'}},
  {name: 'Figure 20b: stiff, clearance', file: 'table10_case2', own: {H: 1, N: 65536, mean: false, restart: 'sample'}}
];

/* The case file of that name among those the page carries, each after a line `== NAME`. */
function presetText(file) {
  const all = document.getElementById('presets').textContent;
  const mark = `\n== ${file}\n`, from = all.indexOf(mark);
  const end = all.indexOf('\n== ', from + mark.length);
  return from < 0 ? '' : all.slice(from + mark.length, end < 0 ? undefined : end + 1);
}

if (typeof exports !== 'undefined') Object.assign(exports, {presets, presetText});
