/* fundamental_matrix.h - the monodromy matrix of a period of the exact law of a structure, from one change of contact
 * state to the next. In an interval a variation of the motion obeys the same linear equation without its loads
 * (series_columns.h, or complex modes where that is less work); all forces are continuous, so that a transition changes
 * no column but in the rows of sliders that begin to stick there (contact_track.h). A slip that turns has a variation
 * dphi of its angle, e = (cos phi, sin phi): dphi = (dU - dW).e_perp/R at its start, and
 *     dW = dU - dR e - R e_perp dphi
 * where it sticks again. During such a slip the motion itself is integrated again, by its series, beside the columns.
 *
 * With slowed modes (modal_base.h) columns exist for the other modes and for sliders only: slowed modes follow these at
 * theta = 0 quasi-statically, as springs; deviations from that decay within a period, so their own columns are 0. */
#pragma once

#include "timeint/closed_form/interval_modes.h"
#include "timeint/closed_form/motion_series.h"
#include "timeint/closed_form/series_columns.h"

/* Columns within an interval from its complex modes (interval_modes.h), over any span at once:
 *
 *     eta_k = by_x . D + by_v . D' - eta_k of where sliders that stick hold the variation
 *     D += sum_k Re V_k (e^{mu_k span} - 1) eta_k,   D' = sum_k Re V_k mu_k e^{mu_k span} eta_k */
typedef struct modes_columns {
  int n, n_columns;      /* number of modes of the structure; capacity */
  double *change, *rate; /* [2 n][2][n_columns] real and imaginary parts */
} modes_columns;

typedef struct fundamental_matrix {
  int n, n_states;       /* number of modes; 2 n + contacts */
  double safe;           /* step length while the slip direction turns, in units of the reach of the motion's series */
  double theta;          /* [rad] angle that `rows` has reached */
  int n_columns, *state; /* number of columns; [n_states] of which n_columns: index of each column's state, ascending */
  double *rows;          /* [n_states][n_states] row i: state i, column q: state[q]. A slider's row is valid while its
                            contact sticks; while a slip turns the row of its first direction is dphi */
  double *du[2], *dv;    /* [n_columns] work: variations of one contact's U, V */
  int n_slowed;          /* number of slowed modes */
  int *fast;             /* [n_slowed] their indices */
  double *spring;        /* [n_slowed][n_slowed] factors of their stiffness, with contacts in their first states */
  double *follow;        /* [n_states][n_slowed] their motion for a unit of each state */
  int *pivot;            /* [n_slowed] of `spring` */
  double *y;             /* [2 n] motion at `theta`; valid if the base has contacts in a plane */
  contact_track *track;  /* [n_contacts] its contacts; valid likewise */
  motion_series motion;  /* series of that motion */
  series_columns series;
  modes_columns by_modes;
  interval_modes *modes; /* not owned; or NULL */
} fundamental_matrix;

/* Complex modes are used if `modes` is not NULL and they are the faster way. Arrays are memory's. HC_NO_MEMORY. */
hc_status fundamental_matrix_make(fundamental_matrix *v, const modal_base *base, interval_modes *modes,
                                  workspace *memory);

/* Starts with the identity at theta = 0, state y[n_states], contacts in track[]. coarse: steps accurate to 1e-6 only
 * (with slowed modes always to 1e-5). HC_SINGULAR: the stiffness of slowed modes is singular. */
hc_status fundamental_matrix_begin(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                                   const double *y, bool coarse);

/* Sets the motion y[2 n] and the contacts track[] at v->theta; call whenever a contact has changed its state. */
void fundamental_matrix_follow(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                               const double *y);

/* Advances to theta with constant contact states. HC_NOT_FINITE, HC_NO_MEMORY. */
hc_status fundamental_matrix_advance(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                                     double theta);

/* Passes a change of contact j at v->theta, at the motion *at, from tracks before[] to after[]. */
void fundamental_matrix_pass(fundamental_matrix *v, const scaled_model *m, int j, const contact_track *before,
                             const contact_track *after, const contact_motion *at);

/* Ends the period at the motion y[2 n]: sets the rows of sliders that follow from it, and copies to monodromy. */
void fundamental_matrix_end(fundamental_matrix *v, const scaled_model *m, const contact_track *track, const double *y,
                            double *monodromy);
