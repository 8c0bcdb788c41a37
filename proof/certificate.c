/* certificate.c - reading: every number is exact, every list has its length, everything is bounded. A key of the model
 * that is not known is refused: a theorem about another model would be worse than none. */
#include "proof/certificate.h"
#include "base/message.h"
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

const char *const claim_names[CLAIMS] = {"max", "min", "amplitude", "mean", "a1", "b1", "harmonic_1", "multiplier"};
const char *const stability_names[] = {NULL, "stable", "unstable", "unproven"};

typedef struct reading {
  certificate *c;
  bool candidate; /* JSON numbers stand for decimals, and what has a default may be missing */
  bool failed;
  char *why;
  size_t size;
} reading;

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static bool
wrong(reading *r, const char *format, ...)
{
  if (r->failed) return false; /* the first fault is the one to tell */
  message m;
  va_list args;
  message_start(&m, r->why, r->size);
  va_start(args, format);
  message_add_list(&m, format, args);
  va_end(args);
  r->failed = true;
  return false;
}

/* ---- numbers ---- */

bool decimal_read(const char *text, size_t length, fmpq_t value)
{
  char digits[LIMIT_DIGITS + 2];
  size_t n = 0, i = 0;
  long point = 0, exponent = 0;
  bool any = false, negative = false;
  if (length > LIMIT_DIGITS) return false;
  if (i < length && (text[i] == '-' || text[i] == '+')) negative = text[i++] == '-';
  for (bool after = false; i < length && ((text[i] >= '0' && text[i] <= '9') || (text[i] == '.' && !after)); i++) {
    if (text[i] == '.') {
      after = true;
      continue;
    }
    any = true;
    digits[n++] = text[i];
    if (after) point++;
  }
  if (!any) return false;
  if (i < length && (text[i] == 'e' || text[i] == 'E')) {
    bool down = false, some = false;
    if (++i < length && (text[i] == '-' || text[i] == '+')) down = text[i++] == '-';
    for (; i < length && text[i] >= '0' && text[i] <= '9'; i++) {
      some = true;
      exponent = 10 * exponent + (text[i] - '0');
      if (exponent > LIMIT_EXPONENT) return false;
    }
    if (!some) return false;
    if (down) exponent = -exponent;
  }
  if (i != length) return false;
  digits[n] = 0;
  if (fmpz_set_str(fmpq_numref(value), digits, 10) != 0) return false;
  if (negative) fmpz_neg(fmpq_numref(value), fmpq_numref(value));
  exponent -= point;
  fmpz_ui_pow_ui(fmpq_denref(value), 10, (ulong)labs(exponent));
  if (exponent >= 0) {
    fmpz_mul(fmpq_numref(value), fmpq_numref(value), fmpq_denref(value));
    fmpz_one(fmpq_denref(value));
  }
  fmpq_canonicalise(value);
  return true;
}

static bool number(reading *r, const json_t *json, const char *where, fmpq *value)
{
  char text[40];
  if (json_is_string(json)) {
    if (!decimal_read(json_string_value(json), json_string_length(json), value))
      wrong(r, "%s: not a decimal number of at most %d characters and exponents to %d", where, LIMIT_DIGITS,
            LIMIT_EXPONENT);
    return !r->failed;
  }
  if (!r->candidate || !json_is_number(json)) return wrong(r, "%s: a decimal number as a string was expected", where);
  int length = snprintf(text, sizeof text, "%.17g", json_number_value(json));
  if (!decimal_read(text, (size_t)length, value)) wrong(r, "%s: not a number between 1e-400 and 1e400", where);
  return !r->failed;
}

static bool list(reading *r, const json_t *json, const char *where, slong n, fmpq *values)
{
  if (!json_is_array(json) || json_array_size(json) != (size_t)n)
    return wrong(r, "%s: a list of %ld numbers was expected", where, (long)n);
  for (slong i = 0; i < n; i++) number(r, json_array_get(json, (size_t)i), where, values + i);
  return !r->failed;
}

