/* variation.h - perturbations of an event-located orbit, from one interval of the period to the next: between two
 * angles at which a contact changes its state. What becomes of them within an interval is another's (interval_flow.h,
 * planar_flow.h, modal_flow.h).
 *
 * The state is (dx, dx', dheld_1, ..., dheld_n); dheld_j counts only while contact j is stuck. Row i of phi is state i,
 * column q a perturbation. While a planar contact sticks the rows of its two halves are dheld = kt dw, while it slips
 * the first's is y = R d phi (planar_flow.h). What they begin with, at fixed th (planar_force.h):
 *     touch-down   sticks dw = du - (dR/R') u', slips y = 0, since R = 0
 *     to slip      y = (du - dw).e_perp
 *     to rest      dw = du - dR e - y e_perp */
#pragma once

#include "hbm/forces/contact_forces.h"
#include "hbm/planar/planar_flow.h"
#include "numerics/base/workspace.h"

typedef struct perturbed_law perturbed_law;

/* A contact while a perturbation is followed; of a planar one the first half. */
typedef struct tracked_contact {
  const perturbed_law *law;
  const planar_cycle *cycle;                /* of a planar one, as below */
  const planar_interval *interval, *before; /* the current one and the one before; NULL while separated */
} tracked_contact;

typedef struct variation {           /* from variation_make, to variation_free */
  const model *m;                    /* the structure in the coordinates of dx */
  int n;                             /* degrees of freedom */
  int n_states;                      /* 2 n + contacts */
  const contact_forces *orbit;       /* of variation_begin */
  double omega;                      /* [rad/time] its frequency */
  int n_intervals;                   /* some are empty: where two contacts change at one angle */
  double *boundary;                  /* [n_intervals] [rad] where they begin, ascending */
  size_t cap;                        /* of boundary */
  int parts;                         /* equal parts of the period whose ends are boundaries, too */
  int columns;                       /* of phi that count */
  double *phi;                       /* [n_states][n_states] by rows */
  const contact_interval **interval; /* [contacts] of each the current interval; NULL while separated */
  int n_slipping;                    /* planar contacts that slip on the current interval */
  planar_slipping *slipping;         /* [contacts] */
  tracked_contact *track;            /* [contacts] */
  int n_active, *active;             /* [n_states] initial states, of variation_find_states */
  workspace memory;                  /* of all arrays but boundary */
} variation;

/* For m, which must live as long. HC_NO_MEMORY: to be freed all the same. */
hc_status variation_make(variation *v, const model *m, int parts);
void variation_free(variation *v);

/* The intervals of that orbit. HC_NO_MEMORY. */
hc_status variation_begin(variation *v, const contact_forces *orbit, double omega);

/* [rad] Where interval i ends, behind 2 pi if it is the last; and is it empty? */
double variation_end(const variation *v, int i);
bool variation_is_empty(const variation *v, int i);

/* Interval i becomes the current one, entered from the one before it; and then its rows of phi begin. */
void variation_enter(variation *v, int i);
void variation_start(variation *v, int i);

/* v->active: the states that the period begins with behind the interval `last`, which is the current one then. */
void variation_find_states(variation *v, int last);

/* slider[]: contacts of one tangent that are at rest over the interval `last`, and matter; sticks_on[]: true if they
 * still are behind it. Their number. `last` is the current interval then. */
int variation_held_sliders(variation *v, int last, int *slider, bool *sticks_on);

/* On the current interval: contact j sticks; it is planar and slips. */
bool variation_sticks(const variation *v, int j);
bool variation_slips(const variation *v, int j);

/* True if all contacts stay stuck or apart all period, and none follows a law that bends. */
bool variation_never_changes(const variation *v);
