/* integrate_private.h - the base of integrators; for integrate*.c alone. */
#pragma once

#include "timeint/period/integrate.h"

typedef struct integrator_class {
  /* monodromy and watch may be NULL */
  hc_status (*period)(integrator *, const scaled_model *, double *y, double *monodromy, integrate_watch *, void *self);
  hc_status (*dense)(const integrator *, double theta, int order, double *y);
  hc_status (*samples)(const integrator *, int r, double theta, double step, int count, double *x);
  bool (*fourier)(const integrator *, int r, double out[3]);
  bool (*extremes)(const integrator *, int r, double *max, double *min); /* NULL: not available */
  contact_state (*state)(const integrator *, int j, const double *y);    /* NULL: by `track` */
  void (*at_end)(const integrator *, double theta, const double *y, double *rate,
                 contact_state *states);                  /* NULL: by scaled_rhs and `state` */
  hc_status (*tolerance)(integrator *, double tolerance); /* NULL: no tolerance */
  void (*free)(integrator *);
} integrator_class;

/* The sliders of all contacts of the motion y (order 0), or their rates where y is its derivative. turn, unless NULL:
 * callback that sets the direction of contact j, whose slip turns, in its tracks t. */
typedef void integrate_turn(const void *self, int j, contact_track *t);
void integrate_sliders(const contact_track *track, const scaled_model *m, int order, integrate_turn *turn,
                       const void *self, double *y);

/* Transitions of a period above which it is chatter: 1000, or 60 for each contact if that is more. A contact that
 * closes, slips, sticks, slips, sticks and opens has 6 in an oscillation. */
static inline int integrate_most_transitions(int n_contacts) { return n_contacts > 16 ? 60 * n_contacts : 1000; }

/* [tolerance] integrator.scatter of Adams' method, and of BDF, where up to 250 was measured (steady/state.c), 400 next
 * to a fold (r2 at 708.5). */
#define INTEGRATE_ADAMS_SCATTER 50.0
#define INTEGRATE_BDF_SCATTER   1000.0

struct integrator { /* the first member of each kind */
  const integrator_class *does;
  const contact_track *track;   /* [n_contacts] contact states in the current step; NULL for the regularised law */
  long steps, rhs, transitions; /* counts of all finished periods */
  long periods;                 /* number of periods begun */
  double scatter;               /* [tolerance] see integrate_scatter; 0 unless by CVODE */
  bool has_coarse, coarse;      /* a coarse matrix takes less time; the current period's is coarse */
  int flag;                     /* CVODE's last flag other than success */
  const hc_monitor *monitor;    /* not owned; or NULL */
  int unheard;                  /* steps (by CVODE right-hand sides) since the monitor was last called in this period */
};

enum { INTEGRATE_UNHEARD = 4096 };

/* Call after each step, or by CVODE at each right-hand side. false: the monitor, called every INTEGRATE_UNHEARD times,
 * stops the period. */
static inline bool integrate_goes_on(integrator *in)
{
  if (++in->unheard < INTEGRATE_UNHEARD) return true;
  in->unheard = 0;
  return hc_monitor_tick(in->monitor, -1);
}
