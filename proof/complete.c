/* complete.c - Newton in extended precision, the radii that pass, approximate eigenvectors, and claims that leave room
 * for a checker whose enclosures are wider. The certificate is then read and decided like any other. */
#include "proof/complete.h"
#include "base/number.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NEWTON_STEPS = 60, WIDE_DIGITS = 40 };
static const double ROOM = 0.001, NEAR = 1e-8, FAR = 1e-3;

/* Decimal digits of an event's numbers, of the scales: what the precision leaves for the growth over a period. */
static slong digits_of(slong precision)
{
  const slong digits = (slong)((double)(precision - 45) * 0.30103);
  return digits > 8 ? digits : 8;
}

/* ---- what a candidate may lack ---- */

/* Numbers become strings, everywhere in the value but in integers that are no theorem's numbers. */
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

static double largest_of(const fmpq *values, slong n)
{
  LOCAL(arb) x = ZERO;
  double largest = 0;
  for (slong i = 0; i < n; i++) {
    arb_set_fmpq(x, values + i, 53);
    largest = fmax(largest, fabs(arf_get_d(arb_midref(x), ARF_RND_NEAR)));
  }
  return largest;
}

static void set_defaults(json_t *draft, const certificate *c, int precision)
{
  if (!json_object_get(draft, "multiple")) json_object_set_new(draft, "multiple", json_integer(1));
  if (!json_object_get(draft, "precision_bits"))
    json_object_set_new(draft, "precision_bits", json_integer(precision ? precision : 128));
  if (!json_object_get(draft, "rest")) json_object_set_new(draft, "rest", json_object());
  if (!json_object_get(draft, "response")) {
    json_t *response = json_array();
    for (int i = 0; i < c->n; i++) json_array_append_new(response, json_string(i ? "0" : "1"));
    json_object_set_new(draft, "response", response);
  }
  if (json_object_get(draft, "scales")) return;
  double scales[] = {0, 0, 1 / largest_of(c->omega, 1)};
  for (int i = 0; i < 2 * c->n_events; i++)
    scales[i % 2] = fmax(scales[i % 2], largest_of(c->state + (slong)i * c->n, c->n));
  if (!(scales[0] > 0) && !(scales[1] > 0)) scales[0] = 1;
  scales[0] =
      fmax(scales[0], 1e-3 * scales[1] * scales[2]); /* an orbit may cross its section at rest, or in the middle */
  scales[1] = fmax(scales[1], 1e-3 * scales[0] / scales[2]);
  json_t *object = json_object();
  for (int i = 0; i < 3; i++) {
    char text[40];
    snprintf(text, sizeof text, "%.2e", scales[i]);
    json_object_set_new(object, (const char *[]){"x", "v", "t"}[i], json_string(text));
  }
  json_object_set_new(draft, "scales", object);
}

/* ---- the parts of a certificate ---- */

/* The share of Newton's step by which no segment becomes shorter or longer by more than half. step: [unknowns] */
static double damping(const orbit *o, arb_srcptr step)
{
  const int stride = 2 * o->n + 1;
  double share = 1;
  LOCAL(arb) tau = ZERO, change = ZERO;
  for (int i = 0; i < o->m && !o->c->section; i++) {
    flow_duration(o, i, tau);
    arb_sub(change, step + i * stride + 2 * o->n, step + (i + 1) % o->m * stride + 2 * o->n, o->precision);
    share =
        fmin(share, 0.5 * arf_get_d(arb_midref(tau), ARF_RND_NEAR) / fabs(arf_get_d(arb_midref(change), ARF_RND_NEAR)));
  }
  return share;
}

