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
  const means = data.response.curve.mean.filter((v, i) => !data.response.curve.mean_free[i]);
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
  const open = curve.mean_free.filter(isFree => isFree).length;
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

/* dR/dX against central differences of R. A transition moves by 1e-6 between the two, which changes dR/dX by as much
 * times the slope of the force there, and rounding adds 1e-10: 1e-5 of the largest derivative is allowed. */
function tryDerivatives(model, X, omega, samples) {
  const n = X.length;
  const now = equations(model, X, omega, samples);
  const step = 1e-6 * largest(X);
  let off = 0;
  for (let col = 0; col < n; col++) {
    const [more, less] = [1, -1].map(sign => {
      const moved = X.map((x, j) => (j === col ? x + sign * step : x));
      return equations(model, moved, omega, samples).R;
    });
    for (let row = 0; row < n; row++)
      off = Math.max(off, Math.abs((more[row] - less[row]) / (2 * step) - now.jac[row * n + col]));
  }
  const relative = off / largest(now.jac);
  trial.check(relative <= 1e-5, (samples || 'exact') + ': derivatives are off by ' + show(relative, 2));
}

/* What the page computes against what the program computed (aliasing.h). Both solve to 1e-10 of the forces and the
 * numbers are written to 12 digits; a solution near a turning point loses some of them: 1e-7. Harmonics are written
 * in steps of the state's scale: one step. */
function tryEvaluator() {
  const {steps, samples, states, spots} = alias.checks;
  const home = Object.fromEntries(parameters.map(p => [p.id, homeOf(p)]));
  const near = (a, b) => Math.abs(a - b) <= 1e-7 * Math.abs(b);
  const model = modelAt(home);
  const shown = largestAt(model, 5, alias.omega[alias.first]);
  if (shown) [0, 64].forEach(N => tryDerivatives(model, shown.X, alias.omega[alias.first], N));
  states.forEach((row, i) =>
    row.forEach((state, j) => {
      const [omega, H] = [alias.omega[i], alias.harmonics[j]];
      const found = largestAt(model, H, omega);
      const name = 'at ' + where(omega) + ', H = ' + H + ', ';
      trial.check(!state === !found, name + 'both or neither find a solution');
      if (!state || !found) return;
      trial.check(near(found.amplitude, state.amplitude), name + found.amplitude + ' is ' + state.amplitude);
      if (!state.scale) return;
      state.sampled.forEach((s, n) => s && trySampled(model, found, state, s, samples[n], H, omega, steps, name));
    })
  );
  for (const spot of spots) {
    const p = parameters.find(q => q.id === spot.parameter);
    const position = positionsOf(p).findIndex(f => near(f, spot.factor));
    if (position < 0) continue; /* a gap of 0 is moved, not multiplied */
    const found = largestAt(modelAt(Object.assign({}, home, {[p.id]: position})), spot.harmonics, spot.omega);
    const text = found ? String(found.amplitude) : 'none';
    const same = found ? near(found.amplitude, spot.amplitude) : spot.amplitude === null;
    trial.check(same, p.name + ' times ' + spot.factor + ': ' + text + ' is ' + spot.amplitude);
  }
}

function trySampled(model, found, state, s, N, H, omega, steps, name) {
  const at = forcesAt(model, found.X, H, N);
  const flat = parts => [parts[0][0]].concat(parts.slice(1).flat());
  const off = (a, b, step) => Math.max(...b.map((v, i) => Math.abs(a[i] / state.scale - v * step))) / step;
  const offs = [off(flat(at.harmonics), state.true, steps[0]), off(flat(at.difference), s.difference, steps[1])];
  offs.push(off(at.folds, s.folds, steps[1]));
  const text = offs.map(v => show(v, 3)).join(', ') + ' steps';
  trial.check(offs.every(v => v <= 1), name + N + ' samples: harmonics off by ' + text);
  const next = nextSampled(model, H, N, omega);
  if (s.amplitude === null) return; /* found here, maybe, by more patience */
  const same = next && Math.abs(next.amplitude - s.amplitude) <= 1e-7 * s.amplitude;
  trial.check(same, name + N + ' samples: ' + (next ? next.amplitude : 'none') + ' is ' + s.amplitude);
}

function trySliders() {
  const moves = [['n', 'force'], ['n', 'spectrum'], ['n', 'fold'], ['n', 'effect'], ['h', 'force'], ['h', 'fold']];
  for (const p of parameters) if (firstOf(p)) moves.push([p.id, 'effect']);
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

/* Where H has lost the branch on which contacts work, the words say so; at the ends of all sliders there are words. */
function tryWords() {
  const least = alias.harmonics[0];
  trial.set('alias-h', 0, 'input');
  alias.omega.forEach((omega, i) => {
    trial.set('alias-omega', i);
    const {model} = aliasShown;
    const [few, many] = [least, 10].map(H => largestAt(model, H, omega));
    const isLost = few && many && !few.touches && many.touches;
    const text = $('alias-words').textContent;
    trial.check(!isLost || /truncation, not sampling, has lost it/.test(text), 'the lost branch is explained: ' + text);
    const gained = isLost && nextSampled(model, least, alias.samples[0], omega);
    const said = /have gained one/.test(text);
    trial.check(said === !!(gained && gained.touches), 'a branch that sampling gained is told: ' + text);
  });
  trial.set('alias-omega', alias.first);
  trial.set('alias-h', 2, 'input');
  for (const p of parameters)
    for (const end of [0, positionsOf(p).length - 1]) {
      trial.set('alias-' + p.id, end, 'input');
      const text = $('alias-words').textContent;
      trial.check(/^At (omega|frequency) .*: .*\.$/.test(text), p.name + ' at its end has words: ' + text);
      $('alias-reset').click();
    }
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
    tryEvaluator();
  }
  const lines = trial.lines.concat(problems.map(p => 'ERROR: ' + p));
  return (lines.length ? lines.join('\n') + '\nselftest: FAILED' : 'selftest: ok') + ' ' + trial.checks + ' checks';
}
