/* force_steps.h - time integration of a structure that rubs on node pairs (law of the circle), of the tests' own: it
 * shares with timeint/ the model, the law's formulas and LAPACK alone.
 *
 *     q'' + c q' + omega^2 q = p(t) - B^T f     in modes, phi^T M phi = 1, damping diagonal in them; r = B q: two
 *                                               tangential motions and the normal one of each pair, f(r) its forces
 *
 * Loads and contact forces are straight lines over a step h; of such forces the modes' motion is exact (Nigam and
 * Jennings, Bull. Seism. Soc. Am. 59, 1969, 909-922). f at a step's end by Newton on r = r_free - G f(r). The law is
 * exact for motions r that are straight lines over a step, too:
 *     stick until |u - w| = R = mu N/kt; from there on slip, the angle d of e from the direction of u' falling as
 *         tan(d/2) = tan(d0/2) exp(-integral ds/R),   s the way of u, R linear in s      (R d' = -sin d, contact_law.h)
 *     from a touch on in the direction of u', if |u'| > R', else stick where it touched
 * What is left is the bend of forces and motions in a step: second order, at kinks of the law, too. */
#pragma once

#include "model/model.h"
#include "numerics/dense.h"
#include "tests/check.h"

enum { STEPS_MODES = 84, STEPS_PAIRS = 12, STEPS_ROWS = 3 * STEPS_PAIRS, STEPS_LOADS = 4 };

typedef struct force_steps {
  int n, pairs, rows, n_loads;
  double shape[STEPS_MODES * STEPS_MODES],
      inverse[STEPS_MODES * STEPS_MODES]; /* by columns: x = shape q, q = inverse x */
  double omega2[STEPS_MODES], damping[STEPS_MODES];
  double row[STEPS_ROWS][STEPS_MODES], response[STEPS_MODES];
  double cosine[STEPS_LOADS][STEPS_MODES], sine[STEPS_LOADS][STEPS_MODES];
  int harmonic[STEPS_LOADS];
  contact law[STEPS_PAIRS]; /* of whole pairs */
  /* of steps of one length: q = x_x q0 + x_v q0' + x_0 f0 + x_1 f1, q' = v_x q0 + ..., forces from f0 to f1; G */
  double x_x[STEPS_MODES], x_v[STEPS_MODES], x_0[STEPS_MODES], x_1[STEPS_MODES];
  double v_x[STEPS_MODES], v_v[STEPS_MODES], v_0[STEPS_MODES], v_1[STEPS_MODES];
  double compliance[STEPS_ROWS * STEPS_ROWS];
} force_steps;

typedef struct steps_state {
  double q[STEPS_MODES], dq[STEPS_MODES], w[2 * STEPS_PAIRS];
} steps_state;

static inline void force_steps_make(force_steps *s, const model *m)
{
  static double C[STEPS_MODES * STEPS_MODES], work[2 * STEPS_MODES * STEPS_MODES];
  const int n = m->n;
  assert_true(n <= STEPS_MODES && m->n_contacts <= 2 * STEPS_PAIRS && m->n_loads <= STEPS_LOADS);
  s->n = n, s->pairs = m->n_contacts / 2, s->rows = 3 * s->pairs, s->n_loads = m->n_loads;
  assert_int_equal(dense_modes(n, m->stiffness, m->mass, s->omega2, s->shape), HC_OK);
  dense_congruence(n, n, s->shape, m->damping, work, C);
  assert_true(dense_is_diagonal(n, C, n));
  dense_multiply(n, n, n, m->mass, s->shape, work);
  dense_transpose(n, n, work, s->inverse);
  for (int k = 0; k < n; ++k) {
    const double *phi = s->shape + (size_t)k * (size_t)n;
    s->damping[k] = C[k * (n + 1)];
    s->response[k] = dot_product(n, m->responses, phi);
    for (int l = 0; l < m->n_loads; ++l) {
      s->harmonic[l] = m->loads[l].harmonic;
      s->cosine[l][k] = dot_product(n, m->loads[l].cosine, phi);
      s->sine[l][k] = dot_product(n, m->loads[l].sine, phi);
    }
    for (int p = 0; p < s->pairs; ++p) {
      const model_contact *c = &m->contacts[2 * p];
      assert_true(c[0].circle && c[0].pair == CONTACT_FIRST && c[0].law.load == 0);
      s->row[3 * p][k] = dot_product(n, c[0].tangent, phi);
      s->row[3 * p + 1][k] = dot_product(n, c[1].tangent, phi);
      s->row[3 * p + 2][k] = dot_product(n, c[0].normal, phi);
    }
  }
  for (int p = 0; p < s->pairs; ++p) { /* model_half_law */
    s->law[p] = m->contacts[2 * p].law;
    s->law[p].kn *= 2;
    s->law[p].mu /= 2;
  }
}