/* y -= B F(y) until it moves no more; the largest step that remains, relative to the scales. */
static bool refine(krawczyk *k, orbit *o, failure *f)
{
  const int n = o->unknowns, stride = 2 * o->n + 1;
  const double enough = pow(10, -(double)digits_of(o->precision) - 4);
  LOCAL(pool) own = ZERO;
  arb_ptr row = pool_balls(own, 2L * n), step = row + n;
  LOCAL(arb) share = ZERO;
  double last = INFINITY, largest = INFINITY;
  bool fine = existence_prepare(k, o, false, f);
  for (int i = 0; i < NEWTON_STEPS && fine; i++) {
    if (i > 0) {
      box_set(o, NULL);
      const bool near = i == 1 ? largest < NEAR : largest <= 1e-3 * last; /* so that one B does for all steps */
      if (largest > FAR && !flow_prepare(o, f)) return false;
      fine = near ? shooting_equations(o, k->value, NULL) : existence_prepare(k, o, false, f);
      if (!fine) break;
    }
    last = largest;
    largest = 0;
    for (int r = 0; r < n; r++) {
      for (int c = 0; c < n; c++) arb_set_d(row + c, k->inverse[(size_t)r * n + c]);
      arb_dot(step + r, NULL, 0, row, 1, k->value, 1, n, o->precision);
    }
    arb_set_d(share, damping(o, step));
    for (int r = 0; r < n; r++) {
      arb_mul(step + r, step + r, share, o->precision);
      arb_sub(o->centre + r, o->centre + r, step + r, o->precision);
      arb_get_mid_arb(o->centre + r, o->centre + r);
      arb_div(step + r, step + r, o->scale + r % stride, o->precision);
      largest = fmax(largest, fabs(arf_get_d(arb_midref(step + r), ARF_RND_NEAR)));
    }
    if (largest <= enough || (largest < 100 * enough && largest > 0.5 * last)) break;
  }
  if (!fine || !(largest < 1e4 * enough))
    return refute(f, -1, -1, "Newton does not converge: its last step was %.1e of the scales", largest);
  return true;
}

/* The events' numbers as decimals, and the centre at exactly these. */
static void write_events(json_t *draft, orbit *o)
{
  const slong digits = digits_of(o->precision);
  const int n = o->n;
  LOCAL(fmpq) exact = ZERO_FMPQ;
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

/* Powers of ten: the smallest radius, about 8 |B F|, and the largest that passes with room for another checker's balls.
 * Leaves the box at the smallest. */
static bool find_radii(krawczyk *k, json_t *claims, failure *f)
{
  const orbit *o = k->o;
  double largest = 0, ratio = INFINITY;
  LOCAL(arb) radius = ZERO, ten = ZERO;
  char text[40];
  arb_set_ui(ten, 10);
  for (int r = 0; r < o->unknowns; r++)
    largest =
        fmax(largest, mag_get_d(k->shift + r) / arf_get_d(arb_midref(o->scale + r % (2 * o->n + 1)), ARF_RND_NEAR));
  slong smallest = largest > 0 ? (slong)ceil(log10(8 * largest)) : -digits_of(o->precision), best;
  bool holds = false;
  for (const slong last = smallest + 8; smallest < last && smallest < 1; smallest++) {
    arb_pow_fmpz(radius, ten, (fmpz[]){smallest}, o->precision);
    if ((holds = existence_holds(k, radius, &ratio))) break;
  }
  if (holds) {
    slong fails = 1;
    best = smallest;
    while (best < 0 && fails - best > 1) { /* 1 passes where F is linear */
      const slong middle = fails == 1 ? 0 : (best + fails) / 2 - ((best + fails) % 2 < 0);
      arb_pow_fmpz(radius, ten, (fmpz[]){middle}, o->precision);
      if (existence_holds(k, radius, &ratio) && ratio < ROOM) best = middle;
      else fails = middle;
    }
    arb_pow_fmpz(radius, ten, (fmpz[]){smallest}, o->precision);
    existence_holds(k, radius, &ratio);
    snprintf(text, sizeof text, "1e%ld", (long)smallest);
    json_object_set_new(claims, "radius", json_string(text));
    snprintf(text, sizeof text, "1e%ld", (long)best);
    json_object_set_new(claims, "uniqueness_radius", json_string(text));
  } else refute(f, -1, -1, "existence: Krawczyk gives %.2g of the radius", ratio);
  return holds;
}

/* Approximate eigenvectors of the monodromy matrix, to so many digits. */
static void write_vectors(json_t *draft, const orbit *o, slong digits, failure *f)
{
  LOCAL(arb_mat) m = ZERO;
  LOCAL(acb_mat) a = ZERO, v = ZERO;
  const int n = monodromy(o, m, f);
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
      arb_srcptr parts[] = {acb_realref(acb_mat_entry(v, i, j)), acb_imagref(acb_mat_entry(v, i, j))};
      char *text[2];
      for (int part = 0; part < 2; part++) text[part] = decimal_write(arb_midref(parts[part]), -digits, 0);
      json_array_append_new(row, json_pack("[s, s]", text[0], text[1]));
      free(text[0]);
      free(text[1]);
    }
    json_array_append_new(rows, row);
  }
  json_object_set_new(draft, "vectors", rows);
  _acb_vec_clear(values, n);
}

