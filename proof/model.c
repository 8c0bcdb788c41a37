/* model.c - all that depends on the model and the letters only: the matrix A of every segment, the linear functions for
 * guards and conditions, and the rejection of sequences that the theorem does not cover. */
#include "proof/orbit.h"
#include <stdarg.h>

bool refute(failure *f, int segment, int contact, const char *format, ...)
{
  va_list args;
  if (f->reason[0]) return false;
  va_start(args, format);
  vsnprintf(f->reason, sizeof f->reason, format, args);
  va_end(args);
  f->segment = segment;
  f->contact = contact;
  return false;
}

static void balls(arb_ptr to, const fmpq *from, slong n, slong precision)
{
  for (slong i = 0; i < n; i++) arb_set_fmpq(to + i, from + i, precision);
}

/* ---- contacts ---- */

/* True if a[n] = ratio b[n] exactly and b is not 0. */
static bool proportional(const fmpq *a, const fmpq *b, int n, fmpq_t ratio)
{
  int pivot = 0;
  while (pivot < n && fmpq_is_zero(b + pivot)) pivot++;
  if (pivot == n) return false;
  fmpq_div(ratio, a + pivot, b + pivot);
  bool all = true;
  LOCAL(fmpq) product = {0};
  for (int i = 0; i < n; i++) {
    fmpq_mul(product, ratio, b + i);
    all = all && fmpq_equal(product, a + i);
  }
  return all;
}

static void contact_set(orbit *o, contact_balls *f, const contact_given *k, const fmpq *rest)
{
  const int n = o->n;
  const slong precision = o->precision;
  LOCAL(fmpq) ratio = {0};
  f->t = pool_balls(&o->pool, 2L * n + CONTACT_NUMBERS + 2);
  f->n = f->t + n, f->kt = f->n + n + 1, f->mu = f->kt + 1, f->kn = f->mu + 1, f->gap = f->kn + 1, f->load = f->gap + 1;
  f->rest = f->load + 1, f->ratio = f->rest + 1;
  balls(f->t, k->t, 2L * n + CONTACT_NUMBERS, precision); /* t, n and the numbers in the certificate's order */
  arb_set_fmpq(f->rest, rest, precision);
  f->parallel = k->angled; /* u and v are proportional by construction, whatever the cosine is */
  if (k->angled) {
    LOCAL(arb) sine = {0}, cosine = {0};
    fmpq_set_ui(ratio, 180, 1);
    fmpq_div(ratio, k->angle, ratio);
    arb_sin_cos_pi_fmpq(sine, cosine, ratio, precision);
    _arb_vec_scalar_mul(f->t, f->t, n, cosine, precision);
    _arb_vec_scalar_mul(f->n, f->n, n, sine, precision);
    arb_div(f->ratio, cosine, sine, precision);
  } else if (k->tangential && k->normal && proportional(k->t, k->n, n, ratio)) {
    arb_set_fmpq(f->ratio, ratio, precision);
    f->parallel = true;
  }
}

/* ---- rows ---- */

void row_gap(const orbit *o, const orbit_segment *s, int contact, int sign, arb_ptr row)
{
  const contact_balls *f = &o->friction[contact];
  _arb_vec_zero(row, s->size);
  _arb_vec_set(row, f->n, o->n);
  arb_set(row + 2 * o->n, f->gap);
  if (sign < 0) _arb_vec_neg(row, row, s->size);
}

/* N of a closed contact: kn (n.x + gap), or the constant load */
static void row_load(const orbit *o, const orbit_segment *s, int contact, arb_ptr row)
{
  const contact_balls *f = &o->friction[contact];
  row_gap(o, s, contact, 1, row);
  if (o->c->contacts[contact].normal) _arb_vec_scalar_mul(row, row, s->size, f->kn, o->precision);
  else arb_set(row + 2 * o->n, f->load);
}

/* T: in stick kt (t.x - w), in slip sign mu N */
static void row_traction(const orbit *o, const orbit_segment *s, int contact, arb_ptr row)
{
  const contact_balls *f = &o->friction[contact];
  if (s->slider[contact] < 0) {
    row_load(o, s, contact, row);
    _arb_vec_scalar_mul(row, row, s->size, f->mu, o->precision);
    if (sign_of(s->letters[contact]) < 0) _arb_vec_neg(row, row, s->size);
    return;
  }
  _arb_vec_zero(row, s->size);
  _arb_vec_scalar_mul(row, f->t, o->n, f->kt, o->precision);
  arb_neg(row + s->slider[contact], f->kt);
}

