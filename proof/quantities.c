/* quantities.c - bounds of the orbit's amplitude, mean and harmonic 1, over the whole motion, by its series. */
#include "proof/orbit.h"

enum { DEPTH = 60, PARTS = 4000, ROUGH = 12, NEWTON_STEPS = 60 };

/* Search for the largest value of sign times the response. Pieces are the substeps that may contain it: Taylor
 * coefficients on the substep of the function and its two derivatives, with the rest added to the constant terms; and
 * the segment's end. */
typedef struct extremum {
  pool pool;
  const orbit *o;
  int sign, n;
  arb_ptr *pieces;      /* [n] each [3][degree + 1], followed by the end, at most 1 */
  arf_t low, high;      /* bounds of the largest value */
  arf_t close;          /* difference of values that need not be resolved */
  arb_ptr coefficients; /* [DEPTH + 2][3][degree + 1] */
  long parts;
} extremum;

/* bound = max(bound, lower end of x if side < 0, else upper end) */
static void raise_to(const extremum *e, arf_t bound, const arb_t x, int side)
{
  LOCAL(arf) end = {0};
  if (side < 0) arb_get_lbound_arf(end, x, e->o->precision);
  else arb_get_ubound_arf(end, x, e->o->precision);
  arf_max(bound, bound, end);
}

/* Adds the value at the ball `at`, which is attained: value at its midpoint plus slope on the ball times its radius. */
static void attained_at(extremum *e, arb_srcptr p, const arb_t at)
{
  const int n = e->o->degree + 1;
  LOCAL(arb) middle = {0}, slope = {0}, value = {0};
  LOCAL(mag) wide = {0};
  arb_get_mid_arb(middle, at);
  _arb_poly_evaluate(value, p, n, middle, e->o->precision);
  _arb_poly_evaluate(slope, p + n, n, at, e->o->precision);
  arb_get_mag(wide, slope);
  mag_mul(wide, wide, arb_radref(at));
  arb_add_error_mag(value, wide);
  raise_to(e, e->low, value, -1);
  raise_to(e, e->high, value, 1);
}

/* The maximum over [a, b], where the curvature is within a ball below 0 whose ends are within a factor of 2: Newton's
 * interval for the zero of the slope becomes shorter by half at least, or is empty: then the slope has one sign. */
static void concave(extremum *e, arb_srcptr p, const arb_t a, const arb_t b, const arb_t curvature)
{
  const slong precision = e->o->precision;
  const int n = e->o->degree + 1;
  LOCAL(arb) at = {0}, next = {0}, middle = {0}, slope = {0}, here = {0};
  arb_union(at, a, b, precision);
  for (int i = 0; i < NEWTON_STEPS; i++) {
    arb_get_mid_arb(middle, at);
    _arb_poly_evaluate(slope, p + n, n, middle, precision);
    _arb_poly_evaluate(here, p + 2L * n, n, at, precision);
    if (!arb_intersection(here, here, curvature, precision)) arb_set(here, curvature);
    arb_div(next, slope, here, precision);
    arb_sub(next, middle, next, precision);
    if (!arb_intersection(next, next, at, precision)) {
      attained_at(e, p, arb_is_positive(slope) ? b : a);
      return;
    }
    const bool shorter = mag_cmp(arb_radref(next), arb_radref(at)) < 0;
    arb_set(at, next);
    if (!shorter) break;
  }
  arb_min(at, at, b, precision); /* where b is the segment's end, a ball, the maximum may be there */
  attained_at(e, p, at);
}

/* The maximum over [a, b] of the piece; its Bernstein coefficients, and those of two derivatives, stand at `level`. */
static void bound_on(extremum *e, arb_srcptr p, int level, double a, double b)
{
  const int n = e->o->degree + 1;
  const slong precision = e->o->precision;
  arb_ptr g = e->coefficients + 3L * n * level, below = g + 3L * n;
  LOCAL(arf) bound = {0}, least = {0};
  LOCAL(arb) from = {0}, to = {0}, curvature = {0};
  LOCAL(mag) most = {0}, twice = {0};
  arb_set_d(from, a);
  arb_set_d(to, b);
  arb_min(from, from, p + 3L * n, precision); /* never beyond the segment's end, which may be a ball */
  arb_min(to, to, p + 3L * n, precision);
  arf_neg_inf(bound);
  arb_set(curvature, g + 2L * n);
  for (int i = 0; i < n; i++) {
    raise_to(e, bound, g + i, 1);
    arb_union(curvature, curvature, g + 2L * n + i, precision);
  }
  arf_add(least, e->low, e->close, precision, ARF_RND_FLOOR);
  arb_get_mag(most, curvature);
  arb_get_mag_lower(twice, curvature);
  mag_mul_2exp_si(twice, twice, 1);
  const bool even = mag_cmp(most, twice) <= 0 && !mag_is_zero(most); /* within a factor of 2, so of one sign */
  const known_sign slope = bernstein_side(g + n, n - 1);
  if (arf_cmp(bound, e->low) <= 0) return; /* the maximum is not on this piece */
  if (slope != SIDE_BOTH) attained_at(e, p, slope == SIDE_POSITIVE ? to : from);
  else if (even && arb_is_negative(curvature)) concave(e, p, from, to, curvature);
  else if (even) {
    attained_at(e, p, from);
    attained_at(e, p, to);
  } else if (level == DEPTH || ++e->parts > PARTS || arf_cmp(bound, least) <= 0) {
    arf_max(e->high, e->high, bound);
  } else {
    const double middle = 0.5 * (a + b);
    for (int d = 0; d < 3; d++) bernstein_halve(g + d * n, below + d * n, g + d * n, n - 1, precision);
    bound_on(e, p, level + 1, a, middle);
    _arb_vec_swap(below, g, 3L * n);
    bound_on(e, p, level + 1, middle, b);
  }
}

