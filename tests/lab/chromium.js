/* chromium.js - headless Chromium driven over its debugging pipe: no packages, no port. */
'use strict';
const {spawn} = require('child_process');
const fs = require('fs'), os = require('os'), path = require('path');

/* Of processes that have just been killed: they may still be ending, and what they have begun to write appear while it is removed. */
async function removeFolder(folder) {
  for (let left = 50; ; --left) {
    try {
      return fs.rmSync(folder, {recursive: true, force: true});
    } catch (error) {
      if (left === 0) throw error;
      await new Promise(done => setTimeout(done, 100));
    }
  }
}

/* open(program, address, {width, height, dark, before}): a page, with the network off; before: a script that runs ahead of its own. {evaluate, key, pointer,
 * picture, paper, tree, close, lines, requests}: tree() is what a screen reader is told. Of the page and its workers, lines are what came on the console and what
 * was thrown, requests the addresses asked for but the page's own, blob: and data: (watched.js sees that they are all seen). */
async function open(program, address, {width = 1400, height = 900, dark = false, before = ''} = {}) {
  const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'hbmcheck-lab-'));
  const browser = spawn(program, ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
    '--remote-debugging-pipe', `--user-data-dir=${profile}`, 'about:blank'], {detached: true, stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
  const [to, from] = [browser.stdio[3], browser.stdio[4]], waiting = new Map(), lines = [], requests = [];
  let number = 0, rest = '', session, closing = false;
  browser.on('error', error => { throw error; });
  /* Its pipes are reset where it is killed while it writes; where it ends by itself, what waits for it fails. */
  [to, from].forEach(pipe => pipe.on('error', () => {}));
  browser.on('exit', () => closing || waiting.forEach(asked => asked.failed(new Error('the browser has ended'))));

  function hear(message) {
    const asked = waiting.get(message.id);
    if (asked) {
      waiting.delete(message.id);
      return message.error ? asked.failed(new Error(message.error.message)) : asked.done(message.result);
    }
    const p = message.params || {};
    if (message.method === 'Target.attachedToTarget' && p.targetInfo.type !== 'page') watch(p.sessionId);
    if (message.method === 'Network.requestWillBeSent') note(p.request.url);
    if (message.method === 'Network.webSocketCreated') note(p.url);
    if (message.method === 'Runtime.consoleAPICalled') lines.push(p.args.map(a => a.value || a.description).join(' '));
    if (message.method === 'Runtime.exceptionThrown') lines.push(p.exceptionDetails.exception ? p.exceptionDetails.exception.description : p.exceptionDetails.text);
    if (message.method === 'Log.entryAdded') lines.push(p.entry.text);
  }
  from.on('data', data => {
    const parts = (rest + data).split('\0');
    rest = parts.pop();
    parts.forEach(part => hear(JSON.parse(part)));
  });
  const send = (method, params = {}, sessionId = session) => new Promise((done, failed) => {
    waiting.set(++number, {done, failed});
    to.write(JSON.stringify({id: number, method, params, sessionId}) + '\0');
  });
  const note = url => {
    const own = url.split('#')[0] === address.split('#')[0];
    if (!own && !/^(blob|data):/.test(url)) requests.push(url);
  };

  /* A page or a worker, before it runs. What a kind of target has not is refused. */
  async function watch(target) {
    const ask = (method, params) => send(method, params, target).catch(() => {});
    const asked = ['Runtime', 'Log', 'Network'].map(domain => ask(domain + '.enable'));
    asked.push(ask('Network.emulateNetworkConditions', {offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0}));
    asked.push(ask('Target.setAutoAttach', {autoAttach: true, waitForDebuggerOnStart: true, flatten: true}));
    asked.push(ask('Runtime.runIfWaitingForDebugger'));
    await Promise.all(asked);
  }

  const {targetInfos} = await send('Target.getTargets');
  const target = targetInfos.find(t => t.type === 'page');
  session = (await send('Target.attachToTarget', {targetId: target.targetId, flatten: true})).sessionId;
  await watch(session);
  await send('Page.enable');
  await send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: false});
  await send('Emulation.setEmulatedMedia', {features: [{name: 'prefers-color-scheme', value: dark ? 'dark' : 'light'}]});
  await send('Page.addScriptToEvaluateOnNewDocument', {source: before});
  await send('Page.navigate', {url: address});

  return {
    lines,
    requests,
    async evaluate(expression) {
      const {result, exceptionDetails} = await send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
      if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception ? exceptionDetails.exception.description : exceptionDetails.text}`);
      return result.value;
    },
    async key(key, code, text) {
      const known = {Tab: 9, Enter: 13, ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40};
      const of = {key, code: code || key, windowsVirtualKeyCode: known[key] || key.toUpperCase().charCodeAt(0)};
      await send('Input.dispatchKeyEvent', Object.assign({type: 'keyDown', text: text || (key === 'Enter' ? '\r' : undefined)}, of));
      await send('Input.dispatchKeyEvent', Object.assign({type: 'keyUp'}, of));
    },
    pointer: (type, x, y) => send('Input.dispatchMouseEvent', {type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1}),
    async picture(file) {
      const {cssContentSize} = await send('Page.getLayoutMetrics');
      const clip = {x: 0, y: 0, width, height: cssContentSize.height, scale: 1};
      const {data} = await send('Page.captureScreenshot', {format: 'png', captureBeyondViewport: true, clip});
      fs.writeFileSync(file, Buffer.from(data, 'base64'));
    },
    async paper(file) {
      const {data} = await send('Page.printToPDF', {printBackground: false});
      fs.writeFileSync(file, Buffer.from(data, 'base64'));
    },
    tree: async () => (await send('Accessibility.getFullAXTree')).nodes,
    async close() {
      closing = true;
      process.kill(-browser.pid, 'SIGKILL'); // its processes, too, which write to the profile
      await new Promise(done => browser.exitCode === null && browser.signalCode === null ? browser.on('exit', done) : done());
      await removeFolder(profile);
    }
  };
}

module.exports = {open};
