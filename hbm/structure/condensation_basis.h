/* condensation_basis.h - the coordinates of condensation.h, and the structure's matrices in them; private to hbm/. */
#pragma once

#include <stdbool.h>

#include "model/model.h"
#include "numerics/base/workspace.h"

typedef struct condensation_basis {
  int n, dim, rest;   /* dim + rest = n */
  bool modes;         /* y are modes: M and K of the rest are diagonal, and K couples them with q nowhere */
  bool diagonal;      /* C of the rest is, too */
  double *rows;       /* [dim][n]: q = rows x, where there is a rest */
  double *T;          /* [n][n] by columns: x = T (q, y) */
  double *M, *C, *K;  /* [n][n] by columns: T^T M T, ... */
  double *directions; /* [n_contacts][2][dim]: tangent and normal in q */
  double *loads;      /* [n_loads][2][n]: T^T of cosine and sine */
  double *responses;  /* [n_responses][n]: T^T of each */
  double *rounding;   /* [dim] [force/length] of the mean forces on all q together, for q_d = 1 */
  workspace memory;
} condensation_basis;

/* HC_NO_MEMORY; HC_SINGULAR: what is left when all contacts are held can move freely, or M is not positive definite.
 * condensation_basis_clear in any case. */
hc_status condensation_basis_make(const model *m, condensation_basis *out);
void condensation_basis_clear(condensation_basis *b);
