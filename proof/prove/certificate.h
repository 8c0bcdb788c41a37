/* certificate.h - a case and an orbit of it as a certificate, the text that hbmcheck-proof decides about
 * (proof/README.md has its format). All numbers are decimal strings, the shortest that read back to the case's doubles:
 * those of the case file if it has at most 15 digits. */
#pragma once

#include <jansson.h>

#include "model/casefile/scene.h"
#include "timeint/steady/orbit_events.h"

/* The scene's model in the form of certificates, without loads, and the mapping of its contacts. */
typedef struct certificate_model {
  const model *of;
  json_t *model, *response;
  int n_contacts; /* contacts of the certificate; contacts without a varying force are omitted */
  int *contact;   /* [n_contacts] index in the model */
  bool *friction; /* [n_contacts] true: letters O S + -; false: O N */
} certificate_model;

/* For response r of m, which must live as long. Call certificate_model_free in any case. HC_NO_MEMORY. */
hc_status certificate_model_make(const scene *sc, const model *m, int r, certificate_model *out);
void certificate_model_free(certificate_model *c);

/* A certificate without claims of the orbit over k periods at omega, with the response's amplitude; to be
 * json_decref'd. NULL: out of memory. */
json_t *certificate_of(const certificate_model *c, double omega, int k, double amplitude, const orbit_events *e);

/* True if this certificate has exactly the case's model, omega, period and response. */
bool certificate_is_of(const json_t *certificate, const certificate_model *c, double omega, int k);

/* Letters of the contacts in each interval, "O S", into text[size], ending in "..." if they do not fit. */
void certificate_letters(const json_t *certificate, char *text, size_t size);

/* The decimal string `name` (index i of a list; i < 0: not a list) as a double rounded down (towards < 0), up (> 0) or
 * to nearest (0); NaN: missing. */
double certificate_bound(const json_t *claims, const char *name, int i, int towards);
