/* transitions.h - when a contact sticks, slips and separates over a period of a given motion, located to rounding
 * error. Needs libm only; allocates nothing.
 *
 * Every guard of the contact law (model/contact_law.h) is linear in the motion, so it is a trigonometric polynomial
 * f(th) plus a constant:
 *     contact   g   = v + gap                                                separation where g falls through 0
 *     stick(s)  q_s = mu N - s (kt u - held),   held = kt w                  slip(s) where q_s falls through 0
 *     slip(s)   r_s = s kt u' - mu kn v'                                     stick where r_s falls through 0
 *
 * A crossing is searched between neighbouring angles of a grid. No crossing is missed, double roots (grazing)
 * included: an interval is dismissed only if max|f''| proves it empty, else it is divided at its extremum or in the
 * middle (numerics/crossing.h). */
#pragma once

#include "hbm/contact/contact_report.h"
#include "model/moving_contact.h"
#include "numerics/base/status.h"
#include "numerics/series.h"

/* An interval of the period in one state. */
typedef struct contact_interval {
  double from, to;                  /* [rad] from < to <= from + 2 pi */
  contact_state state;              /* never CONTACT_SEPARATED: an angle that no interval covers is separated */
  double held;                      /* [force] kt w while stuck */
  double origin;                    /* [rad] where the slider came to rest: d held = sum held_by_x[d] dx_d(origin) */
  double held_by_x[SERIES_MAX_DIM]; /* [force/length] all 0 where the motion does not change held */
  int transitions;                  /* changes of state in the search so far, to recognise chatter */
} contact_interval;

/* [length] The largest sum of |coefficients| of a motion. The search multiplies motions and their derivatives, up to
 * 200^2 times larger, with each other; what overflowed there would be no transition, and the contact separated without
 * a word. */
#define TRANSITIONS_LARGEST 1e140

/* The intervals of one period, ascending, into interval[cap]; *n of them. Where contact is never lost the slider
 * starts at c->rest. HC_CHATTER: more than cap intervals, or 64 (H + 1) changes
 * of state. HC_NOT_CLOSED: the slider is not where it was a period before. HC_NOT_FINITE: a guard overflows. */
hc_status transitions_find(const series_grid *grid, const moving_contact *c, int cap, contact_interval *interval,
                           int *n);

/* What happens to a contact with a slider and these intervals of one period. */
contact_report transitions_report(int n, const contact_interval *interval);

/* The interval at th [rad], between -2 pi and 4 pi; NULL: the contact is separated then. */
const contact_interval *contact_interval_at(int n, const contact_interval *interval, double th);

/* dT by the normal motion while it slips, else by the tangential one [force/length]; 0 without friction. */
static inline double contact_interval_stiffness(const contact *law, const contact_interval *at)
{
  const int slip = contact_slip_sign(at->state);
  if (!contact_has_friction(law)) return 0;
  return slip ? slip * law->mu * law->kn : law->kt;
}

/* Does a slider hold the contact in that interval, or in none (NULL)? */
static inline bool contact_interval_holds(const contact *law, const contact_interval *at)
{
  return at && !contact_slip_sign(at->state) && contact_has_friction(law);
}

/* T [force] at an instant of that interval, or of none: kt u less held while stuck, +-mu N while it slips. */
double contact_interval_traction(const contact *law, const contact_interval *at, double u, double normal);
