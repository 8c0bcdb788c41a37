/* continuation.js - the response curve of evaluator.js' equations with exact forces by arc length, and the solutions on
 * it. A plain one: what the page needs of hbm/continuation.c. Nothing of the page. */

const linearSolution = (model, H, omega) => {
  const X = new Float64Array(2 * H + 1);
  const k = model.stiffness - model.mass * omega * omega;
  const c = model.damping * omega;
  X[1] = (model.force * k) / (k * k + c * c);
  X[2] = (model.force * c) / (k * k + c * c);
  return X;
};

/* A solution where the sweep begins: Newton from the one without contact; else with so much more damping that no
 * contact matters, which is then taken away. */
function firstSolution(model, H) {
  const omega = model.from;
  const direct = solveAt(model, linearSolution(model, H, omega), omega, 0);
  if (direct) return direct;
  const stiffest = model.contacts.reduce((sum, k) => sum + k.kt + k.kn, model.stiffness + model.mass * omega * omega);
  const damped = more => Object.assign({}, model, {damping: model.damping + more});
  let more = (10 * stiffest) / omega;
  let X = solveAt(damped(more), linearSolution(damped(more), H, omega), omega, 0);
  for (let factor = 0.5; X && factor < 0.999; ) {
    const last = more * omega < 1e-6 * stiffest;
    const next = solveAt(damped(last ? 0 : more * factor), X, omega, 0);
    if (next && last) return next;
    if (next) [X, more, factor] = [next, more * factor, Math.max(0.5, factor * factor)];
    else factor = Math.sqrt(factor);
    if (!next && last) return null;
  }
  return null;
}

/* The equations in y = [X/scale, omega/width], with the row `last` below. */
function bordered(now, scale, width, last) {
  const n = now.R.length;
  const a = new Float64Array((n + 1) * (n + 1));
  for (let row = 0; row < n; row++) {
    for (let col = 0; col < n; col++) a[row * (n + 1) + col] = now.jac[row * n + col] * scale;
    a[row * (n + 1) + n] = now.byOmega[row] * width;
  }
  a.set(last, n * (n + 1));
  return a;
}

/* The unit tangent in y, going on from `before`; null where there is none. */
function tangentAt(now, scale, width, before) {
  const n = now.R.length;
  const t = new Float64Array(n + 1);
  t[n] = 1;
  if (!solveLinear(bordered(now, scale, width, before), t, n + 1)) return null;
  const length = Math.hypot(...t);
  return t.map(v => v / length);
}

/* The solution in the plane through y normal to the tangent; as newton gives it. */
function correct(model, y, tangent, scale, width) {
  const n = y.length - 1;
  const system = z => {
    const omega = z[n] * width;
    const now = omega > 0 ? equations(model, z.subarray(0, n).map(v => v * scale), omega, 0) : null;
    if (!now) return null;
    const R = new Float64Array(n + 1);
    R.set(now.R);
    R[n] = now.size * tangent.reduce((sum, t, j) => sum + t * (z[j] - y[j]), 0);
    return {R, matrix: bordered(now, scale, width, tangent.map(t => t * now.size)), size: now.size, now};
  };
  return newton(y, system, 1e-9, 9);
}

const works = pieces => pieces.length && pieces.some(p => p.piece.state !== APART) && !everStuck(pieces);
const everStuck = pieces => new Set(pieces.map(p => p.contact)).size === pieces.length;

/* Past the end of the sweep; or far past its start, from where a curve may come back (hbm/continuation.c). */
function hasLeft(model, omega) {
  const far = 4;
  if (model.from < model.to) return omega > model.to || omega < model.from / far;
  return omega < model.to || omega > model.from * far;
}

/* The response curve by arc length, turning points and all, as far as it goes: points {X, omega, works}, `works` where
 * a contact changes its state. */
function traceCurve(model, H, most) {
  const width = model.to - model.from;
  const first = firstSolution(model, H);
  const points = [];
  if (!first) return points;
  const n = first.length;
  const put = (X, omega, now) => points.push({X, omega, works: works(now.pieces)});
  let now = equations(model, first, model.from, 0);
  let tangent = new Float64Array(n + 1).fill(1, n); /* towards the end of the sweep */
  let step = 0.01;
  put(first, model.from, now);
  while (points.length < most && step > 1e-7) {
    const {X, omega} = points[points.length - 1];
    const scale = Math.max(largest(X), 1e-300);
    const t = tangentAt(now, scale, width, tangent);
    if (!t) break;
    const y = t.map((v, j) => (j < n ? X[j] / scale : omega / width) + step * v);
    const found = correct(model, y, t, scale, width);
    const next = found && tangentAt(found.at.now, scale, width, t);
    const turn = next ? next.reduce((sum, v, j) => sum + v * t[j], 0) : -1;
    if (turn < (step > 1e-4 ? 0.8 : -0.5)) {
      step /= 2;
      continue;
    }
    [now, tangent] = [found.at.now, next];
    put(found.y.subarray(0, n).map(v => v * scale), found.y[n] * width, now);
    if (hasLeft(model, points[points.length - 1].omega)) break;
    if (found.iterations <= 3 && turn > 0.95) step = Math.min(0.04, 1.4 * step);
  }
  return points;
}

/* The solutions at omega between the points of a curve. */
function solutionsOn(model, points, omega) {
  const out = [];
  for (let i = 1; i < points.length; i++) {
    const [a, b] = [points[i - 1], points[i]];
    if (a.omega === omega && i === 1) out.push(a.X);
    if ((a.omega - omega) * (b.omega - omega) > 0 || a.omega === omega) continue;
    const part = (omega - a.omega) / (b.omega - a.omega);
    const X = solveAt(model, a.X.map((x, j) => x + part * (b.X[j] - x)), omega, 0);
    if (X) out.push(X);
  }
  return out;
}
