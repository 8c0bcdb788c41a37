/* certificate.c - reading: every number is exact, every list has its length, everything is bounded. Objects of the
 * model must have known keys only: a theorem about another model would be worse than none. */
#include "proof/certificate.h"
#include "numerics/base/message.h"
#include <ctype.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

const char *const claim_names[CLAIMS] = {"max", "min", "amplitude", "mean", "a1", "b1", "harmonic_1", "multiplier"};
const char *const stability_names[] = {NULL, "stable", "unstable", "unproven"};

typedef struct reading {
  certificate *c;
  message why;
  bool failed;
} reading;

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
wrong(reading *r, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  if (!r->failed) message_add_list(&r->why, format, args); /* the first fault is reported */
  va_end(args);
  r->failed = true;
}

/* ---- numbers ---- */

bool decimal_read(const char *text, size_t length, fmpq_t value)
{
  char digits[LIMIT_DIGITS + 2];
  size_t n = 0, i = 0;
  long exponent = 0, given = 0;
  bool any = false, point = false;
  if (length > LIMIT_DIGITS) return false;
  const bool negative = length > 0 && text[0] == '-';
  if (length > 0 && (negative || text[0] == '+')) i++;
  for (; i < length && (isdigit((unsigned char)text[i]) || (text[i] == '.' && !point)); i++) {
    if (text[i] == '.') point = true;
    else digits[n++] = text[i], any = true, exponent -= point;
  }
  if (any && i < length && (text[i] == 'e' || text[i] == 'E')) {
    const bool down = ++i < length && text[i] == '-';
    if (i < length && (down || text[i] == '+')) i++;
    any = false;
    for (; i < length && isdigit((unsigned char)text[i]) && given <= LIMIT_EXPONENT; i++, any = true)
      given = 10 * given + (text[i] - '0');
    exponent += down ? -given : given;
  }
  digits[n] = 0;
  if (!any || i != length || given > LIMIT_EXPONENT || fmpz_set_str(fmpq_numref(value), digits, 10) != 0) return false;
  if (negative) fmpz_neg(fmpq_numref(value), fmpq_numref(value));
  fmpz_ui_pow_ui(fmpq_denref(value), 10, (ulong)labs(exponent));
  if (exponent >= 0) {
    fmpz_mul(fmpq_numref(value), fmpq_numref(value), fmpq_denref(value));
    fmpz_one(fmpq_denref(value));
  }
  fmpq_canonicalise(value);
  return true;
}

static void number(reading *r, const json_t *json, const char *where, fmpq *value)
{
  if (!json_is_string(json) || !decimal_read(json_string_value(json), json_string_length(json), value))
    wrong(r, "%s: a decimal number as a string was expected, of %d characters and exponents to %d at most", where,
          LIMIT_DIGITS, LIMIT_EXPONENT);
}

static fmpq *positive(reading *r, const json_t *object, const char *key)
{
  fmpq *value = pool_rationals(&r->c->pool, 1);
  number(r, json_object_get(object, key), key, value);
  if (fmpq_sgn(value) <= 0) wrong(r, "%s: must be positive", key);
  return value;
}

/* The length of a list, which must be least .. most; on a fault `least`. */
static int length(reading *r, const json_t *json, const char *where, int least, int most)
{
  const size_t n = json_array_size(json);
  if (json_is_array(json) && n >= (size_t)least && n <= (size_t)most) return (int)n;
  wrong(r, "%s: a list of %d to %d was expected", where, least, most);
  return least;
}

static void list(reading *r, const json_t *json, const char *where, int n, fmpq *values)
{
  length(r, json, where, n, n);
  for (int i = 0; i < n && !r->failed; i++) number(r, json_array_get(json, (size_t)i), where, values + i);
}

/* The numbers of `rows` lists, one after the other. */
static fmpq *matrix(reading *r, const json_t *json, const char *where, int rows, int n)
{
  fmpq *values = pool_rationals(&r->c->pool, (slong)rows * n);
  length(r, json, where, rows, rows);
  for (int i = 0; i < rows && !r->failed; i++)
    list(r, json_array_get(json, (size_t)i), where, n, values + (slong)i * n);
  return values;
}

