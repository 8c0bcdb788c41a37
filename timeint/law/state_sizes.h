/* state_sizes.h - how much each state of scaled.h may change before something that matters changes by its own size: the
 * one measure of tolerances, distances between states and corners in N.
 *
 * What matters are the motions u_j, v_j of contacts and the responses: row b of them moves by b . q. Its size is the
 * largest of
 *     vibration   the alternating part of its motion: (max - min)/2 on the orbit where that is known; else |(b q, b p)|
 *                 of the states met so far, or what the loads that vibrate do to it without any resonance, all contacts
 *                 open: sum_i |b_i| |p_i|/(omega_i^2 + omega^2)
 *     own         a length of the contact's law (contact_length)
 * relative to the largest vibration of all rows. A row that nothing moves, but for rounding, has no size and counts
 * for nothing. State i, q_i or p_i, has the size
 *     s_i = L min over rows of size/|b_i|,   slider j: L times the size of u_j
 * so that one state that changes by s_i changes no row by more than its share of L. Three limits:
 *     - no more than L, the whole motion's: what has one size keeps one tolerance;
 *     - sizes are divided by STATE_SIZES_ALIKE: rows that move within a factor of 30 of each other are served by the
 *       same steps, whose tolerance is 1e-3 of what is asked for;
 *     - no less than rounding of the state's own motion allows. */
#pragma once

#include "model/model.h"
#include "numerics/base/workspace.h"
#include "timeint/law/modal_base.h"

#define STATE_SIZES_ALIKE (1.0 / 30)

typedef struct state_sizes {
  int n, n_contacts, n_rows; /* rows: u of all contacts, v of all contacts, responses */
  double *vibration, *own;   /* [n_rows] [length] */
  double *of;                /* [2 n + n_contacts] [L] s_i */
} state_sizes;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status state_sizes_make(state_sizes *s, const modal_base *base, workspace *memory);

/* At omega [rad/time], where nothing is known of the motion. */
void state_sizes_begin(state_sizes *s, const modal_base *base, const model *m, double omega);

/* The motion comes to y, X and P of scaled.h in lengths L = length: true if a vibration has doubled by that. */
bool state_sizes_see(state_sizes *s, const modal_base *base, double length, const double *y);

/* `of`, at y. rounding [1]: the least s_i, relative to state i's own motion. */
void state_sizes_find(state_sizes *s, const modal_base *base, double rounding, const double *y);

/* [L] By no more than this row r changes where one state does by s_i. */
double state_sizes_unit(const state_sizes *s, int r);

/* [length] The size of u_j, along which slider j moves. */
double state_sizes_slider(const state_sizes *s, int j);

/* |z|, z[i] in units of size[i]; and of a - b. */
double state_sizes_norm(int n, const double *size, const double *z);
double state_sizes_distance(int n, const double *size, const double *a, const double *b);
