/* contact_evaluator.h - what a contact law can be asked, whichever it is and however it is integrated over the period.
 *
 * A contact is evaluated in coordinates x[n_dof] of its own, each a direction of the structure's q; F[n_dof] are the
 * forces on them. What moves a contact is a relative displacement, so one coordinate is enough for a spring, and those
 * of a contact with friction are u and v (or the one that both are multiples of), or u_1, u_2 and v. */
#pragma once

#include "hbm/contact/contact_report.h"
#include "hbm/contact/slider.h"
#include "hbm/contact/transitions.h"
#include "hbm/hbm_settings.h"
#include "model/contact_period.h"

struct planar_cycle;

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
  slider_rule slider; /* of sampled forces */
  const struct hbm_plug_in *plug_in;
} evaluator_settings;

/* A smooth law's derivatives at an instant of the last evaluation's motion, by u', v [force time/length, force/length];
 * and the step [rad] over which they are followed by collocation (numerics/collocation.h) to rounding. */
typedef struct contact_slopes {
  double t_du, t_v, n_v, step;
} contact_slopes;

/* A law in one way of integrating it over the period. F[n_dof][2H+1] [force], X likewise [length]; jac[row + ld col],
 * ld = n_dof (2H+1). */
typedef struct contact_evaluator {
  hc_status (*make)(const contact_coordinates *c, const evaluator_settings *how, void **self);
  void (*free)(void *self); /* NULL is allowed */

  /* F at X; and dF/dX, unless jac is NULL or there is `jacobian`, which then gives it when it is asked for. */
  hc_status (*evaluate)(void *self, const double *X, double *F, double *jac, contact_report *report);
  void (*jacobian)(void *self, double *jac);

  /* [length] The sliders at th = 0 in the last evaluation, one for each contact of the model; and where those of
   * evaluations to come begin that are never lifted off, at first at 0. `start` is NULL for laws without sliders. */
  void (*sliders)(const void *self, double *w);
  void (*start)(void *self, const double *w);

  /* Where forces are exact, the last evaluation's: the intervals in contact, n of them; and the slip of a contact
   * with two tangents, for whoever follows a perturbation along it. NULL where there is none. */
  const contact_interval *(*intervals)(const void *self, int *n);
  const struct planar_cycle *(*in_plane)(const void *self);
  contact_slopes (*slopes)(const void *self, double th, double omega); /* of a smooth law, as it is in contact */

  /* For a law that depends on rates, else NULL: the frequency [rad/time] of evaluations to come; and F's derivative by
   * it at the last one, which derived. */
  void (*at_omega)(void *self, double omega);
  const double *(*by_omega)(const void *self);
} contact_evaluator;

/* Parts of the equations that somebody else puts in the place of ours; it must live as long as the solver. */
typedef struct hbm_plug_in {
  /* Makes *self for the model's contact j, in the place of by->make: its coordinates *x and its evaluator *by, ours at
   * first, may be changed. */
  hc_status (*make)(const struct hbm_plug_in *plug_in, int j, contact_coordinates *x, const placed_contact *c,
                    const evaluator_settings *how, contact_evaluator *by, void **self);
  /* What C is multiplied by in the dynamic stiffness of harmonic h, and the derivative of that by omega, instead of
   * i h omega and i h. NULL: nothing instead. */
  double _Complex (*damping)(int h, double omega, double _Complex *by_omega);
} hbm_plug_in;

/* Of one contact with one tangent, by sampling (aft.c). */
extern const contact_evaluator aft_evaluator;

/* A smooth law's two, without aliasing and sampled; and what it does along u, v [2 n_harm + 1], as contact_measures_of
 * (u_2 is not looked at), epsilon being of rates by angle. Each law has a file. */
#define SMOOTH_EVALUATORS(code, name)                                                                                  \
  extern const contact_evaluator name##_evaluator, name##_sampled_evaluator;                                           \
  hc_status name##_measures_of(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,    \
                               contact_period *out);
CONTACT_SMOOTH_LIST(SMOOTH_EVALUATORS)
#undef SMOOTH_EVALUATORS

/* Joins of rest and slip in a law's response curves (continuation.c): X goes like a root of the distance from them on
 * either side, so that its rate is infinite, and the curve may turn back. */
typedef struct slip_edges {
  double too_short;     /* [1] arc length of steps that suggest one */
  double located;       /* [1] part of omega to which its place can be told */
  int most, bisections; /* edges of a curve; halvings of omega to locate one */
} slip_edges;
