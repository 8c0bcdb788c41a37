/* draw_spectrum.js - harmonics of the contact force, true and sampled, and arcs from those that fold to where they land. */
'use strict';

const mostShown = 200; /* HBM_MAX_HARMONICS */

/* So many harmonics are asked for: some that fold, if there are. */
const shownHarmonics = state => Math.min(mostShown, Math.max(state.H + 8, 40, Math.ceil(1.3 * Math.min(state.N, 150))));

/* {h, size, sampled, off} of each harmonic of the table. */
const harmonicsOf = table => Array.from({length: table.rows}, (_, h) => {
  const [, a, b, sampledA, sampledB] = table.values.subarray(5 * h, 5 * h + 5);
  return {h, size: Math.hypot(a, b), sampled: Math.hypot(sampledA, sampledB), off: Math.hypot(a - sampledA, b - sampledB)};
});

const spectrumFloor = 1e-5; /* of the largest: shorter bars are not drawn */

function drawSpectrum(svg, state, motion) {
  const box = boxOf(svg, 330);
  const list = motion && motion.spectrum ? harmonicsOf(motion.spectrum) : [];
  const largest = Math.max(0, ...list.map(f => f.size));
  if (!largest) return putWords(svg, box, motion && motion.spectrum ? 'No contact force: nothing touches.' : whyNothing(motion));
  box.top += 90; /* for the arcs */
  const low = largest * spectrumFloor;
  const p = panel(box, {from: -0.8, to: list.length - 0.2, title: 'harmonic'}, {from: low, to: 1.5 * largest, log: true, title: 'size of the force'});
  const step = p.sx(1) - p.sx(0), wide = Math.max(1, Math.min(9, 0.42 * step));
  const bar = (h, size, shift, classes) => size > low ? `<rect class="${classes}" x="${round(p.sx(h) + shift)}" y="${round(p.sy(size))}" ` +
    `width="${round(wide)}" height="${round(box.bottom - p.sy(size))}"/>` : '';
  const bars = list.map(f => bar(f.h, f.size, f.h <= state.H ? -wide : -wide / 2, f.h <= state.H ? 'fill-exact' : 'fill-beyond') +
    (f.h <= state.H ? bar(f.h, f.sampled, 0, 'fill-sampled') : '')).join('');
  put(svg, box, p.svg + bars + foldArcs(p, state, list, largest));
}

/* From the largest that fold onto a harmonic kept to where they land; those onto the one looked at are thicker. */
function foldArcs(p, state, list, largest) {
  const folding = list.filter(f => f.h > state.H && foldOf(f.h, state.N) <= state.H && f.size > spectrumFloor * largest);
  const chosen = folding.filter(f => foldOf(f.h, state.N) === state.harmonic);
  const others = folding.filter(f => !chosen.includes(f)).sort((a, b) => b.size - a.size).slice(0, 14);
  const arc = (f, width, opacity) => {
    const [a, b] = [p.sx(f.h), p.sx(foldOf(f.h, state.N))], top = p.box.top - Math.min(84, 14 + 0.22 * Math.abs(a - b));
    return `<path class="folded" stroke-width="${width}" opacity="${opacity}" d="M${round(a)} ${p.box.top}C${round(a)} ${round(top)} ${round(b)} ${round(top)} ${round(b)} ${p.box.top}"/>` +
      `<path class="fill-folded" opacity="${opacity}" d="M${round(b) - 3} ${p.box.top - 6}h6l-3 6z"/>`;
  };
  return others.map(f => arc(f, 1, 0.35)).join('') + chosen.map(f => arc(f, 2.2, 1)).join('');
}

/* The first true harmonics beyond H that land on h. */
function foldingOnto(h, N, H, n) {
  const list = [];
  for (let i = 1; list.length < n; ++i) {
    if (i * N - h > H) list.push(i * N - h);
    if (h && i * N + h > H && list.length < n) list.push(i * N + h);
  }
  return list;
}

function spectrumWords(state, motion) {
  const list = motion && motion.spectrum ? harmonicsOf(motion.spectrum) : [];
  const f = list[state.harmonic];
  if (!list.length) return whyNothing(motion);
  const degree = state.contacts.length && state.contacts.every(degreeOf) ? Math.max(...state.contacts.map(degreeOf)) : 0;
  const need = (degree + 1) * state.H + 1, rule = degree ? `A polynomial of degree p = ${degree} makes no harmonic above p H = ${degree * state.H}: N = (p + 1) H + 1 = ${need} samples ` +
    `are exact for the force and its Jacobian, and N = ${state.N} ${state.N >= need ? 'is enough' : 'is too few'}. ` : '';
  if (!f || state.harmonic > state.H) return `Harmonics 0 to ${state.H} are kept: look at one of them.`;
  const first = foldingOnto(f.h, state.N, state.H, 4).join(', ');
  const beyond = state.N - f.h > list.length - 1 ? ` All of them are beyond harmonic ${list.length - 1}, where the drawing ends.` : '';
  const size = f.size > 0 ? `, ${percent(f.off / f.size)} of it` : '';
  return `${rule}Harmonic ${f.h}: true ${show(f.size)}, from ${state.N} samples ${show(f.sampled)}. The difference, of complex numbers (cosine and sine parts), is ${show(f.off, 3)}${size}. ` +
    `Harmonics ${first}, ... look the same as it at the samples.${beyond}`;
}

function harmonicRows(state, motion) {
  const list = motion && motion.spectrum ? harmonicsOf(motion.spectrum).slice(0, state.H + 1) : [];
  return list.map(f => `<tr${f.h === state.harmonic ? ' class="looked"' : ''}><td>${f.h}</td><td>${show(f.size, 6)}</td><td>${show(f.sampled, 6)}</td>` +
    `<td>${show(f.off, 2)}</td><td>${foldingOnto(f.h, state.N, state.H, 3).join(', ')}</td></tr>`).join('');
}
