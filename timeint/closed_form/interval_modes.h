/* interval_modes.h - the complex modes of a structure in an interval, in which no contact changes its state:
 *
 *     q'' + C q' + (K + K_contacts) q = f(t),  K_contacts of contact_track_forces        in physical time
 *     q = sum_k weight_k Re(V_k eta_k),   eta_k' = lambda_k eta_k + W_k . f
 * k over the real eigenvalues of the first-order equation, weight 1, and one of each pair, weight 2, slowest first.
 * They depend on the contact states, not on omega: each set of states is decomposed once and cached; the set that was
 * requested least recently is overwritten. Eigenvectors nearly dependent (a free body, critical damping): no modes; the
 * motion is then motion_series.h's. */
#pragma once

#include <complex.h>

#include "numerics/base/workspace.h"
#include "timeint/law/contact_track.h"

static inline double complex *complex_array(workspace *w, size_t n)
{
  return workspace_array(w, n, sizeof(double complex));
}

typedef struct complex_modes {
  int count;                      /* number of modes <= 2 n; 0: none for these contact states */
  long asked;                     /* request number of the last use */
  unsigned char *states;          /* [n_contacts] the contact states that it is for */
  double *weight;                 /* [2 n] */
  double *largest;                /* [2 n] max norm of V_k */
  double complex *lambda;         /* [2 n] [1/time] */
  double complex *V;              /* [2 n][n] */
  double complex *by_x;           /* [2 n][n] eta = by_x . q + by_v . q' */
  double complex *by_v;           /* [2 n][n] W, too */
  double complex *u, *v;          /* [2 n][n_contacts] t_j . V_k, n_j . V_k */
  double complex *along, *across; /* [2 n][n_contacts] W_k . t_j, W_k . n_j */
  double complex *response;       /* [2 n][n_responses] r . V_k */
  double complex *load;           /* [2 n][n_loads] W_k . (cosine - i sine) */
  double complex *load_back;      /* [2 n][n_loads] W_k . (cosine + i sine) */
} complex_modes;

typedef struct interval_modes interval_modes;

/* Fastest rate over omega above which modes are less work than series, for up to 16 modes; for more, times (n/16)^2. A
 * set of states then takes about as long as a period by series: 3 ms of 16 modes, 24 ms of 32, 160 ms of 64. */
#define INTERVAL_MODES_STIFF 60.0

/* Modes pay if the fastest rate is more than `stiff` times omega. *out = NULL if they never do: stiff = INFINITY, or
 * more than 64 modes, which take too long. HC_NO_MEMORY. */
hc_status interval_modes_new(const modal_base *base, double stiff, interval_modes **out);
void interval_modes_free(interval_modes *p); /* NULL is allowed */

/* True if modes are less work than series at omega, over a span [rad] of the interval (INFINITY: unknown). False for p
 * = NULL. */
bool interval_modes_pay(const interval_modes *p, double omega, double span);

/* The modes for the contact states track[]. *out is owned by the cache, valid until the next call; NULL: there are
 * none. HC_NO_MEMORY, HC_NOT_FINITE. */
hc_status interval_modes_of(interval_modes *p, const scaled_model *m, const contact_track *track,
                            const complex_modes **out);
