/* ---- the page tries itself, and says what came of it: opened with #selftest, start.js shows it ------------------- */

/* The pixels of a plot, by way of a canvas that is made for reading. */
function pixels(name) {
  const from = charts[name].canvas;
  const copy = document.createElement('canvas');
  copy.width = from.width;
  copy.height = from.height;
  const context = copy.getContext('2d', {willReadFrequently: true});
  context.drawImage(from, 0, 0);
  return context.getImageData(0, 0, copy.width, copy.height).data;
}

/* A number that changes when a pixel does, and how many pixels are not background. */
function pixelsOf(name) {
  const all = pixels(name);
  let hash = 0;
  let drawn = 0;
  for (let i = 0; i < all.length; i += 4) {
    if (!all[i + 3]) continue;
    drawn++;
    hash = (hash * 31 + all[i] + 256 * all[i + 1] + 65536 * all[i + 2] + i) % 2147483647;
  }
  return {hash, drawn};
}

/* Pixels of about that colour: is the curve there? */
function pixelsLike(name, tint) {
  const all = pixels(name);
  const wanted = [1, 3, 5].map(i => parseInt(tint.slice(i, i + 2), 16));
  let n = 0;
  for (let i = 0; i < all.length; i += 4)
    if (all[i + 3] > 200 && wanted.every((c, j) => Math.abs(all[i + j] - c) < 24)) n++;
  return n;
}

const trial = {
  checks: 0,
  lines: [],
  check(good, what) {
    this.checks++;
    if (!good) this.lines.push('FAILED: ' + what);
  },
  changes(name, act, what) {
    const before = pixelsOf(name).hash;
    act();
    this.check(pixelsOf(name).hash !== before, what + ' changes the plot ' + name);
  },
  set(id, value, event) {
    const e = $(id);
    if (e.type === 'checkbox') e.checked = value;
    else e.value = value;
    e.dispatchEvent(new Event(event || 'change'));
  }
};

function tryToggles() {
  const curve = kindsOf(data.response.curve, 'amplitude');
  const toggles = responseToggles.filter(tag => charts.response.data.datasets.some(set => set.tag === tag));
  for (const tag of toggles)
    for (const again of ['', ' again']) {
      const id = 'show-' + tag;
      trial.changes('response', () => trial.set(id, !$(id).checked), id + again);
    }
  trial.check(curve.length > 0, 'there are points on the curve');
  if (!curve.includes('unstable')) return;
  const n = pixelsLike('response', colour(4));
  trial.set('show-unstable', false);
  trial.check(pixelsLike('response', colour(4)) < n, 'unstable branches go away');
  trial.set('show-unstable', true);
}

/* A negative mean is drawn on a logarithmic axis, too. */
function tryLogarithm() {
  trial.changes('response', () => trial.set('log-amplitude', true), 'the logarithmic axis');
  trial.set('quantity', 'mean');
  const means = data.response.curve.mean.filter((v, i) => data.response.curve.mean_free[i] !== 'yes');
  const points = charts.response.data.datasets.filter(set => /^HBM, /.test(set.label)).flatMap(set => set.data);
  const negative = points.filter(p => p.value < 0);
  trial.check(!means.some(v => v < 0) || negative.length > 0, 'negative means are among the points');
  trial.check(negative.every(p => p.y === -p.value), 'the logarithm of |mean| is drawn');
  tryOpenMeans();
  trial.check(charts.response.options.scales.y.title.text.startsWith('|mean|'), 'the axis says |mean|');
  trial.set('log-amplitude', false);
  trial.changes('response', () => trial.set('quantity', 'harmonic_1'), 'the quantity');
  trial.set('quantity', 'amplitude');
}

/* A mean that is a matter of history is drawn apart, and not beside the transient's. */
function tryOpenMeans() {
  const sets = charts.response.data.datasets;
  const {curve, transient} = data.response;
  const open = curve.mean_free.filter(isFree => isFree === 'yes').length;
  const drawnOpen = sets.filter(set => /^HBM, mean open/.test(set.label)).flatMap(set => set.data);
  trial.check(drawnOpen.filter(p => p.kind === 'open').length >= open, 'open means are drawn apart');
  trial.check(open > 0 || drawnOpen.length === 0, 'no mean is drawn as open that is not');
  const compared = sets.filter(set => set.tag === 'transient').flatMap(set => set.data).length;
  const closed = transient.filter(t => !t.mean_free).length;
  trial.check(compared === closed, 'transients show the means that are not open: ' + compared + ' of ' + closed);
}

