/* existence.c - the shooting equations F(y) = 0, their derivative, and Krawczyk's test. */
#include "proof/orbit.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- F and dF/dy ---- */

/* Sets entry *at; entries are allocated in the first call only, since the pattern is the same for every box. Several
 * entries for one position are summed. */
static void put(jacobian *d, int *at, int column, const arb_t value)
{
  if (!d) return;
  if (*at == d->room) {
    d->room = d->room ? 2 * d->room : 256;
    d->column = flint_realloc(d->column, (size_t)d->room * sizeof *d->column);
    d->value = flint_realloc(d->value, (size_t)d->room * sizeof *d->value);
    for (int i = *at; i < d->room; i++) arb_init(d->value + i);
  }
  d->column[*at] = column;
  arb_set(d->value + *at, value);
  if (++*at > d->n) d->n = *at;
}

/* Entries of factor d w/d x in the columns of the event where the stick of a contact began. */
static void put_slider(const orbit *o, const orbit_segment *s, int contact, const arb_t factor, jacobian *d, int *at)
{
  arb_ptr gradient = o->scratch;
  if (!d || s->began[contact] < 0) return; /* a slider that sticks all period is a constant */
  slider_line(o, contact, s->from[contact], gradient);
  for (int c = 0; c < o->n; c++) {
    arb_mul(gradient + c, gradient + c, factor, o->precision);
    put(d, at, s->began[contact] * (2 * o->n + 1) + c, gradient + c);
  }
}

/* The guard of event i, which is 0 when the letter of its contact changes. */
static void guard_equation(const orbit *o, int i, arb_t f, jacobian *d, int *at)
{
  const orbit_segment *s = &o->segments[(i + o->m - 1) % o->m]; /* the segment that ends here, whose sliders still
                                                                   stick */
  const int j = orbit_guarded(o, i), n = o->n;
  const char before = orbit_letter(o, i - 1, j), after = orbit_letter(o, i, j);
  const guard kind = guard_of(before, after);
  arb_ptr row = o->scratch + s->size, z = row + s->size;
  if (kind == GUARD_TOUCH) row_gap(o, s, j, 1, row);                    /* any <-> O: n.x + gap = 0                  */
  else if (kind == GUARD_SLIP) row_limit(o, s, j, sign_of(after), row); /* S -> s: mu N - s kt (t.x - w) = 0          */
  else row_slip(o, s, j, sign_of(before), row);                         /* s -> S: s kt t.v - mu kn n.v = 0           */
  _arb_vec_set(z, s->start, s->size);
  _arb_vec_set(z, orbit_event(o, i), 2 * n);
  if (f) arb_dot(f, NULL, 0, row, 1, z, 1, s->size, o->precision);
  for (int c = 0; c < 2 * n; c++)
    if (!arb_is_zero(row + c)) put(d, at, i * (2 * n + 1) + c, row + c);
  if (kind == GUARD_SLIP) put_slider(o, s, j, row + s->slider[j], d, at);
}