void row_limit(const orbit *o, const orbit_segment *s, int contact, int sign, arb_ptr row)
{
  arb_ptr traction = o->scratch;
  row_load(o, s, contact, row);
  _arb_vec_scalar_mul(row, row, s->size, o->friction[contact].mu, o->precision);
  row_traction(o, s, contact, traction);
  if (sign > 0) _arb_vec_neg(traction, traction, s->size);
  _arb_vec_add(row, row, traction, s->size, o->precision);
}

void row_slip(const orbit *o, const orbit_segment *s, int contact, int sign, arb_ptr row)
{
  _arb_vec_zero(row, s->size);
  slider_line(o, contact, sign > 0 ? '+' : '-', row + o->n); /* sign kt (t.v - sign mu kn n.v/kt) */
  arb_zero(row + 2 * o->n);
  _arb_vec_scalar_mul(row + o->n, row + o->n, o->n, o->friction[contact].kt, o->precision);
  if (sign < 0) _arb_vec_neg(row, row, s->size);
}

void slider_line(const orbit *o, int contact, char before, arb_ptr line)
{
  const contact_balls *f = &o->friction[contact];
  const bool normal = o->c->contacts[contact].normal;
  LOCAL(arb) factor = {0};
  _arb_vec_set(line, f->t, o->n);
  arb_zero(line + o->n);
  if (before == 'O') return;
  arb_div(factor, f->mu, f->kt, o->precision);
  arb_mul(factor, factor, normal ? f->kn : f->load, o->precision);
  if (sign_of(before) > 0) arb_neg(factor, factor);
  if (normal) _arb_vec_scalar_addmul(line, f->n, o->n, factor, o->precision);
  if (normal) arb_mul(line + o->n, factor, f->gap, o->precision);
  else arb_set(line + o->n, factor);
}

/* ---- the matrix of a segment ---- */

/* Rows v of A before the mass: -K x - C v - sum [ t T + n (N - N0) ] + loads. row: [size] */
static void forces(const orbit *o, const orbit_segment *s, arb_mat_t r, arb_ptr row)
{
  const certificate *c = o->c;
  const int n = o->n;
  const slong p = o->precision;
  LOCAL(arb) load = {0};
  for (int i = 0; i < n; i++) {
    balls(arb_mat_entry(r, i, 0), c->stiffness + (slong)i * n, n, p);
    balls(arb_mat_entry(r, i, n), c->damping + (slong)i * n, n, p);
  }
  for (int j = 0; j < o->contacts; j++) {
    const contact_balls *f = &o->friction[j];
    const bool closed = s->letters[j] != 'O';
    if (c->contacts[j].normal) {
      _arb_vec_zero(row, s->size);
      if (closed) row_load(o, s, j, row);
      if (fmpq_sgn(c->contacts[j].gap) > 0) arb_submul(row + 2 * n, f->kn, f->gap, p); /* N0 = max(kn gap, 0) */
      for (int i = 0; i < n; i++) _arb_vec_scalar_addmul(arb_mat_entry(r, i, 0), row, s->size, f->n + i, p);
    }
    if (!closed || !c->contacts[j].tangential) continue;
    row_traction(o, s, j, row);
    for (int i = 0; i < n; i++) _arb_vec_scalar_addmul(arb_mat_entry(r, i, 0), row, s->size, f->t + i, p);
  }
  arb_mat_neg(r, r);
  for (int h = 0; h < c->n_harmonics; h++)
    for (int i = 0; i < n; i++) {
      arb_ptr place = arb_mat_entry(r, i, o->load_column[h]);
      arb_set_fmpq(load, c->cosine + (slong)h * n + i, p);
      arb_add(place, place, load, p);
      if (c->harmonic[h] > 0) arb_set_fmpq(place + 1, c->sine + (slong)h * n + i, p);
    }
}