/* All axes over the sweep, and words, are in the sweep's own unit. */
function tryUnits() {
  const turn = data.cycles ? 1 : 2 * Math.PI;
  trial.check(Math.abs(along(2 * Math.PI) - turn) < 1e-14, 'the unit of the sweep');
  for (const name of ['response', 'budget']) {
    const title = charts[name].options.scales.x.title.text;
    trial.check(/cycles/.test(title) === data.cycles && /rad/.test(title) !== data.cycles, name + ' over ' + title);
  }
}

function tryZoom() {
  const chart = charts.response;
  const home = pixelsOf('response').hash;
  trial.changes('response', () => zoomTo(chart, {x: [0.2, 0.5], y: [0.1, 0.9]}), 'zoom');
  chart.canvas.dispatchEvent(new MouseEvent('dblclick'));
  trial.check(pixelsOf('response').hash === home, 'a double click resets the zoom');
  const press = () => chart.canvas.dispatchEvent(new KeyboardEvent('keydown', {key: '+'}));
  trial.changes('response', press, 'the key +');
  zoomReset(chart);
}

function tryHovering() {
  const chart = charts.response;
  const points = chart.getDatasetMeta(0).data;
  const index = points.findIndex(p => !p.skip && isFinite(p.y));
  chart.tooltip.setActiveElements([{datasetIndex: 0, index}], {x: points[index].x, y: points[index].y});
  chart.update();
  const said = JSON.stringify(chart.tooltip.body);
  const value = show(chart.data.datasets[0].data[index].x, 7);
  trial.check(said.includes(alongName + ' ' + value + ', amplitude '), 'hovering says where it is: ' + said);
  chart.tooltip.setActiveElements([], {x: 0, y: 0});
  chart.update();
}

function tryResponse() {
  trial.check(pixelsLike('response', colour(0)) > 150, 'the response curve is drawn');
  const other = $('range').value === 'peak' ? 'whole' : 'peak';
  if (String(rangeOf('peak')) !== String(rangeOf('whole')))
    trial.changes('response', () => trial.set('range', other), 'the range');
  trial.set('range', 'peak');
  tryUnits();
  tryToggles();
  tryLogarithm();
  tryZoom();
  tryHovering();
}

/* The reader's scheme may change while the page is open. */
function tryScheme() {
  const change = isDark => wantsDark.dispatchEvent(new MediaQueryListEvent('change', {matches: isDark}));
  const was = theme;
  for (const [isDark, wanted] of [[true, dark], [false, light], [was === dark, was]]) {
    change(isDark);
    trial.check(theme === wanted, 'the colours follow the scheme');
    for (const name of ['response', 'budget', 'accuracy'].filter(n => charts[n] && charts[n].data.datasets.length)) {
      const ticks = charts[name].scales.y.options.ticks.color;
      trial.check(ticks === wanted.ink, 'the ink of plot ' + name + ' follows the scheme: ' + ticks);
    }
    trial.check(pixelsLike('response', wanted.colours[0]) > 150, 'the curve is drawn in the colours of the scheme');
  }
}

/* Plots are printed as wide as the sheet, whatever the window, and in the colours of paper. */
function tryPaper() {
  const before = Object.values(charts).map(chart => chart.width);
  window.dispatchEvent(new Event('beforeprint'));
  for (const [name, chart] of Object.entries(charts)) {
    trial.check(chart.width === paperWidth, 'plot ' + name + ' is drawn for paper: ' + chart.width);
    trial.check(chart.chartArea.right <= paperWidth && chart.chartArea.width > 0.7 * paperWidth, name + ' is whole');
  }
  trial.check(theme === light, 'paper is white');
  window.dispatchEvent(new Event('afterprint'));
  trial.check(!onPaper && theme === (wantsDark.matches ? dark : light), 'after printing the colours are the screen\'s');
  const after = Object.values(charts).map(chart => chart.width);
  const text = 'after printing the plots fit the window: ' + before + ', ' + after;
  trial.check(after.every((w, i) => w === before[i]), text);
}

function trySliders() {
  const moves = [['n', 'force'], ['n', 'spectrum'], ['n', 'fold'], ['n', 'effect'], ['h', 'force'], ['h', 'fold']];
  if (!$('alias-kn').closest('label').hidden) moves.push(['kn', 'effect']);
  for (const [id, name] of moves) {
    const value = +$('alias-' + id).value;
    const move = () => trial.set('alias-' + id, value + 1, 'input');
    trial.changes(name, move, 'the slider ' + id);
    trial.set('alias-' + id, value, 'input');
  }
  if (alias.omega.length < 2) return;
  const other = () => trial.set('alias-omega', (alias.first + 1) % alias.omega.length);
  trial.changes('force', other, 'alias-omega');
  trial.set('alias-omega', alias.first);
}

