/* state_sizes.h - sizes of the states of scaled.h, relative to the motions they cause: the common scale of tolerances,
 * distances between states and widths of corners in N.
 *
 * The relevant motions (rows) are u_j, v_j of contacts and the responses: row b moves by b . q. Its size is the larger
 * of
 *     vibration   amplitude (max - min)/2 on the orbit, once known; before, the largest |(b q, b p)| of states so far,
 *                 or the quasi-static response to the alternating loads, contacts open:
 *                 sum_i |b_i| |p_i|/(omega_i^2 + omega^2)
 *     own         a length of the contact's law (contact_length)
 * relative to the largest vibration of all rows. A row that moves by rounding only is ignored. State i, q_i or p_i, has
 * the size
 *     s_i = L min over rows of size/|b_i|,   slider j: L times the size of u_j
 * so that a change of one state by s_i changes no row by more than its size. Three limits:
 *     - at most L, the size of the whole motion: then all states have one tolerance;
 *     - sizes are divided by STATE_SIZES_ALIKE: rows of up to 30 times smaller motion get no smaller size, since steps
 *       have 1e-3 of the required tolerance;
 *     - at least the rounding of the state's own motion. */
#pragma once

#include "model/model.h"
#include "numerics/base/workspace.h"
#include "timeint/law/modal_base.h"

#define STATE_SIZES_ALIKE (1.0 / 30)

typedef struct state_sizes {
  int n, n_contacts, n_rows; /* rows: u of all contacts, v of all contacts, responses */
  double *vibration, *own;   /* [n_rows] [length] */
  double *of;                /* [2 n + n_contacts] [L] sizes s_i */
} state_sizes;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status state_sizes_make(state_sizes *s, const modal_base *base, workspace *memory);

/* Initial sizes at omega [rad/time], from loads and laws alone. */
void state_sizes_begin(state_sizes *s, const modal_base *base, const model *m, double omega);

/* Updates vibrations with the state y (X and P of scaled.h, L = length); true if one has more than doubled. */
bool state_sizes_see(state_sizes *s, const modal_base *base, double length, const double *y);

/* Computes s->of at y. rounding [1]: least s_i, relative to state i's own motion. */
void state_sizes_find(state_sizes *s, const modal_base *base, double rounding, const double *y);

/* [L] Bound of the change of row r if one state changes by s_i. */
double state_sizes_unit(const state_sizes *s, int r);

/* [length] The size of u_j, along which slider j moves. */
double state_sizes_slider(const state_sizes *s, int j);

/* Norm of z with z[i] in units of size[i]; norm of a - b. */
double state_sizes_norm(int n, const double *size, const double *z);
double state_sizes_distance(int n, const double *size, const double *a, const double *b);
