/* condensation_impl.h - what condensation.c and condensation_change.c share. */
#ifndef HC_HBM_CONDENSATION_IMPL_H
#define HC_HBM_CONDENSATION_IMPL_H

#include <stddef.h>

#include "hbm/structure/compliance.h"
#include "hbm/structure/condensation.h"
#include "hbm/structure/condensation_basis.h"

struct condensation {
  const model *m;
  int n_harm;
  condensation_basis basis;
  compliance *compliance; /* of a large structure; NULL: there is none */
  double more_mass;       /* [1/mass] n/trace M */
  /* at the omega asked for last; of harmonic h at [h] */
  double omega, more_damping;
  bool known;
  bool *by_compliance;     /* [n_harm + 1] the harmonic is by it */
  double complex *motion;  /* [n_loads][dim] of q under a load, nothing else acting, where it is */
  double complex *room;    /* [2 n_loads][dim] */
  double complex *vector;  /* [2][dim + rest] of condensation_change.c */
  double complex *S;       /* [n_harm + 1][dim][dim] */
  double *size;            /* [dim][dim] of the harmonic asked for last */
  double complex *by_q;    /* [n_harm + 1][dim][rest]: Z_yy^-1 Z_yq */
  double complex *by_y;    /* [n_harm + 1][dim][rest]: (Z_qy Z_yy^-1)^T */
  double complex *load;    /* [n_loads][dim] */
  double complex *rest_of; /* [n_loads][rest]: Z_yy^-1 p_y */
  double complex *Zyy;     /* [rest][rest] where it is not diagonal; else [rest], its inverse */
  int *pivot;              /* [rest] */
};

/* What Z is at h: K + (alpha M + beta C) with these. */
static inline condensation_change condensation_dynamic(const condensation *c, int h)
{
  const double w = h * c->omega;
  return (condensation_change){-w * w + I * (w * c->more_damping * c->more_mass), I * w};
}

static inline size_t condensation_entry(const condensation *c, int row, int column)
{
  return (size_t)row + (size_t)c->m->n * (size_t)column;
}

static inline double complex condensation_change_at(const condensation *c, condensation_change by, size_t at)
{
  return by.alpha * c->basis.M[at] + by.beta * c->basis.C[at];
}

static inline double complex condensation_Z_at(const condensation *c, condensation_change dynamic, size_t at)
{
  return c->basis.K[at] + condensation_change_at(c, dynamic, at);
}

/* Z_yy of harmonic h is diagonal: at rest whatever the damping. */
static inline bool condensation_rest_is_diagonal(const condensation *c, int h)
{
  return c->basis.diagonal || (c->basis.modes && h == 0);
}

/* What compliance.h wants to know of harmonic h. */
static inline double condensation_frequency(const condensation *c, int h) { return h * c->omega; }
static inline double condensation_reach(const condensation *c) { return condensation_frequency(c, c->n_harm); }
static inline double condensation_more_rate(const condensation *c) { return c->more_damping * c->more_mass; }

/* S, couplings and loads of harmonic h by the rest: HC_NOT_FINITE where Z_yy is singular. */
hc_status condensation_by_rest(condensation *c, int h);

/* out[dim] = S a. */
void condensation_multiply(int dim, const double complex *S, const double complex *a, double complex *out);

#endif
