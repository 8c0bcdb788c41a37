/* contact_kind.h - the contact laws as the equations see them: one row of a table for each, chosen where contacts are
 * taken up, and not asked for again. A new law is one more evaluator or two in a file of its own, and a row in
 * contact_kind.c.
 *
 * A contact is evaluated in coordinates x[n_dof] of its own, each a direction of the structure's q; F[n_dof] are the
 * forces on them. What moves a contact is a relative displacement, so one coordinate is enough for a spring, and those
 * of a contact with friction are u and v (or the one that both are multiples of), or u_1, u_2 and v. */
#ifndef HC_HBM_CONTACT_KIND_H
#define HC_HBM_CONTACT_KIND_H

#include "hbm/circle_cycle.h"
#include "hbm/contact_report.h"
#include "hbm/hbm_settings.h"
#include "hbm/transitions.h"
#include "model/contact_period.h"

enum { EVALUATOR_MOST_DOF = 3 };

/* x_d = direction[d] . q/divisor[d]. `moved`: the law (of a pair either half's), and of one tangent how x moves it. */
typedef struct contact_coordinates {
  int n_dof; /* 1..EVALUATOR_MOST_DOF */
  const double *direction[EVALUATOR_MOST_DOF];
  double divisor[EVALUATOR_MOST_DOF];
  moving_contact moved;
} contact_coordinates;

/* A contact in q[dim]: u = tangent . q, v = normal . q. */
typedef struct placed_contact {
  contact law; /* of a pair under one limit: of one half */
  bool planar; /* this one and the next are the halves of a contact whose two tangents share a limit (model.h) */
  const double *tangent, *tangent_2, *normal; /* [dim] tangent_2 where planar */
} placed_contact;

typedef struct evaluator_settings {
  int n_harm, n_time; /* n_time: of sampled forces */
  hbm_restart restart;
} evaluator_settings;

/* A law in one way of integrating it over the period. F[n_dof][2H+1] [force], X likewise [length]; jac[row + ld col],
 * ld = n_dof (2H+1). */
typedef struct contact_evaluator {
  hc_status (*make)(const contact_coordinates *c, const evaluator_settings *how, void **self);
  void (*free)(void *self); /* NULL is allowed */

  /* F at X; and dF/dX, unless jac is NULL or there is `jacobian`, which then gives it when it is asked for. */
  hc_status (*evaluate)(void *self, const double *X, double *F, double *jac, contact_report *report);
  void (*jacobian)(void *self, double *jac);

  /* [length] The sliders at th = 0 in the last evaluation, one for each contact of the model. */
  void (*sliders)(const void *self, double *w);

  /* Of exact forces, the last evaluation's: the intervals in contact, n of them; and the slip of a contact with two
   * tangents, for whoever follows a perturbation along it. NULL where there is none. */
  const contact_piece *(*intervals)(const void *self, int *n);
  const circle_cycle *(*planar_slip)(const void *self);
} contact_evaluator;

typedef struct contact_kind {
  int contacts; /* of the model that are evaluated together */
  void (*coordinates)(const placed_contact *c, int dim, contact_coordinates *out);
  const contact_evaluator *exact, *sampled;
  /* out[contacts]: what the exact law does along the motion u, u_2 (NULL of one tangent), v [2 n_harm + 1]. */
  hc_status (*measures)(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,
                        contact_period *out);
} contact_kind;

const contact_kind *contact_kind_of(const placed_contact *c);

/* Contact j of the model, whose directions are left to be set but for a second one of two tangents under one limit.
 * Without friction two tangents share none, and each is a spring. */
placed_contact placed_contact_of(const model *m, int j);

#endif
