/* integrate_private.h - what an integrator is made of; for integrate*.c alone. */
#pragma once

#include "timeint/period/integrate.h"

typedef struct integrator_class {
  /* monodromy, watch: or NULL */
  hc_status (*period)(integrator *, const scaled_model *, double *y, double *monodromy, integrate_watch *, void *self);
  hc_status (*dense)(const integrator *, double theta, int order, double *y);
  hc_status (*samples)(const integrator *, int r, double theta, double step, int count, double *x);
  bool (*fourier)(const integrator *, int r, double out[3]);
  bool (*extremes)(const integrator *, int r, double *max, double *min); /* NULL: cannot tell */
  contact_state (*state)(const integrator *, int j, const double *y);    /* NULL: as `track` says */
  void (*at_end)(const integrator *, double theta, const double *y, double *rate,
                 contact_state *states);                  /* NULL: as below */
  hc_status (*tolerance)(integrator *, double tolerance); /* NULL: it has none */
  void (*free)(integrator *);
} integrator_class;

/* The sliders of all contacts of the motion y (order 0), or their rates where y is its derivative. `turn`, unless NULL,
 * sets the direction of contact j, whose slip turns, in its tracks t. */
typedef void integrate_turn(const void *self, int j, contact_track *t);
void integrate_sliders(const contact_track *track, const scaled_model *m, int order, integrate_turn *turn,
                       const void *self, double *y);

/* Transitions of a period beyond which it is chatter: 1000, or 60 a contact if that is more. One that closes, slips,
 * sticks, slips, sticks and opens makes 6 an oscillation. */
static inline int integrate_most_transitions(int n_contacts) { return n_contacts > 16 ? 60 * n_contacts : 1000; }

/* [tolerance] integrator.scatter by Adams' method; and by BDF, where up to 250 was seen (steady/state.c), 400 next to a
 * fold (r2 at 708.5). */
#define INTEGRATE_ADAMS_SCATTER 50.0
#define INTEGRATE_BDF_SCATTER   1000.0

struct integrator { /* the first member of each kind */
  const integrator_class *does;
  const contact_track *track;   /* [n_contacts] of the step under way by the exact law; NULL: not kept */
  long steps, rhs, transitions; /* of all finished periods */
  long periods;                 /* begun */
  double scatter;               /* [tolerance] by how much a period may be off, cut into other steps; by CVODE */
  bool has_coarse, coarse;      /* a coarse matrix takes less; the one under way is coarse */
  int flag;                     /* CVODE's last flag other than success */
  const hc_monitor *monitor;    /* the caller's, or NULL */
  int unheard;                  /* steps, or right-hand sides by CVODE, since it was asked in this period */
};

enum { INTEGRATE_UNHEARD = 4096 };

/* After each step, or at each right-hand side by CVODE. false: the monitor, asked once in INTEGRATE_UNHEARD of them,
 * stops the period. */
static inline bool integrate_goes_on(integrator *in)
{
  if (++in->unheard < INTEGRATE_UNHEARD) return true;
  in->unheard = 0;
  return hc_monitor_tick(in->monitor, -1);
}