/* The largest value, from the pieces and e->low, values that are attained. */
static void find_largest(extremum *e, arb_t value)
{
  const int n = e->o->degree + 1;
  LOCAL(mag) none = {0};
  for (int i = 0; i < e->n; i++) {
    for (int d = 0; d < 3; d++)
      bernstein(e->coefficients + d * n, e->pieces[i] + d * n, n - 1, n - 1, none, e->o->precision);
    bound_on(e, e->pieces[i], 0, 0, 1);
  }
  arf_max(e->high, e->high, e->low); /* if no piece exceeds attained values */
  arb_set_interval_arf(value, e->low, e->high, e->o->precision);
  if (e->sign < 0) arb_neg(value, value);
}

/* Adds the substep to the pieces, unless the function stays below values attained elsewhere. rows: the response and its
 * two derivatives; x, rest: its polynomial; work: [2][degree + 1] */
static void consider(extremum *e, const walk *w, arb_srcptr rows, arb_srcptr x, const mag_t rest, arb_ptr work)
{
  const orbit *o = e->o;
  const int n = o->degree + 1, rough = ROUGH < w->degree ? ROUGH : w->degree;
  LOCAL(mag) slack = {0};
  LOCAL(arb) unit = {0};
  LOCAL(arf) bound = {0};
  arb_set_si(unit, e->sign);
  _arb_vec_scalar_mul(work, x, w->degree + 1, unit, o->precision);
  raise_to(e, e->low, work, -1); /* a substep starts inside the segment */
  bernstein(work + n, work, w->degree, rough, rest, o->precision);
  arf_neg_inf(bound);
  for (int i = 0; i <= rough; i++) raise_to(e, bound, work + n + i, 1);
  if (arf_cmp(bound, e->low) <= 0) return;
  arb_ptr p = e->pieces[e->n++] = pool_balls(&e->pool, 3L * n + 1);
  arb_set(p + 3L * n, w->end);
  for (int d = 0; d < 3; d++) { /* derivatives by s in [0, 1] on the substep */
    arb_ptr derivative = p + d * n;
    walk_polynomial(w, rows + d * o->largest, derivative, slack);
    arb_add_error_mag(derivative, slack);
    arb_pow_ui(unit, w->width, (ulong)d, o->precision);
    arb_mul_si(unit, unit, e->sign, o->precision);
    _arb_vec_scalar_mul(derivative, derivative, w->degree + 1, unit, o->precision);
  }
}

/* ---- mean and harmonic 1 ---- */

/* Adds the substep's part to the integrals over the motion of x, x cos omega t, x sin omega t: with x = sum x_i s^i its
 * moments are m_j = sum x_i end^(i + j + 1)/(i + j + 1), and the integral of x cos is sum c_j m_j, with a truncation of
 * at most |x - p| + |p| |cos - c|. power: [2 degree + 2] end^(k + 1)/(k + 1) */
static void integrate(arb_ptr integral, const walk *w, arb_srcptr x, const mag_t rest, arb_ptr power)
{
  const slong p = w->o->precision;
  LOCAL(pool) own = {0};
  arb_ptr part = pool_balls(own, 3), moment = pool_balls(own, 1);
  LOCAL(mag) error = {0}, term = {0}, truncated = {0};
  if (w->k == 0 || w->k == w->steps - 1) {
    arb_one(moment);
    for (int k = 0; k < 2 * w->degree + 2; k++) {
      arb_mul(moment, moment, w->end, p);
      arb_div_ui(power + k, moment, (ulong)k + 1, p);
    }
  }
  for (int j = 0; j <= w->degree; j++) {
    arb_srcptr wave = w->series + (slong)j * w->s->size + w->o->first_harmonic;
    arb_dot(moment, NULL, 0, x, 1, power + j, 1, w->degree + 1, p);
    if (j == 0) arb_set(part, moment);
    arb_addmul(part + 1, wave, moment, p);
    arb_addmul(part + 2, wave + 1, moment, p);
    arb_get_mag(term, x + j);
    mag_add(error, error, term);
  }
  /* |cos - c|, |sin - s| <= (omega width)^(degree + 1)/(degree + 1)! */
  arb_mul(moment, w->o->omega, w->width, p);
  arb_get_mag(term, moment);
  mag_pow_ui(truncated, term, (ulong)w->degree + 1);
  mag_rfac_ui(term, (ulong)w->degree + 1);
  mag_mul(truncated, truncated, term);
  for (int i = 0; i < 3; i++) {
    arb_add_error_mag(part + i, rest);
    if (i == 1) mag_mul(error, error, truncated);
    if (i > 0) arb_add_error_mag(part + i, error);
    arb_addmul(integral + i, part + i, w->width, p);
  }
}

