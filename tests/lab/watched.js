/* watched.js CHROMIUM - what chromium.js says of a page is all there is: a page that asks for addresses, writes to the console and throws, itself and in a worker, is seen doing each,
 * and has no network. Exit 1: something was not seen. */
'use strict';
const fs = require('fs'), os = require('os'), path = require('path');
const {open} = require('./chromium.js');

const worker = `fetch('http://one.invalid/').catch(() => {}); console.log('two'); setTimeout(() => { throw new Error('three'); }, 0);`;
const page = `<!doctype html><img src="http://four.invalid/" alt=""><script>
  fetch('http://five.invalid/').catch(() => {});
  new WebSocket('ws://six.invalid/');
  console.log('seven');
  new Worker(URL.createObjectURL(new Blob([${JSON.stringify(worker)}]))).onerror = () => {};
  fetch('other.txt').catch(() => {});
  setTimeout(() => { throw new Error('eight'); }, 0);
</script>`;
const wanted = {requests: ['http://one.invalid/', 'http://four.invalid/', 'http://five.invalid/', 'ws://six.invalid/'], lines: ['two', 'seven', 'three', 'eight']};

async function main() {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'hbmcheck-lab-')), file = path.join(folder, 'page.html');
  fs.writeFileSync(file, page);
  const p = await open(process.argv[2], 'file://' + file);
  const missing = () => Object.entries(wanted).flatMap(([list, words]) => words.filter(word => !p[list].some(line => line.includes(word))));
  for (const end = Date.now() + 30000; missing().length && Date.now() < end;) await new Promise(done => setTimeout(done, 50));
  const online = await p.evaluate('navigator.onLine');
  if (missing().length) console.log(`not seen: ${missing().join(', ')}; requests: ${p.requests.join(', ')}; lines: ${p.lines.join(' | ')}`);
  if (online) console.log('the page has a network');
  await p.close();
  fs.rmSync(folder, {recursive: true});
  process.exit(missing().length || online ? 1 : 0);
}
main();
