/* contact_period.h - what a contact does over one period of a motion, in numbers. hbm/contact_measures.h fills it from
 * a motion, timeint/contact_watch.h along its own. */
#ifndef HC_CONTACT_PERIOD_H
#define HC_CONTACT_PERIOD_H

#include "model/contact_law.h"

typedef struct contact_period {
  contact_regime regime;
  double normal_min, normal_max; /* [force] extrema of the normal force N >= 0 */
  double traction_max;           /* [force] the largest |T| */
  double slip_distance;          /* [length] path of the slider over the surface while it slips */
  double work; /* [force length] dissipated by friction: closed integral of T du = integral of mu N |dw| >= 0; of a
                  regularised law, whose T is not that, off by its error, perhaps below 0 */
} contact_period;

#endif
