/* monodromy_impl.h - what monodromy.c and planar_monodromy.c share. */
#ifndef HC_HBM_MONODROMY_IMPL_H
#define HC_HBM_MONODROMY_IMPL_H

#include <complex.h>

#include "hbm/planar/planar_flow.h"
#include "hbm/stability/interval_flow.h"
#include "hbm/stability/monodromy.h"
#include "numerics/floquet.h"

/* A circle while a perturbation is followed: its interval on the current interval and on the one before, NULL while
 * separated. */
typedef struct planar_track {
  const planar_cycle *cycle;
  const planar_interval *interval, *before;
} planar_track;

struct monodromy {
  int n;            /* degrees of freedom */
  int n_states;     /* 2 n + contacts */
  int cap;          /* of boundary */
  double *boundary; /* [cap] [rad] every angle at which a contact changes state, ascending */
  int columns;      /* of phi that count */
  double *phi;      /* [n_states][n_states] by rows */
  double *left;     /* [n_states][n_states] of interval_flow_left */
  double *share;    /* [n_states] */
  interval_flow *flow;
  const contact_interval **interval; /* [n_states] of each contact, on the current interval; NULL while separated */
  int *active;                       /* [n_states] the initial states that the multipliers are made of */
  planar_flow *circles;              /* NULL: the model has none */
  planar_track *track;               /* [contacts] of each circle, at its first contact; a cycle is NULL elsewhere */
  planar_slipping *slipping;         /* [contacts] the circles that slip on the current interval */
  int *slider;                       /* [n_states] of interval_flow_leave, and which of them go on */
  bool *goes_on;
  double complex *lambda; /* [n_states] */
  floquet *floquet;
};

/* The interval of contact j that covers th, NULL while separated. */
const contact_interval *monodromy_interval_at(const contact_forces *orbit, int j, double th);

/* Initial states dheld of the sliders at rest when the period starts, behind the first n_active; their number then. */
int monodromy_initial_sliders(monodromy *w, const model *m, const contact_forces *orbit, int n_active, double th);

/* Sliders that come to rest at th: dheld from dx there. */
void monodromy_set_sliders(monodromy *w, const model *m, const contact_forces *orbit, double th);

/* With circles: over the period from boundary 0 = 0 rad to boundary n - 1 = 2 pi: w->phi, and the states
 * in w->active that count; their number. Errors of interval_flow_advance and planar_flow_advance. */
hc_status monodromy_follow_planar(monodromy *w, const model *m, const contact_forces *orbit, double omega, int n,
                                  int *n_active);

#endif