bool shooting_equations(orbit *o, arb_ptr f, jacobian *d)
{
  const int n = o->n, stride = 2 * n + 1;
  const slong p = o->precision;
  LOCAL(pool) own = {0};
  arb_ptr end = pool_balls(own, (slong)o->largest * (2 * n + o->contacts + 3)), rate = end + o->largest,
          columns = rate + 2 * o->largest;
  LOCAL(arb) entry = {0};
  int at = 0;
  bool fine = true;
  for (int i = 0; i < o->m && fine; i++) {
    const orbit_segment *s = &o->segments[i];
    const int next = (i + 1) % o->m;
    arb_ptr start_rate = rate + o->largest;
    fine = flow_end(o, i, end, d ? columns : NULL);
    if (!fine) break;
    flow_apply(o, s, end, rate);
    flow_apply(o, s, s->start, start_rate);
    for (int r = 0; r < 2 * n; r++) {
      if (f) arb_sub(f + i * stride + r, end + r, orbit_event(o, next) + r, p);
      if (!d) continue;
      d->row[i * stride + r] = at;
      for (int c = 0; c < 2 * n; c++) put(d, &at, i * stride + c, columns + c * s->size + r); /* exp(A tau) */
      arb_set_si(entry, -1);
      put(d, &at, next * stride + r, entry);
      for (int j = 0; j < o->contacts; j++)
        if (s->slider[j] >= 0)
          put_slider(o, s, j, columns + (s->slider[j] - 1 - 2 * o->harmonics) * s->size + r, d, &at);
      if (o->c->section) continue;
      /* t_i: exp(A tau) (dZ/dt_i - A Z) = -exp(A tau) (v, v'), since the loads move as A says. t_(i+1): A Z(end). */
      arb_dot(entry, NULL, 1, columns + r, s->size, start_rate, 1, 2 * n, p);
      put(d, &at, i * stride + 2 * n, entry);
      put(d, &at, next * stride + 2 * n, rate + r);
    }
    if (o->c->section) continue;
    if (d) d->row[i * stride + 2 * n] = at;
    guard_equation(o, i, f ? f + i * stride + 2 * n : NULL, d, &at);
  }
  if (d) d->row[o->unknowns] = at;
  return fine;
}

void box_set(orbit *o, mag_srcptr radius)
{
  _arb_vec_set(o->box, o->centre, (slong)o->m * (2 * o->n + 1));
  for (int c = 0; c < o->unknowns && radius; c++) arb_add_error_mag(o->box + c, radius + c);
  orbit_starts(o);
}

/* ---- Krawczyk ---- */

/* Kind of an unknown, in the order of an event: 0 for x, 1 for v, 2 for t. */
static int kind_of(const orbit *o, int unknown) { return unknown % (2 * o->n + 1) / o->n; }

/* defect: sum over c of |I - B middle|_rc scale_c; shift: |B F|_r. The first in long double, since it is most of the
 * work: a sum of k products, each of them and each partial sum rounded once, is off by no more than (k + 2) epsilon
 * times the sum of their absolute values. */
void existence_measure(krawczyk *k)
{
  const orbit *o = k->o;
  const jacobian *d = &k->derivative;
  const int n = o->unknowns;
  LOCAL(pool) own = {0};
  long double *row = pool_take(own, POOL_BYTES, (size_t)n * sizeof *row);
  double *size = pool_take(own, POOL_BYTES, (size_t)n * sizeof *size); /* sums of absolute values, accurate to 1e-9 */
  arb_ptr inverse = pool_balls(own, n);
  LOCAL(arb) sum = {0};
  LOCAL(mag) entry = {0}, scale = {0};
  for (int r = 0; r < n; r++) {
    const double *b = k->inverse + (size_t)r * n;
    long double total[3] = {DBL_MIN, DBL_MIN, DBL_MIN}; /* covers all underflow below LDBL_MIN */
    for (int c = 0; c < n; c++) row[c] = size[c] = c == r;
    for (int c = 0; c < n; c++) {
      arb_set_d(inverse + c, b[c]);
      for (int e = d->row[c]; e < d->row[c + 1] && b[c] != 0; e++) {
        row[d->column[e]] -= (long double)b[c] * k->middle[e];
        size[d->column[e]] += fabs(b[c] * k->middle[e]);
      }
    }
    for (int c = 0; c < n; c++) total[kind_of(o, c)] += fabsl(row[c]) + (n + 5) * LDBL_EPSILON * size[c];
    mag_zero(k->defect + r);
    for (int kind = 0; kind < 3; kind++) { /* 1e-15: rounding of these sums and to double */
      mag_set_d(entry, (double)(total[kind] * (1 + 1e-15L)));
      arb_get_mag(scale, o->scale + kind * o->n);
      mag_addmul(k->defect + r, entry, scale);
    }
    arb_dot(sum, NULL, 0, inverse, 1, k->value, 1, n, o->precision);
    arb_get_mag(k->shift + r, sum);
  }
}

