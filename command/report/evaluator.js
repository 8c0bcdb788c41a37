/* evaluator.js - harmonic balance in the page: what the sliders of the aliasing section show, wherever they stand. The
 * equations are those of hbm/system.c and hbm/exact_force.c; the page's self test holds these numbers against theirs.
 *   model    {mass, damping, stiffness, force, keep_mean, restart, from, to, contacts[]}, from..to the sweep
 *   samples  N a period, or 0: exact forces
 * On a piece (contact_pieces.js) the force is k x + g with constants k and g. Its harmonics, and their derivatives, are
 * sums of
 *   E(m) = (1/pi) int exp(-i m th) dth over the piece,   or   (2/N) sum exp(-i m th_i) over its samples. */

/* E(m) of a piece, [re, im], from its middle and half its width: so that a short piece keeps its digits. */
function weightOf(piece, samples, m) {
  if (!samples) {
    const middle = (m * (piece.from + piece.to)) / 2;
    const half = (piece.to - piece.from) / 2;
    const size = m ? (2 * Math.sin(m * half)) / (m * Math.PI) : (2 * half) / Math.PI;
    return [size * Math.cos(middle), -size * Math.sin(middle)];
  }
  const step = (TURN * (m % samples)) / samples; /* sin(n step/2)/sin(step/2): n terms of a geometric series */
  const n = piece.to - piece.from;
  const middle = (step * (piece.from + piece.to - 1)) / 2;
  const size = ((2 / samples) * (m % samples ? Math.sin((n * step) / 2) : n)) / (m % samples ? Math.sin(step / 2) : 1);
  return [size * Math.cos(middle), -size * Math.sin(middle)];
}

/* The force on a piece: stiffness times x plus constant. */
function lawOn(k, piece) {
  const preload = k.gap > 0 ? k.kn * k.gap : 0;
  if (piece.state === APART) return {stiffness: 0, constant: -k.s * preload};
  const normal = k.s * (k.kn * k.gap - preload);
  if (piece.state === STICK) {
    const kt = hasFriction(k) ? k.kt : 0;
    return {stiffness: k.c * k.c * kt + k.s * k.s * k.kn, constant: normal - k.c * kt * piece.w};
  }
  const pull = k.c * piece.state * k.mu * k.kn;
  return {stiffness: k.s * (pull + k.s * k.kn), constant: pull * k.gap + normal};
}

/* ---- the contact force and its harmonics ------------------------------------------------------------------------ */

/* x at N samples. */
function samplesOf(X, n) {
  const x = new Float64Array(n);
  const cosine = Float64Array.from({length: n}, (_, i) => Math.cos((TURN * i) / n));
  for (let i = 0; i < n; i++) {
    let sum = X[0];
    for (let h = 1, j = 0; 2 * h < X.length; h++) {
      j = (h * i) % n;
      sum += X[2 * h - 1] * cosine[j] + X[2 * h] * cosine[(j + n - (n >> 2)) % n]; /* sin = cos a quarter later */
    }
    x[i] = sum;
  }
  return x;
}

/* All pieces of all contacts with their laws; null where they cannot be located. */
function piecesOf(model, X, samples) {
  const x = samples ? samplesOf(X, samples) : null;
  const out = [];
  for (const k of model.contacts) {
    const pieces = samples ? sampledPieces(x, k, model.restart) : locatedPieces(X, k);
    if (!pieces) return null;
    for (const piece of pieces) out.push(Object.assign({contact: k, piece}, lawOn(k, piece)));
  }
  return out;
}

/* sum of factor(piece) E(m) over the pieces, m = 0..most: {re[], im[]}. */
function transform(pieces, samples, most, factor) {
  const re = new Float64Array(most + 1);
  const im = new Float64Array(most + 1);
  for (const p of pieces) {
    const f = factor(p);
    if (f === 0) continue;
    for (let m = 0; m <= most; m++) {
      const e = weightOf(p.piece, samples, m);
      re[m] += f * e[0];
      im[m] += f * e[1];
    }
  }
  return {re, im};
}