static int integer(reading *r, const json_t *object, const char *key, int from, int to)
{
  const json_t *json = json_object_get(object, key);
  if (json_is_integer(json) && json_integer_value(json) >= from && json_integer_value(json) <= to)
    return (int)json_integer_value(json);
  wrong(r, "%s: an integer, %d to %d, was expected", key, from, to);
  return from;
}

/* ---- the model ---- */

/* Bit mask of the keys[n] that an object has; other keys are a fault. */
static unsigned keys_of(reading *r, const json_t *json, const char *where, int n, const char *const *keys)
{
  unsigned has = 0;
  size_t known = 0;
  for (int i = 0; i < n; i++)
    if (json_object_get(json, keys[i])) has |= 1u << i, known++;
  if (!json_is_object(json) || known != json_object_size(json))
    wrong(r, "%s: an object of known keys was expected", where);
  return has;
}

static bool all_zero(const fmpq *v, int n)
{
  for (int i = 0; i < n; i++)
    if (!fmpq_is_zero(v + i)) return false;
  return true;
}

static void read_contact(reading *r, const json_t *json, contact_given *k)
{
  enum { N_KEYS = 9, TANGENT = 0007, NORMAL = 0070, PRELOAD = 0100, ANGLE = 0666 };
  static const char *const keys[N_KEYS] = {
      "tangent",  "tangential_stiffness", "friction", "normal", "normal_stiffness", "gap", "preload", "direction",
      "angle_deg"};
  const int n = r->c->n;
  const unsigned has = keys_of(r, json, "model.contacts", N_KEYS, keys);
  k->angled = has == ANGLE;
  k->normal = !(has & PRELOAD);
  if (has != (TANGENT | NORMAL) && has != (TANGENT | PRELOAD) && has != NORMAL && has != ANGLE)
    wrong(r,
          "model.contacts: `direction`, `angle_deg` and constants, or `tangent` and a normal direction or `preload`, "
          "or a normal direction alone");
  k->t = pool_rationals(&r->c->pool, 2L * n + CONTACT_NUMBERS);
  k->n = k->t + n, k->angle = k->n + n, k->kt = k->angle + 1, k->mu = k->kt + 1, k->kn = k->mu + 1, k->gap = k->kn + 1,
  k->load = k->gap + 1;
  fmpq *const to[N_KEYS] = {k->t, k->kt, k->mu, k->n, k->kn, k->gap, k->load, k->t, k->angle};
  for (int i = 0; i < N_KEYS && !r->failed; i++) {
    const json_t *value = json_object_get(json, keys[i]);
    if (value && (to[i] == k->t || to[i] == k->n)) list(r, value, keys[i], n, to[i]);
    else if (value) number(r, value, keys[i], to[i]);
  }
  if (k->angled) {
    for (int i = 0; i < n; i++) fmpq_set(k->n + i, k->t + i);
    LOCAL(fmpq) quarters = {0};
    fmpq_set_ui(quarters, 90, 1);
    fmpq_div(quarters, k->angle, quarters);
    if (fmpz_is_one(fmpq_denref(quarters)))
      wrong(r, "model.contacts.angle_deg: at a multiple of 90 write `preload`, or `normal` only");
  }
  if (fmpq_sgn(k->kt) < 0 || fmpq_sgn(k->mu) < 0 || fmpq_sgn(k->load) < 0)
    wrong(r, "model.contacts: friction, tangential_stiffness and preload must not be negative");
  if (k->normal && (fmpq_sgn(k->kn) <= 0 || all_zero(k->n, n)))
    wrong(r, "model.contacts: normal_stiffness must be positive, and the normal direction not 0");
  k->tangential =
      !fmpq_is_zero(k->kt) && !fmpq_is_zero(k->mu) && (k->normal || !fmpq_is_zero(k->load)) && !all_zero(k->t, n);
}

