/* complete.c - Newton in extended precision, the radii that pass, approximate eigenvectors, and claims wide enough for
 * a checker with wider enclosures. The certificate is then read and decided like any other. */
#include "proof/around/complete.h"
#include "numerics/base/number.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NEWTON_STEPS = 60, WIDE_DIGITS = 40, MULTIPLIER_WIDTHS = 8 };
static const double ROOM = 0.001, NEAR = 1e-8, FAR = 1e-3;

/* Decimal digits of an event's numbers relative to the scales, from the precision less the growth over a period. */
static slong digits_of(slong precision)
{
  const slong digits = (slong)((double)(precision - 45) * 0.30103);
  return digits > 8 ? digits : 8;
}

/* ---- defaults of a candidate ---- */

/* A copy in which numbers are decimal strings, except the integers in counts[]. */
static json_t *as_strings(json_t *json)
{
  static const char *const counts[] = {"harmonic", "multiple", "precision_bits", "section"};
  const char *key;
  json_t *value;
  char text[NUMBER_TEXT];
  if (json_is_number(json)) {
    const double number = json_number_value(json);
    return json_string(isfinite(number) ? number_write(number, text) : "nan");
  }
  if (json_is_array(json)) {
    json_t *list = json_array();
    for (size_t i = 0; i < json_array_size(json); i++) json_array_append_new(list, as_strings(json_array_get(json, i)));
    return list;
  }
  if (!json_is_object(json)) return json_deep_copy(json);
  json_t *object = json_object();
  json_object_foreach(json, key, value)
  {
    bool count = false;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) count = count || strcmp(key, counts[i]) == 0;
    json_object_set_new(object, key, count ? json_deep_copy(value) : as_strings(value));
  }
  return object;
}

/* The largest number of a list of decimal strings. */
static double largest_of(const json_t *list)
{
  double largest = 0;
  for (size_t i = 0; i < json_array_size(list); i++) {
    const char *text = json_string_value(json_array_get(list, i));
    largest = fmax(largest, text ? fabs(strtod(text, NULL)) : 0);
  }
  return largest;
}

static void set_default(json_t *draft, const char *key, json_t *value)
{
  if (!json_object_get(draft, key)) json_object_set(draft, key, value);
  json_decref(value);
}

static void set_defaults(json_t *draft, int precision)
{
  const char *omega = json_string_value(json_object_get(draft, "omega"));
  json_t *response = json_array(), *scales = json_object(), *event;
  double size[] = {0, 0, 1 / strtod(omega ? omega : "1", NULL)};
  size_t i;
  char text[40];
  for (i = 0; i < json_array_size(json_object_get(json_object_get(draft, "model"), "mass")); i++)
    json_array_append_new(response, json_string(i ? "0" : "1"));
  json_array_foreach(json_object_get(draft, "events"), i, event)
  {
    size[0] = fmax(size[0], largest_of(json_object_get(event, "x")));
    size[1] = fmax(size[1], largest_of(json_object_get(event, "v")));
  }
  if (!(size[0] > 0) && !(size[1] > 0)) size[0] = 1;
  size[0] = fmax(size[0], 1e-3 * size[1] * size[2]); /* at a section x or v may be 0 */
  size[1] = fmax(size[1], 1e-3 * size[0] / size[2]);
  for (i = 0; i < 3; i++) {
    snprintf(text, sizeof text, "%.2e", size[i]);
    json_object_set_new(scales, (const char *[]){"x", "v", "t"}[i], json_string(text));
  }
  set_default(draft, "multiple", json_integer(1));
  set_default(draft, "precision_bits", json_integer(precision ? precision : 128));
  set_default(draft, "rest", json_object());
  set_default(draft, "response", response);
  set_default(draft, "scales", scales);
}

/* ---- the parts of a certificate ---- */

static double near_double(const arb_t x) { return arf_get_d(arb_midref(x), ARF_RND_NEAR); }