/* Harmonic h of k(th) times x(th), a - i b, from the transform S of k. */
function harmonicOfProduct(S, X, h) {
  const at = m => [S.re[Math.abs(m)], m < 0 ? -S.im[-m] : S.im[m]];
  let [re, im] = at(h).map(v => v * X[0]);
  for (let j = 1; 2 * j < X.length; j++) {
    const [below, above] = [at(h - j), at(h + j)];
    const a = X[2 * j - 1] / 2;
    const b = X[2 * j] / 2;
    re += a * (below[0] + above[0]) + b * (below[1] - above[1]);
    im += a * (below[1] + above[1]) - b * (below[0] - above[0]);
  }
  return [re, im];
}

/* The harmonics `wanted` of the force, each as [a, b]; the mean as [a0, 0]. */
function forceHarmonics(pieces, samples, X, wanted) {
  const most = Math.max(...wanted) + (X.length - 1) / 2;
  const S = transform(pieces, samples, most, p => p.stiffness);
  const G = transform(pieces, samples, most, p => p.constant);
  return wanted.map(h => {
    const [re, im] = harmonicOfProduct(S, X, h);
    return h ? [re + G.re[h], -(im + G.im[h])] : [(re + G.re[0]) / 2, 0];
  });
}

/* jac[row n + col] += dF/dX. */
function addForceJacobian(pieces, samples, H, jac) {
  const n = 2 * H + 1;
  const S = transform(pieces, samples, 2 * H, p => p.stiffness);
  const unit = new Float64Array(n);
  const add = (h, col, [re, im], factor) => {
    if (h) jac[(2 * h - 1) * n + col] += factor * re;
    jac[2 * h * n + col] += h ? -factor * im : (factor * re) / 2;
  };
  for (let col = 0; col < n; col++) {
    const j = (col + 1) >> 1;
    for (let h = 0; h <= H; h++) {
      const back = Math.abs(h - j);
      const below = [S.re[back], h < j ? -S.im[back] : S.im[back]];
      const above = [S.re[h + j], S.im[h + j]];
      if (!col) add(h, 0, above, 1);
      else if (col % 2) add(h, col, [below[0] + above[0], below[1] + above[1]], 0.5);
      else add(h, col, [below[1] - above[1], above[0] - below[0]], 0.5);
    }
  }
  for (const p of pieces) {
    if (p.piece.state !== STICK || !p.piece.slope || !hasFriction(p.contact)) continue;
    unit[0] = 1;
    for (let h = 1; h <= H; h++) {
      unit[2 * h - 1] = Math.cos(h * p.piece.at);
      unit[2 * h] = Math.sin(h * p.piece.at);
    }
    const factor = -p.contact.c * p.contact.kt * p.piece.slope;
    for (let h = 0; h <= H; h++) {
      const e = weightOf(p.piece, samples, h);
      for (let col = 0; col < n; col++) add(h, col, e, factor * unit[col]);
    }
  }
}

/* ---- the equations ---------------------------------------------------------------------------------------------- */

/* Residual, its derivatives by X (row by row) and by omega, and the size of the forces it is made of; null where the
 * contacts cannot be followed. */
