/* certificate.h - a case and an orbit of it as a certificate, the text that hbmcheck-proof reads and decides about
 * (proof/README.md has its format). All numbers are decimal strings: the shortest that read back to the case's doubles,
 * which are those of the file where that has no more than 15 digits. */
#pragma once

#include <jansson.h>

#include "model/casefile/scene.h"
#include "timeint/steady/orbit_events.h"

/* The scene's model, as certificates have it but for the loads, and which of their contacts are the model's. */
typedef struct certificate_model {
  const model *of;
  json_t *model, *response;
  int n_contacts; /* of the certificate: a contact that can exert no force that changes is left out */
  int *contact;   /* [n_contacts] of the model */
  bool *friction; /* [n_contacts] its letters are O S + -, else O N */
} certificate_model;

/* By response r of m, which must live as long. Free in any case. HC_NO_MEMORY. */
hc_status certificate_model_make(const scene *sc, const model *m, int r, certificate_model *out);
void certificate_model_free(certificate_model *c);

/* A certificate without claims of the orbit of k periods at omega, whose response has that amplitude, to json_decref;
 * NULL: out of memory. */
json_t *certificate_of(const certificate_model *c, double omega, int k, double amplitude, const orbit_events *e);

/* Has this certificate the case's model, omega, period and response, text by text? */
bool certificate_is_of(const json_t *certificate, const certificate_model *c, double omega, int k);

/* "O S", the letters of the contacts in each interval; into text[size], with "..." where they do not fit. */
void certificate_letters(const json_t *certificate, char *text, size_t size);

/* The decimal string `name` (index i of a list, i < 0: itself) rounded down (towards < 0) or up to a double; NaN: there
 * is none. */
double certificate_bound(const json_t *claims, const char *name, int i, int towards);