/* The step matrices of h. */
static inline void force_steps_of(force_steps *s, double h)
{
  for (int i = 0; i < s->n; ++i) {
    const double k = s->omega2[i], c = s->damping[i], z = c / 2, nu = sqrt(k - z * z), decay = exp(-z * h);
    s->x_v[i] = decay * sin(nu * h) / nu;
    s->x_x[i] = decay * cos(nu * h) + z * s->x_v[i];
    s->v_x[i] = -k * s->x_v[i];
    s->v_v[i] = decay * cos(nu * h) - z * s->x_v[i];
    const double constant = (1 - s->x_x[i]) / k; /* a force 1 from rest; t/h: t/(k h) - c/(k^2 h) and a free motion */
    s->x_1[i] = (h + s->x_x[i] * c / k - s->x_v[i] - c / k) / (k * h);
    s->v_1[i] = (1 + s->v_x[i] * c / k - s->v_v[i]) / (k * h);
    s->x_0[i] = constant - s->x_1[i];
    s->v_0[i] = s->x_v[i] - s->v_1[i];
  }
  for (int a = 0; a < s->rows; ++a)
    for (int b = 0; b < s->rows; ++b) {
      double sum = 0;
      for (int i = 0; i < s->n; ++i) sum += s->row[a][i] * s->x_1[i] * s->row[b][i];
      s->compliance[a + b * s->rows] = sum;
    }
}

/* At which part of the straight way d + s D, s >= 0, it leaves the circle of radius R0 + s dR, |d| <= R0; INFINITY:
 * never. */
static inline double steps_leave(const double d[2], const double D[2], double R0, double dR)
{
  const double a = D[0] * D[0] + D[1] * D[1] - dR * dR, b = 2 * (d[0] * D[0] + d[1] * D[1] - R0 * dR);
  const double c = fmin(d[0] * d[0] + d[1] * d[1] - R0 * R0, 0), inside = b * b - 4 * a * c;
  if (!(inside >= 0)) return INFINITY;
  if (b > 0) return -2 * c / (b + sqrt(inside));
  return a > 0 ? (sqrt(inside) - b) / (2 * a) : INFINITY;
}

/* The law along the straight line from r0, slider w0, to r1: slider w, forces f: T and N - N0. */
static inline void steps_contact(const contact *law, const double *r0, const double *r1, const double *w0, double *w,
                                 double *f)
{
  const double g0 = r0[2] + law->gap, g1 = r1[2] + law->gap, per_g = law->mu * law->kn / law->kt;
  const bool touches = g0 <= 0;
  f[2] = contact_normal_change(law, r1[2]);
  if (g1 <= 0) {
    for (int i = 0; i < 2; ++i) w[i] = r1[i], f[i] = 0;
    return;
  }
  const double closed = touches ? g1 / (g1 - g0) : 1, R0 = touches ? 0 : per_g * g0, dR = per_g * g1 - R0;
  double d[2], D[2], e[2]; /* u - w where it closes; the way from there; u - w at the end */
  for (int i = 0; i < 2; ++i) {
    d[i] = touches ? 0 : r0[i] - w0[i];
    D[i] = closed * (r1[i] - r0[i]);
    e[i] = d[i] + D[i];
  }
  const double way = hypot(D[0], D[1]);
  const double slips = !touches ? steps_leave(d, D, R0, dR) : way > dR ? 0 : INFINITY;
  if (slips < 1) {
    const double along[2] = {D[0] / way, D[1] / way}, at[2] = {d[0] + slips * D[0], d[1] + slips * D[1]};
    const double R = R0 + slips * dR, R1 = R0 + dR, left = (1 - slips) * way;
    const double per_R = fabs(R1 - R) > 1e-9 * R ? log(R1 / R) / (R1 - R) : 1 / R; /* mean of 1/R */
    const double began = atan2(along[0] * at[1] - along[1] * at[0], along[0] * at[0] + along[1] * at[1]);
    const double angle = touches ? 0 : 2 * atan(tan(began / 2) * exp(-left * per_R));
    e[0] = R1 * (cos(angle) * along[0] - sin(angle) * along[1]);
    e[1] = R1 * (cos(angle) * along[1] + sin(angle) * along[0]);
  }
  for (int i = 0; i < 2; ++i) {
    w[i] = r1[i] - e[i];
    f[i] = law->kt * e[i];
  }
}

static inline void steps_contacts(const force_steps *s, const double *r0, const double *r1, const double *w0, double *w,
                                  double *f)
{
  for (int p = 0; p < s->pairs; ++p)
    steps_contact(&s->law[p], r0 + 3 * p, r1 + 3 * p, w0 + 2 * p, w + 2 * p, f + 3 * p);
}