/* The enclosures, three times as wide, and a radius more. */
static void write_claims(json_t *claims, const orbit *o, const quantities *q, const arb_t radius)
{
  for (int i = 0; i < CLAIMS; i++) {
    LOCAL(mag) pad = ZERO, wide = ZERO;
    if (!(i == CLAIM_MULTIPLIER ? q->multiplier_known : q->known)) continue;
    arb_get_mag(pad, radius);
    arb_get_mag(wide, o->scale);
    if (i != CLAIM_MULTIPLIER) mag_mul(pad, pad, wide);
    mag_addmul(pad, arb_radref(q->value[i]), arb_radref(q->value[i]));
    mag_mul_2exp_si(wide, arb_radref(q->value[i]), 1);
    mag_add(pad, pad, wide);
    json_object_set_new(claims, claim_names[i], decimal_interval(q->value[i], pad, o->precision));
  }
  json_object_set_new(claims, "stability",
                      json_string(stability_names[q->stability ? q->stability : STABILITY_UNPROVEN]));
}

/* ---- all of it ---- */

/* Fills in the certificate; false: v says why there is none, or none that would be accepted. */
static bool make(json_t *draft, const certificate *c, krawczyk *k, decision *v)
{
  failure *f = &v->failure;
  json_t *claims = json_object();
  json_object_set_new(draft, "claims", claims);
  orbit *o = orbit_new(c, f);
  bool fine = o && flow_prepare(o, f) && refine(k, o, f);
  if (!fine) json_object_del(draft, "events"); /* no certificate */
  if (fine) {
    write_events(draft, o);
    fine = existence_prepare(k, o, true, f);
  }
  if (fine) {
    existence_measure(k);
    fine = find_radii(k, claims, f);
  }
  static const slong digits[] = {17, WIDE_DIGITS};
  certificate *read = NULL;
  for (int attempt = 0; attempt < 2 && fine; attempt++) {
    char why[256];
    write_vectors(draft, o, digits[attempt], f);
    certificate_free(read);
    read = certificate_read(draft, false, why, sizeof why);
    if (!read) fine = refute(f, -1, -1, "%s", why);
    if (!fine) break;
    o->c = read; /* with its vectors */
    multipliers(o, &v->quantities, f);
    if (v->quantities.stability != STABILITY_UNPROVEN) break;
  }
  if (fine && read && (fine = prove_orbit(o, v))) {
    LOCAL(arb) radius = ZERO;
    arb_set_fmpq(radius, read->radii, o->precision);
    write_claims(claims, o, &v->quantities, radius);
  }
  existence_free(k);
  orbit_free(o);
  certificate_free(read);
  return fine;
}

json_t *complete(json_t *candidate, int precision)
{
  char why[256] = "";
  krawczyk k = {0};
  decision v;
  decision_init(&v);
  json_t *draft = as_strings(candidate), *answer = NULL;
  json_object_del(draft, "claims");
  json_object_del(draft, "vectors");
  json_object_del(draft, "id");
  certificate *c = certificate_read(draft, true, why, sizeof why), *made = NULL;
  if (c) {
    set_defaults(draft, c, precision);
    certificate_free(c);
    c = certificate_read(draft, true, why, sizeof why);
  }
  if (!c) answer = answer_json(NULL, NULL, why);
  else if (make(draft, c, &k, &v)) {
    decision_clear(&v);
    decision_init(&v);
    made = certificate_read(draft, false, why, sizeof why);
    if (made) prove(made, &v);
    answer = made ? answer_json(made, &v, NULL) : answer_json(NULL, NULL, why);
  } else answer = answer_json(c, &v, NULL);
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
