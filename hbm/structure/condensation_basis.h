/* condensation_basis.h - the coordinates of condensation.h, and the structure's matrices in them; private to hbm/. */
#pragma once

#include <stdbool.h>

#include "model/model.h"
#include "numerics/base/workspace.h"

typedef struct condensation_basis {
  int n, dim, rest;   /* dim + rest = n */
  bool modes;         /* y are modes: their blocks of M and K are diagonal, and K does not couple them with q */
  bool diagonal;      /* the rest's block of C is diagonal, too */
  double *rows;       /* [dim][n]: q = rows x; used only if rest > 0 */
  double *T;          /* [n][n] by columns: x = T (q, y) */
  double *M, *C, *K;  /* [n][n] by columns: T^T M T, ... */
  double *directions; /* [n_contacts][2][dim]: tangent and normal in q */
  double *loads;      /* [n_loads][2][n]: T^T times cosine and sine */
  double *responses;  /* [n_responses][n]: T^T times each response */
  double *rounding;   /* [dim] [force/length] condensation_rounding */
  workspace memory;
} condensation_basis;

/* HC_NO_MEMORY; HC_SINGULAR: K has a rigid-body motion with q fixed, or M is not positive definite. Call
 * condensation_basis_clear in any case. */
hc_status condensation_basis_make(const model *m, condensation_basis *out);
void condensation_basis_clear(condensation_basis *b);
