/* planar_force_impl.h - the workspace of planar_force.c, and its parts: rows of derivatives where intervals begin
 * (planar_rows.c), and a panel's sums (planar_panel_sums.c). Nobody else includes it. */
#ifndef HC_HBM_PLANAR_FORCE_IMPL_H
#define HC_HBM_PLANAR_FORCE_IMPL_H

#include "hbm/contact/exact_force.h"
#include "hbm/planar/planar_force.h"

struct planar_force {
  int n_harm, n_dof, n_coef, n_size; /* n_size = n_dof n_coef */
  int n_col;                         /* n_size + 2 */
  contact law;                       /* of both halves together */
  exact_force *normal;               /* N - N0 and when there is contact; NULL where N is constant */
  double *F_normal, *jac_normal;     /* [n_coef], [n_coef]^2 */
  double *X;                         /* [n_size] of the last evaluation, which its motion is read from later, too */
  planar_motion motion;
  double *table; /* of series_grid.h */
  planar_point grid[PLANAR_GRID];
  collocation rule;
  planar_contact *contact; /* [cap] */
  planar_cycle cycle;
  contact_interval *intervals;         /* [cycle.cap] its intervals, for contact_evaluator.h */
  double *indicator, *symbol, *weight; /* [4H+1] of an interval, of all stick intervals; [2H+1] */
  double *F;                           /* [2][n_coef] [length] of T/kt */
  double *by;                          /* [2][n_coef][n_col] its derivatives */
  double *dw[2], *dphi;                /* [n_col] */
  double *node;                        /* [3][N][n_col] d phi at the points of a panel; d(R e) there, with weights */
  double *matrix;                      /* [n_coef]^2 */
  double *base, *rate;                 /* [N][n_coef] 1, cos, sin at the points, and their derivatives */
  double *test;                        /* [n_coef][N] what is integrated with: 1/2, cos, sin */
};

/* ---- rows of derivatives [n_col]: by the columns of X and by w0 ---- */

/* 1, cos, sin .. of h th; and their derivatives by th. [n_coef] */
void planar_row_base(int n_harm, double th, double *base, double *rate);

void planar_row_clear(const planar_force *f, double *row);

/* to += a du_1 + b du_2 + c dv, base being that of an angle: derivatives of a combination of the motions there. */
void planar_row_add(const planar_force *f, const double *base, double a, double b, double c, double *to);

/* From what was before into interval i, whose derivatives are then in dw or dphi; base and rate become those of its
 * angle. */
void planar_row_begin(planar_force *f, int i, double *base, double *rate);

/* From slip in direction phi into rest: d w = du - dR e - R e_perp d phi. */
void planar_row_rest(planar_force *f, const double *base, double phi, double R);

/* ---- slip ---- */

/* += a panel's integrals over pi of R e with 1/2, cos, sin .. of h th, into F; if wanted with their derivatives, into
 * by, dphi being those of phi where it begins, and then where it ends. */
void planar_panel_sums(planar_force *f, const planar_panel *p, bool derive);

#endif
