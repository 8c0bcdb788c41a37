/* contact_period.h - what a contact does over one period of a motion, in numbers. hbm/contact/contact_measures.h
 * fills it from a motion, timeint/steady/contact_watch.h along its own. */
#pragma once

#include "model/contact_law.h"
#include "model/model.h"

typedef struct contact_period {
  contact_regime regime;
  double normal_min, normal_max; /* [force] extrema of the normal force N >= 0 */
  double traction_max;           /* [force] the largest |T| */
  double slip_distance;          /* [length] path of the slider over the surface while it slips */
  double work; /* [force length] dissipated by friction: closed integral of T du = integral of mu N |dw| >= 0; of a
                  regularised law, whose T is not that, off by its error, perhaps below 0 */
} contact_period;

/* The contact's, from those of a pair's two (model.h): the larger regime, the sum of the normal forces, the larger
 * traction, the sums of slip and work. Under the law of the circle both halves have the contact's regime and half of
 * its normal force each; the first one has all of traction, path and work, which are the plane's, and the second one
 * 0. */
contact_period contact_period_of_pair(const contact_period *first, const contact_period *second);

/* p[m->n_contacts], one for each contact of the model -> one for each contact of the case: the first
 * model_whole_contacts(m) of p. */
void contact_periods_merge(const model *m, contact_period *p);
