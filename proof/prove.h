/* prove.h - the decision about one certificate. */
#pragma once

#include "proof/orbit.h"

typedef struct decision {
  failure failure;       /* empty reason: accepted */
  bool exists;           /* proven at both radii */
  quantities quantities; /* proven bounds */
} decision;
void decision_init(decision *v);
void decision_clear(decision *v);

/* True if the theorem holds as claimed. Order: existence, sequence, stability, quantities, claims. inverse:
 * [unknowns][unknowns], an approximate inverse of dF/dy of any quality; NULL: computed here. */
bool prove(const certificate *c, const double *inverse, decision *v);