/* The largest part <= 1 of Newton's step that changes no segment's duration by more than half. step: [unknowns] */
static double damping(const orbit *o, const double *step)
{
  const int stride = 2 * o->n + 1;
  double share = 1;
  LOCAL(arb) tau = {0};
  for (int i = 0; i < o->m && !o->c->section; i++) {
    flow_duration(o, i, tau);
    const double change = step[i * stride + 2 * o->n] - step[(i + 1) % o->m * stride + 2 * o->n];
    share = fmin(share, 0.5 * near_double(tau) / fabs(change));
  }
  return share;
}

/* Newton, y -= B F(y), until the step relative to the scales is rounding. */
static bool refine(krawczyk *k, orbit *o, double most_work, failure *f)
{
  const int n = o->unknowns, stride = 2 * o->n + 1;
  const double enough = pow(10, -(double)digits_of(o->precision) - 4);
  LOCAL(pool) own = {0};
  double *value = pool_take(own, POOL_BYTES, 2 * (size_t)n * sizeof *value), *step = value + n;
  LOCAL(arb) y = {0};
  double last = INFINITY, largest = INFINITY, work = 0;
  bool fine = existence_prepare(k, o, NULL, f);
  for (int i = 0; i < NEWTON_STEPS && fine; i++) {
    if (i > 0) {
      box_set(o, NULL);
      const bool near = i == 1 ? largest < NEAR : largest <= 1e-3 * last; /* one B serves all steps near the solution */
      if (largest > FAR && !flow_prepare(o, f)) return false;
      if (!near && (work += pow(n, 3)) > most_work) return refute(f, -1, -1, "Newton takes too much work");
      fine = near ? shooting_equations(o, k->value, NULL) : existence_prepare(k, o, NULL, f);
      if (!fine) break;
    }
    for (int c = 0; c < n; c++) value[c] = near_double(k->value + c);
    for (int r = 0; r < n; r++) {
      step[r] = 0;
      for (int c = 0; c < n; c++) step[r] += k->inverse[(size_t)r * n + c] * value[c];
    }
    const double share = damping(o, step);
    last = largest;
    largest = 0;
    for (int r = 0; r < n; r++) {
      arb_set_d(y, share * step[r]);
      arb_sub(o->centre + r, o->centre + r, y, o->precision);
      arb_get_mid_arb(o->centre + r, o->centre + r);
      largest = fmax(largest, fabs(share * step[r]) / near_double(o->scale + r % stride));
    }
    if (largest <= enough || (largest < 100 * enough && largest > 0.5 * last)) break;
  }
  if (!fine || !(largest < 1e4 * enough))
    return refute(f, -1, -1, "Newton does not converge: its last step was %.1e of the scales", largest);
  return true;
}

/* Writes the events' numbers as decimals, and sets the centre to exactly these. */
static void write_events(json_t *draft, orbit *o)
{
  const slong digits = digits_of(o->precision);
  const int n = o->n;
  LOCAL(fmpq) exact = {0};
  for (int i = 0; i < o->m; i++) {
    json_t *event = json_array_get(json_object_get(draft, "events"), (size_t)i),
           *lists[] = {json_array(), json_array()};
    for (int c = 0; c < 2 * n + 1; c++) {
      arb_ptr y = o->centre + (slong)i * (2 * n + 1) + c;
      if (c == 2 * n && o->c->section) continue;
      char *text = decimal_write(arb_midref(y), decimal_place(arb_midref(o->scale + c), 0) - digits - 1, 0);
      decimal_read(text, strlen(text), exact);
      arb_set_fmpq(y, exact, o->precision);
      if (c < 2 * n) json_array_append_new(lists[c / n], json_string(text));
      else json_object_set_new(event, "t", json_string(text));
      free(text);
    }
    json_object_set_new(event, "x", lists[0]);
    json_object_set_new(event, "v", lists[1]);
  }
}

static bool holds_at(krawczyk *k, slong power, double *ratio)
{
  LOCAL(arb) radius = {0};
  arb_set_ui(radius, 10);
  arb_pow_fmpz(radius, radius, (fmpz[]){power}, k->o->precision);
  return existence_holds(k, radius, ratio);
}