/* The nonzero range of each row, and the norm. */
static void measure_rows(orbit_segment *s)
{
  LOCAL(mag) sum = {0}, entry = {0};
  for (int r = 0; r < s->size; r++) {
    int first = 0, last = s->size;
    while (last > 0 && arb_is_zero(arb_mat_entry(s->a, r, last - 1))) last--;
    while (first < last && arb_is_zero(arb_mat_entry(s->a, r, first))) first++;
    s->first[r] = first;
    s->length[r] = last - first;
    mag_zero(sum);
    for (int j = first; j < last; j++) {
      arb_get_mag(entry, arb_mat_entry(s->a, r, j));
      mag_mul_2exp_si(entry, entry, s->weight[j] - s->weight[r]);
      mag_add(sum, sum, entry);
    }
    mag_max(s->norm, s->norm, sum);
  }
}

static void segment_set(orbit *o, int i)
{
  orbit_segment *s = &o->segments[i];
  const int n = o->n;
  s->letters = o->c->letters + (size_t)i * (size_t)o->contacts;
  s->size = 2 * n + 1 + 2 * o->harmonics;
  s->state = 2 * n;
  for (int j = 0; j < o->contacts; j++) {
    s->slider[j] = s->began[j] = s->place[j] = -1;
    if (s->letters[j] != 'S') continue;
    s->slider[j] = s->size++;
    for (int e = i; e > i - o->m && s->began[j] < 0; e--) {
      s->from[j] = orbit_letter(o, e - 1, j);
      if (s->from[j] != 'S') s->began[j] = (e + o->m) % o->m;
    }
    const bool fixed = s->began[j] < 0 || (o->friction[j].parallel && s->from[j] == 'O'); /* then u is fixed by
                                                                                             touching */
    if (!fixed) s->place[j] = s->state++;
  }
  if (s->size > o->largest) o->largest = s->size;
  s->a = pool_take(&o->pool, POOL_MATRICES, 1);
  arb_mat_init(s->a, s->size, s->size);
  s->norm = pool_mags(&o->pool, 1);
  s->start = pool_balls(&o->pool, s->size + 2L);
  s->span = s->start + s->size;
  s->step = s->span + 1;
  s->first = pool_take(&o->pool, POOL_BYTES, 2 * (size_t)s->size * sizeof *s->first);
  s->length = s->first + s->size;
  s->weight = pool_take(&o->pool, POOL_BYTES, (size_t)s->size * sizeof *s->weight);
  LOCAL(arb_mat) force = {0}, acceleration = {0};
  arb_mat_init(force, n, s->size);
  arb_mat_init(acceleration, n, s->size);
  forces(o, s, force, s->start);
  arb_mat_mul(acceleration, o->inverse_mass, force, o->precision);
  for (int r = 0; r < n; r++) {
    arb_one(arb_mat_entry(s->a, r, n + r));
    _arb_vec_set(arb_mat_entry(s->a, n + r, 0), arb_mat_entry(acceleration, r, 0), s->size);
  }
  for (int h = 0; h < o->harmonics; h++) {
    const int cosine = 2 * n + 1 + 2 * h, sine = cosine + 1;
    arb_mul_si(arb_mat_entry(s->a, sine, cosine), o->omega, o->harmonic[h], o->precision);
    arb_neg(arb_mat_entry(s->a, cosine, sine), arb_mat_entry(s->a, sine, cosine));
  }
  guess_weights(o, s);
  measure_rows(s);
}

/* ---- sequences that the theorem covers ---- */

guard guard_of(char before, char after)
{
  return before == 'O' || after == 'O' ? GUARD_TOUCH : before == 'S' ? GUARD_SLIP : GUARD_STICK;
}

int orbit_guarded(const orbit *o, int i)
{
  for (int j = 0; j < o->contacts; j++)
    if (orbit_letter(o, i - 1, j) != orbit_letter(o, i, j)) return j;
  return -1;
}

/* True if two contacts and their histories are equal. */
static bool twins(const orbit *o, int a, int b)
{
  const contact_given *k = &o->c->contacts[a], *l = &o->c->contacts[b];
  bool equal = k->angled == l->angled && k->normal == l->normal && fmpq_equal(o->c->rest + a, o->c->rest + b);
  for (int i = 0; i < 2 * o->n + CONTACT_NUMBERS; i++) equal = equal && fmpq_equal(k->t + i, l->t + i);
  for (int i = 0; i < o->m; i++) equal = equal && orbit_letter(o, i, a) == orbit_letter(o, i, b);
  return equal;
}

