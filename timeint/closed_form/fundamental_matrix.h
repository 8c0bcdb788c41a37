/* fundamental_matrix.h - the monodromy matrix of a period of the exact law of a structure, from one change of contact
 * state to the next. In an interval a variation of the motion obeys the same linear equation without its loads
 * (series_columns.h, or complex modes where that is less work); all forces are continuous, so that a transition
 * changes no column but in the rows of sliders that begin to stick there (contact_track.h). A slip that turns has an
 * angle, e = (cos phi, sin phi), that varies, too: dphi = (dU - dW).e_perp/R where it begins, and
 *     dW = dU - dR e - R e_perp dphi
 * where it sticks again. Meanwhile the motion itself is integrated once more, by its series, beside its columns.
 *
 * Of a base with slowed modes (modal_base.h) there are columns of the others and of sliders alone: slowed modes follow
 * these at theta = 0 as springs do, and what they deviate from that dies away in a period; its columns are 0. */
#pragma once

#include "timeint/closed_form/interval_modes.h"
#include "timeint/closed_form/motion_series.h"
#include "timeint/closed_form/series_columns.h"

/* Columns within an interval from its complex modes (interval_modes.h), over any span at once:
 *
 *     eta_k = by_x . D + by_v . D' - eta_k of where sliders that stick hold the variation
 *     D += sum_k Re V_k (e^{mu_k span} - 1) eta_k,   D' = sum_k Re V_k mu_k e^{mu_k span} eta_k */
typedef struct modes_columns {
  int n, n_columns;      /* modes of the structure; the most columns */
  double *change, *rate; /* [2 n][2][n_columns] real and imaginary parts */
} modes_columns;

typedef struct fundamental_matrix {
  int n, n_states;       /* modes; 2 n + contacts */
  double safe;           /* [reach of the motion] the length of a step in which slip turns */
  double theta;          /* up to which `rows` has come */
  int n_columns, *state; /* [n_states] the first of them: states that the motion depends on, ascending */
  double *rows;          /* [n_states][n_states] row i is that of state i, column q that of state[q]; a slider's row is
                   valid while its contact sticks; while a slip turns that of its first is that of e's angle */
  double *du[2], *dv;    /* [n_states] of a contact, all columns */
  int n_slowed;          /* modes of the base that are, */
  int *fast;             /* [n_slowed] which, */
  double *spring;        /* [n_slowed][n_slowed] their stiffness with contacts as they begin; factored */
  double *follow;        /* [n_states][n_slowed] what they do where a state is 1 */
  int *pivot;            /* [n_slowed] */
  double *y;             /* [2 n] the motion at `theta`, and its contacts, */
  contact_track *track;  /* [n_contacts] where a slip turns */
  motion_series motion;  /* of that */
  series_columns series;
  modes_columns by_modes;
  interval_modes *modes; /* the owner's, or NULL */
} fundamental_matrix;

/* With complex modes where `modes` is not NULL and they pay. Arrays are memory's. HC_NO_MEMORY. */
hc_status fundamental_matrix_make(fundamental_matrix *v, const modal_base *base, interval_modes *modes,
                                  workspace *memory);

/* The identity at theta = 0, contacts as they begin there at y[n_states]; coarse: good to 1e-6 a step alone, as
 * those with slowed modes are to 1e-5.
 * HC_SINGULAR: slowed modes are no springs. */
hc_status fundamental_matrix_begin(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                                   const double *y, bool coarse);

/* From v->theta on the motion is that of y[2 n], its contacts those of track[]: whenever one has changed its state. */
void fundamental_matrix_follow(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                               const double *y);

/* On to theta, the contacts as they were. HC_NOT_FINITE, HC_NO_MEMORY. */
hc_status fundamental_matrix_advance(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                                     double theta);

/* At v->theta contact j, its tracks `before` up to there, has come to after[], at that motion. */
void fundamental_matrix_pass(fundamental_matrix *v, const scaled_model *m, int j, const contact_track *before,
                             const contact_track *after, const contact_motion *at);

/* The rows of sliders that are tied to the motion y[2 n], when the period is over. */
void fundamental_matrix_end(fundamental_matrix *v, const scaled_model *m, const contact_track *track, const double *y,
                            double *monodromy);