static void read_model(reading *r, const json_t *model)
{
  static const char *const keys[] = {"mass", "damping", "stiffness", "forcing", "contacts"};
  static const char *const load_keys[] = {"harmonic", "cos", "sin"};
  certificate *c = r->c;
  const json_t *forcing = json_object_get(model, "forcing"), *contacts = json_object_get(model, "contacts");
  keys_of(r, model, "model", 5, keys);
  c->n = length(r, json_object_get(model, "mass"), "model.mass", 1, LIMIT_COORDINATES);
  c->n_harmonics = length(r, forcing, "model.forcing", 0, LIMIT_HARMONICS);
  c->n_contacts = length(r, contacts, "model.contacts", 0, LIMIT_CONTACTS);
  c->mass = matrix(r, json_object_get(model, "mass"), "model.mass", c->n, c->n);
  c->damping = matrix(r, json_object_get(model, "damping"), "model.damping", c->n, c->n);
  c->stiffness = matrix(r, json_object_get(model, "stiffness"), "model.stiffness", c->n, c->n);
  c->cosine = pool_rationals(&c->pool, (slong)c->n_harmonics * c->n);
  c->sine = pool_rationals(&c->pool, (slong)c->n_harmonics * c->n);
  for (int h = 0; h < c->n_harmonics && !r->failed; h++) {
    const json_t *load = json_array_get(forcing, (size_t)h);
    fmpq *sine = c->sine + (slong)h * c->n;
    keys_of(r, load, "model.forcing", 3, load_keys);
    c->harmonic[h] = integer(r, load, "harmonic", 0, LIMIT_HARMONIC);
    list(r, json_object_get(load, "cos"), "model.forcing.cos", c->n, c->cosine + (slong)h * c->n);
    list(r, json_object_get(load, "sin"), "model.forcing.sin", c->n, sine);
    if (c->harmonic[h] == 0 && !all_zero(sine, c->n)) wrong(r, "model.forcing: harmonic 0 has no sine");
    for (int other = 0; other < h; other++)
      if (c->harmonic[other] == c->harmonic[h]) wrong(r, "model.forcing: harmonic %d is there twice", c->harmonic[h]);
  }
  for (int j = 0; j < c->n_contacts && !r->failed; j++)
    read_contact(r, json_array_get(contacts, (size_t)j), &c->contacts[j]);
}

/* ---- the orbit ---- */

static void read_events(reading *r, const json_t *events)
{
  certificate *c = r->c;
  const size_t contacts = (size_t)c->n_contacts;
  c->n_events = length(r, events, "events", 1, LIMIT_UNKNOWNS / (2 * c->n + 1));
  c->time = pool_rationals(&c->pool, c->n_events);
  c->state = pool_rationals(&c->pool, 2L * c->n_events * c->n);
  c->letters = pool_take(&c->pool, POOL_BYTES, (size_t)c->n_events * contacts);
  for (int i = 0; i < c->n_events && !r->failed; i++) {
    const json_t *event = json_array_get(events, (size_t)i), *letters = json_object_get(event, "state");
    number(r, json_object_get(event, "t"), "events.t", c->time + i);
    list(r, json_object_get(event, "x"), "events.x", c->n, c->state + 2L * i * c->n);
    list(r, json_object_get(event, "v"), "events.v", c->n, c->state + (2L * i + 1) * c->n);
    if (!json_is_string(letters) || json_string_length(letters) != contacts)
      wrong(r, "events.state: %d letters were expected, one a contact", c->n_contacts);
    for (size_t j = 0; j < contacts && !r->failed; j++) {
      const contact_given *k = &c->contacts[j];
      const char letter = json_string_value(letters)[j], *possible = k->tangential ? k->normal ? "OS+-" : "S+-"
                                                                     : k->normal   ? "ON"
                                                                                   : "N";
      if (!letter || !strchr(possible, letter)) wrong(r, "events.state: contact %zu has the letters %s", j, possible);
      c->letters[(size_t)i * contacts + j] = letter;
    }
  }
  c->section = json_object_get(json_array_get(events, 0), "section") != NULL;
  if (c->section && c->n_events != 1) wrong(r, "events: a section stands alone");
  for (int i = 0; i < c->n_events && !c->section; i++) {
    const int before = (i + c->n_events - 1) % c->n_events;
    if (memcmp(c->letters + (size_t)before * contacts, c->letters + (size_t)i * contacts, contacts) == 0)
      wrong(r, "events: at number %d no letter changes", i);
  }
}

