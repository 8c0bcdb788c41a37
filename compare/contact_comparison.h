/* contact_comparison.h - one contact in one HBM solution, and in the transient that the solution is held against: a
 * friction damper is bought for its work, and a motion that agrees does not say that this does. */
#ifndef HC_CONTACT_COMPARISON_H
#define HC_CONTACT_COMPARISON_H

#include <stdbool.h>

#include "base/status.h"
#include "compare/response.h"
#include "model/contact_period.h"
#include "model/model.h"

typedef struct contact_comparison {
  double omega;
  int branch, contact;      /* counted from 0, as in the case: a pair is one */
  char name[RESPONSE_NAME]; /* of the contact, or empty */
  char verdict[24];         /* of the solution, in words */
  bool one_orbit;           /* the transient runs on the solution's orbit: else the two are not held together */
  hc_status hbm_status, transient_status;
  contact_period hbm, transient; /* by the exact law along the solution; by the transient's own. Valid where HC_OK */
  /* [1] |difference| of the work, relative to the largest of any contact on either side; of the least normal force,
   * to this contact's largest, NaN where a slider is free: N may be a matter of history then. NaN: not known. */
  double work_error, normal_error;
  bool differs; /* one orbit, and an error beyond the gate's waveform, or one side never touches */
} contact_comparison;

/* In c[n], all contacts of one solution, filled so far but for the last three; `contacts` are the model's, where a pair
 * is two. allowed: [1] what an error may be.
 * Where no contact dissipates more than 1e-6 of what its spring holds, work is measured by that: nobody measures a loss
 * factor below. Stick and slip are told apart by the work alone: a graze is no disagreement. */
void contact_comparison_judge(int n, const model_contact *contacts, double allowed, bool mean_free,
                              contact_comparison *c);

/* Are the two sides held together: does `differs` say something? */
bool contact_comparison_made(const contact_comparison *c);

/* "contact slider: stick by HBM, slip by the transient; work 0 and 0.3", "contact slider: work 1.2 by HBM, 1.4 by the
 * transient, 14 % of the largest apart: so is the damping". One line in text[CONTACT_COMPARISON_TEXT], which is
 * returned; of one that differs. */
enum { CONTACT_COMPARISON_TEXT = 192 };
const char *contact_comparison_text(const contact_comparison *c, char text[CONTACT_COMPARISON_TEXT]);

#endif
