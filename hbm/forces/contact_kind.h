/* contact_kind.h - the table of contact laws: a row for each, selected when the solver is made; later code does not ask
 * which law it has. A new law is one more evaluator or two (contact_evaluator.h) in a file of its own, and a row in
 * contact_kind.c. */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "model/contact_period.h"

typedef struct contact_kind {
  int contacts; /* number of the model's contacts that are evaluated together */
  void (*coordinates)(const placed_contact *c, int dim, contact_coordinates *out);
  const contact_evaluator *exact, *sampled;
  /* Measures of the exact law along the motion u, u_2 (NULL: one tangent), v [2 n_harm + 1] into out[contacts]. */
  hc_status (*measures)(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,
                        contact_period *out);
  const slip_edges *edges; /* edges of slip of its response curves; NULL: none */
} contact_kind;

const contact_kind *contact_kind_of(const placed_contact *c);

/* The parameters of joins of rest and slip that curves of m may have; NULL: none. */
const slip_edges *contact_edges_of(const model *m);

/* Contact j of the model; the caller sets its directions. planar is false for the second half of two tangents, and
 * without friction, where there is no common limit and each half is a spring. */
placed_contact placed_contact_of(const model *m, int j);