static void read_rest(reading *r, const json_t *rest)
{
  certificate *c = r->c;
  size_t found = 0;
  c->rest = pool_rationals(&c->pool, c->n_contacts);
  for (int j = 0; j < c->n_contacts; j++) {
    char key[16];
    bool always = true;
    snprintf(key, sizeof key, "%d", j);
    for (int i = 0; i < c->n_events; i++) always = always && c->letters[i * c->n_contacts + j] == 'S';
    const json_t *w = json_object_get(rest, key);
    if (always != (w != NULL)) wrong(r, "rest: contact %d %s all period", j, always ? "sticks" : "does not stick");
    if (w) number(r, w, "rest", c->rest + j), found++;
  }
  if (!json_is_object(rest) || found != json_object_size(rest)) wrong(r, "rest: an object of numbers of contacts");
}

static void read_claims(reading *r, const json_t *claims)
{
  certificate *c = r->c;
  const json_t *word = json_object_get(claims, "stability");
  c->radius = positive(r, claims, "radius");
  c->uniqueness_radius = positive(r, claims, "uniqueness_radius");
  c->claims = pool_rationals(&c->pool, 2L * CLAIMS);
  for (int q = 0; q < CLAIMS; q++) {
    const json_t *interval = json_object_get(claims, claim_names[q]);
    c->claimed[q] = interval && !json_is_null(interval);
    if (c->claimed[q]) list(r, interval, claim_names[q], 2, c->claims + 2L * q);
  }
  for (int s = STABILITY_STABLE; s <= STABILITY_UNPROVEN; s++)
    if (json_is_string(word) && strcmp(json_string_value(word), stability_names[s]) == 0) c->stability = (stability)s;
  if (word && !json_is_null(word) && !c->stability)
    wrong(r, "claims.stability: stable, unstable or unproven was expected");
}

static void read_vectors(reading *r, const json_t *vectors)
{
  certificate *c = r->c;
  if (!vectors || json_is_null(vectors)) return;
  const int n = c->n_vectors = length(r, vectors, "vectors", 0, 2 * c->n + c->n_contacts);
  c->vectors = pool_rationals(&c->pool, 2L * n * n);
  for (int i = 0; i < n * n && !r->failed; i++) {
    const json_t *row = json_array_get(vectors, (size_t)(i / n));
    length(r, row, "vectors", n, n);
    list(r, json_array_get(row, (size_t)(i % n)), "vectors", 2, c->vectors + 2L * i);
  }
}

certificate *certificate_read(const json_t *json, bool candidate, char *why, size_t size)
{
  certificate *c = flint_calloc(1, sizeof *c);
  const json_t *scales = json_object_get(json, "scales");
  reading r = {.c = c};
  message_start(&r.why, why, size);
  read_model(&r, json_object_get(json, "model"));
  c->multiple = integer(&r, json, "multiple", 1, LIMIT_MULTIPLE);
  c->precision = integer(&r, json, "precision_bits", 32, LIMIT_PRECISION);
  c->omega = positive(&r, json, "omega");
  for (int i = 0; i < 3; i++) c->scales[i] = positive(&r, scales, (const char *[]){"x", "v", "t"}[i]);
  c->response = pool_rationals(&c->pool, c->n);
  list(&r, json_object_get(json, "response"), "response", c->n, c->response);
  if (!r.failed) read_events(&r, json_object_get(json, "events"));
  if (!r.failed) read_rest(&r, json_object_get(json, "rest"));
  if (!r.failed && !candidate) read_claims(&r, json_object_get(json, "claims"));
  if (!r.failed && !candidate) read_vectors(&r, json_object_get(json, "vectors"));
  if (!r.failed) return c;
  certificate_free(c);
  return NULL;
}

void certificate_free(certificate *c)
{
  if (c) pool_clear(&c->pool);
  flint_free(c);
}
