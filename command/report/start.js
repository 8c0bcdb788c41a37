/* ---- start; and, opened with #selftest, the page tries itself and writes what came of it into <pre id="selftest"> ------------------- */

startResponse();
startBudget();
startAccuracy();
startAliasing();
window.addEventListener('beforeprint', () => {
  Chart.defaults.color = '#3a4048'; /* paper is white */
  Object.values(charts).forEach(chart => { chart.resize(); chart.update(); });
});

/* The pixels of a plot, by way of a canvas that is made for reading. */
function pixels(name) {
  const from = charts[name].canvas, copy = document.createElement('canvas');
  copy.width = from.width;
  copy.height = from.height;
  const context = copy.getContext('2d', {willReadFrequently: true});
  context.drawImage(from, 0, 0);
  return context.getImageData(0, 0, copy.width, copy.height).data;
}

/* A number that changes when a pixel does, and how many pixels are not background. */
function pixelsOf(name) {
  const all = pixels(name);
  let hash = 0, drawn = 0;
  for (let i = 0; i < all.length; i += 4) {
    if (!all[i + 3]) continue;
    drawn++;
    hash = (hash * 31 + all[i] + 256 * all[i + 1] + 65536 * all[i + 2] + i) % 2147483647;
  }
  return {hash, drawn};
}

/* Pixels of about that colour: is the curve there? */
function pixelsLike(name, colour) {
  const all = pixels(name);
  const wanted = [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16));
  let n = 0;
  for (let i = 0; i < all.length; i += 4) if (all[i + 3] > 200 && wanted.every((c, j) => Math.abs(all[i + j] - c) < 24)) n++;
  return n;
}

function selfTest() {
  const lines = [];
  let checks = 0;
  const check = (good, what) => { checks++; if (!good) lines.push('FAILED: ' + what); };
  const changes = (name, act, what) => { const before = pixelsOf(name).hash; act(); check(pixelsOf(name).hash !== before, what + ' changes the plot ' + name); };
  const set = (id, value, event) => { const e = $(id); if (e.type === 'checkbox') e.checked = value; else e.value = value; e.dispatchEvent(new Event(event || 'change')); };
  for (const name of Object.keys(charts)) check(pixelsOf(name).drawn > 1000, 'plot ' + name + ' is drawn');
  check(pixelsLike('response', colours[0]) > 150, 'the response curve is drawn');
  changes('response', () => set('range', $('range').value === 'peak' ? 'whole' : 'peak'), 'the range');
  set('range', 'peak');
  const stable = runs(data.response.curve, 'amplitude', 1).length, unstable = runs(data.response.curve, 'amplitude', -1).length;
  for (const id of ['show-unstable', 'show-transient', 'show-special', 'show-turned']) {
    if (id === 'show-unstable' && !unstable) continue;
    if (id === 'show-special' && !data.response.specials.length) continue;
    changes('response', () => set(id, !$(id).checked), id);
    changes('response', () => set(id, !$(id).checked), id + ' again');
  }
  if (unstable) { const n = pixelsLike('response', colours[4]); set('show-unstable', false); check(pixelsLike('response', colours[4]) < n, 'unstable branches go away'); set('show-unstable', true); }
  changes('response', () => set('log-amplitude', true), 'the logarithmic axis');
  set('log-amplitude', false);
  changes('response', () => set('quantity', 'harmonic_1'), 'the quantity');
  set('quantity', 'amplitude');
  const home = pixelsOf('response').hash;
  changes('response', () => zoomTo(charts.response, {x: [.2, .5], y: [.1, .9]}), 'zoom');
  charts.response.canvas.dispatchEvent(new MouseEvent('dblclick'));
  check(pixelsOf('response').hash === home, 'a double click resets the zoom');
  changes('response', () => charts.response.canvas.dispatchEvent(new KeyboardEvent('keydown', {key: '+'})), 'the key +');
  zoomReset(charts.response);
  const first = charts.response.getDatasetMeta(0).data.find(p => !p.skip && isFinite(p.y));
  charts.response.tooltip.setActiveElements([{datasetIndex: 0, index: charts.response.getDatasetMeta(0).data.indexOf(first)}], {x: first.x, y: first.y});
  charts.response.update();
  check(/omega .*amplitude/.test(JSON.stringify(charts.response.tooltip.body)), 'hovering says omega and amplitude');
  charts.response.tooltip.setActiveElements([], {x: 0, y: 0});
  charts.response.update();
  check(stable + unstable > 0, 'there are points on the curve');
  if (data.accuracy.length) changes('accuracy', () => set('measure', 'false_turning_points'), 'the measure');
  if (alias) {
    for (const [id, name] of [['alias-n', 'force'], ['alias-n', 'spectrum'], ['alias-n', 'fold'], ['alias-n', 'effect'], ['alias-h', 'force'], ['alias-h', 'fold'], ['alias-k', 'force']]) {
      const value = +$(id).value;
      changes(name, () => set(id, value + 1, 'input'), id);
      set(id, value, 'input');
    }
    if (alias.omega.length > 1) changes('force', () => set('alias-omega', (alias.first + 1) % alias.omega.length), 'alias-omega');
    for (let i = 0; i < alias.omega.length; i++) for (let k = 0; k < alias.factors.length; k++) for (let h = 0; h < alias.harmonics.length; h++) for (let n = 0; n < alias.samples.length; n += 4) {
      $('alias-omega').value = i; $('alias-k').value = k; $('alias-h').value = h; $('alias-n').value = n;
      drawAliasing();
      const at = aliasState();
      check(!at.sampledParts || at.sampledParts.every(isFinite), 'state ' + [i, k, h, n] + ' is whole');
    }
  }
  for (const p of problems) lines.push('ERROR: ' + p);
  return (lines.length ? lines.join('\n') + '\nselftest: FAILED' : 'selftest: ok') + ' ' + checks + ' checks';
}

if (location.hash === '#selftest') {
  const out = document.createElement('pre');
  out.id = 'selftest';
  try { out.textContent = selfTest(); } catch (e) { out.textContent = 'ERROR: ' + e.message + '\n' + e.stack + '\nselftest: FAILED'; }
  document.body.prepend(out);
}