/* The row [coordinates + 1] of a touch or stick guard, exact up to a factor: n.x + gap, or s kt t.v - mu kn n.v. false:
 * that factor may be 0. */
static bool guard_shape(const orbit *o, int contact, guard kind, int sign, fmpq *shape)
{
  const contact_given *k = &o->c->contacts[contact];
  const contact_balls *f = &o->friction[contact];
  LOCAL(fmpq) along = {0}, across = {0};
  LOCAL(arb) factor = {0};
  fmpq_set_si(along, 0, 1);
  fmpq_set_si(across, 1, 1);
  arb_one(factor);
  if (kind == GUARD_TOUCH) fmpq_set(shape + o->n, k->gap);
  else if (k->angled) { /* (sign kt cos - mu kn sin) d */ arb_mul(factor, f->kt, f->ratio, o->precision);
    if (sign < 0) arb_neg(factor, factor);
    arb_submul(factor, f->mu, f->kn, o->precision);
  } else {
    fmpq_mul_si(along, k->kt, sign);
    fmpq_mul(across, k->mu, k->kn);
    fmpq_neg(across, across);
  }
  for (int i = 0; i < o->n; i++) {
    fmpq_mul(shape + i, along, k->t + i);
    fmpq_addmul(shape + i, across, k->n + i);
  }
  return !arb_contains_zero(factor);
}

/* True if contacts a and b may change at one event: their guards are exactly proportional, and F has one of them. */
static bool changes_together(const orbit *o, int event, int a, int b)
{
  const contact_given *k = &o->c->contacts[a], *l = &o->c->contacts[b];
  const char before_a = orbit_letter(o, event - 1, a), before_b = orbit_letter(o, event - 1, b);
  const guard kind = guard_of(before_a, orbit_letter(o, event, a));
  const bool gapless = fmpq_is_zero(k->gap) && fmpq_is_zero(l->gap), one_angle = fmpq_equal(k->angle, l->angle);
  if (kind != guard_of(before_b, orbit_letter(o, event, b))) return false;
  if (twins(o, a, b)) return true;
  if (kind == GUARD_SLIP || (kind == GUARD_TOUCH && !gapless && !one_angle)) return false;
  LOCAL(pool) own = {0};
  LOCAL(fmpq) ratio = {0};
  fmpq *shapes = pool_rationals(own, 2L * (o->n + 1));
  return guard_shape(o, a, kind, sign_of(before_a), shapes) &&
         guard_shape(o, b, kind, sign_of(before_b), shapes + o->n + 1) &&
         proportional(shapes, shapes + o->n + 1, o->n + 1, ratio) && !fmpq_is_zero(ratio);
}

static bool sequence_possible(const orbit *o, failure *f)
{
  for (int i = 0; i < o->m && !o->c->section; i++) {
    const int guarded = orbit_guarded(o, i);
    const orbit_segment *s = &o->segments[(i + o->m - 1) % o->m];
    for (int j = 0; j < o->contacts; j++) {
      const char before = orbit_letter(o, i - 1, j), after = orbit_letter(o, i, j);
      if (before == after) continue;
      if (sign_of(before) * sign_of(after) < 0)
        return refute(f, i, j, "segment %d, contact %d: slip does not turn without stick", i, j);
      /* Stick -> O: |T| <= mu N, so T and N would vanish at once, which is generic only where they are proportional. */
      if (before == 'S' && after == 'O' && (!o->friction[j].parallel || s->from[j] != 'O'))
        return refute(f, i, j, "segment %d, contact %d: stick ends by separation where motions are not proportional", i,
                      j);
      if (j != guarded && !changes_together(o, i, guarded, j))
        return refute(f, i, j, "two independent transitions at once: event %d, contacts %d and %d", i, guarded, j);
    }
  }
  return true;
}

/* ---- the orbit ---- */

void orbit_time(const orbit *o, int event, arb_t t)
{
  arb_set(t, orbit_event(o, event) + 2 * o->n);
  if (event == o->m) arb_add(t, t, o->duration, o->precision);
}

