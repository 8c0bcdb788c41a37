/* quantities.c - bounds of the orbit's amplitude, mean and harmonic 1: of the motion at all times, by its series. */
#include "proof/orbit.h"
#include <math.h>

enum { DEPTH = 60, PARTS = 4000, ROUGH = 12, BISECTIONS = 160 };

/* A substep on which the response may have its maximum: Taylor coefficients of the response and its two derivatives by
 * the place on the substep; the constant term carries the rest. */
typedef struct piece {
  arb_ptr polynomial; /* [3][degree + 1]                     */
  arb_struct end;     /* where the segment ends, at most 1   */
} piece;

typedef struct extremum {
  pool pool;
  const orbit *o;
  int n;
  piece *pieces;
  arf_t low, high;      /* the largest value is between them     */
  arf_t close;          /* what need not be told apart           */
  arb_ptr coefficients; /* [DEPTH + 2][3][degree + 1]         */
  long parts;
} extremum;

/* ---- extrema ---- */

static void attained(extremum *e, const arb_t value)
{
  LOCAL(arf) bound = ZERO;
  arb_get_lbound_arf(bound, value, e->o->precision);
  if (arf_cmp(bound, e->low) > 0) arf_set(e->low, bound);
}

static void not_above(extremum *e, const arb_t value)
{
  LOCAL(arf) bound = ZERO;
  arb_get_ubound_arf(bound, value, e->o->precision);
  if (arf_cmp(bound, e->high) > 0) arf_set(e->high, bound);
}

/* The polynomial at a ball: its value in the middle, and the slope on the ball times what it is wide. */
static void value_at(const extremum *e, const piece *p, const arb_t at, arb_t value)
{
  const int n = e->o->degree + 1;
  const slong precision = e->o->precision;
  LOCAL(arb) middle = ZERO, slope = ZERO;
  arb_get_mid_arb(middle, at);
  _arb_poly_evaluate(value, p->polynomial, n, middle, precision);
  if (!arb_is_exact(at)) {
    _arb_poly_evaluate(slope, p->polynomial + n, n, at, precision);
    LOCAL(mag) wide = ZERO;
    arb_get_mag(wide, slope);
    mag_mul(wide, wide, arb_radref(at));
    arb_add_error_mag(value, wide);
  }
}

static void both(extremum *e, const piece *p, const arb_t at)
{
  LOCAL(arb) value = ZERO;
  value_at(e, p, at, value);
  attained(e, value);
  not_above(e, value);
}

/* The maximum of a concave piece over [a, b]: bisect the slope; where it has no sign, a second-order error is left. */
static void concave(extremum *e, const piece *p, const arb_t a, const arb_t b)
{
  const slong precision = e->o->precision;
  const int n = e->o->degree + 1;
  LOCAL(arb) low = ZERO, high = ZERO, middle = ZERO, slope = ZERO;
  arb_set(low, a);
  arb_set(high, b);
  for (int i = 0; i < BISECTIONS; i++) {
    arb_add(middle, low, high, precision);
    arb_mul_2exp_si(middle, middle, -1);
    arb_get_mid_arb(middle, middle);
    _arb_poly_evaluate(slope, p->polynomial + n, n, middle, precision);
    if (arb_is_positive(slope)) arb_set(low, middle);
    else if (arb_is_negative(slope)) arb_set(high, middle);
    else break;
  }
  /* No sign at the middle: close in on it from both sides while there is one. */
  for (int i = 0; i < BISECTIONS; i++) {
    LOCAL(arb) quarter = ZERO;
    bool moved = false;
    for (int side = 0; side < 2; side++) {
      arb_add(quarter, side ? high : low, middle, precision);
      arb_mul_2exp_si(quarter, quarter, -1);
      arb_get_mid_arb(quarter, quarter);
      _arb_poly_evaluate(slope, p->polynomial + n, n, quarter, precision);
      if (!side && arb_is_positive(slope) && arb_gt(quarter, low)) arb_set(low, quarter), moved = true;
      if (side && arb_is_negative(slope) && arb_lt(quarter, high)) arb_set(high, quarter), moved = true;
    }
    if (!moved) break;
  }
  /* Where b is the segment's end, a ball, the maximum may be there. */
  arb_min(low, low, b, precision);
  arb_min(high, high, b, precision);
  arb_union(middle, low, high, precision);
  both(e, p, middle);
}

