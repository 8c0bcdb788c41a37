/* page_library.js - the library that the page carries, asked by a test: in a worker of the page's own source, in Chromium. */
'use strict';
const path = require('path');
const {labTable} = require(path.join(__dirname, '../../interfaces/lab/lab_client.js'));

/* Put behind the page's worker, whose `lab` and listener it takes over: a job is {method, args} of lab_client.js. Numbers go as text, which keeps NaN and every digit. */
function answerQuestions() {
  onmessage = async ({data: {method, args}}) => {
    if (!lab) lab = labClient(await hbmcheckLab());
    const answer = lab[method](...args);
    postMessage(answer && answer.values ? Object.assign(answer, {list: [], values: answer.values.join()}) : answer);
  };
}

/* The client of lab_client.js, of promises; p: the page (chromium.js). */
async function libraryOf(p) {
  await p.evaluate(`(() => {
    const source = document.getElementById('worker-source').textContent + '\\n(' + ${JSON.stringify(String(answerQuestions))} + ')();';
    const worker = new Worker(URL.createObjectURL(new Blob([source], {type: 'text/javascript'})));
    window.askLibrary = job => new Promise((done, failed) => {
      worker.onmessage = event => done(event.data);
      worker.onerror = event => failed(new Error(event.message));
      worker.postMessage(job);
    });
  })()`);
  const ask = method => async (...args) => {
    const job = JSON.stringify({method, args: args.map(arg => (ArrayBuffer.isView(arg) ? Array.from(arg) : arg))});
    const answer = await p.evaluate(`askLibrary(${job})`);
    return answer && labTable(Object.assign(answer, {values: Float64Array.from(answer.values ? answer.values.split(',') : [], Number)}));
  };
  const methods = ['read', 'curve', 'curveAt', 'specials', 'neighboursAt', 'motion', 'signal', 'spectrum', 'work', 'transients', 'errors', 'free'];
  return Object.fromEntries(methods.map(method => [method, ask(method)]));
}

module.exports = {libraryOf};
