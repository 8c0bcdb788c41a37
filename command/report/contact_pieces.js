/* contact_pieces.js - the states a contact goes through in a period of x(th): located as hbm/transitions.c does, or
 * followed from sample to sample as hbm/slider.c does. The law is in model/contact_law.h. Nothing of the page.
 *   X        [a0, a1, b1, ...]: x(th) = a0 + sum_h a_h cos(h th) + b_h sin(h th), th = omega t
 *   contact  {kt, kn, mu, gap, c, s}: u = c x, v = s x
 *   piece    {state, from, to, w, at, slope}: from angle to angle; or from sample to sample, `to` not included. Stuck,
 *            the slider is at w, and dw = slope dx(at), `at` an angle */
const TURN = 2 * Math.PI;
const APART = 0;
const STICK = 2; /* and slip: +1 forwards, -1 backwards */

/* x and dx/dth at an angle. */
function motionAt(X, th) {
  const c1 = Math.cos(th);
  const s1 = Math.sin(th);
  let c = 1;
  let s = 0;
  let x = X[0];
  let dx = 0;
  for (let h = 1; 2 * h < X.length; h++) {
    const turned = c * c1 - s * s1;
    s = s * c1 + c * s1;
    c = turned;
    x += X[2 * h - 1] * c + X[2 * h] * s;
    dx += h * (X[2 * h] * c - X[2 * h - 1] * s);
  }
  return {th, x, dx};
}

const isSlip = state => Math.abs(state) === 1;
const touches = (k, x) => k.s * x + k.gap > 0;
const hasFriction = k => k.kt > 0 && k.kn > 0 && k.mu > 0;

/* mu N at x; where slip with that sign leaves the slider, and its derivative by x. */
const limitAt = (k, x) => k.mu * k.kn * (k.s * x + k.gap);
const slidTo = (k, sign, x) => k.c * x - (sign * limitAt(k, x)) / k.kt;
const slidSlope = (k, sign) => k.c - (sign * k.mu * k.kn * k.s) / k.kt;

/* ---- located -------------------------------------------------------------------------------------------------- */

/* Why a state may end: functions of a motion {th, x, dx} that are positive until it does. */
function guardsOf(k, now) {
  const contact = m => k.s * m.x + k.gap;
  if (now.state === APART) return [m => -contact(m)];
  if (!hasFriction(k)) return [contact];
  if (isSlip(now.state)) return [contact, m => now.state * k.kt * k.c * m.dx - k.mu * k.kn * k.s * m.dx];
  return [contact].concat([1, -1].map(sign => m => limitAt(k, m.x) - sign * k.kt * (k.c * m.x - now.w)));
}

/* Where the guard falls through 0 between the motions a and b, at b it has: by secants and bisection. */
function rootOf(X, guard, a, b) {
  let low = a.th;
  let high = b.th;
  let atLow = Math.max(guard(a), 0);
  let atHigh = guard(b);
  for (let i = 0; i < 60 && high - low > 4e-16 * high; i++) {
    const secant = low + ((high - low) * atLow) / (atLow - atHigh);
    const th = i % 3 === 2 || !(secant > low && secant < high) ? 0.5 * (low + high) : secant;
    const value = guard(motionAt(X, th));
    if (value > 0) [low, atLow] = [th, value];
    else [high, atHigh] = [th, value];
    if (value === 0) break;
  }
  return motionAt(X, high);
}

/* Motions over a period, from 0 to 2 pi, and between them all where x turns. Every guard is linear in x, or in dx, so
 * between two neighbours it changes its sign at most once. */
function nodesOf(X) {
  const n = Math.max(96, 12 * ((X.length - 1) / 2));
  const nodes = [motionAt(X, 0)];
  for (let i = 1; i <= n; i++) {
    const [a, b] = [nodes[nodes.length - 1], motionAt(X, (TURN * i) / n)];
    if (a.dx * b.dx < 0) nodes.push(rootOf(X, m => Math.sign(a.dx) * m.dx, a, b));
    nodes.push(b);
  }
  return nodes;
}