/* The maximum over [a, b] of the piece; its Bernstein coefficients, and those of two derivatives, stand at `level`. */
static void bound_on(extremum *e, const piece *p, int level, double a, double b)
{
  const int n = e->o->degree + 1, degree = e->o->degree;
  arb_ptr g = e->coefficients + 3L * n * level;
  LOCAL(arf) bound = ZERO, least = ZERO;
  LOCAL(arb) from = ZERO, to = ZERO;
  arb_set_d(from, a);
  arb_set_d(to, b);
  arb_min(from, from, &p->end, e->o->precision); /* never beyond the segment's end, which may be a ball */
  arb_min(to, to, &p->end, e->o->precision);
  arb_get_ubound_arf(bound, g, e->o->precision);
  for (int i = 1; i < n; i++) {
    arb_get_ubound_arf(least, g + i, e->o->precision);
    if (arf_cmp(least, bound) > 0) arf_set(bound, least);
  }
  arf_add(least, e->low, e->close, e->o->precision, ARF_RND_FLOOR);
  const known_sign slope = bernstein_side(g + n, degree), curvature = bernstein_side(g + 2 * n, degree);
  if (arf_cmp(bound, e->low) <= 0) return; /* not here */
  if (slope == SIDE_POSITIVE) both(e, p, to);
  else if (slope == SIDE_NEGATIVE) both(e, p, from);
  else if (curvature == SIDE_NEGATIVE) concave(e, p, from, to);
  else if (curvature == SIDE_POSITIVE) {
    both(e, p, from);
    both(e, p, to);
  } else if (level == DEPTH || ++e->parts > PARTS || arf_cmp(bound, least) <= 0) {
    if (arf_cmp(bound, e->high) > 0) arf_set(e->high, bound);
  } else {
    arb_ptr below = g + 3 * n;
    const double middle = 0.5 * (a + b);
    for (int d = 0; d < 3; d++) bernstein_halve(g + d * n, below + d * n, g + d * n, degree, e->o->precision);
    bound_on(e, p, level + 1, a, middle);
    _arb_vec_swap(below, g, 3 * n);
    bound_on(e, p, level + 1, middle, b);
  }
}

/* The largest value of sign times the response over all pieces, given what is attained. */
static void largest(extremum *e, int sign, arb_t value)
{
  const orbit *o = e->o;
  const int n = o->degree + 1;
  LOCAL(mag) none = ZERO;
  for (int i = 0; i < e->n; i++) {
    const piece *p = &e->pieces[i];
    for (int d = 0; d < 3; d++)
      bernstein(e->coefficients + d * n, p->polynomial + d * n, o->degree, o->degree, none, o->precision);
    bound_on(e, p, 0, 0, 1);
  }
  arf_max(e->high, e->high, e->low); /* where no piece can exceed what is attained */
  arb_set_interval_arf(value, e->low, e->high, o->precision);
  if (sign < 0) arb_neg(value, value);
}