function equations(model, X, omega, samples) {
  const n = X.length;
  const H = (n - 1) / 2;
  const pieces = piecesOf(model, X, samples);
  if (!pieces) return null;
  const R = new Float64Array(n);
  const byOmega = new Float64Array(n);
  const jac = new Float64Array(n * n);
  const F = forceHarmonics(pieces, samples, X, Array.from({length: H + 1}, (_, h) => h));
  addForceJacobian(pieces, samples, H, jac);
  R[0] = model.stiffness * X[0] + F[0][0];
  jac[0] += model.stiffness;
  let size = Math.abs(model.force);
  for (let h = 1; h <= H; h++) {
    const [i, j] = [2 * h - 1, 2 * h];
    const [a, b] = [X[i], X[j]];
    const k = model.stiffness - model.mass * h * h * omega * omega;
    const c = model.damping * h * omega;
    R[i] = k * a + c * b + F[h][0];
    R[j] = k * b - c * a + F[h][1];
    jac[i * n + i] += k;
    jac[i * n + j] += c;
    jac[j * n + i] -= c;
    jac[j * n + j] += k;
    byOmega[i] = -2 * model.mass * h * h * omega * a + model.damping * h * b;
    byOmega[j] = -2 * model.mass * h * h * omega * b - model.damping * h * a;
    size = Math.max(size, Math.abs(model.stiffness * a), Math.abs(model.stiffness * b), ...F[h].map(Math.abs));
  }
  R[1] -= model.force;
  if (!model.keep_mean) {
    for (let col = 0; col < n; col++) jac[col] = col ? 0 : 1;
    R[0] = X[0];
  }
  return {R, jac, byOmega, size, pieces};
}

/* Solves a x = b in place, n equations, rows one after another; false: singular. */
function solveLinear(a, b, n) {
  for (let col = 0; col < n; col++) {
    let top = col;
    for (let row = col + 1; row < n; row++) if (Math.abs(a[row * n + col]) > Math.abs(a[top * n + col])) top = row;
    if (!(Math.abs(a[top * n + col]) > 0)) return false;
    if (top !== col) {
      for (let j = col; j < n; j++) [a[col * n + j], a[top * n + j]] = [a[top * n + j], a[col * n + j]];
      [b[col], b[top]] = [b[top], b[col]];
    }
    for (let row = col + 1; row < n; row++) {
      const f = a[row * n + col] / a[col * n + col];
      if (f === 0) continue;
      for (let j = col + 1; j < n; j++) a[row * n + j] -= f * a[col * n + j];
      b[row] -= f * b[col];
    }
  }
  for (let row = n - 1; row >= 0; row--) {
    for (let j = row + 1; j < n; j++) b[row] -= a[row * n + j] * b[j];
    b[row] /= a[row * n + row];
  }
  return true;
}

const largest = v => v.reduce((most, x) => Math.max(most, Math.abs(x)), 0);

/* Newton from y: system(y) gives the residual R, the matrix dR/dy and the size of R's terms, or null where it cannot
 * be evaluated. Steps are halved until the residual falls; where no part of one does that, as across a corner, it is
 * taken whole. {y, at, iterations}, `at` what system gave there, or null. */
function newton(y, system, tolerance, most) {
  let at = system(y);
  for (let i = 0; at && i <= most; i++) {
    if (largest(at.R) <= tolerance * at.size) return {y, at, iterations: i};
    const step = Float64Array.from(at.R);
    if (!solveLinear(Float64Array.from(at.matrix), step, step.length)) return null;
    const norm = Math.hypot(...at.R);
    const move = part => y.map((v, j) => v - part * step[j]);
    let part = 1;
    let next = system(move(part));
    while (part > 1e-3 && !(next && Math.hypot(...next.R) < norm)) {
      part /= 2;
      next = system(move(part));
    }
    if (part <= 1e-3) [part, next] = [1, system(move(1))];
    [y, at] = [move(part), next];
  }
  return null;
}

/* The solution at omega that Newton finds from X, or null. */
function solveAt(model, X, omega, samples) {
  const system = y => {
    const at = equations(model, y, omega, samples);
    return at && Object.assign(at, {matrix: at.jac});
  };
  const found = newton(Float64Array.from(X), system, 1e-11, 40);
  return found && found.y;
}

/* (max - min)/2 of x over a period. */
function amplitudeOf(X) {
  const x = nodesOf(X).map(m => m.x);
  return (Math.max(...x) - Math.min(...x)) / 2;
}