static fmpq *one_number(reading *r, const json_t *object, const char *where, const char *key)
{
  char name[80];
  fmpq *value = pool_rationals(&r->c->pool, 1);
  snprintf(name, sizeof name, "%s%s", where, key);
  number(r, json_object_get(object, key), name, value);
  return value;
}

static bool matrix(reading *r, const json_t *object, const char *key, fmpq **values)
{
  const int n = r->c->n;
  const json_t *rows = json_object_get(object, key);
  *values = pool_rationals(&r->c->pool, (slong)n * n);
  if (!json_is_array(rows) || json_array_size(rows) != (size_t)n)
    return wrong(r, "model.%s: %d rows were expected", key, n);
  for (int i = 0; i < n; i++) list(r, json_array_get(rows, (size_t)i), key, n, *values + (size_t)i * n);
  return !r->failed;
}

static int integer(reading *r, const json_t *object, const char *key, int from, int to, int otherwise)
{
  const json_t *json = json_object_get(object, key);
  if (!json && otherwise >= from) return otherwise;
  if (json_is_integer(json) && json_integer_value(json) >= from && json_integer_value(json) <= to)
    return (int)json_integer_value(json);
  wrong(r, "%s: an integer, %d to %d, was expected", key, from, to);
  return from;
}

/* ---- the model ---- */

/* Refuses keys that are not among known[], which ends in NULL. */
static bool only(reading *r, json_t *object, const char *where, const char *const *known)
{
  const char *key;
  json_t *value;
  if (!json_is_object(object)) return wrong(r, "%s: an object was expected", where);
  json_object_foreach(object, key, value)
  {
    const char *const *name = known;
    while (*name && strcmp(*name, key) != 0) name++;
    if (!*name) wrong(r, "%s: %s is not a key of it", where, QUOTED(key, strlen(key)));
  }
  return !r->failed;
}

static bool all_zero(const fmpq *v, int n)
{
  for (int i = 0; i < n; i++)
    if (!fmpq_is_zero(v + i)) return false;
  return true;
}

static bool read_contact(reading *r, json_t *json, contact_given *k)
{
  static const char *const known[] = {"tangent",          "tangential_stiffness",
                                      "friction",         "normal",
                                      "normal_stiffness", "gap",
                                      "preload",          "direction",
                                      "angle_deg",        NULL};
  static const char where[] = "model.contacts.";
  certificate *c = r->c;
  if (!only(r, json, "model.contacts", known)) return false;
  bool has[9];
  for (int i = 0; i < 9; i++) has[i] = json_object_get(json, known[i]) != NULL;
  const bool tangent = has[0], normal = has[3] || has[4] || has[5], preloaded = has[6];
  k->angled = has[7];
  k->normal = !preloaded;
  if (k->angled != has[8] || (k->angled && (tangent || has[3] || preloaded)) || (preloaded && normal) ||
      (!tangent && !k->angled && (preloaded || has[1] || has[2])))
    return wrong(r, "model.contacts: `direction` and `angle_deg`, or `tangent` and a normal direction or `preload`, "
                    "or a normal direction alone");
  k->t = pool_rationals(&c->pool, c->n);
  k->n = pool_rationals(&c->pool, c->n);
  if (k->angled) {
    list(r, json_object_get(json, "direction"), "model.contacts.direction", c->n, k->t);
    list(r, json_object_get(json, "direction"), "model.contacts.direction", c->n, k->n);
    k->angle = one_number(r, json, where, "angle_deg");
    LOCAL(fmpq) quarters = ZERO_FMPQ;
    fmpq_set_ui(quarters, 90, 1);
    fmpq_div(quarters, k->angle, quarters);
    if (fmpz_is_one(fmpq_denref(quarters)))
      wrong(r, "model.contacts.angle_deg: at a multiple of 90 write `preload`, or `normal` only");
  } else {
    if (tangent) list(r, json_object_get(json, "tangent"), "model.contacts.tangent", c->n, k->t);
    if (k->normal) list(r, json_object_get(json, "normal"), "model.contacts.normal", c->n, k->n);
  }
  if (tangent || k->angled) {
    k->kt = one_number(r, json, where, "tangential_stiffness");
    k->mu = one_number(r, json, where, "friction");
    if (fmpq_sgn(k->kt) < 0 || fmpq_sgn(k->mu) < 0)
      wrong(r, "model.contacts: friction and tangential_stiffness must not be negative");
  }
  if (k->normal) {
    k->kn = one_number(r, json, where, "normal_stiffness");
    k->gap = one_number(r, json, where, "gap");
    if (fmpq_sgn(k->kn) <= 0 || all_zero(k->n, c->n))
      wrong(r, "model.contacts: normal_stiffness must be positive, and the normal direction not 0");
  } else {
    k->load = one_number(r, json, where, "preload");
    if (fmpq_sgn(k->load) < 0) wrong(r, "model.contacts.preload: must not be negative");
  }
  k->tangential = k->kt && !fmpq_is_zero(k->kt) && !fmpq_is_zero(k->mu) && (k->normal || !fmpq_is_zero(k->load)) &&
                  !all_zero(k->t, c->n);
  return !r->failed;
}