bool existence_prepare(krawczyk *k, orbit *o, const double *inverse, failure *f)
{
  const size_t n = (size_t)o->unknowns;
  jacobian *d = &k->derivative;
  if (!k->o) {
    d->row = pool_take(&k->pool, POOL_BYTES, (n + 1) * sizeof *d->row);
    k->inverse = pool_take(&k->pool, POOL_BYTES, n * n * sizeof *k->inverse);
    k->value = pool_balls(&k->pool, o->unknowns);
    k->defect = pool_mags(&k->pool, o->unknowns);
    k->shift = pool_mags(&k->pool, o->unknowns);
    k->image = pool_mags(&k->pool, o->unknowns);
  }
  k->o = o;
  box_set(o, NULL);
  bool fine = shooting_equations(o, k->value, d);
  k->middle = flint_realloc(k->middle, ((size_t)d->n + 1) * sizeof *k->middle);
  for (int e = 0; e < d->n; e++) k->middle[e] = arf_get_d(arb_midref(d->value + e), ARF_RND_NEAR);
  if (inverse && inverse != k->inverse) memcpy(k->inverse, inverse, n * n * sizeof *inverse);
  fine = fine && (inverse || guess_inverse(k));
  return fine || refute(f, -1, -1, "the shooting equations are singular");
}

bool existence_holds(krawczyk *k, const arb_t radius, double *ratio)
{
  orbit *o = k->o;
  const jacobian *d = &k->derivative;
  const int n = o->unknowns;
  LOCAL(pool) own = {0};
  mag_ptr half = pool_mags(own, 2L * n), spread = half + n;
  LOCAL(mag) entry = {0};
  LOCAL(arb) bound = {0};
  for (int c = 0; c < n; c++) {
    arb_mul(bound, radius, o->scale + kind_of(o, c) * o->n, o->precision);
    arb_get_mag(half + c, bound); /* rounded up */
  }
  box_set(o, half);
  *ratio = INFINITY;
  if (!shooting_equations(o, NULL, &k->derivative)) return false;
  /* spread_r = sum over c of |dF/dy(Y) - middle|_rc radius scale_c */
  for (int r = 0; r < n; r++)
    for (int e = d->row[r]; e < d->row[r + 1]; e++) {
      arb_set_d(bound, k->middle[e]);
      arb_sub(bound, d->value + e, bound, o->precision);
      arb_get_mag(entry, bound);
      mag_addmul(spread + r, entry, half + d->column[e]);
    }
  bool holds = true;
  *ratio = 0;
  for (int r = 0; r < n; r++) {
    /* |B F(y0)| + |I - B dF/dy(Y)| radius scale < radius scale: Y has exactly one zero, which lies in the image. */
    mag_set(k->image + r, k->shift + r);
    arb_get_mag(entry, radius);
    mag_addmul(k->image + r, k->defect + r, entry);
    for (int c = 0; c < n; c++) {
      mag_set_d(entry, fabs(k->inverse[(size_t)r * n + c]));
      mag_addmul(k->image + r, entry, spread + c);
    }
    arb_mul(bound, radius, o->scale + kind_of(o, r) * o->n, o->precision);
    arb_get_mag_lower(entry, bound);
    holds = holds && mag_cmp(k->image + r, entry) < 0;
    const double share = mag_get_d(k->image + r) / mag_get_d(entry);
    *ratio = share > *ratio || isnan(share) ? share : *ratio;
  }
  return holds;
}

void existence_free(krawczyk *k)
{
  for (int i = 0; i < k->derivative.room; i++) arb_clear(k->derivative.value + i);
  flint_free(k->derivative.column);
  flint_free(k->derivative.value);
  flint_free(k->middle);
  pool_clear(&k->pool);
}
