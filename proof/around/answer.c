/* answer.c - see answer.h. */
#include "proof/around/answer.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- decimals ---- */

slong decimal_place(const arf_t x, slong otherwise)
{
  LOCAL(mag) m = {0};
  arf_get_mag(m, x);
  const double log2 = mag_is_special(m) ? NAN : mag_get_d_log2_approx(m);
  return isfinite(log2) && fabs(log2) < 20000 ? (slong)floor(log2 * 0.30102999566398120) : otherwise;
}

/* digits 10^place as text: 0.00125, 1250, or 1.25e-12 */
static char *place_point(const char *digits, slong place)
{
  const bool negative = *digits == '-';
  digits += negative;
  const size_t n = strlen(digits);
  const slong lead = place + (slong)n - 1;
  char *text = malloc(n + 64), *at = text;
  if (!text) abort();
  if (negative) *at++ = '-';
  if (*digits == '0') memcpy(text, "0", 2);
  else if (lead < -5 || lead > 20 || place > 0)
    sprintf(at, "%c%s%se%ld", *digits, n > 1 ? "." : "", digits + 1, (long)lead);
  else if (lead < 0) sprintf(at, "0.%.*s%s", (int)(-lead - 1), "0000", digits);
  else sprintf(at, "%.*s%s%s", (int)lead + 1, digits, place < 0 ? "." : "", digits + lead + 1);
  return text;
}

char *decimal_write(const arf_t x, slong place, int round)
{
  LOCAL(fmpz) power = {0}, integer = {0};
  LOCAL(arf) scaled = {0};
  fmpz_ui_pow_ui(power, 10, (ulong)labs(place));
  if (place <= 0) {
    arf_mul_fmpz(scaled, x, power, ARF_PREC_EXACT, ARF_RND_DOWN);
    arf_get_fmpz(integer, scaled, round < 0 ? ARF_RND_FLOOR : round > 0 ? ARF_RND_CEIL : ARF_RND_NEAR);
  } else { /* the integer part is enough, rounded twice in the same direction */
    arf_get_fmpz(integer, x, round > 0 ? ARF_RND_CEIL : ARF_RND_FLOOR);
    if (round > 0) fmpz_cdiv_q(integer, integer, power);
    else fmpz_fdiv_q(integer, integer, power);
  }
  char *digits = fmpz_get_str(NULL, 10, integer), *text = place_point(digits, place);
  flint_free(digits);
  return text;
}

json_t *decimal_interval(const arb_t x, const mag_t pad, slong precision)
{
  enum { WIDTH_DIGITS = 3, MOST_DIGITS = 60 };
  LOCAL(arf) low = {0}, high = {0}, width = {0};
  arf_set_mag(width, pad);
  arb_get_lbound_arf(low, x, precision);
  arb_get_ubound_arf(high, x, precision);
  arf_sub(low, low, width, precision, ARF_RND_FLOOR);
  arf_add(high, high, width, precision, ARF_RND_CEIL);
  arf_sub(width, high, low, 30, ARF_RND_UP);
  const slong lead = decimal_place(arf_cmpabs(low, high) > 0 ? low : high, 0);
  slong place = decimal_place(width, lead - MOST_DIGITS) - WIDTH_DIGITS;
  if (place < lead - MOST_DIGITS) place = lead - MOST_DIGITS;
  char *from = decimal_write(low, place, -1), *to = decimal_write(high, place, 1);
  json_t *interval = json_pack("[s, s]", from, to);
  free(from);
  free(to);
  return interval;
}

/* ---- the answer ---- */

static json_t *radius_json(const fmpq *radius)
{
  LOCAL(arf) r = {0};
  arf_set_fmpq(r, radius, 64, ARF_RND_UP);
  char *text = decimal_write(r, decimal_place(r, 0) - 2, 0);
  json_t *json = json_string(text);
  free(text);
  return json;
}

static void put(json_t *answer, const char *key, json_t *value)
{
  json_object_set_new(answer, key, value ? value : json_null());
}

json_t *answer_json(const certificate *c, const decision *v, const char *why)
{
  static const decision none = {.failure = {.segment = -1, .contact = -1, .from = NAN, .to = NAN}};
  if (why) v = &none;
  const failure *f = &v->failure;
  const quantities *q = &v->quantities;
  json_t *answer = json_object(), *states = c ? json_array() : NULL;
  LOCAL(mag) pad = {0};
  put(answer, "verdict", json_string(why ? "wrong" : f->reason[0] ? "rejected" : "accepted"));
  put(answer, "reason", why || f->reason[0] ? json_string(why ? why : f->reason) : NULL);
  put(answer, "segment", f->segment >= 0 ? json_integer(f->segment) : NULL);
  put(answer, "time", isfinite(f->from) && isfinite(f->to) ? json_pack("[f, f]", f->from, f->to) : NULL);
  put(answer, "contact", f->contact >= 0 ? json_integer(f->contact) : NULL);
  put(answer, "radius", c && v->exists ? radius_json(c->radius) : NULL);
  put(answer, "uniqueness_radius", c && v->exists ? radius_json(c->uniqueness_radius) : NULL);
  put(answer, "stability", q->stability ? json_string(stability_names[q->stability]) : NULL);
  for (int i = CLAIMS - 1; i >= 0; i--) {
    const bool known = i == CLAIM_MULTIPLIER ? q->multiplier_known : q->known;
    put(answer, claim_names[i], c && known ? decimal_interval(q->value[i], pad, c->precision + 30L) : NULL);
  }
  for (int i = 0; c && i < c->n_events; i++)
    json_array_append_new(states, json_stringn(c->letters + (size_t)i * (size_t)c->n_contacts, (size_t)c->n_contacts));
  put(answer, "states", states);
  put(answer, "transitions", c ? json_integer(c->section ? 0 : c->n_events) : NULL);
  return answer;
}
