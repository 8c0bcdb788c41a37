/* ask.js - a worker with the library, asked one job at a time: the newest that waits is put as soon as what the one before
 * draws has come. One that has become old and does not answer is ended, and another begun. */
'use strict';

const patience = 1500; /* [ms] for a job that nobody waits for any more */

function workerAddress() {
  const source = document.getElementById('worker-source').textContent;
  return URL.createObjectURL(new Blob([source], {type: 'text/javascript'}));
}

/* onPart(part): every answer. */
function asker(address, onPart) {
  let worker = null, number = 0, put = null, since = 0, next = null, timer = 0;

  function begin() {
    worker = new Worker(address);
    worker.onmessage = event => {
      const part = event.data;
      if (put && part.number === put.number && ['drawn', 'refused', 'end'].includes(part.part)) put = null;
      onPart(part);
      if (!put && next) send();
    };
    worker.onerror = event => onPart({part: 'refused', message: 'The library stopped: ' + event.message});
  }

  function send() {
    put = next;
    next = null;
    since = performance.now();
    worker.postMessage(put);
  }

  function giveUp() {
    timer = 0;
    if (!put || !next || put.text === next.text) return; /* what it is at is wanted still */
    const left = since + patience - performance.now();
    if (left > 0) return void (timer = setTimeout(giveUp, left));
    worker.terminate();
    begin();
    send();
  }

  begin();
  return {
    ask(job) {
      next = Object.assign({number: ++number}, job);
      if (!put) send();
      else if (!timer) timer = setTimeout(giveUp, patience);
      return next ? next.number : number;
    },
    busy: () => put !== null
  };
}
