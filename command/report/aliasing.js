/* ---- 5 aliasing: sliders, the state they stand on, words and table --------------------------------------------- */

const alias = data.aliasing;

/* Parameters with a slider: the member of the model or of its contacts, and factors on the case's value. All contacts
 * change together. */
const parameters = [
  {id: 'kn', name: 'normal stiffness', unit: () => units.force + '/' + units.length, of: 'contacts'},
  {id: 'gap', name: 'gap', unit: () => units.length, of: 'contacts'},
  {id: 'mu', name: 'friction', unit: () => '', of: 'contacts'},
  {id: 'damping', name: 'damping', unit: () => units.force + ' ' + units.time + '/' + units.length, of: 'model'},
  {id: 'force', name: 'force', unit: () => units.force, of: 'model'}
];
const factors = {
  kn: [0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 10],
  gap: [0, 0.1, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 3],
  mu: [0, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 5],
  damping: [0.25, 0.5, 0.75, 1, 1.5, 2, 3, 5, 10],
  force: [0.1, 0.2, 0.3, 0.5, 0.75, 1, 1.5, 2, 3, 5]
};
const gapShifts = [-1, -0.5, -0.2, -0.1, 0, 0.1, 0.2, 0.5, 1]; /* of F0/K, where the case's gap is 0 */

const firstOf = p => (p.of === 'model' ? alias.model[p.id] : alias.model.contacts[0][p.id]);

/* What a slider's position makes of a value of the case, and its position in the case. */
function moved(p, position, value) {
  const shift = alias.model.force / alias.model.stiffness;
  if (p.id === 'gap' && !firstOf(p)) return value + gapShifts[position] * shift;
  return value * factors[p.id][position];
}
const positionsOf = p => (p.id === 'gap' && !firstOf(p) ? gapShifts : factors[p.id]);
const homeOf = p => positionsOf(p).indexOf(p.id === 'gap' && !firstOf(p) ? 0 : 1);

/* The case with its parameters changed: positions {kn, gap, ...}. */
function modelAt(positions) {
  const model = Object.assign({}, alias.model, {contacts: alias.model.contacts.map(k => Object.assign({}, k))});
  for (const p of parameters)
    for (const owner of p.of === 'model' ? [model] : model.contacts)
      owner[p.id] = moved(p, positions[p.id], owner[p.id]);
  for (const k of model.contacts) {
    k.c = Math.cos((k.angle_deg * Math.PI) / 180);
    k.s = Math.sin((k.angle_deg * Math.PI) / 180);
  }
  return model;
}

/* ---- states: found when a slider first gets there, and kept ----------------------------------------------------- */

const kept = new Map();
function keep(key, make) {
  const text = JSON.stringify(key);
  if (!kept.has(text)) kept.set(text, make());
  return kept.get(text);
}

const mostPoints = 1500;

const curveOf = (model, H) => keep([model, H], () => traceCurve(model, H, mostPoints));

/* Of the curve's solutions at omega the one with the largest amplitude: {X, amplitude, touches}, or null. `touches`:
 * the motion touches a contact. */
function largestAt(model, H, omega) {
  return keep([model, H, omega], () => {
    const found = solutionsOn(model, curveOf(model, H), omega).map(X => ({X, amplitude: amplitudeOf(X)}));
    if (!found.length) return null;
    const top = found.reduce((a, b) => (b.amplitude > a.amplitude ? b : a));
    return Object.assign(top, {touches: touchesIn(model, top.X, 0)});
  });
}

const touchesIn = (model, X, N) => (piecesOf(model, X, N) || []).some(p => p.piece.state !== APART);

const mostTried = 10;

/* More harmonics, up to mostTried, with which the motion at omega touches, or 0. */
function harmonicsThatTouch(model, H, omega) {
  const touching = H => (largestAt(model, H, omega) || {}).touches;
  return alias.harmonics.find(h => h > H && h <= mostTried && touching(h)) || 0;
}

/* The solution of the sampled equations that Newton finds from the exact ones', or where that touches nothing from the
 * one of more harmonics that does: {amplitude, touches}, or null. */
function nextSampled(model, H, N, omega) {
  return keep([model, H, N, omega, 'next'], () => {
    const exact = largestAt(model, H, omega);
    if (!exact || N < samplesNeeded(H)) return null;
    const more = exact.touches ? 0 : harmonicsThatTouch(model, H, omega);
    const start = more ? largestAt(model, more, omega).X.slice(0, 2 * H + 1) : exact.X;
    const X = solveAt(model, start, omega, N);
    return X && {amplitude: amplitudeOf(X), touches: touchesIn(model, X, N)};
  });
}

const samplesNeeded = H => 2 * H + 2;
const numbersTo = n => Array.from({length: n + 1}, (_, i) => i);
const sizeOf = ([a, b]) => Math.hypot(a, b);

/* The force at n times of the period, and its largest size. */
function forceOver(model, X, n) {
  const pieces = piecesOf(model, X, 0);
  return numbersTo(n).map(i => {
    const th = (TURN * (i % n)) / n;
    const x = motionAt(X, th).x;
    const here = pieces.filter(p => p.piece.from <= th && th < p.piece.to);
    return here.reduce((f, p) => f + p.stiffness * x + p.constant, 0);
  });
}

