/* flow.c - Z(t) = exp(A t) Z(0), in balls: Taylor series over the nonzero ranges of rows, a remainder bound by the
 * norm, squarings. */
#include "proof/orbit.h"
#include <math.h>

enum {
  LIMIT_STEPS = 1 << 15,   /* most substeps of all segments */
  LIMIT_WORK = 1 << 26,    /* most of substeps times size^2 (precision/128)^2 */
  LIMIT_ENTRIES = 1 << 22, /* most entries of all exponentials */
  LIMIT_TERMS = 600,
  REACH = 1, /* log2 of the bound of |A| step */
  FAR = 4,   /* the same for |A| duration > 2^STIFF */
  STIFF = 13
};

/* ---- Taylor series ---- */

/* Truncation error of the series of exp(A h) of this degree, relative to the norm of its operand:
 *     |A h|^(degree + 1) / (degree + 1)! exp |A h| */
static void remainder_bound(mag_t rest, const mag_t norm, int degree)
{
  LOCAL(mag) growth = {0};
  mag_exp(growth, norm);
  mag_pow_ui(rest, norm, (ulong)degree + 1);
  mag_mul(rest, rest, growth);
  mag_rfac_ui(growth, (ulong)degree + 1);
  mag_mul(rest, rest, growth);
}

/* The smallest degree with a truncation error below 2^-bits; at most LIMIT_TERMS. */
static int degree_for(const mag_t norm, slong bits)
{
  int degree = 1;
  LOCAL(mag) rest = {0};
  do remainder_bound(rest, norm, ++degree);
  while (mag_cmp_2exp_si(rest, -bits) > 0 && degree < LIMIT_TERMS);
  return degree;
}

static void norm_of(mag_t norm, const orbit_segment *s, arb_srcptr z)
{
  LOCAL(mag) entry = {0};
  mag_zero(norm);
  for (int i = 0; i < s->size; i++) {
    arb_get_mag(entry, z + i);
    mag_mul_2exp_si(entry, entry, -s->weight[i]);
    mag_max(norm, norm, entry);
  }
}

/* Adds to every component the bound that a vector of this norm implies, except to constants, whose rows of A are empty:
 * their series is exact. */
static void add_rest(const orbit_segment *s, arb_ptr z, const mag_t norm)
{
  LOCAL(mag) entry = {0};
  for (int i = 0; i < s->size; i++) {
    mag_mul_2exp_si(entry, norm, s->weight[i]);
    if (s->length[i]) arb_add_error_mag(z + i, entry);
  }
}

void flow_apply(const orbit *o, const orbit_segment *s, arb_srcptr z, arb_ptr derivative)
{
  for (int i = 0; i < o->n; i++) arb_set(derivative + i, z + o->n + i);
  for (int i = o->n; i < s->size; i++)
    arb_dot(derivative + i, NULL, 0, arb_mat_entry(s->a, i, s->first[i]), 1, z + s->first[i], 1, s->length[i],
            o->precision);
}

/* z[columns][size] becomes exp(A h) z; norm: |A| |h| */
static void exponential(const orbit *o, const orbit_segment *s, const arb_t h, const mag_t norm, arb_ptr z, int columns)
{
  const int size = s->size, degree = degree_for(norm, o->precision + 8);
  LOCAL(pool) own = {0};
  arb_ptr term = pool_balls(own, 2L * size), next = term + size;
  LOCAL(arb) factor = {0};
  LOCAL(mag) rest = {0}, whole = {0};
  for (int c = 0; c < columns; c++, z += size) {
    norm_of(whole, s, z);
    _arb_vec_set(term, z, size);
    for (int k = 1; k <= degree; k++) {
      flow_apply(o, s, term, next);
      arb_div_ui(factor, h, (ulong)k, o->precision);
      _arb_vec_scalar_mul(term, next, size, factor, o->precision);
      _arb_vec_add(z, z, term, size, o->precision);
    }
    remainder_bound(rest, norm, degree);
    mag_mul(rest, rest, whole);
    add_rest(s, z, rest);
  }
}

/* ---- segments ---- */

void flow_duration(const orbit *o, int i, arb_t tau)
{
  LOCAL(arb) from = {0};
  orbit_time(o, i, from);
  orbit_time(o, i + 1, tau);
  if (o->c->section) arb_set(tau, o->duration); /* the time of a section is fixed */
  else arb_sub(tau, tau, from, o->precision);
}

