/* report.js CHROMIUM LAB_HTML HBMCHECK CASE - a report leads to the lab: the link in it, clicked from disk with a lab.html beside it, opens the lab on the report's case, at the omega
 * where both sides differ most; the command in it names the case. Exit 1: something does not hold. */
'use strict';
const {execFileSync} = require('child_process');
const fs = require('fs'), os = require('os'), path = require('path');
const {open} = require('./chromium.js'), {until} = require('./page.js');

const [chromium, page, hbmcheck, caseFile] = process.argv.slice(2);
const title = 'A "b" & c+d, 100 % <i>', set = ['title=' + title, 'oscillator.mass=1.25', 'hbm.harmonics=7', 'hbm.slider_restart=sample'].flatMap(one => ['--set', one]);
const wanted = {title, mass: 1.25, damping: 0.4, stiffness: 40, force: 100, from: 3, to: 20, H: 7, N: 1024, mean: true, sampled: false, restart: 'sample',
  contacts: [{kt: 100, kn: 1000, mu: 0.3, angle: 45, gap: -5}]};
const at = ['--at', '4,6,7'];

/* Of the rows that `compare` finds to be the same motion. */
function omegaOfLargestError() {
  const {rows} = JSON.parse(execFileSync(hbmcheck, ['compare', caseFile, ...at, '--format', 'json', '-q', ...set]));
  const same = rows.filter(row => ['match', 'differs'].includes(row.verdict));
  return same.sort((a, b) => b.amplitude_error - a.amplitude_error)[0].omega;
}

async function main() {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'hbmcheck-lab-')), report = path.join(folder, 'report.html');
  execFileSync(hbmcheck, ['report', caseFile, ...at, '--harmonics', '1', '--samples', '32', '-q', '-o', report, ...set]);
  wanted.omega = omegaOfLargestError();
  fs.copyFileSync(page, path.join(folder, 'lab.html'));
  const p = await open(chromium, 'file://' + report);
  await until(p, 'document.getElementById("to-lab") && document.readyState === "complete"', 'the report is there');
  const command = await p.evaluate('document.querySelector("#aliasing code").textContent');
  const named = command.startsWith(`hbmcheck lab --case ${caseFile} --set 'title=`);
  await p.evaluate('document.getElementById("to-lab").click()');
  await until(p, `location.pathname.endsWith('/lab.html') && typeof state !== 'undefined' && state && state.title.startsWith('A "b"') && seen.motion && seen.motion.chosen >= 0`, 'the lab is open on the case');
  const got = await p.evaluate('state'), off = Object.keys(wanted).filter(key => JSON.stringify(got[key]) !== JSON.stringify(wanted[key]));
  if (!named) console.log('the command: ' + command);
  if (off.length) console.log('not the case: ' + off.map(key => `${key} is ${JSON.stringify(got[key])}`).join(', '));
  if (p.lines.length) console.log('on the console: ' + p.lines.join('\n').slice(0, 2000));
  const others = p.requests.filter(url => !url.split('#')[0].endsWith('/lab.html'));
  if (others.length) console.log('asked for: ' + others.join());
  await p.close();
  fs.rmSync(folder, {recursive: true});
  process.exit(!named || off.length || p.lines.length || others.length ? 1 : 0);
}

main().catch(error => {
  console.log(error.stack);
  process.exit(1);
});
