/* comparison_private.h - settings and solvers of one comparison, and what is found of the HBM solution under way; for
 * comparison.c (frequencies and branches), solution.c (the numbers of a row) and remedy.c (what would mend it). */
#pragma once

#include "compare/comparison.h"
#include "numerics/base/workspace.h"

typedef struct comparison_work comparison_work;
struct comparison_work {
  const compare_setup *setup;
  hbm_solver *hbm;
  timeint *ti;
  timeint *exact; /* the referee: exact law, shooting */
  budgeter *budgeter;
  band_search *band_search; /* NULL until a solution has a free slider */
  const hc_monitor *monitor;
  comparison *out;
  workspace memory; /* of the arrays below */
  double *swept;    /* [n_states] where a sweep start has come to */
  double *state;    /* [n_states] of the row under way, on the transient's orbit */
  double *scratch;  /* [n_states] of what else is integrated for it */
  double swept_omega;
  /* [n_responses], of the row under way: the transient's and the orbit's results, what HBM expects of itself, its
   * motion (for the budget), and the budget */
  timeint_result *responses, *orbits;
  motion_error *expected;
  periodic_motion *motions;
  error_budget *budgets;
  band *bands;    /* [n_responses] */
  double *beside; /* [n_coef] a solution that the transient of the row runs on, and the curve has not come to */
  bool looked_beside, has_beside;
  double *moved; /* [2][n_coef] of from_reduction; as long as any solution may be */
  /* [n_contacts] of the model, filled as the case counts them (model_whole_contacts), of the row under way: what the
   * transient's contacts do, where that is HC_OK, and the solution's */
  contact_period *acting, *balanced;
  hc_status acted;
};

/* Solution k of *at against the transient started from it: the row of the first response; in *w what the rows of the
 * others and the contacts are made of. HC_NO_MEMORY, HC_INTERRUPTED: no going on. */
hc_status solution_compare(comparison_work *w, const hbm_curve *at, int k, comparison_row *row);

/* *row becomes that of response r > 0 of the solution whose first row is `first`. HC_NO_MEMORY, HC_INTERRUPTED. */
hc_status solution_turn(comparison_work *w, const hbm_curve *at, int k, int r, const comparison_row *first,
                        comparison_row *row);

/* c[model_whole_contacts]: of the same solution X. HC_NO_MEMORY. */
hc_status solution_contacts(comparison_work *w, const double *X, const comparison_row *row, contact_comparison *c);