/* Chooses a power of two substeps with |A| step <= 2^reach. */
static bool choose_steps(orbit *o, int i, failure *f, long *steps, double *work, double *entries)
{
  orbit_segment *s = &o->segments[i];
  LOCAL(mag) norm = {0};
  flow_duration(o, i, s->span);
  bool fine = arb_is_finite(s->span) && arb_is_positive(s->span);
  if (!fine) refute(f, i, -1, "times not in order: segment %d", i);
  arb_get_mid_arb(s->span, s->span);
  arf_get_mag(norm, arb_midref(s->span));
  mag_mul(norm, norm, s->norm);
  int reach = REACH;
  if (mag_cmp_2exp_si(norm, STIFF) > 0)
    reach = FAR; /* stiff: the motion itself is slow, and longer series are cheaper */
  for (s->levels = 0; fine && mag_cmp_2exp_si(norm, s->levels + reach) > 0;)
    if (1L << ++s->levels > LIMIT_STEPS) break;
  if (reach > o->reach) o->reach = reach;
  *steps += 1L << s->levels;
  *work += pow(2, s->levels) * pow((double)s->size * (double)o->precision / 128, 2);
  *entries += (s->levels + 1.0) * s->size * s->size;
  if (fine && (*steps > LIMIT_STEPS || *work > LIMIT_WORK || *entries > LIMIT_ENTRIES))
    fine = refute(f, i, -1, "too stiff: more substeps than %d, or too large for so many", LIMIT_STEPS);
  arb_mul_2exp_si(s->step, s->span, -s->levels);
  return fine;
}

bool flow_prepare(orbit *o, failure *f)
{
  long steps = 0;
  double work = 0, entries = 0;
  LOCAL(mag) norm = {0};
  for (int i = 0; i < o->m; i++)
    if (!choose_steps(o, i, f, &steps, &work, &entries)) return false;
  mag_set_ui(norm, 1ul << o->reach);
  o->degree = degree_for(norm, o->precision - 20);
  LOCAL(pool) own = {0};
  arb_ptr columns = pool_balls(own, (slong)o->largest * o->largest);
  for (int i = 0; i < o->m; i++) {
    orbit_segment *s = &o->segments[i];
    const int size = s->size;
    s->power = pool_take(&o->pool, POOL_MATRICES, (size_t)s->levels + 1);
    for (int b = 0; b <= s->levels; b++) arb_mat_init(s->power + b, size, size);
    _arb_vec_zero(columns, (slong)size * size);
    for (int c = 0; c < size; c++) arb_one(columns + c * size + c);
    arb_get_mag(norm, s->step);
    mag_mul(norm, norm, s->norm);
    exponential(o, s, s->step, norm, columns, size);
    for (int r = 0; r < size; r++)
      for (int c = 0; c < size; c++) arb_set(arb_mat_entry(s->power, r, c), columns + c * size + r);
    for (int b = 1; b <= s->levels; b++) arb_mat_sqr(s->power + b, s->power + b - 1, o->precision);
  }
  return true;
}

/* z = exp(A (tau - span)) z, columns of z: [columns][size]. */
static bool correct(const orbit *o, const orbit_segment *s, const arb_t tau, arb_ptr z, int columns)
{
  LOCAL(arb) h = {0};
  LOCAL(mag) norm = {0};
  arb_sub(h, tau, s->span, o->precision);
  arb_get_mag(norm, h);
  mag_mul(norm, norm, s->norm);
  const bool small = mag_cmp_2exp_si(norm, 4) < 0;
  if (small) exponential(o, s, h, norm, z, columns);
  return small;
}

static void times_vector(arb_ptr to, const arb_mat_t m, arb_srcptr z, slong precision)
{
  const slong n = arb_mat_ncols(m);
  for (slong r = 0; r < arb_mat_nrows(m); r++) arb_dot(to + r, NULL, 0, arb_mat_entry(m, r, 0), 1, z, 1, n, precision);
}

bool flow_end(const orbit *o, int i, arb_ptr end, arb_ptr columns)
{
  const orbit_segment *s = &o->segments[i];
  const int sliders = 2 * o->n + 1 + 2 * o->harmonics;
  LOCAL(arb) tau = {0};
  flow_duration(o, i, tau);
  times_vector(end, s->power + s->levels, s->start, o->precision);
  bool fine = correct(o, s, tau, end, 1);
  if (columns && fine) {
    int count = 0;
    for (int c = 0; c < s->size; c++) {
      if (c >= 2 * o->n && c < sliders) continue;
      for (int r = 0; r < s->size; r++)
        arb_set(columns + count * s->size + r, arb_mat_entry(s->power + s->levels, r, c));
      count++;
    }
    fine = correct(o, s, tau, columns, count);
  }
  return fine;
}

/* ---- substeps ---- */

static void walk_width(walk *w, const arb_t width)
{
  LOCAL(mag) norm = {0};
  arb_set(w->width, width);
  arb_get_mag(norm, width);
  mag_mul(norm, norm, w->s->norm);
  w->degree = degree_for(norm, w->o->precision - 20);
  if (w->degree > w->o->degree) w->degree = w->o->degree;
  remainder_bound(w->rest, norm, w->degree);
  for (int j = 0; j < w->degree; j++) arb_div_ui(w->factor + j, width, (ulong)j + 1, w->o->precision);
}

void walk_start(walk *w, const orbit *o, int i)
{
  const orbit_segment *s = &o->segments[i];
  *w = (walk){.o = o, .s = s, .steps = 1L << s->levels, .k = -1};
  w->at = pool_balls(&w->pool, (s->levels + 1L) * s->size);
  w->series = pool_balls(&w->pool, (o->degree + 1L) * s->size);
  w->factor = pool_balls(&w->pool, o->degree + 2L);
  w->width = w->factor + o->degree;
  w->end = w->width + 1;
  w->rest = pool_mags(&w->pool, 1);
  walk_width(w, s->step);
  arb_one(w->end);
}