/* Where the sliders stand. With a solution that touches: `harmonics` true [a, b] and `sampled` ones, `scale` the
 * largest force, `amplitude` of the sampled solution. */
function aliasState() {
  const positions = Object.fromEntries(parameters.map(p => [p.id, +$('alias-' + p.id).value]));
  const omega = alias.omega[+$('alias-omega').value];
  const H = alias.harmonics[+$('alias-h').value];
  const N = alias.samples[+$('alias-n').value];
  const model = modelAt(positions);
  const at = {omega, H, N, model, positions, look: +$('alias-look').value};
  at.inCase = parameters.every(p => positions[p.id] === homeOf(p));
  at.solution = largestAt(model, H, omega);
  if (!at.solution || !at.solution.touches) return at;
  return Object.assign(at, keep([model, H, N, omega, 'force'], () => forcesAt(model, at.solution.X, H, N)));
}

const shownHarmonics = 80;

function forcesAt(model, X, H, N) {
  const force = forceOver(model, X, 256);
  const pieces = piecesOf(model, X, 0);
  const harmonics = forceHarmonics(pieces, 0, X, numbersTo(shownHarmonics));
  const scale = Math.max(...forceOver(model, X, 2048).map(Math.abs));
  const out = {force, harmonics, scale, pieces};
  if (N < samplesNeeded(H)) return out;
  out.sampled = forceHarmonics(piecesOf(model, X, N), N, X, numbersTo(H));
  out.difference = out.sampled.map(([a, b], h) => [a - harmonics[h][0], b - harmonics[h][1]]);
  out.folds = forceHarmonics(pieces, 0, X, numbersTo(H).flatMap(h => [N - h, N + h])).map(sizeOf);
  return out;
}

const foldOf = (h, N) => Math.min(h % N, N - (h % N)); /* where harmonic h lands */

/* ---- words ------------------------------------------------------------------------------------------------------- */

const length = v => show(v) + ' ' + units.length;
const valueOf = (p, position) => (show(moved(p, position, firstOf(p)), 4) + ' ' + p.unit()).trim();

function placeWords(at) {
  const changed = parameters.filter(p => at.positions[p.id] !== homeOf(p));
  const texts = changed.map(p => p.name + ' ' + valueOf(p, at.positions[p.id]));
  return ['At ' + where(at.omega, 6), 'H = ' + at.H].concat(texts).join(', ') + ': ';
}

/* The least and largest omega of the curve where a contact changes its state, or null. */
function workingRange(at) {
  const touching = curveOf(at.model, at.H).filter(p => p.works).map(p => p.omega);
  if (!touching.length) return null;
  return [Math.min(...touching), Math.max(...touching)];
}

/* The largest motion touches nothing. Is that so, or has the truncation lost the branch that does? */
function idleWords(at) {
  const range = workingRange(at);
  const size = length(at.solution.amplitude);
  const alone = 'the only motion on this response curve has amplitude ' + size + ' and touches no contact';
  if (!range) return alone + ', nor does any at another ' + alongName + ': nothing to sample.';
  const ends = range.map(w => show(along(w), 4)).join(' and ');
  let text = alone + '. The branch on which contacts work lies between ' + alongName + ' ' + ends + ' with this H. ';
  const more = harmonicsThatTouch(at.model, at.H, at.omega);
  if (more) text += lostWords(at, more, largestAt(at.model, more, at.omega).amplitude);
  else if (at.H < mostTried) text += 'More harmonics, up to ' + mostTried + ', do not bring it here.';
  return text.trim();
}

/* `lost`: the amplitude with `more` harmonics. */
function lostWords(at, more, lost) {
  const reaches = 'With H = ' + more + ' it reaches this ' + alongName + ', amplitude ' + length(lost) + ': ';
  const text = reaches + 'truncation, not sampling, has lost it.';
  const gained = nextSampled(at.model, at.H, at.N, at.omega);
  if (!gained || !gained.touches) return text;
  const off = percent(Math.abs(gained.amplitude - lost) / lost);
  const found = ' With ' + at.N + ' samples the equations have gained one, amplitude ' + length(gained.amplitude);
  return text + found + ', ' + off + ' off that: an accident of sampling.';
}

/* The sampled equations' solution beside the exact ones'. */
function effectWords(at) {
  const next = nextSampled(at.model, at.H, at.N, at.omega);
  const gone = 'The sampled equations have lost this branch here: ';
  if (!next) return gone + 'Newton, started on the true solution, finds none of theirs.';
  const true_ = at.solution.amplitude;
  const other = 'what Newton finds from it has amplitude ' + length(next.amplitude) + ' and touches nothing.';
  if (!next.touches) return gone + other;
  const off = percent(Math.abs(next.amplitude - true_) / true_);
  return 'The amplitude comes out as ' + show(next.amplitude) + ' instead of ' + length(true_) + ': ' + off + ' off.';
}

