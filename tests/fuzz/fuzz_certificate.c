/* fuzz_certificate.c - bytes as a certificate and as a candidate: decided, or refused in words. */
#include "proof/around/answer.h"
#include "tests/fuzz/fuzz.h"
#include <string.h>

enum { WORDS = 256, HEAVY = 40 /* unknowns: what has more is read, and takes long to decide */ };

static void is_within_limits(const certificate *c)
{
  must(c->n >= 1 && c->n <= LIMIT_COORDINATES && c->n_contacts <= LIMIT_CONTACTS && c->n_harmonics <= LIMIT_HARMONICS,
       "sizes %d, %d, %d", c->n, c->n_contacts, c->n_harmonics);
  must(c->n_events >= 1 && c->n_events * (2 * c->n + 1) <= LIMIT_UNKNOWNS && c->multiple >= 1 &&
           c->precision <= LIMIT_PRECISION,
       "%d events", c->n_events);
  for (int i = 0; i < c->n_events * c->n_contacts; i++)
    must(strchr("ONS+-", c->letters[i]) && c->letters[i], "letter %d", c->letters[i]);
  must(fmpq_sgn(c->omega) > 0 && fmpq_sgn(c->scales[0]) > 0, "omega or a scale is not positive");
}

/* Decides it at low precision, and answers. */
static void decide(certificate *c)
{
  decision v;
  decision_init(&v);
  if (c->precision > 64) c->precision = 64;
  const bool accepted = prove(c, NULL, &v);
  must(accepted == !v.failure.reason[0], "accepted %d, but: %s", accepted, v.failure.reason);
  json_t *answer = answer_json(c, &v, NULL);
  char *text = json_dumps(answer, JSON_COMPACT);
  must(text != NULL, "the answer is no JSON");
  free(text);
  json_decref(answer);
  decision_clear(&v);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  json_t *json = json_loadb((const char *)data, size, JSON_REJECT_DUPLICATES, NULL);
  bool read = false;
  for (int candidate = 0; json && candidate < 2; candidate++) {
    char why[WORDS] = "";
    certificate *c = certificate_read(json, candidate, why, sizeof why);
    must((c != NULL) == !*why, "%s, but: %s", c ? "read" : "refused", why);
    if (!c) message_is_clean(why, sizeof why);
    else {
      is_within_limits(c);
      if (!candidate && c->n_events * (2 * c->n + 1) <= HEAVY) decide(c);
      read = true;
    }
    certificate_free(c);
  }
  json_decref(json);
  ++*(read ? &fuzz_accepted : &fuzz_refused);
  return 0;
}
