/* contact_period.h - measures of a contact over one period of a motion. Filled by hbm/contact/contact_measures.h from a
 * given motion, and by timeint/steady/contact_watch.h during time integration. */
#pragma once

#include "model/contact_law.h"
#include "model/model.h"

typedef struct contact_period {
  contact_regime regime;
  double normal_min, normal_max; /* [force] extrema of the normal force N >= 0 */
  double traction_max;           /* [force] the largest |T| */
  double slip_distance;          /* [length] path of the slider over the surface while it slips */
  double work; /* [force length] dissipated by friction: closed integral of T du = integral of mu N |dw| >= 0; with a
                  regularised law, whose T differs, it has that law's error and may be < 0 */
} contact_period;

/* The measures of a pair (model.h) from those of its two halves: the larger regime, the sum of the normal forces, the
 * larger traction, the sums of slip and work. Under the law of the circle each half has the contact's regime and half
 * of its normal force; traction, path and work are all in the first, 0 in the second. */
contact_period contact_period_of_pair(const contact_period *first, const contact_period *second);

/* Merges p[m->n_contacts], one for each contact of the model, into one for each contact of the case: the first
 * model_whole_contacts(m) of p. */
void contact_periods_merge(const model *m, contact_period *p);