/* Number of trailing zero bits of a substep's index: the slot of its Z in w->at. */
static int trailing(const walk *w, long k)
{
  int bits = 0;
  while (bits < w->s->levels && !(k >> bits & 1)) bits++;
  return bits;
}

bool walk_next(walk *w)
{
  const orbit *o = w->o;
  const orbit_segment *s = w->s;
  const int size = s->size;
  if (++w->k == w->steps) return false;
  /* Z at k from Z at k without its lowest bit: no ball is multiplied more than log2(steps) times. */
  const int slot = trailing(w, w->k);
  arb_ptr z = w->at + (slong)slot * size;
  if (w->k == 0) _arb_vec_set(z, s->start, size);
  else times_vector(z, s->power + slot, w->at + (slong)trailing(w, w->k & (w->k - 1)) * size, o->precision);
  if (w->k == w->steps - 1) { /* the last substep: as long as the segment may last */
    LOCAL(arb) left = {0}, length = {0};
    flow_duration(o, (int)(s - o->segments), left);
    arb_mul_si(length, s->step, w->k, o->precision);
    arb_sub(left, left, length, o->precision);
    arb_get_ubound_arf(arb_midref(length), left, o->precision);
    mag_zero(arb_radref(length));
    walk_width(w, length);
    arb_div(w->end, left, length, o->precision);
  }
  _arb_vec_set(w->series, z, size);
  for (int j = 0; j < w->degree; j++) {
    arb_ptr next = w->series + (j + 1L) * size;
    flow_apply(o, s, next - size, next);
    _arb_vec_scalar_mul(next, next, size, w->factor + j, o->precision);
  }
  return true;
}

void walk_end(walk *w) { pool_clear(&w->pool); }

void walk_polynomial(const walk *w, arb_srcptr row, arb_ptr polynomial, mag_t rest)
{
  const int size = w->s->size;
  LOCAL(mag) entry = {0};
  int first = 0, last = size;
  while (first < size && arb_is_zero(row + first)) first++;
  while (last > first && arb_is_zero(row + last - 1)) last--;
  for (int j = 0; j <= w->degree; j++)
    arb_dot(polynomial + j, NULL, 0, row + first, 1, w->series + (slong)j * size + first, 1, last - first,
            w->o->precision);
  /* |row rest| <= sum |row_i| 2^weight_i times the rest's norm, which is relative to the norm of Z */
  mag_zero(rest);
  for (int i = first; i < last; i++) {
    arb_get_mag(entry, row + i);
    mag_mul_2exp_si(entry, entry, w->s->weight[i]);
    if (w->s->length[i]) mag_add(rest, rest, entry);
  }
  norm_of(entry, w->s, w->series);
  mag_mul(rest, rest, entry);
  mag_mul(rest, rest, w->rest);
}

/* ---- polynomials on [0, 1] ---- */

void bernstein(arb_ptr b, arb_srcptr polynomial, int full, int degree, const mag_t rest, slong precision)
{
  LOCAL(mag) error = {0}, term = {0};
  mag_set(error, rest);
  for (int k = degree + 1; k <= full; k++) {
    arb_get_mag(term, polynomial + k);
    mag_add(error, error, term);
  }
  /* b_i = sum over k <= i of binomial(i, k) / binomial(degree, k) c_k, by repeated sums */
  LOCAL(fmpz) binomial = {0};
  fmpz_one(binomial);
  for (int k = 0; k <= degree; k++) {
    arb_div_fmpz(b + k, polynomial + k, binomial, precision);
    fmpz_mul_ui(binomial, binomial, (ulong)(degree - k));
    fmpz_divexact_ui(binomial, binomial, (ulong)k + 1);
  }
  for (int round = 1; round <= degree; round++)
    for (int i = degree; i >= round; i--) arb_add(b + i, b + i, b + i - 1, precision);
  for (int i = 0; i <= degree; i++) arb_add_error_mag(b + i, error);
}

/* de Casteljau at 1/2; `left` may be b itself. */
void bernstein_halve(arb_srcptr b, arb_ptr left, arb_ptr right, int degree, slong precision)
{
  if (right != b) _arb_vec_set(right, b, degree + 1);
  for (int round = 0; round <= degree; round++) {
    arb_set(left + round, right);
    for (int i = 0; i < degree - round; i++) {
      arb_add(right + i, right + i, right + i + 1, precision);
      arb_mul_2exp_si(right + i, right + i, -1);
    }
  }
}

known_sign bernstein_side(arb_srcptr b, int degree)
{
  bool positive = true, negative = true;
  for (int i = 0; i <= degree; i++) {
    positive = positive && arb_is_positive(b + i);
    negative = negative && arb_is_negative(b + i);
  }
  return positive ? SIDE_POSITIVE : negative ? SIDE_NEGATIVE : SIDE_BOTH;
}
