/* stretch_flow_impl.h - what a stretch_flow consists of; for stretch_flow.c and stretch_modes.c only. */
#ifndef HC_HBM_STRETCH_FLOW_IMPL_H
#define HC_HBM_STRETCH_FLOW_IMPL_H

#include <complex.h>
#include <gsl/gsl_matrix.h>

#include "hbm/stretch_flow.h"

enum { MOST_STATES = 32 }; /* combinations of contact states that are kept; more replace the oldest */

/* One combination. */
typedef struct decomposition {
  char *key;              /* [n_contacts] contact_state + 1 of each */
  bool usable;            /* else by the matrix exponential */
  int n;                  /* eigenvalues that are followed: real ones and those of positive imaginary part */
  double complex *lambda; /* [n] */
  double *V, *W;          /* [moving][2 n], [2 n][moving] by rows: (dx, dx') = V y, y = W (dx, dx'), and y of eigenvalue
                             k is y[2k] + i y[2k + 1] */
} decomposition;

struct stretch_flow {
  const model *m;
  int n, moving /* 2n */, n_states;
  double unit;            /* [1/time] of velocities */
  double *by_K, *by_C;    /* [n][n] by columns: M^-1 K, M^-1 C */
  double *along, *across; /* [n_contacts][n] M^-1 t_j, M^-1 n_j */
  char *key;              /* [n_contacts] of the stretch */
  double *A;              /* [2n][2n] by columns */
  int kept, oldest;
  decomposition known[MOST_STATES];
  int *pivot;                          /* [2n] */
  double complex *work;                /* [3][2n][2n] and [2n] */
  double *y;                           /* [2 moving][n_states] */
  int n_lasting, *lasting;             /* [moving] of stretch_flow_leave: which of y */
  gsl_matrix *augmented, *exponential; /* [n_states]^2, for what has no eigenvectors; made when needed */
};

/* A of a stretch into f->A. */
void stretch_fill_A(stretch_flow *f, const contact_piece *const *piece);

/* The combination of a stretch, decomposed now or before. HC_NO_MEMORY. */
hc_status stretch_find(stretch_flow *f, const contact_piece *const *piece, const decomposition **out);
void stretch_forget(decomposition *d);

#endif