/* ---- all of them ---- */

bool response_quantities(const orbit *o, quantities *q, failure *f)
{
  const slong p = o->precision, n = o->degree + 1, coefficients = 3 * n * (DEPTH + 2);
  extremum extrema[2] = {{.o = o, .sign = 1}, {.o = o, .sign = -1}};
  LOCAL(pool) own = {0};
  arb_ptr rows = pool_balls(own, 3L * o->largest), x = pool_balls(own, n), work = pool_balls(own, 2 * n),
          power = pool_balls(own, 2 * n), integral = pool_balls(own, 3);
  LOCAL(arb) value = {0};
  LOCAL(mag) rest = {0};
  size_t steps = 0;
  for (int i = 0; i < o->m; i++) steps += (size_t)1 << o->segments[i].levels;
  for (int i = 0; i < o->n; i++) arb_set_fmpq(rows + i, o->c->response + i, p);
  for (int side = 0; side < 2; side++) {
    extremum *e = &extrema[side];
    arf_neg_inf(e->low);
    arf_neg_inf(e->high);
    e->coefficients = pool_balls(&e->pool, coefficients);
    e->pieces = pool_take(&e->pool, POOL_BYTES, steps * sizeof *e->pieces);
    for (int i = 0; i < o->m; i++) { /* values at events are attained: they exclude most substeps */
      arb_dot(value, NULL, 0, rows, 1, orbit_event(o, i), 1, o->n, p);
      if (side) arb_neg(value, value);
      raise_to(e, e->low, value, -1);
    }
  }
  for (int i = 0; i < o->m; i++) {
    const orbit_segment *s = &o->segments[i];
    walk w;
    _arb_vec_zero(rows + o->n, 3L * o->largest - o->n);
    _arb_vec_set(rows + o->largest + o->n, rows, o->n); /* velocity, acceleration */
    for (int r = 0; r < o->n; r++)
      _arb_vec_scalar_addmul(rows + 2L * o->largest, arb_mat_entry(s->a, o->n + r, 0), s->size, rows + r, p);
    walk_start(&w, o, i);
    while (walk_next(&w)) {
      walk_polynomial(&w, rows, x, rest);
      for (int side = 0; side < 2; side++) consider(&extrema[side], &w, rows, x, rest, work);
      integrate(integral, &w, x, rest, power);
    }
    walk_end(&w);
  }
  /* close: a small part of the range */
  arf_add(extrema[0].close, extrema[0].low, extrema[1].low, p, ARF_RND_FLOOR);
  arf_abs(extrema[0].close, extrema[0].close);
  arf_mul_2exp_si(extrema[0].close, extrema[0].close, -(p - 20));
  arf_set(extrema[1].close, extrema[0].close);
  for (int side = 0; side < 2; side++) {
    extremum *e = &extrema[side];
    find_largest(e, q->value[side ? CLAIM_MIN : CLAIM_MAX]);
    pool_clear(&e->pool);
    arf_clear(e->low);
    arf_clear(e->high);
    arf_clear(e->close);
  }
  arb_sub(q->value[CLAIM_AMPLITUDE], q->value[CLAIM_MAX], q->value[CLAIM_MIN], p);
  arb_mul_2exp_si(q->value[CLAIM_AMPLITUDE], q->value[CLAIM_AMPLITUDE], -1);
  for (int i = 0; i < 3; i++) {
    if (i > 0) arb_mul_2exp_si(integral + i, integral + i, 1);
    arb_div(q->value[CLAIM_MEAN + i], integral + i, o->duration, p);
  }
  arb_mul(value, q->value[CLAIM_A1], q->value[CLAIM_A1], p);
  arb_addmul(value, q->value[CLAIM_B1], q->value[CLAIM_B1], p);
  arb_sqrtpos(q->value[CLAIM_HARMONIC_1], value, p);
  q->known = true;
  for (int c = CLAIM_MAX; c <= CLAIM_HARMONIC_1; c++) q->known = q->known && arb_is_finite(q->value[c]);
  return q->known || refute(f, -1, -1, "the precision does not suffice");
}
