/* ---- 5 aliasing: its four plots, of the state aliasShown --------------------------------------------------------- */

/* The sum of harmonics [a, b] at an angle. */
const seriesAt = (parts, th) => parts.reduce((sum, [a, b], h) => sum + a * Math.cos(h * th) + b * Math.sin(h * th), 0);

function forceSets() {
  const at = aliasShown;
  if (!at || !at.harmonics) return [];
  const n = at.force.length - 1;
  const rebuilt = parts => numbersTo(n).map(i => ({x: i / n, y: seriesAt(parts, (2 * Math.PI * i) / n)}));
  const kept = rebuilt(at.harmonics.slice(0, at.H + 1));
  const sets = [line('true force', at.force.map((y, i) => ({x: i / n, y})), colour(0))];
  sets.push(line('its true harmonics 0..H', kept, colour(2), {borderWidth: 1.5, borderDash: [5, 3]}));
  const look = {borderWidth: 1.5, borderDash: [2, 3]};
  if (at.sampled) sets.push(line('sampled harmonics 0..H', rebuilt(at.sampled), colour(4), look));
  const step = Math.max(1, n / at.N);
  const dots = numbersTo(n / step).map(i => ({x: (i * step) / n, y: at.force[i * step]}));
  const label = at.N > n ? 'samples (one of ' + at.N / n + ' drawn)' : 'samples';
  const dotLook = {pointRadius: at.N > 64 ? 2 : 4, order: -1, key: 'samples'};
  return sets.concat([marks(label, dots, colour(1), 'circle', dotLook)]);
}

const smallest = 5e-7; /* of the largest force: shorter bars are not drawn */

function spectrumSets() {
  const at = aliasShown;
  if (!at || !at.harmonics) return [];
  const floor = smallest * at.scale;
  const look = {barPercentage: 1, categoryPercentage: 0.85, grouped: true, maxBarThickness: 9, base: floor};
  const bars = parts => parts.map((p, x) => ({x, y: sizeOf(p) > floor ? sizeOf(p) : NaN}));
  const bar = (label, key, parts, fill) =>
    Object.assign({type: 'bar', label, key, data: bars(parts), backgroundColor: fill}, look);
  const tint = h => {
    const lands = foldOf(h, at.N);
    if (lands === at.look && h !== at.look) return colour(4);
    return h <= at.H ? colour(0) : lands <= at.H ? colour(1) : colour(7) + '90';
  };
  const sets = [bar('true', 'true', at.harmonics, at.harmonics.map((p, h) => tint(h)))];
  if (at.sampled) sets.push(bar('from ' + at.N + ' samples', 'sampled', at.sampled, colour(2)));
  return sets;
}

/* |F_j| of a true harmonic as far as it is known: from the spectrum, or among what folds first. */
function trueSize(at, j) {
  if (j < at.harmonics.length) return sizeOf(at.harmonics[j]);
  const away = Math.abs(j - at.N);
  return at.folds && away <= at.H ? at.folds[2 * away + (j > at.N ? 1 : 0)] : null;
}

function foldSets() {
  const at = aliasShown;
  if (!at || !at.harmonics) return [];
  const most = 2 * at.N + at.H;
  const zigzag = [0, 1, 2, 3, 4].map(j => ({x: (j * at.N) / 2, y: j % 2 ? at.N / 2 : 0}));
  const lands = [];
  for (let m = 0; m <= 2; m++)
    for (let h = -at.H; h <= at.H; h++) {
      const j = m * at.N + h;
      if (j >= 0 && j <= most) lands.push({x: j, y: Math.abs(h), size: trueSize(at, j)});
    }
  const isLooked = p => p.y === at.look;
  const last = [0, most].map(x => ({x, y: at.H}));
  return [
    line('where true harmonic h lands', zigzag.concat([{x: most, y: at.H}]), colour(7), {borderWidth: 1}),
    marks('lands on a kept harmonic', lands.filter(p => !isLooked(p)), colour(1), 'circle', {pointRadius: 3}),
    marks('lands on harmonic ' + at.look, lands.filter(isLooked), colour(4), 'circle', {pointRadius: 6, key: 'look'}),
    line('H, the last one kept', last, colour(2), {borderWidth: 1, borderDash: [4, 4]})
  ];
}

