/* structure_cases.h - the models of cases/structures, their settings, and solutions of them at one frequency. */
#pragma once

#include "hbm/hbm.h"
#include "tests/case_scene.h"

static const char *const STRUCTURE_CASES[] = {"jenkins2", "chain3",     "tangent_normal_F50", "tangent_normal_F100",
                                              "beam16",   "wedge_F0.5", "wedge_F2",           "wedge_F10",
                                              "wedge_F20"};
enum { N_STRUCTURE_CASES = sizeof STRUCTURE_CASES / sizeof *STRUCTURE_CASES, CASE_MAX_COEF = 4000 };

typedef struct structure_case {
  model *model;
  hbm_settings how;
  double from, to; /* [rad/time] the sweep */
} structure_case;

/* The case of that name with the assignments set[0..n_set-1]; to free with model_free(model). Located forces, tolerance
 * 1e-13 unless they say otherwise. */
static inline structure_case structure_case_with(const char *name, int harmonics, int n_set, const char *const *set)
{
  char below[128];
  structure_case c;
  snprintf(below, sizeof below, "structures/%s", name);
  scene sc = case_scene(below, n_set, set);
  assert_int_equal(scene_model(&sc, &c.model), HC_OK);
  c.how = sc.hbm;
  c.how.harmonics = harmonics;
  c.how.tolerance = 1e-13;
  c.from = sc.omega_from;
  c.to = sc.omega_to;
  case_clear(&sc);
  return c;
}

static inline structure_case structure_case_named(const char *name, int harmonics)
{
  return structure_case_with(name, harmonics, 0, NULL);
}

static inline hbm_solver *structure_solver(const structure_case *c)
{
  CHECK_MADE(hbm_solver, s, hbm_solver_new(c->model, &c->how, &s));
  assert_true(hbm_n_coefficients(s) <= CASE_MAX_COEF);
  return s;
}

/* All loads of a harmonic >= 1 become `factor` times as large. */
static inline void scale_dynamic_loads(model *m, double factor)
{
  for (int l = 0; l < m->n_loads; ++l)
    for (int i = 0; i < m->n && m->loads[l].harmonic > 0; ++i)
      m->loads[l].cosine[i] *= factor, m->loads[l].sine[i] *= factor;
}

/* The responses become the degrees of freedom: hbm_response then gives all of x. To free with model_free. */
static inline model *with_all_responses(const model *m)
{
  CHECK_MADE(model, all, model_copy_all_seen(m, &all));
  return all;
}