static bool read_model(reading *r, json_t *model)
{
  static const char *const known[] = {"mass", "damping", "stiffness", "forcing", "contacts", NULL};
  static const char *const forcing_keys[] = {"harmonic", "cos", "sin", NULL};
  certificate *c = r->c;
  if (!only(r, model, "model", known)) return false;
  const json_t *mass = json_object_get(model, "mass"), *forcing = json_object_get(model, "forcing"),
               *contacts = json_object_get(model, "contacts");
  if (!json_is_array(mass) || json_array_size(mass) < 1 || json_array_size(mass) > LIMIT_COORDINATES)
    wrong(r, "model.mass: 1 to %d rows were expected", LIMIT_COORDINATES);
  if (!json_is_array(forcing) || json_array_size(forcing) > LIMIT_HARMONICS)
    wrong(r, "model.forcing: a list of at most %d harmonics was expected", LIMIT_HARMONICS);
  if (!json_is_array(contacts) || json_array_size(contacts) > LIMIT_CONTACTS)
    wrong(r, "model.contacts: a list of at most %d contacts was expected", LIMIT_CONTACTS);
  if (r->failed) return false;
  c->n = (int)json_array_size(mass);
  c->n_harmonics = (int)json_array_size(forcing);
  c->n_contacts = (int)json_array_size(contacts);
  matrix(r, model, "mass", &c->mass);
  matrix(r, model, "damping", &c->damping);
  matrix(r, model, "stiffness", &c->stiffness);
  c->cosine = pool_rationals(&c->pool, (slong)c->n_harmonics * c->n);
  c->sine = pool_rationals(&c->pool, (slong)c->n_harmonics * c->n);
  for (int h = 0; h < c->n_harmonics && !r->failed; h++) {
    json_t *load = json_array_get(forcing, (size_t)h);
    only(r, load, "model.forcing", forcing_keys);
    c->harmonic[h] = integer(r, load, "harmonic", 0, LIMIT_HARMONIC, -1);
    list(r, json_object_get(load, "cos"), "model.forcing.cos", c->n, c->cosine + (size_t)h * c->n);
    list(r, json_object_get(load, "sin"), "model.forcing.sin", c->n, c->sine + (size_t)h * c->n);
    if (c->harmonic[h] == 0 && !all_zero(c->sine + (size_t)h * c->n, c->n))
      wrong(r, "model.forcing: harmonic 0 has no sine");
    for (int other = 0; other < h; other++)
      if (c->harmonic[other] == c->harmonic[h]) wrong(r, "model.forcing: harmonic %d is there twice", c->harmonic[h]);
  }
  for (int j = 0; j < c->n_contacts && !r->failed; j++)
    read_contact(r, json_array_get(contacts, (size_t)j), &c->contacts[j]);
  return !r->failed;
}

/* ---- the orbit ---- */

