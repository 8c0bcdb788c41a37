/* fields.js - the case as fields: each a number and a slider around where the case was when it was begun (`home`). */
'use strict';

/* log: the slider multiplies, by 1/30 to 30; from, to: its ends where they do not depend on the case. Limits of what may
 * be typed are those of model/casefile/fields.c. */
const fieldList = [
  {key: 'mass', name: 'Mass M', log: true, above: 0},
  {key: 'damping', name: 'Damping C', log: true, min: 0, size: s => 0.02 * Math.sqrt(s.mass * s.stiffness) || 0.1},
  {key: 'stiffness', name: 'Stiffness K', log: true, min: 0, size: () => 1},
  {key: 'force', name: 'Force F0', log: true, min: 0, size: () => 1},
  {key: 'from', name: 'Sweep from omega', log: true, above: 0},
  {key: 'to', name: 'to omega', log: true, above: 0},
  {key: 'H', name: 'Harmonics H', from: 1, to: 40, whole: true, min: 1, max: 100},
  {key: 'N', name: 'Samples N per period', from: 8, to: 8192, log: true, whole: true, min: 3, max: 1048576}
];
const contactList = [
  {key: 'kt', name: 'Tangential stiffness kt', log: true, min: 0, size: s => s.stiffness || 1},
  {key: 'kn', name: 'Normal stiffness kn', log: true, min: 0, size: s => s.stiffness || 1},
  {key: 'mu', name: 'Friction mu', from: 0, to: 1.5, min: 0},
  {key: 'angle', name: 'Angle [deg]', from: 0, to: 90, min: -90, max: 90},
  {key: 'gap', name: 'Gap (> 0: preload)', around: s => s.force / (s.stiffness || 1)}
];
const polynomialList = powers.map(p => ({key: 'k' + p, name: `Coefficient of d^${p}`, around: s => (s.stiffness || 1) / Math.pow(s.force / (s.stiffness || 1) || 1, p - 1)}));
const lawChoice = {name: 'Law', options: [['', 'friction and gap'], ['polynomial', 'polynomial spring'], ['table', 'table of forces']]};
const sliderSteps = 400;

const fieldFits = (field, v) => isFinite(v) && !(v < field.min) && !(v > field.max) && !(v <= field.above) && (!field.whole || Number.isInteger(v));

/* What a field wants, in words. */
function wantedOf(field) {
  const kind = field.whole ? 'a whole number' : 'a number';
  if (field.above !== undefined) return `${kind} above ${field.above}`;
  if (field.max !== undefined) return `${kind} from ${field.min} to ${field.max}`;
  return field.min !== undefined ? `${kind} not below ${field.min}` : kind;
}

/* [from, to] of the field's slider. */
function sliderEnds(field, home, homeState) {
  if (field.from !== undefined) return [field.from, field.to];
  if (!field.log) {
    const reach = Math.max(2 * Math.abs(home), field.around(homeState));
    return [home - reach, home + reach];
  }
  const middle = home > 0 ? home : field.size(homeState);
  return [middle / 30, middle * 30];
}

function valueAt(field, [from, to], position) {
  const f = position / sliderSteps;
  const v = field.log ? from * Math.pow(to / from, f) : from + f * (to - from);
  return field.whole ? Math.round(v) : +v.toPrecision(4);
}

function positionOf(field, [from, to], v) {
  const f = field.log ? Math.log(v / from) / Math.log(to / from) : (v - from) / (to - from);
  return Math.round(sliderSteps * Math.min(1, Math.max(0, isNaN(f) ? 0 : f)));
}

/* A field's element; set(v) shows v. onChange(v, moving). */
function fieldElement(field, id, home, homeState, onChange) {
  const all = document.createElement('div'), label = document.createElement('label');
  const number = document.createElement('input'), slider = document.createElement('input'), mistake = document.createElement('span');
  const ends = sliderEnds(field, home, homeState);
  all.className = 'field';
  Object.assign(number, {type: 'number', step: field.whole ? 1 : 'any', id});
  if (field.min !== undefined) number.min = field.min;
  if (field.max !== undefined) number.max = field.max;
  Object.assign(slider, {type: 'range', min: 0, max: sliderSteps, step: 1, id: id + '-slider'});
  slider.setAttribute('aria-label', field.name + ', slider');
  Object.assign(mistake, {className: 'mistake', id: id + '-mistake'});
  mistake.setAttribute('role', 'alert');
  number.setAttribute('aria-describedby', mistake.id);
  label.append(field.name, number);
  all.append(label, slider, mistake);
  const judge = fits => {
    number.setCustomValidity(fits ? '' : wantedOf(field));
    number.setAttribute('aria-invalid', !fits);
    mistake.textContent = fits ? '' : `Wanted is ${wantedOf(field)}.`;
  };
  number.addEventListener('input', () => {
    const v = number.value === '' ? NaN : Number(number.value), fits = fieldFits(field, v);
    judge(fits);
    if (fits) onChange(v, false);
  });
  const slid = moving => () => onChange(valueAt(field, ends, Number(slider.value)), moving);
  slider.addEventListener('input', slid(true));
  slider.addEventListener('change', slid(false));
  const set = v => {
    if (document.activeElement !== number) {
      number.value = +Number(v).toPrecision(8);
      judge(true);
    }
    slider.value = positionOf(field, ends, v);
    slider.setAttribute('aria-valuetext', show(v, 6));
  };
  set(home);
  return {all, set};
}