function effectSets() {
  const at = aliasShown;
  if (!at || !at.solution) return [];
  const amplitudeOf = next => (next && next.amplitude !== null ? next.amplitude : NaN);
  const points = alias.samples.map((N, i) => ({x: N, y: amplitudeOf(at.solution.sampled[i])}));
  const ends = y => [alias.samples[0], alias.samples[alias.samples.length - 1]].map(x => ({x, y}));
  const sets = [line('sampled', points, colour(1), {pointRadius: 4})];
  const exact = {borderDash: [5, 4], borderWidth: 1.5};
  sets.push(line('exact forces, same H', ends(at.solution.amplitude), colour(2), exact));
  const rows = data.response.transient.filter(t => Math.abs(t.omega - at.omega) <= 1e-6 * at.omega);
  const top = Math.max(...rows.map(t => t.amplitude));
  if (at.place.stiffness === alias.the_case && rows.length) sets.push(line('time integration', ends(top), colour(0), {borderDash: [1, 3]}));
  const here = points.filter(p => p.x === at.N && !isNaN(p.y));
  const ring = {pointRadius: 8, borderWidth: 2, backgroundColor: 'transparent', order: -1, key: 'here'};
  return sets.concat([marks('N = ' + at.N, here, colour(4), 'circle', ring)]);
}

/* ---- drawing ----------------------------------------------------------------------------------------------------- */

function drawAliasPlots(at) {
  if (at.harmonics) {
    const shown = Math.min(2 * at.N + at.H, 4 * at.H + 20);
    const last = Math.min(at.harmonics.length - 1, Math.max(24, shown));
    setHome(charts.force, 'x', [0, 1]);
    setHome(charts.spectrum, 'x', [-0.6, last + 0.6]);
    setHome(charts.spectrum, 'y', [smallest * at.scale, 2 * at.scale]);
    setHome(charts.fold, 'x', [0, 2 * at.N + at.H]);
    setHome(charts.fold, 'y', [0, Math.min(at.N / 2, 2 * at.H + 6)]);
  }
  for (const name of ['force', 'spectrum', 'fold', 'effect']) redraw(name);
}

function spectrumWords(item) {
  const [h, N] = [item.raw.x, aliasShown.N];
  const size = item.dataset.label + ' |F(' + h + ')| = ' + show(item.raw.y, 5);
  const folds = item.datasetIndex === 0 && h > aliasShown.H;
  return folds ? [size, 'with N samples it looks like harmonic ' + foldOf(h, N)] : [size];
}

function foldWords(item) {
  const {x, y, size} = item.raw;
  const known = size === undefined || size === null ? '' : ', size ' + show(size, 3) + ' ' + units.force;
  return 'true harmonic ' + show(x) + ' looks like ' + show(y) + known;
}

function effectPointWords(item) {
  const isLevel = item.dataset.showLine && item.datasetIndex > 0;
  return item.dataset.label + (isLevel ? '' : ', N = ' + item.raw.x) + ': ' + length(item.raw.y);
}

function startAliasPlots() {
  const force = axis('contact force [' + units.force + ']');
  const time = item => ' at ' + show(item.raw.x, 4) + ' of the period';
  const forceWords = item => item.dataset.label + ': ' + show(item.raw.y) + time(item);
  plot('force', 'scatter', forceSets, {x: axis('time / period [1]', 'linear', {min: 0, max: 1}), y: force}, forceWords);
  const whole = {ticks: {precision: 0, callback: v => (Number.isInteger(v) ? v : '')}, grid: {offset: false}};
  const size = axis('|F| [' + units.force + ']', 'logarithmic');
  plot('spectrum', 'bar', spectrumSets, {x: axis('harmonic', 'linear', whole), y: size}, spectrumWords);
  const lands = {x: axis('true harmonic', 'linear', {min: 0}), y: axis('lands on harmonic', 'linear', {min: 0})};
  plot('fold', 'scatter', foldSets, lands, foldWords);
  const ends = {min: alias.samples[0] / 1.3, max: alias.samples[alias.samples.length - 1] * 1.3};
  const samples = axis('samples per period N', 'logarithmic', Object.assign(ends, ticksAt(alias.samples)));
  plot('effect', 'scatter', effectSets, {x: samples, y: axis('amplitude [' + units.length + ']')}, effectPointWords);
}
