/* ---- 5 aliasing: sliders, the state they stand on, words and table --------------------------------------------- */

const alias = data.aliasing;

const numbersTo = n => Array.from({length: n + 1}, (_, i) => i);
const sizeOf = ([a, b]) => Math.hypot(a, b);
const samplesNeeded = H => 2 * H + 2;

/* Harmonics [a, b] from a list a0, a1, b1, a2, ..., the mean as [a0, 0]. */
const pairsOf = list => numbersTo((list.length - 1) / 2).map(h => (h ? [list[2 * h - 1], list[2 * h]] : [list[0], 0]));

/* The answer at a place {stiffness, h, omega}, positions in alias.stiffness, alias.harmonics, alias.omega, or null. */
const answerAt = p => alias.curves[p.stiffness][p.h].states[p.omega];

/* The answer chosen. With a solution that touches: `harmonics` true [a, b] and sampled ones, `scale` the largest
 * force, `next` the solution of the sampled equations that Newton finds from the exact ones', or where that touches
 * nothing from the one of more harmonics that does: {amplitude or null, touches}; null: N is too small. */
function aliasState() {
  const place = {stiffness: +$('alias-kn').value, h: +$('alias-h').value, omega: +$('alias-omega').value};
  const n = +$('alias-n').value;
  const solution = answerAt(place);
  const at = {place, solution, look: +$('alias-look').value};
  Object.assign(at, {omega: alias.omega[place.omega], H: alias.harmonics[place.h], N: alias.samples[n]});
  if (!solution) return at;
  at.next = solution.sampled[n];
  if (!solution.touches) return at;
  const scaled = (list, step) => list.map(v => (v === null ? null : v * step * solution.largest));
  at.scale = solution.largest;
  at.force = scaled(solution.force, alias.steps.force);
  at.harmonics = pairsOf(scaled(solution.harmonics, alias.steps.harmonics));
  if (!at.next || !at.next.difference) return at;
  at.difference = pairsOf(scaled(at.next.difference, alias.steps.difference));
  at.sampled = at.difference.map((d, h) => [d[0] + at.harmonics[h][0], d[1] + at.harmonics[h][1]]);
  at.folds = scaled(at.next.folds, alias.steps.difference);
  return at;
}

/* The position of the least H above at which the motion there touches, or -1. */
const touchingAbove = place =>
  alias.harmonics.findIndex((H, h) => h > place.h && (answerAt({...place, h}) || {}).touches);

const mostTried = alias && alias.harmonics[alias.harmonics.length - 1];

const foldOf = (h, N) => Math.min(h % N, N - (h % N)); /* where harmonic h lands */

/* ---- words ------------------------------------------------------------------------------------------------------- */

const length = v => show(v) + ' ' + units.length;
const stiffnessText = k => show(alias.stiffness[k], 4) + ' ' + units.force + '/' + units.length;

function placeWords(at) {
  const texts = ['At ' + where(at.omega, 6), 'H = ' + at.H];
  if (at.place.stiffness !== alias.the_case) texts.push('normal stiffness ' + stiffnessText(at.place.stiffness));
  return texts.join(', ') + ': ';
}

/* The largest motion touches nothing. Is that so, or has the truncation lost the branch that does? */
function idleWords(at) {
  const range = alias.curves[at.place.stiffness][at.place.h].working;
  const size = length(at.solution.amplitude);
  const alone = 'the only motion on this response curve has amplitude ' + size + ' and touches no contact';
  if (!range) return alone + ', nor does any at another ' + alongName + ': nothing to sample.';
  const ends = range.map(w => show(along(w), 4)).join(' and ');
  let text = alone + '. The branch on which contacts work lies between ' + alongName + ' ' + ends + ' with this H. ';
  const more = touchingAbove(at.place);
  if (more >= 0) text += lostWords(at, alias.harmonics[more], answerAt({...at.place, h: more}).amplitude);
  else if (at.H < mostTried) text += 'More harmonics, up to ' + mostTried + ', do not bring it here.';
  return text.trim();
}

/* `lost`: the amplitude with `more` harmonics. */
function lostWords(at, more, lost) {
  const reaches = 'With H = ' + more + ' it reaches this ' + alongName + ', amplitude ' + length(lost) + ': ';
  const text = reaches + 'truncation, not sampling, has lost it.';
  const gained = at.next;
  if (!gained || !gained.touches) return text;
  const off = percent(Math.abs(gained.amplitude - lost) / lost);
  const found = ' With ' + at.N + ' samples the equations have gained one, amplitude ' + length(gained.amplitude);
  return text + found + ', ' + off + ' off that: an accident of sampling.';
}

/* The sampled equations' solution beside the exact ones'. */
function effectWords({solution, next}) {
  const gone = 'The sampled equations have lost this branch here: ';
  if (next.amplitude === null) return gone + 'Newton, started on the true solution, finds none of theirs.';
  const other = 'what Newton finds from it has amplitude ' + length(next.amplitude) + ' and touches nothing.';
  if (!next.touches) return gone + other;
  const [found, exact] = [next.amplitude, solution.amplitude];
  const off = percent(Math.abs(found - exact) / exact);
  return 'The amplitude comes out as ' + show(found) + ' instead of ' + length(exact) + ': ' + off + ' off.';
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
  if (!at.sampled || !at.next.touches) return 'open';
  const exact = at.solution.amplitude;
  return Math.abs(at.next.amplitude - exact) <= data.gate * exact ? 'good' : 'bad';
}

function aliasTable(at) {
  const box = $('alias-table');
  box.textContent = '';
  if (!at.sampled) return;
  const table = document.createElement('table');
  const addTo = (row, tag, text) => row.append(Object.assign(document.createElement(tag), {textContent: text}));
  table.createCaption().textContent =
    'Sizes of force harmonics [' + units.force + ']. What folds onto h comes from N - h, N + h, 2N - h, ...; ' +
    'the first two are usually most of it. Not listed above harmonic 200.';
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
  const stiffness = +$('alias-kn').value;
  nameSlider('n', alias.samples[+$('alias-n').value]);
  nameSlider('h', alias.harmonics[+$('alias-h').value]);
  nameSlider('kn', stiffnessText(stiffness) + (stiffness === alias.the_case ? ' (the case)' : ''));
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

/* Another stiffness than the case's was solved at one omega alone. */
function moveStiffness() {
  const isCase = +$('alias-kn').value === alias.the_case;
  if (!isCase) $('alias-omega').value = alias.first;
  $('alias-omega').disabled = !isCase;
  drawAliasing();
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
  setSlider('kn', alias.stiffness, alias.the_case);
  $('alias-kn').closest('label').hidden = !alias.stiffness[alias.the_case];
  for (const id of ['omega', 'look']) $('alias-' + id).addEventListener('change', drawAliasing);
  for (const id of ['n', 'h']) $('alias-' + id).addEventListener('input', drawAliasing);
  $('alias-kn').addEventListener('input', moveStiffness);
  $('alias-reset').addEventListener('click', () => {
    $('alias-kn').value = alias.the_case;
    moveStiffness();
  });
  startAliasPlots();
  drawAliasing();
}