/* Keeps the substep unless the response stays below what is attained elsewhere. */
static void consider(extremum *e, const walk *w, arb_srcptr rows, int sign, arb_ptr polynomial, arb_ptr rough)
{
  const orbit *o = e->o;
  const int n = o->degree + 1;
  LOCAL(mag) rest = ZERO;
  LOCAL(arf) bound = ZERO;
  walk_polynomial(w, rows, polynomial, rest);
  if (sign < 0) _arb_vec_neg(polynomial, polynomial, w->degree + 1);
  attained(e, polynomial); /* a substep starts inside the segment */
  bernstein(rough, polynomial, w->degree, ROUGH < w->degree ? ROUGH : w->degree, rest, o->precision);
  bool above = false;
  for (int i = 0; i <= ROUGH && i <= w->degree; i++) {
    arb_get_ubound_arf(bound, rough + i, o->precision);
    above = above || arf_cmp(bound, e->low) > 0;
  }
  if (above) {
    if ((e->n & (e->n - 1)) == 0)
      e->pieces = flint_realloc(e->pieces, (e->n ? 2 * (size_t)e->n : 1) * sizeof *e->pieces);
    piece *p = &e->pieces[e->n++];
    p->polynomial = pool_balls(&e->pool, 3L * n);
    arb_init(&p->end);
    arb_set(&p->end, w->end);
    _arb_vec_set(p->polynomial, polynomial, w->degree + 1);
    arb_add_error_mag(p->polynomial, rest);
    for (int d = 1; d < 3; d++) { /* derivatives by the place on the substep */
      arb_ptr derivative = p->polynomial + d * n;
      walk_polynomial(w, rows + d * o->largest, derivative, rest);
      arb_add_error_mag(derivative, rest);
      for (int power = 0; power < d; power++)
        _arb_vec_scalar_mul(derivative, derivative, w->degree + 1, w->width, o->precision);
      if (sign < 0) _arb_vec_neg(derivative, derivative, w->degree + 1);
    }
  }
}

/* ---- mean and harmonic 1 ---- */

typedef struct fourier {
  arb_t mean, cosine, sine; /* integrals over the motion of x, x cos omega t, x sin omega t */
  arb_ptr power;            /* [2 degree + 3] end^(k + 1)/(k + 1)                           */
  arb_ptr c, s;             /* [degree + 1]                                                 */
} fourier;

/* Adds the substep's part: with x = sum p_i s^i, its moments are m_j = sum p_i end^(i + j + 1)/(i + j + 1), and the
 * integral of x cos is sum c_j m_j, with a truncation of at most |x - p| + |p| |cos - c|. */
static void integrate(fourier *f, const walk *w, arb_srcptr polynomial, const mag_t rest)
{
  const orbit *o = w->o;
  const slong p = o->precision;
  LOCAL(arb) angle = ZERO, moment = ZERO, cosine = ZERO, sine = ZERO;
  LOCAL(mag) error = ZERO, term = ZERO, truncated = ZERO;
  if (w->k == 0 || w->k == w->steps - 1) {
    arb_one(moment);
    for (int k = 0; k < 2 * w->degree + 2; k++) {
      arb_mul(moment, moment, w->end, p);
      arb_div_ui(f->power + k, moment, (ulong)k + 1, p);
    }
  }
  arb_mul(angle, o->omega, w->width, p);
  arb_get_mag(term, angle);
  arb_set(f->c, w->series + o->first_harmonic);
  arb_set(f->s, w->series + o->first_harmonic + 1);
  int degree = 0;
  do { /* |cos - c|, |sin - s| <= (omega width)^(degree + 1)/(degree + 1)! */
    arb_mul(f->c + degree + 1, f->s + degree, angle, p);
    arb_mul(f->s + degree + 1, f->c + degree, angle, p);
    arb_div_si(f->c + degree + 1, f->c + degree + 1, -(degree + 1), p);
    arb_div_ui(f->s + degree + 1, f->s + degree + 1, (ulong)degree + 1, p);
    degree++;
    mag_pow_ui(truncated, term, (ulong)degree + 1);
    mag_rfac_ui(error, (ulong)degree + 1);
    mag_mul(truncated, truncated, error);
  } while (degree < w->degree && mag_cmp_2exp_si(truncated, 10 - p) > 0);
  for (int j = 0; j <= degree; j++) {
    arb_dot(moment, NULL, 0, polynomial, 1, f->power + j, 1, w->degree + 1, p);
    arb_addmul(cosine, f->c + j, moment, p);
    arb_addmul(sine, f->s + j, moment, p);
    if (j > 0) continue;
    arb_add_error_mag(moment, rest);
    arb_addmul(f->mean, moment, w->width, p);
  }
  mag_zero(error);
  for (int i = 0; i <= w->degree; i++) {
    arb_get_mag(term, polynomial + i);
    mag_add(error, error, term);
  }
  mag_mul(error, error, truncated);
  mag_add(error, error, rest);
  arb_add_error_mag(cosine, error);
  arb_add_error_mag(sine, error);
  arb_addmul(f->cosine, cosine, w->width, p);
  arb_addmul(f->sine, sine, w->width, p);
}