/* The piece that begins at the motion m, where guard number `which` of the piece before has ended it. */
function nextPiece(k, before, which, m) {
  const piece = {state: STICK, from: m.th, to: m.th, w: k.c * m.x, at: m.th, slope: 0};
  if (before.state === APART) {
    const pull = k.kt * k.c * m.dx;
    const friction = k.mu * k.kn * k.s * m.dx;
    if (hasFriction(k) && Math.abs(pull) > friction) piece.state = Math.sign(pull);
  } else if (which === 0) piece.state = APART;
  else if (before.state === STICK) piece.state = which === 1 ? 1 : -1;
  else Object.assign(piece, {w: slidTo(k, before.state, m.x), slope: slidSlope(k, before.state)});
  return piece;
}

/* From the motion a to b, neighbours: pieces that end are pushed; returns the one under way, or null after
 * more changes than a contact has. */
function followTo(X, k, now, a, b, pieces) {
  for (let changes = 0; ; changes++) {
    let first = null;
    let which = 0;
    guardsOf(k, now).forEach((guard, i) => {
      if (guard(b) > 0 || (isSlip(now.state) && i === 1 && guard(b) === 0)) return;
      const root = rootOf(X, guard, a, b);
      if (!first || root.th < first.th) [first, which] = [root, i];
    });
    if (!first) return now;
    if (changes > 8) return null;
    now.to = first.th;
    pieces.push(now);
    now = nextPiece(k, now, which, first);
    a = first;
    if (!(a.th < b.th)) return now;
  }
}

/* The pieces of the period, located; null if they cannot be. A first period settles the slider. */
function locatedPieces(X, k) {
  const nodes = nodesOf(X);
  let now = {state: touches(k, nodes[0].x) ? STICK : APART, from: 0, to: 0, w: 0, at: 0, slope: 0};
  for (let period = 0; period < 2; period++) {
    const pieces = [];
    now = Object.assign({}, now, {from: 0});
    for (let i = 1; i < nodes.length && now; i++) now = followTo(X, k, now, nodes[i - 1], nodes[i], pieces);
    if (!now) return null;
    now.to = TURN;
    pieces.push(now);
    if (period === 1) return pieces;
  }
}

/* ---- sampled -------------------------------------------------------------------------------------------------- */

/* One step of the law from the piece `now` to x[i]: the same piece, or the one that begins there. */
function stepTo(k, now, before, x, i, n, restart) {
  const begin = more => Object.assign({from: i, to: i, w: 0, at: (TURN * ((i + n - 1) % n)) / n, slope: 0}, more);
  if (!touches(k, x)) return now.state === APART ? now : begin({state: APART});
  if (!hasFriction(k)) return now.state === STICK ? now : begin({state: STICK});
  let slider = now;
  if (now.state === APART && restart === 'sample') slider = begin({w: k.c * before, slope: k.c});
  else if (now.state === APART) slider = begin({w: (-k.gap * k.c) / k.s});
  else if (isSlip(now.state)) slider = begin({w: slidTo(k, now.state, before), slope: slidSlope(k, now.state)});
  const pull = k.kt * (k.c * x - slider.w);
  if (Math.abs(pull) > limitAt(k, x)) {
    const sign = Math.sign(pull);
    return now.state === sign ? now : begin({state: sign});
  }
  return now.state === STICK ? now : Object.assign(slider, {state: STICK});
}

/* The pieces of the N samples x[]. */
function sampledPieces(x, k, restart) {
  const n = x.length;
  let now = {state: touches(k, x[n - 1]) ? STICK : APART, from: 0, to: 0, w: 0, at: 0, slope: 0};
  for (let period = 0; period < 2; period++) {
    const pieces = [];
    now = Object.assign({}, now, {from: 0});
    for (let i = 0; i < n; i++) {
      const next = stepTo(k, now, x[(i + n - 1) % n], x[i], i, n, restart);
      if (next === now) continue;
      now.to = i;
      if (i > now.from) pieces.push(now);
      now = next;
    }
    now.to = n;
    pieces.push(now);
    if (period === 1) return pieces;
  }
}