static bool read_events(reading *r, const json_t *events)
{
  certificate *c = r->c;
  const size_t most = LIMIT_UNKNOWNS / (2 * (size_t)c->n + 1);
  if (!json_is_array(events) || json_array_size(events) < 1 || json_array_size(events) > most)
    return wrong(r, "events: a list of 1 to %zu was expected", most);
  c->n_events = (int)json_array_size(events);
  c->time = pool_rationals(&c->pool, c->n_events);
  c->state = pool_rationals(&c->pool, 2L * c->n_events * c->n);
  c->letters = pool_take(&c->pool, POOL_BYTES, (size_t)c->n_events * (size_t)c->n_contacts);
  for (int i = 0; i < c->n_events && !r->failed; i++) {
    const json_t *event = json_array_get(events, (size_t)i), *letters = json_object_get(event, "state");
    number(r, json_object_get(event, "t"), "events.t", c->time + i);
    list(r, json_object_get(event, "x"), "events.x", c->n, c->state + 2L * i * c->n);
    list(r, json_object_get(event, "v"), "events.v", c->n, c->state + (2L * i + 1) * c->n);
    if (!json_is_string(letters) || json_string_length(letters) != (size_t)c->n_contacts)
      return wrong(r, "events.state: %d letters were expected, one a contact", c->n_contacts);
    for (int j = 0; j < c->n_contacts; j++) {
      const contact_given *k = &c->contacts[j];
      const char letter = json_string_value(letters)[j], *possible = k->tangential ? k->normal ? "OS+-" : "S+-"
                                                                     : k->normal   ? "ON"
                                                                                   : "N";
      if (!letter || !strchr(possible, letter)) wrong(r, "events.state: contact %d has the letters %s", j, possible);
      c->letters[(size_t)i * (size_t)c->n_contacts + (size_t)j] = letter;
    }
  }
  c->section = json_object_get(json_array_get(events, 0), "section") != NULL;
  if (c->section && c->n_events != 1) wrong(r, "events: a section stands alone");
  for (int i = 0; i < c->n_events && !c->section && !r->failed; i++) {
    const char *after = c->letters + (size_t)i * (size_t)c->n_contacts;
    const char *before = c->letters + (size_t)((i + c->n_events - 1) % c->n_events) * (size_t)c->n_contacts;
    if (memcmp(before, after, (size_t)c->n_contacts) == 0) wrong(r, "events: at number %d no letter changes", i);
  }
  return !r->failed;
}

static bool read_rest(reading *r, const json_t *rest)
{
  certificate *c = r->c;
  c->rest = pool_rationals(&c->pool, c->n_contacts);
  if (!rest && r->candidate) return !r->failed;
  if (!json_is_object(rest)) return wrong(r, "rest: an object was expected");
  size_t found = 0;
  for (int j = 0; j < c->n_contacts; j++) {
    char key[16];
    bool always = true;
    snprintf(key, sizeof key, "%d", j);
    for (int i = 0; i < c->n_events; i++) always = always && c->letters[i * c->n_contacts + j] == 'S';
    const json_t *w = json_object_get(rest, key);
    if (always != (w != NULL)) wrong(r, "rest: contact %d %s all period", j, always ? "sticks" : "does not stick");
    if (!w) continue;
    found++;
    number(r, w, "rest", c->rest + j);
  }
  if (found != json_object_size(rest)) wrong(r, "rest: keys are numbers of contacts");
  return !r->failed;
}

static bool read_scales(reading *r, const json_t *scales)
{
  certificate *c = r->c;
  static const char *const names[] = {"x", "v", "t"};
  c->scales = pool_rationals(&c->pool, 3);
  for (int i = 0; i < 3; i++) fmpq_one(c->scales + i);
  if (!scales && r->candidate) return !r->failed; /* complete.c will say */
  for (int i = 0; i < 3; i++) {
    number(r, json_object_get(scales, names[i]), "scales", c->scales + i);
    if (!r->failed && fmpq_sgn(c->scales + i) <= 0) wrong(r, "scales.%s: must be positive", names[i]);
  }
  return !r->failed;
}

