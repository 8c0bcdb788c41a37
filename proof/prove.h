/* prove.h - the whole decision about one certificate, and its words. */
#pragma once

#include "proof/orbit.h"

typedef struct decision {
  failure failure;       /* no reason: accepted */
  bool exists;           /* at both radii       */
  quantities quantities; /* what is proven      */
} decision;
void decision_init(decision *v);
void decision_clear(decision *v);

/* Does the theorem hold as claimed? In this order: existence, sequence, stability, quantities, claims. inverse: of
 * dF/dy, of any quality, [unknowns][unknowns]; NULL: made here. */
bool prove(const certificate *c, const double *inverse, decision *v);