/* At every place of the sliders there are words; they explain where H has lost the branch on which contacts work, and
 * where sampling has gained one. */
function tryWords() {
  const {place} = aliasShown;
  const inWords = /^At (omega|frequency) .*: .*\.$/;
  alias.stiffness.forEach((_, stiffness) =>
    alias.omega.forEach((_, omega) =>
      alias.harmonics.forEach((_, h) => {
        if (stiffness !== alias.the_case && omega !== alias.first) return;
        trial.set('alias-kn', stiffness, 'input');
        trial.set('alias-omega', omega);
        trial.set('alias-h', h, 'input');
        const text = $('alias-words').textContent;
        const here = answerAt({stiffness, omega, h});
        const isLost = here && !here.touches && touchingAbove({stiffness, omega, h}) >= 0;
        const lost = !isLost || !alias.curves[stiffness][h].working || /truncation, not sampling, has lost/.test(text);
        trial.check(inWords.test(text), 'there are words: ' + text);
        trial.check(lost, 'the lost branch is explained: ' + text);
        const gained = lost && isLost && here.sampled[+$('alias-n').value];
        trial.check(/have gained one/.test(text) === !!(gained && gained.touches), 'a gained branch is told: ' + text);
      })
    )
  );
  trial.set('alias-omega', place.omega);
  trial.set('alias-h', place.h, 'input');
  $('alias-reset').click();
  trial.check(aliasShown.place.stiffness === alias.the_case && !$('alias-omega').disabled, 'back to the case');
}

/* The force that is drawn and its harmonics belong together: their sum to harmonic 80 leaves out what a force with
 * kinks of slope J has above, J/(80 pi) at most at each, or is off nowhere by more than a tenth of the force. */
function trySeries() {
  const at = aliasShown;
  if (!at.harmonics) return;
  const n = at.force.length - 1;
  const off = at.force.map((f, i) => Math.abs(f - seriesAt(at.harmonics, (2 * Math.PI * i) / n)));
  trial.check(Math.max(...off) <= 0.1 * at.scale, 'the series is the force: ' + show(Math.max(...off) / at.scale, 3));
}

/* Every response, solution and contact can be chosen; the words tell the work that the loop encloses. */
function tryStructure() {
  const s = data.structure;
  if (s.responses.length) {
    trial.changes('response', () => trial.set('of-response', 1), 'another response');
    trial.check(data.response === s.responses[0], 'section 2 has the response chosen');
    trial.set('of-response', 0);
  }
  trial.changes('shape', () => trial.set('shape', 'phases'), 'harmonic 1');
  trial.set('shape', 'amplitude');
  const first = $('solution').value;
  s.solutions.forEach((solution, i) => {
    trial.set('solution', i);
    const rows = $('shape-table').tBodies[0].rows;
    trial.check(rows.length === s.dofs.length, 'the shape has a row for each degree of freedom');
    trial.check(rows[0].cells[1].textContent === show(solution.amplitude[0], 6), 'and its amplitudes');
    solution.loops.forEach((loop, j) => {
      trial.set('contact', j);
      const shown = charts.loops.data.datasets;
      trial.check(shown.length === 1 && shown[0].data.length === loop.x.length, 'one loop is shown');
      const {x, y} = charts.loops.options.scales;
      const inside = loop.x.every(v => v >= x.min && v <= x.max) && loop.y.every(v => v >= y.min && v <= y.max);
      trial.check(inside, 'and all of it');
      trial.check($('structure-words').textContent.includes(s.contacts[j] + ': ' + show(loop.work, 4)), 'its work is told');
    });
    trial.set('contact', 'all');
  });
  trial.set('solution', first);
}

function selfTest() {
  for (const name of Object.keys(charts)) trial.check(pixelsOf(name).drawn > 1000, 'plot ' + name + ' is drawn');
  tryResponse();
  tryScheme();
  tryPaper();
  if (data.accuracy.length)
    trial.changes('accuracy', () => trial.set('measure', 'false_turning_points'), 'the measure');
  if (data.structure && data.structure.solutions.length) tryStructure();
  if (alias) {
    trySliders();
    tryWords();
    trySeries();
  }
  const lines = trial.lines.concat(problems.map(p => 'ERROR: ' + p));
  return (lines.length ? lines.join('\n') + '\nselftest: FAILED' : 'selftest: ok') + ' ' + trial.checks + ' checks';
}
