/* plot.js - what all drawings have: scales, axes, lines and marks as SVG. Colours are style.css's. */
'use strict';

const $ = id => document.getElementById(id);
const round = v => Math.round(v * 100) / 100;
const show = (v, digits) => (v === null || v === undefined || !isFinite(v) ? '-' : String(+Number(v).toPrecision(digits || 5)));
const percent = v => show(100 * v, 2) + ' %';
const plain = text => String(text).replace(/[&<>"]/g, c => '&#' + c.charCodeAt(0) + ';');

const margin = {left: 58, right: 18, top: 12, bottom: 40};

/* Round numbers in [from, to], about n of them. */
function ticksOf(from, to, n) {
  const rough = (to - from) / n, size = Math.pow(10, Math.floor(Math.log10(rough)));
  const step = size * [1, 2, 5, 10].find(f => f * size >= rough);
  const first = Math.ceil(from / step - 1e-9), list = [];
  for (let i = first; i * step <= to + 1e-9 * step; ++i) list.push(+(i * step).toPrecision(12));
  return list;
}

function decadesOf(from, to) {
  const list = [];
  for (let d = Math.ceil(Math.log10(from) - 1e-9); d <= Math.log10(to) + 1e-9; ++d) list.push(Math.pow(10, d));
  return list.length > 8 ? list.filter((v, i) => i % Math.ceil(list.length / 8) === 0) : list;
}

/* axis {from, to, log, title, ticks} onto pixels a..b. */
function scaleOf(axis, a, b) {
  const f = axis.log ? Math.log10 : v => v;
  const [low, high] = [f(axis.from), f(axis.to)];
  const scale = v => a + ((f(v) - low) / (high - low)) * (b - a);
  scale.back = pixel => {
    const v = low + ((pixel - a) / (b - a)) * (high - low);
    return axis.log ? Math.pow(10, v) : v;
  };
  return scale;
}

/* A panel of a drawing: a box in pixels with its two axes. */
function panel(box, x, y) {
  const sx = scaleOf(x, box.left, box.right), sy = scaleOf(y, box.bottom, box.top);
  const list = axis => axis.ticks || (axis.log ? decadesOf(axis.from, axis.to) : null);
  const xs = list(x) || ticksOf(x.from, x.to, Math.max(3, (box.right - box.left) / 90));
  const ys = list(y) || ticksOf(y.from, y.to, Math.max(2, (box.bottom - box.top) / 50));
  const text = (v, log) => (log && (v >= 1e5 || v < 1e-2) ? v.toExponential(0).replace('e+', 'e') : show(v, 6));
  let svg = '';
  for (const v of xs)
    svg += `<path class="grid" d="M${round(sx(v))} ${box.top}V${box.bottom}"/>` + (x.hidden ? '' :
      `<text x="${round(sx(v))}" y="${box.bottom + 15}" text-anchor="middle">${text(v, x.log)}</text>`);
  for (const v of ys)
    svg += `<path class="grid" d="M${box.left} ${round(sy(v))}H${box.right}"/>` +
      `<text x="${box.left - 5}" y="${round(sy(v)) + 4}" text-anchor="end">${text(v, y.log)}</text>`;
  svg += `<path class="frame" d="M${box.left} ${box.top}V${box.bottom}H${box.right}"/>`;
  if (!x.hidden) svg += `<text class="name" x="${(box.left + box.right) / 2}" y="${box.bottom + 33}" text-anchor="middle">${plain(x.title)}</text>`;
  const middle = (box.top + box.bottom) / 2;
  svg += `<text class="name" transform="translate(12 ${middle}) rotate(-90)" text-anchor="middle">${plain(y.title)}</text>`;
  return {box, sx, sy, svg};
}

/* The width a drawing has, and its one box. */
function boxOf(svg, height) {
  const width = Math.max(240, Math.round(svg.parentNode.clientWidth || 600));
  return {left: margin.left, right: width - margin.right, top: margin.top, bottom: height - margin.bottom, width, height};
}

/* What is drawn inside a panel does not leave it. */
let clips = 0;
function clipped(p, inside) {
  const {box} = p, id = 'clip-' + ++clips;
  return `<clipPath id="${id}"><rect x="${box.left}" y="${box.top - 1}" width="${box.right - box.left}" height="${box.bottom - box.top + 2}"/></clipPath>` +
    `<g clip-path="url(#${id})">${inside}</g>`;
}

function put(svg, box, content) {
  svg.setAttribute('viewBox', `0 0 ${box.width} ${box.height}`);
  svg.innerHTML = content;
}

/* A drawing without anything to draw says why. */
function putWords(svg, box, words) {
  put(svg, box, `<text x="${box.width / 2}" y="${box.height / 2}" text-anchor="middle">${plain(words)}</text>`);
}

/* points: [x, y] pairs; where a number is missing the line is broken. */
function lineOf(p, points, classes) {
  let d = '', pen = 'M';
  for (const [x, y] of points) {
    const [px, py] = [p.sx(x), p.sy(y)];
    if (isFinite(px) && isFinite(py)) d += pen + round(px) + ' ' + round(Math.max(-1e5, Math.min(1e5, py)));
    pen = isFinite(px) && isFinite(py) ? 'L' : 'M';
  }
  return d ? `<path class="${classes}" d="${d}"/>` : '';
}

/* Many marks as one path: a dot, diamond, cross, square or tick at each point. */
function marksOf(p, points, shape, size, classes) {
  const shapes = {
    dot: (x, y) => `M${round(x - size)} ${y}a${size} ${size} 0 1 0 ${2 * size} 0a${size} ${size} 0 1 0 ${-2 * size} 0z`,
    diamond: (x, y) => `M${x} ${round(y - size)}l${size} ${size}l${-size} ${size}l${-size} ${-size}z`,
    square: (x, y) => `M${round(x - size)} ${round(y - size)}h${2 * size}v${2 * size}h${-2 * size}z`,
    cross: (x, y) => `M${round(x - size)} ${round(y - size)}l${2 * size} ${2 * size}m0 ${-2 * size}l${-2 * size} ${2 * size}`,
    tick: (x, y) => `M${x} ${round(y - size)}v${2 * size}`
  };
  const inside = points.filter(([x, y]) => isFinite(p.sx(x)) && isFinite(p.sy(y)));
  const d = inside.map(([x, y]) => shapes[shape](round(p.sx(x)), round(p.sy(y)))).join('');
  return d ? `<path class="${classes}" d="${d}"/>` : '';
}

/* [least, largest] of what is finite, with a little air; where there is nothing [-1, 1]. */
function rangeOf(values, air) {
  let low = Infinity, high = -Infinity;
  for (const v of values) if (isFinite(v)) [low, high] = [Math.min(low, v), Math.max(high, v)];
  if (!(low <= high)) return [-1, 1];
  const more = (high - low || Math.abs(high) || 1) * (air === undefined ? 0.05 : air);
  return [low - more, high + more];
}

const columnOf = (table, c) => Array.from({length: table.rows}, (_, i) => table.values[i * table.columns + c]);