/* ---- all of them ---- */

bool response_quantities(const orbit *o, quantities *q, failure *f)
{
  const slong p = o->precision, n = o->degree + 1, coefficients = 3 * n * (DEPTH + 2);
  extremum extrema[2] = {{.o = o}, {.o = o}};
  fourier integral = {0};
  LOCAL(pool) own = ZERO;
  arb_ptr rows = pool_balls(own, 3L * o->largest + 6 * n + 3), polynomial = rows + 3L * o->largest,
          rough = polynomial + n;
  LOCAL(arb) value = ZERO;
  LOCAL(mag) rest = ZERO;
  integral.c = rough + n;
  integral.s = integral.c + n;
  integral.power = integral.s + n;
  for (int side = 0; side < 2; side++) {
    extremum *e = &extrema[side];
    arf_neg_inf(e->low);
    arf_neg_inf(e->high);
    e->coefficients = pool_balls(&e->pool, coefficients);
  }
  for (int i = 0; i < o->n; i++) arb_set_fmpq(rows + i, o->c->response + i, p);
  for (int i = 0; i < o->m; i++) { /* every event is attained: with these, few substeps need a second look */
    arb_dot(value, NULL, 0, rows, 1, orbit_event(o, i), 1, o->n, p);
    attained(&extrema[0], value);
    arb_neg(value, value);
    attained(&extrema[1], value);
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
      consider(&extrema[0], &w, rows, 1, polynomial, rough);
      consider(&extrema[1], &w, rows, -1, polynomial, rough);
      _arb_vec_zero(polynomial, n);
      walk_polynomial(&w, rows, polynomial, rest);
      integrate(&integral, &w, polynomial, rest);
    }
    walk_end(&w);
  }
  for (int side = 0; side < 2; side++) {
    extremum *e = &extrema[side];
    /* what need not be told apart: a small part of the range */
    arf_add(e->close, extrema[0].low, extrema[1].low, p, ARF_RND_FLOOR);
    arf_abs(e->close, e->close);
    arf_mul_2exp_si(e->close, e->close, -(p - 20));
    largest(e, side ? -1 : 1, q->value[side ? CLAIM_MIN : CLAIM_MAX]);
  }
  arb_sub(q->value[CLAIM_AMPLITUDE], q->value[CLAIM_MAX], q->value[CLAIM_MIN], p);
  arb_mul_2exp_si(q->value[CLAIM_AMPLITUDE], q->value[CLAIM_AMPLITUDE], -1);
  arb_div(q->value[CLAIM_MEAN], integral.mean, o->duration, p);
  arb_mul_2exp_si(integral.cosine, integral.cosine, 1);
  arb_mul_2exp_si(integral.sine, integral.sine, 1);
  arb_div(q->value[CLAIM_A1], integral.cosine, o->duration, p);
  arb_div(q->value[CLAIM_B1], integral.sine, o->duration, p);
  arb_mul(value, q->value[CLAIM_A1], q->value[CLAIM_A1], p);
  arb_addmul(value, q->value[CLAIM_B1], q->value[CLAIM_B1], p);
  arb_sqrtpos(q->value[CLAIM_HARMONIC_1], value, p);
  q->known = true;
  for (int c = CLAIM_MAX; c <= CLAIM_HARMONIC_1; c++) q->known = q->known && arb_is_finite(q->value[c]);
  if (!q->known) refute(f, -1, -1, "the precision does not suffice");
  for (int side = 0; side < 2; side++) {
    extremum *e = &extrema[side];
    for (int i = 0; i < e->n; i++) arb_clear(&e->pieces[i].end);
    flint_free(e->pieces);
    pool_clear(&e->pool);
    arf_clear(e->low);
    arf_clear(e->high);
    arf_clear(e->close);
  }
  arb_clear(integral.mean);
  arb_clear(integral.cosine);
  arb_clear(integral.sine);
  return q->known;
}