static bool read_claims(reading *r, const json_t *claims)
{
  certificate *c = r->c;
  if (!json_is_object(claims)) return wrong(r, "claims: an object was expected");
  number(r, json_object_get(claims, "radius"), "claims.radius", c->radii);
  number(r, json_object_get(claims, "uniqueness_radius"), "claims.uniqueness_radius", c->radii + 1);
  for (int i = 0; i < 2; i++)
    if (!r->failed && fmpq_sgn(c->radii + i) <= 0) wrong(r, "claims: radii must be positive");
  for (int q = 0; q < CLAIMS; q++) {
    const json_t *interval = json_object_get(claims, claim_names[q]);
    c->claimed[q] = interval && !json_is_null(interval);
    if (c->claimed[q]) list(r, interval, claim_names[q], 2, c->claims + 2L * q);
  }
  const json_t *word = json_object_get(claims, "stability");
  if (word && !json_is_null(word)) {
    for (int s = 1; s <= STABILITY_UNPROVEN; s++)
      if (json_is_string(word) && strcmp(json_string_value(word), stability_names[s]) == 0) c->stability = (stability)s;
    if (!c->stability) wrong(r, "claims.stability: stable, unstable or unproven was expected");
  }
  return !r->failed;
}

static bool read_vectors(reading *r, const json_t *vectors)
{
  certificate *c = r->c;
  if (!vectors || json_is_null(vectors)) return !r->failed;
  const size_t n = json_array_size(vectors);
  if (!json_is_array(vectors) || n > 2 * (size_t)c->n + (size_t)c->n_contacts)
    return wrong(r, "vectors: at most %d rows were expected", 2 * c->n + c->n_contacts);
  c->n_vectors = (int)n;
  c->vectors = pool_rationals(&c->pool, (slong)(2 * n * n));
  for (size_t i = 0; i < n; i++) {
    const json_t *row = json_array_get(vectors, i);
    if (!json_is_array(row) || json_array_size(row) != n)
      return wrong(r, "vectors: rows of %zu pairs were expected", n);
    for (size_t j = 0; j < n; j++) list(r, json_array_get(row, j), "vectors", 2, c->vectors + 2 * (i * n + j));
  }
  return !r->failed;
}

certificate *certificate_read(const json_t *json, bool candidate, char *why, size_t size)
{
  certificate *c = flint_calloc(1, sizeof *c);
  reading r = {.c = c, .candidate = candidate, .size = size};
  r.why = why;
  if (!json_is_object(json)) wrong(&r, "an object was expected");
  else {
    read_model(&r, json_object_get(json, "model"));
    c->multiple = integer(&r, json, "multiple", 1, LIMIT_MULTIPLE, candidate ? 1 : 0);
    c->precision = integer(&r, json, "precision_bits", 32, LIMIT_PRECISION, candidate ? 128 : 0);
    c->omega = one_number(&r, json, "", "omega");
    if (!r.failed && fmpq_sgn(c->omega) <= 0) wrong(&r, "omega: must be positive");
    c->radii = pool_rationals(&c->pool, 2);
    c->claims = pool_rationals(&c->pool, 2L * CLAIMS);
  }
  if (!r.failed) {
    const json_t *response = json_object_get(json, "response");
    c->response = pool_rationals(&c->pool, c->n);
    if (response || !candidate) list(&r, response, "response", c->n, c->response);
    else fmpq_one(c->response);
  }
  const bool orbit = !r.failed && read_events(&r, json_object_get(json, "events")) &&
                     read_rest(&r, json_object_get(json, "rest")) && read_scales(&r, json_object_get(json, "scales"));
  if (orbit && !candidate && read_claims(&r, json_object_get(json, "claims")))
    read_vectors(&r, json_object_get(json, "vectors"));
  if (!r.failed) return c;
  certificate_free(c);
  return NULL;
}

void certificate_free(certificate *c)
{
  if (c) pool_clear(&c->pool);
  flint_free(c);
}
