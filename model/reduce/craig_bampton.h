/* craig_bampton.h - a large structure on the rows that are kept and its lowest fixed-interface modes (Craig and
 * Bampton, Coupling of Substructures for Dynamic Analyses, AIAA Journal 6, 1968), and what the modes that are left out
 * would add.
 *
 * Rows: b are kept, i the others. In x = T q, q = (x_b, a): x_i = Psi x_b + Phi a,
 *     K_ii Psi = -K_ib,    K_ii phi = lambda M_ii phi,    Phi^T M_ii Phi = 1.
 * With all modes the model is exact. Where K_ii is singular there is a motion that leaves the kept rows, and so all
 * contacts, at rest: nothing holds it, and such structures are refused. */
#pragma once

#include "model/casefile/structure.h"
#include "model/reduce/factor.h"
#include "numerics/base/workspace.h"

typedef struct craig_bampton {
  int n, n_kept, n_modes; /* rows of the large structure; of those kept; modes found so far */
  bool whole;             /* there are no more modes */
  int *kept;              /* [n_kept] which rows, ascending */
  bool *held;             /* [n] kept, or without an entry anywhere: nothing moves them */
  factor *inner;          /* of K_ii */
  double *K, *M;          /* [n_kept][n_kept] of (1, Psi) */
  double *share;          /* [most modes][n_kept] phi^T (M_ib + M_ii Psi), the modes' part in M */
  double *lambda, *phi;   /* [most modes], [most modes][n] ascending */
  double *T_b;            /* [n_kept][n] (1, Psi); kept for a damping matrix, else NULL */
  double *first, *second; /* [n_kept][n_kept] sums over all modes of share share^T/lambda and share share^T/lambda^2 */
  workspace memory;       /* of all that are as long from the start */
} craig_bampton;

/* The reduction of s, which is_sparse, with the rows kept[n_kept], ascending, without modes as yet. HC_SINGULAR where
 * nothing holds the others; HC_NO_MEMORY. */
hc_status craig_bampton_new(const scene_structure *s, int n_kept, const int *kept, craig_bampton **out);
void craig_bampton_free(craig_bampton *cb);

/* `more` modes, or as many as there are. HC_NO_MEMORY, HC_NOT_CONVERGED. */
hc_status craig_bampton_more(craig_bampton *cb, const scene_structure *s, int more);

/* The structure of the kept rows and the first `modes` modes, with the loads, contacts, responses and damping of s, to
 * free with structure_free: its matrices are dense, its damping is resolved. HC_NO_MEMORY, or as
 * structure_resolve_damping. */
hc_status craig_bampton_structure(const craig_bampton *cb, const scene_structure *s, int modes, scene_structure **out);

/* R[n_kept][n_kept], what the modes left out would add to the kept rows' dynamic stiffness at omega:
 *     R = -w^2 sum_k share_k share_k^T / (lambda_k - w),    w = omega^2,
 * over those behind `modes`, from the first two terms of the series in w/lambda_k, of which the second one stands for
 * the rest, too: an upper bound. Damping is left out of it. False where it is none: w has passed the first of them. */
bool craig_bampton_rest(const craig_bampton *cb, int modes, double omega, double *R);