/* Finds the radii, powers of ten: the smallest, about 8 |B F|, and the largest that passes with ratio < ROOM, for
 * another checker's wider balls. The box is then that of the smallest. */
static bool find_radii(krawczyk *k, json_t *claims, failure *f)
{
  const orbit *o = k->o;
  double largest = 0, ratio = INFINITY;
  char text[40];
  for (int r = 0; r < o->unknowns; r++)
    largest = fmax(largest, mag_get_d(k->shift + r) / near_double(o->scale + r % (2 * o->n + 1)));
  slong smallest = largest > 0 ? (slong)ceil(log10(8 * largest)) : -digits_of(o->precision), fails = 1;
  for (const slong last = smallest + 8; !holds_at(k, smallest, &ratio);)
    if (++smallest >= last || smallest >= 1)
      return refute(f, -1, -1, "existence: Krawczyk gives %.2g of the radius", ratio);
  slong best = smallest;
  while (best < 0 && fails - best > 1) { /* 10^0 passes if F is linear */
    const slong middle = fails == 1 ? 0 : (best + fails) / 2 - ((best + fails) % 2 < 0);
    if (holds_at(k, middle, &ratio) && ratio < ROOM) best = middle;
    else fails = middle;
  }
  holds_at(k, smallest, &ratio);
  snprintf(text, sizeof text, "1e%ld", (long)smallest);
  json_object_set_new(claims, "radius", json_string(text));
  snprintf(text, sizeof text, "1e%ld", (long)best);
  json_object_set_new(claims, "uniqueness_radius", json_string(text));
  return true;
}

/* Approximate eigenvectors of the monodromy matrix, to `digits` digits. */
static void write_vectors(json_t *draft, const orbit *o, slong digits)
{
  failure unused = {0};
  LOCAL(arb_mat) m = {0};
  LOCAL(acb_mat) a = {0}, v = {0};
  const int n = monodromy(o, m, &unused);
  acb_ptr values = _acb_vec_init(n);
  json_t *rows = json_array();
  acb_mat_init(a, n, n);
  acb_mat_init(v, n, n);
  acb_mat_set_arb_mat(a, m);
  acb_mat_get_mid(a, a);
  acb_mat_approx_eig_qr(values, NULL, v, a, NULL, 0, o->precision);
  for (int i = 0; i < n; i++) {
    json_t *row = json_array();
    for (int j = 0; j < n; j++) {
      char *re = decimal_write(arb_midref(acb_realref(acb_mat_entry(v, i, j))), -digits, 0);
      char *im = decimal_write(arb_midref(acb_imagref(acb_mat_entry(v, i, j))), -digits, 0);
      json_array_append_new(row, json_pack("[s, s]", re, im));
      free(re);
      free(im);
    }
    json_array_append_new(rows, row);
  }
  json_object_set_new(draft, "vectors", rows);
  _acb_vec_clear(values, n);
}

/* The largest sum over a substep of the radii of the response's Taylor coefficients, for the box. */
static void response_spread(const orbit *o, mag_t spread)
{
  LOCAL(pool) own = {0};
  arb_ptr row = pool_balls(own, o->largest), polynomial = pool_balls(own, o->degree + 1);
  LOCAL(mag) sum = {0}, term = {0};
  for (int i = 0; i < o->n; i++) arb_set_fmpq(row + i, o->c->response + i, o->precision);
  for (int i = 0; i < o->m; i++) {
    walk w;
    walk_start(&w, o, i);
    while (walk_next(&w)) {
      walk_polynomial(&w, row, polynomial, sum);
      for (int j = 0; j <= w.degree; j++) {
        arb_get_mag(term, polynomial + j);
        mag_mul_ui(term, term, (ulong)j);
        mag_addmul(sum, term, arb_radref(w.end)); /* of the last, whose length is a ball */
        mag_add(sum, sum, arb_radref(polynomial + j));
      }
      mag_max(spread, spread, sum);
    }
    walk_end(&w);
  }
}

