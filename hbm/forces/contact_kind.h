/* contact_kind.h - the contact laws as the equations see them: one row of a table for each, chosen where contacts are
 * taken up, and not asked for again. A new law is one more evaluator or two (contact_evaluator.h) in a file of its own,
 * and a row in contact_kind.c. */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "model/contact_period.h"

typedef struct contact_kind {
  int contacts; /* of the model that are evaluated together */
  void (*coordinates)(const placed_contact *c, int dim, contact_coordinates *out);
  const contact_evaluator *exact, *sampled;
  /* out[contacts]: what the exact law does along the motion u, u_2 (NULL of one tangent), v [2 n_harm + 1]. */
  hc_status (*measures)(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,
                        contact_period *out);
  const slip_edges *edges; /* NULL: its curves have none */
} contact_kind;

const contact_kind *contact_kind_of(const placed_contact *c);

/* The joins of rest and slip that curves of m may have; NULL: none. */
const slip_edges *contact_edges_of(const model *m);

/* Contact j of the model, whose directions are left to be set but for a second one of two tangents under one limit.
 * Without friction two tangents share none, and each is a spring. */
placed_contact placed_contact_of(const model *m, int j);