/* J[rows][rows] := I + G df/dr, columns of df/dr by differences over `e`; f at r1. */
static inline void steps_jacobian(const force_steps *s, const double *r0, const double *r1, const double *w0,
                                  const double *f, double e, double *J)
{
  const int n = s->rows;
  for (int q = 0; q < n; ++q) {
    const int p = q / 3;
    double moved[3] = {r1[3 * p], r1[3 * p + 1], r1[3 * p + 2]}, w[2], g[3];
    moved[q % 3] += e;
    steps_contact(&s->law[p], r0 + 3 * p, moved, w0 + 2 * p, w, g);
    for (int i = 0; i < n; ++i) {
      J[i + q * n] = i == q;
      for (int b = 0; b < 3; ++b) J[i + q * n] += s->compliance[i + (3 * p + b) * n] * (g[b] - f[3 * p + b]) / e;
    }
  }
}

/* r1, w1 and f1 := the end of the step from r0, w0 whose motion without forces there would be `unforced`. */
static inline void steps_solve(const force_steps *s, const double *r0, const double *w0, const double *unforced,
                               double *r1, double *w1, double *f1)
{
  enum { MOST_ITERATIONS = 40 };
  const double small = 1e-14, rounding = 1e-11; /* of the largest motion: what ends Newton, what it need not reach */
  double J[STEPS_ROWS * STEPS_ROWS], left[STEPS_ROWS], last = INFINITY;
  int pivot[STEPS_ROWS];
  for (int iteration = 0;; ++iteration) {
    double size = 0, largest = 0;
    steps_contacts(s, r0, r1, w0, w1, f1);
    dense_times_vector(s->rows, s->rows, -1, s->compliance, f1, 0, left);
    for (int r = 0; r < s->rows; ++r) {
      left[r] += unforced[r] - r1[r];
      size = larger(size, fabs(left[r]));
      largest = larger(largest, fabs(r1[r]));
    }
    if (size <= small * largest || (size <= rounding * largest && !(size < 0.5 * last))) return;
    assert_true(iteration < MOST_ITERATIONS && isfinite(size));
    last = size;
    steps_jacobian(s, r0, r1, w0, f1, 1e-8 * largest, J);
    assert_int_equal(dense_factor(s->rows, J, pivot), HC_OK);
    dense_solve(s->rows, J, pivot, 1, left);
    for (int r = 0; r < s->rows; ++r) r1[r] += left[r];
  }
}

static inline void steps_load(const force_steps *s, double theta, double *p)
{
  memset(p, 0, (size_t)s->n * sizeof *p);
  for (int l = 0; l < s->n_loads; ++l)
    for (int i = 0; i < s->n; ++i)
      p[i] += s->cosine[l][i] * cos(s->harmonic[l] * theta) + s->sine[l][i] * sin(s->harmonic[l] * theta);
}

static inline void steps_motion(const force_steps *s, const double *q, double *r)
{
  for (int a = 0; a < s->rows; ++a) r[a] = dot_product(s->n, s->row[a], q);
}

/* p -= B^T f */
static inline void steps_pull(const force_steps *s, const double *f, double *p)
{
  for (int a = 0; a < s->rows; ++a)
    for (int i = 0; i < s->n; ++i) p[i] -= s->row[a][i] * f[a];
}

/* One period at omega in so many steps; wave[steps]: the first response at their beginnings. */
static inline void force_steps_period(force_steps *s, double omega, int steps, steps_state *at, double *wave)
{
  double r0[STEPS_ROWS] = {0}, r1[STEPS_ROWS] = {0}, w[2 * STEPS_PAIRS] = {0}, f[STEPS_ROWS] = {0},
         unforced[STEPS_ROWS];
  double p0[STEPS_MODES], p1[STEPS_MODES], pull[STEPS_MODES];
  force_steps_of(s, TWO_PI / omega / steps);
  steps_motion(s, at->q, r0);
  steps_contacts(s, r0, r0, at->w, w, f);
  memcpy(at->w, w, sizeof w);
  memcpy(r1, r0, sizeof r1);
  steps_load(s, 0, p0);
  for (int step = 0; step < steps; ++step) {
    wave[step] = dot_product(s->n, s->response, at->q);
    steps_pull(s, f, p0);
    steps_load(s, TWO_PI * (step + 1) / steps, p1);
    for (int i = 0; i < s->n; ++i) {
      const double q = at->q[i], dq = at->dq[i];
      at->q[i] = s->x_x[i] * q + s->x_v[i] * dq + s->x_0[i] * p0[i] + s->x_1[i] * p1[i];
      at->dq[i] = s->v_x[i] * q + s->v_v[i] * dq + s->v_0[i] * p0[i] + s->v_1[i] * p1[i];
    }
    steps_motion(s, at->q, unforced);
    steps_solve(s, r0, at->w, unforced, r1, w, f);
    memset(pull, 0, sizeof pull);
    steps_pull(s, f, pull);
    for (int i = 0; i < s->n; ++i) {
      at->q[i] += s->x_1[i] * pull[i];
      at->dq[i] += s->v_1[i] * pull[i];
    }
    memcpy(at->w, w, sizeof w);
    memcpy(r0, r1, sizeof r0);
    memcpy(p0, p1, sizeof p0);
  }
}