/* Claims wide enough for check.py's enclosures, too. Its interval and this program's both contain the true value, so
 * this one, widened by the width of the other, contains both. check.py bounds ranges to first order: for an extremum at
 * most 4 times the sum of the radii on a substep, less for mean and harmonic 1; and its box is within `radius`, for
 * which `spread` was computed. For the multiplier both use discs of the same matrix, check.py with every entry's
 * rounding as large as the largest: up to 4 times as wide in 500 structures; allowed are MULTIPLIER_WIDTHS and 16
 * radii. */
static void write_claims(json_t *claims, const certificate *c, const quantities *q, const mag_t spread)
{
  LOCAL(arb) radius = {0};
  arb_set_fmpq(radius, c->radius, c->precision);
  for (int i = 0; i < CLAIMS; i++) {
    LOCAL(mag) pad = {0};
    if (!(i == CLAIM_MULTIPLIER ? q->multiplier_known : q->known)) continue;
    if (i == CLAIM_MULTIPLIER) arb_get_mag(pad, radius);
    mag_mul_2exp_si(pad, i == CLAIM_MULTIPLIER ? pad : spread, i == CLAIM_MULTIPLIER ? 4 : 2);
    for (int k = 0; k < 2 * (i == CLAIM_MULTIPLIER ? MULTIPLIER_WIDTHS : 1); k++)
      mag_add(pad, pad, arb_radref(q->value[i]));
    json_object_set_new(claims, claim_names[i], decimal_interval(q->value[i], pad, c->precision));
  }
  json_object_set_new(claims, "stability", json_string(stability_names[q->stability]));
}

/* ---- all of it ---- */

/* Completes the draft to the certificate *made, at first with claims of radii only, decides it, and adds the other
 * claims; false: none, reason in *v. */
static bool make(json_t *draft, const certificate *c, double most_work, certificate **made, decision *v, char *why,
                 size_t size)
{
  static const slong digits[] = {17, WIDE_DIGITS};
  krawczyk k = {0};
  LOCAL(mag) spread = {0};
  json_t *claims = json_object();
  orbit *o = orbit_new(c, &v->failure);
  bool fine = o && flow_prepare(o, &v->failure) && refine(&k, o, most_work, &v->failure);
  if (fine) write_events(draft, o);
  else json_object_del(draft, "events"); /* no certificate */
  fine = fine && existence_prepare(&k, o, k.inverse, &v->failure);
  if (fine) existence_measure(&k);
  fine = fine && find_radii(&k, claims, &v->failure);
  if (fine) response_spread(o, spread);
  json_object_set_new(draft, "claims", claims);
  for (int attempt = 0; attempt < 2 && fine; attempt++) {
    write_vectors(draft, o, digits[attempt]);
    certificate_free(*made);
    if (!(*made = certificate_read(draft, false, why, size))) break;
    decision_clear(v);
    decision_init(v);
    if (!prove(*made, k.inverse, v) || v->quantities.stability != STABILITY_UNPROVEN) break;
  }
  if (*made && !v->failure.reason[0]) write_claims(claims, *made, &v->quantities, spread);
  existence_free(&k);
  orbit_free(o);
  return fine;
}

json_t *complete(json_t *candidate, int precision, double most_work)
{
  char why[256] = "";
  decision v;
  decision_init(&v);
  json_t *draft = as_strings(candidate), *answer = NULL;
  json_object_del(draft, "claims");
  json_object_del(draft, "vectors");
  json_object_del(draft, "id");
  if (json_is_object(draft)) set_defaults(draft, precision);
  certificate *c = certificate_read(draft, true, why, sizeof why), *made = NULL;
  if (c && make(draft, c, most_work, &made, &v, why, sizeof why)) answer = answer_json(made, &v, made ? NULL : why);
  else answer = answer_json(c, &v, c ? NULL : why);
  const bool whole = c && json_object_get(draft, "events");
  json_object_set(answer, "certificate", whole ? draft : json_null());
  json_t *id = json_object_get(candidate, "id");
  if (id) json_object_set(answer, "id", id);
  json_decref(draft);
  certificate_free(made);
  certificate_free(c);
  decision_clear(&v);
  return answer;
}