void orbit_starts(orbit *o)
{
  const int n = o->n;
  const slong p = o->precision;
  LOCAL(arb) angle = {0};
  for (int i = 0; i < o->m; i++) {
    orbit_segment *s = &o->segments[i];
    arb_srcptr event = orbit_event(o, i);
    _arb_vec_set(s->start, event, 2 * n);
    arb_one(s->start + 2 * n);
    for (int h = 0; h < o->harmonics; h++) {
      arb_mul(angle, o->omega, event + 2 * n, p);
      arb_mul_si(angle, angle, o->harmonic[h], p);
      arb_sin_cos(s->start + 2 * n + 2 + 2 * h, s->start + 2 * n + 1 + 2 * h, angle, p);
    }
    for (int j = 0; j < o->contacts; j++) {
      if (s->slider[j] < 0) continue;
      arb_ptr w = s->start + s->slider[j];
      arb_set(w, o->friction[j].rest);
      if (s->began[j] < 0) continue;
      slider_line(o, j, s->from[j], o->scratch);
      arb_dot(w, o->scratch + n, 0, o->scratch, 1, orbit_event(o, s->began[j]), 1, n, p);
    }
  }
}

/* Harmonics of Z: those of the loads, and 1, for a1 and b1. */
static void choose_harmonics(orbit *o)
{
  const certificate *c = o->c;
  const int constant = 2 * o->n;
  for (int h = 0; h < c->n_harmonics; h++) {
    o->load_column[h] = c->harmonic[h] > 0 ? constant + 1 + 2 * o->harmonics : constant;
    if (c->harmonic[h] == 1) o->first_harmonic = o->load_column[h];
    if (c->harmonic[h] > 0) o->harmonic[o->harmonics++] = c->harmonic[h];
  }
  if (o->first_harmonic) return;
  o->first_harmonic = constant + 1 + 2 * o->harmonics;
  o->harmonic[o->harmonics++] = 1;
}

orbit *orbit_new(const certificate *c, failure *f)
{
  orbit *o = flint_calloc(1, sizeof *o);
  const int n = c->n, stride = 2 * n + 1;
  const slong p = c->precision;
  o->c = c;
  o->precision = p;
  o->n = n;
  o->m = c->n_events;
  o->contacts = c->n_contacts;
  o->unknowns = c->section ? 2 * n : o->m * stride;
  o->centre = pool_balls(&o->pool, (slong)o->m * stride);
  o->box = pool_balls(&o->pool, (slong)o->m * stride);
  o->scale = pool_balls(&o->pool, stride);
  o->omega = pool_balls(&o->pool, 2);
  o->duration = o->omega + 1;
  arb_set_fmpq(o->omega, c->omega, p);
  arb_const_pi(o->duration, p);
  arb_mul_si(o->duration, o->duration, 2L * c->multiple, p);
  arb_div(o->duration, o->duration, o->omega, p);
  for (int i = 0; i < o->m; i++) {
    balls(o->centre + (slong)i * stride, c->state + 2L * i * n, 2L * n, p);
    balls(o->centre + (slong)i * stride + 2 * n, c->time + i, 1, p);
  }
  _arb_vec_set(o->box, o->centre, (slong)o->m * stride);
  for (int i = 0; i < stride; i++) arb_set_fmpq(o->scale + i, c->scales[i / n], p);
  choose_harmonics(o);
  o->scratch = pool_balls(&o->pool, 4L * (stride + 2 * o->harmonics + o->contacts));
  o->friction = pool_take(&o->pool, POOL_BYTES, (size_t)o->contacts * sizeof *o->friction);
  for (int j = 0; j < o->contacts; j++) contact_set(o, &o->friction[j], &c->contacts[j], c->rest + j);
  LOCAL(arb_mat) mass = {0};
  o->inverse_mass = pool_take(&o->pool, POOL_MATRICES, 1);
  arb_mat_init(mass, n, n);
  arb_mat_init(o->inverse_mass, n, n);
  for (int i = 0; i < n; i++) balls(arb_mat_entry(mass, i, 0), c->mass + (slong)i * n, n, p);
  const bool regular = arb_mat_inv(o->inverse_mass, mass, p);
  o->segments = pool_take(&o->pool, POOL_BYTES, (size_t)o->m * sizeof *o->segments);
  for (int i = 0; i < o->m; i++) segment_set(o, i);
  if (!regular) refute(f, -1, -1, "the mass matrix is singular");
  if (regular && sequence_possible(o, f)) return o;
  orbit_free(o);
  return NULL;
}

void orbit_free(orbit *o)
{
  if (o) pool_clear(&o->pool);
  flint_free(o);
}