function aliasWords(at) {
  const place = placeWords(at);
  const left = 'the response curve leaves the sweep before it comes here, or could not be followed so far.';
  if (!at.solution) return place + left;
  if (!at.solution.touches) return place + idleWords(at);
  if (!at.sampled) {
    const enough = 'at least ' + samplesNeeded(at.H) + ' are needed.';
    return place + at.N + ' samples cannot tell ' + at.H + ' harmonics apart: ' + enough;
  }
  const worst = percent(Math.max(...at.difference.map(sizeOf)) / at.scale);
  const force = at.N + ' samples miss the harmonics of the contact force by up to ' + worst + ' of the largest force. ';
  return place + force + effectWords(at);
}

/* good, bad or open: is the sampled amplitude within the gate? */
function aliasVerdict(at) {
  const next = at.sampled && nextSampled(at.model, at.H, at.N, at.omega);
  if (!next || !next.touches) return 'open';
  const true_ = at.solution.amplitude;
  return Math.abs(next.amplitude - true_) <= data.gate * true_ ? 'good' : 'bad';
}

function aliasTable(at) {
  const box = $('alias-table');
  box.textContent = '';
  if (!at.sampled) return;
  const table = document.createElement('table');
  const addTo = (row, tag, text) => row.append(Object.assign(document.createElement(tag), {textContent: text}));
  table.createCaption().textContent =
    'Sizes of force harmonics [' + units.force + ']. What folds onto h comes from N - h, N + h, 2N - h, ...; ' +
    'the first two are usually most of it.';
  const heads = ['h', 'true |F(h)|', 'sampled |F(h)|', '|sampled - true|', 'of the largest force'];
  heads.push('folds from N - h', '|F(N - h)|', 'and from N + h', '|F(N + h)|');
  const head = table.createTHead().insertRow();
  heads.forEach(text => addTo(head, 'th', text));
  const body = table.createTBody();
  for (let h = 0; h <= at.H; h++) {
    const row = body.insertRow();
    if (h === at.look) row.className = 'looked';
    const off = sizeOf(at.difference[h]);
    const cells = [h, show(sizeOf(at.harmonics[h])), show(sizeOf(at.sampled[h])), show(off, 3)];
    cells.push(percent(off / at.scale));
    cells.push(at.N - h, show(at.folds[2 * h], 3), h ? at.N + h : '', h ? show(at.folds[2 * h + 1], 3) : '');
    cells.forEach(text => addTo(row, 'td', text));
  }
  box.append(table);
}

/* ---- the sliders ------------------------------------------------------------------------------------------------- */

function fillLook(H) {
  const look = $('alias-look');
  const before = Math.min(look.value === '' ? 1 : +look.value, H);
  look.textContent = '';
  for (let h = 0; h <= H; h++) look.append(new Option(h === 0 ? '0 (mean)' : String(h), h));
  look.value = before;
}

function nameSlider(id, text) {
  $('alias-' + id + '-value').textContent = text;
  $('alias-' + id).setAttribute('aria-valuetext', text);
}

function nameSliders() {
  nameSlider('n', alias.samples[+$('alias-n').value]);
  nameSlider('h', alias.harmonics[+$('alias-h').value]);
  for (const p of parameters) {
    const position = +$('alias-' + p.id).value;
    const home = position === homeOf(p) ? ' (the case)' : '';
    nameSlider(p.id, valueOf(p, position) + home);
  }
}

let aliasShown = null; /* the state that the plots draw */

function drawAliasing() {
  fillLook(alias.harmonics[+$('alias-h').value]);
  nameSliders();
  aliasShown = aliasState();
  $('alias-words').textContent = aliasWords(aliasShown);
  $('alias-words').className = 'verdict ' + aliasVerdict(aliasShown);
  aliasTable(aliasShown);
  drawAliasPlots(aliasShown);
}

function setSlider(id, positions, home) {
  const slider = $('alias-' + id);
  slider.max = positions.length - 1;
  slider.value = home;
}

function resetSliders() {
  for (const p of parameters) setSlider(p.id, positionsOf(p), homeOf(p));
}

function startAliasing() {
  $('aliasing-none').hidden = !!alias;
  $('aliasing-body').hidden = !alias;
  if (!alias) return;
  alias.omega.forEach((w, i) => $('alias-omega').append(new Option(show(along(w), 6), i)));
  $('alias-omega').value = alias.first;
  $('alias-omega-name').textContent = data.cycles ? 'Frequency' : 'Omega';
  setSlider('n', alias.samples, 0);
  setSlider('h', alias.harmonics, 2);
  resetSliders();
  for (const p of parameters) $('alias-' + p.id).closest('label').hidden = !firstOf(p) && p.id !== 'gap';
  for (const id of ['omega', 'look']) $('alias-' + id).addEventListener('change', drawAliasing);
  for (const id of ['n', 'h', ...parameters.map(p => p.id)]) $('alias-' + id).addEventListener('input', drawAliasing);
  $('alias-reset').addEventListener('click', () => {
    resetSliders();
    drawAliasing();
  });
  startAliasPlots();
  drawAliasing();
}