/* A table's points, as a case file has them. */
function pointsElement(id, onChange) {
  const all = document.createElement('div'), label = document.createElement('label'), text = document.createElement('input'), mistake = document.createElement('span');
  all.className = 'field';
  Object.assign(text, {type: 'text', id, size: 28});
  Object.assign(mistake, {className: 'mistake', id: id + '-mistake'});
  mistake.setAttribute('role', 'alert');
  text.setAttribute('aria-describedby', mistake.id);
  label.append('Points [[d, f], ...]', text);
  all.append(label, mistake);
  text.addEventListener('input', () => {
    const points = pointsOf(text.value);
    text.setAttribute('aria-invalid', !points);
    mistake.textContent = points ? '' : 'Wanted are 2 to 32 points, d ascending.';
    if (points) onChange(JSON.stringify(points), false);
  });
  return {all, set: v => document.activeElement !== text && (text.value = v)};
}

/* A choice {key, name, options [[value, words]]}. */
function choiceElement(choice, onChange) {
  const all = document.createElement('div'), label = document.createElement('label'), select = document.createElement('select');
  all.className = 'field';
  select.id = choice.id || 'field-' + choice.key;
  for (const [value, words] of choice.options) select.add(new Option(words, String(value)));
  label.append(choice.name, select);
  all.append(label);
  select.addEventListener('change', () => onChange(choice.options[select.selectedIndex][0], false));
  return {all, set: v => (select.selectedIndex = choice.options.findIndex(([value]) => value === v))};
}

const choiceList = [
  {key: 'mean', name: 'Harmonic 0', options: [[true, 'kept'], [false, 'dropped']]},
  {key: 'sampled', name: 'Motion shown from', options: [[false, 'exact forces'], [true, 'N samples']]},
  {key: 'restart', name: 'Slider after separation', options: [['interpolated', 'interpolated'], ['sample', 'on a sample']]}
];

let fieldSetters = [];

/* All fields of a state, anew. onChange(change(state), moving): a function that changes a state. */
function buildFields(state, onChange) {
  const form = $('form'), home = copyOf(state);
  fieldSetters = [];
  form.replaceChildren();
  for (const field of fieldList) {
    const made = fieldElement(field, 'field-' + field.key, state[field.key], home, (v, moving) => onChange(s => (s[field.key] = v), moving));
    form.append(made.all);
    fieldSetters.push(s => made.set(s[field.key]));
  }
  for (const choice of choiceList) {
    const made = choiceElement(choice, v => onChange(s => (s[choice.key] = v), false));
    form.append(made.all);
    fieldSetters.push(s => made.set(s[choice.key]));
  }
  $('contacts').replaceChildren(...state.contacts.map((c, i) => contactFields(home, i, onChange)));
  $('add-contact').disabled = state.contacts.length >= mostContacts;
}

function contactFields(home, i, onChange) {
  const set = document.createElement('fieldset'), legend = document.createElement('legend');
  const grid = document.createElement('div'), remove = document.createElement('button');
  legend.textContent = 'Contact ' + (i + 1);
  grid.className = 'sliders';
  const law = home.contacts[i].law || '';
  const chosen = choiceElement(Object.assign({id: `contact-${i}-law`}, lawChoice), v => onChange(s => (s.contacts[i] = Object.assign({}, contactOfLaw(v, s))), false, true));
  chosen.set(law);
  grid.append(chosen.all);
  if (law === 'table') {
    const points = pointsElement(`contact-${i}-points`, v => onChange(s => (s.contacts[i].points = v), false));
    points.set(home.contacts[i].points);
    grid.append(points.all);
    fieldSetters.push(s => s.contacts[i] && points.set(s.contacts[i].points));
  }
  for (const field of {polynomial: polynomialList, table: []}[law] || contactList) {
    const id = `contact-${i}-${field.key}`;
    const made = fieldElement(field, id, home.contacts[i][field.key], home, (v, moving) => onChange(s => (s.contacts[i][field.key] = v), moving));
    grid.append(made.all);
    fieldSetters.push(s => s.contacts[i] && made.set(s.contacts[i][field.key]));
  }
  Object.assign(remove, {type: 'button', textContent: 'Remove'});
  remove.setAttribute('aria-label', 'Remove contact ' + (i + 1));
  remove.addEventListener('click', () => onChange(s => s.contacts.splice(i, 1), false, true));
  grid.append(remove);
  set.append(legend, grid);
  return set;
}

const showFields = state => fieldSetters.forEach(set => set(state));
