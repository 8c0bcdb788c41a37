/* curves.h - prepared curves: what our own harmonic balance gives with one known mistake in it, as the file of
 * somebody else would say it. */
#pragma once

#include "compare/study/scene_solvers.h"
#include "compare/verify/verify.h"
#include "model/casefile/case_file.h"
#include "tests/check.h"
#include "tests/oscillator.h"

enum { CURVE_ROOM = 512 };

/* How a curve is spoiled; all zero is a good one. */
typedef struct spoiling {
  bool no_static;
  int harmonics, samples; /* 0: the case's, exact forces */
  bool slider_on_sample;
  double omega_factor, value_factor; /* file's = factor times ours; 0: 1 */
  verify_kind said, meant;           /* what the column is called, what it holds; KIND_HARMONIC: of harmonic 1 */
  bool no_contact;
  int branch;              /* -1: unstable only where there is a choice; 1: all; 0: as swept upwards; 2: hops */
  double noise;            /* [1] relative, alternating in sign */
  double warp;             /* [1] relative, 0 at the first omega and this much at the last: nobody's mistake */
  void (*change)(scene *); /* of the model's numbers */
  bool odd_only, turned;
  const slider_rule *slider; /* of a sampled force, if not slider_on_sample; NULL: our own */
} spoiling;

static inline scene curve_scene(const char *path)
{
  scene sc;
  case_error err = {{0}};
  if (case_read(path, 0, NULL, &sc, &err) != HC_OK) fail_msg("%s", err.message);
  return scene_kept(sc);
}

static inline scene curve_spoil(const scene *sc, const spoiling *how)
{
  static verify_mistakes wrong; /* until the next curve */
  scene own = scene_own(sc);
  own.hbm.restart = HBM_RESTART_INTERPOLATED;
  wrong = (verify_mistakes){.slider = how->slider_on_sample ? &verify_on_sample : how->slider,
                            .odd_only = how->odd_only,
                            .turned = how->turned};
  verify_plug_in(&wrong, &own.hbm);
  own.hbm.keep_mean = !how->no_static && !how->odd_only;
  if (how->harmonics) own.hbm.harmonics = how->harmonics;
  own.hbm.force = how->samples ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT;
  if (how->samples) own.hbm.samples = how->samples;
  if (how->change) how->change(&own);
  if (how->no_contact) scene_keep_contacts(&own, 0);
  return own;
}

static inline double curve_value(double omega, const hbm_measures *m, int n_coef, const double *X, verify_kind kind)
{
  const verify_quantity q = {.kind = kind, .harmonic = 1};
  const verify_motion motion = {.omega = omega, .max = m->max, .min = m->min, .n_harm = n_coef / 2, .X = X};
  return verify_quantity_of(&q, &motion);
}

/* Which of the solutions at one omega this curve has: bit k for the k-th along the curve, which is upper, unstable,
 * lower for three. */
static inline unsigned curve_wanted(int branch, int n, int i)
{
  if (branch == 1) return ~0u;
  if (n < 3) return 1;
  if (branch == -1) return 2;
  return branch == 2 && i % 12 < 4 ? 4 : 1;
}

/* n omegas over [low, high], into data, to be cleared by verify_data_clear. */
static inline verify_data curve_make(const scene *sc, const spoiling *how, double low, double high, int n)
{
  const scene own = curve_spoil(sc, how);
  hbm_curve curve = {0};
  verify_data d = {.quantity = {.kind = how->said, .harmonic = how->said == KIND_HARMONIC},
                   .points = calloc(CURVE_ROOM, sizeof *d.points)};
  CHECK_MADE(hbm_solver, hbm, scene_hbm_solver(&own, &hbm));
  assert_int_equal(hbm_trace(hbm, own.omega_from, own.omega_to, NULL, &curve), HC_OK);
  for (int i = 0; i < n; ++i) {
    double omega = low + (high - low) * i / (n - 1);
    hbm_curve at = {0};
    hbm_measures m;
    hbm_curve_at(hbm, &curve, omega, &at);
    for (int k = 0; k < at.n && d.n < CURVE_ROOM; ++k) {
      if (!(curve_wanted(how->branch, at.n, i) & (1u << k))) continue;
      assert_int_equal(hbm_measure(hbm, at.X + (size_t)k * at.n_coef, &m), HC_OK);
      double value = curve_value(omega, &m, at.n_coef, at.X + (size_t)k * at.n_coef, how->meant) *
                     (how->value_factor > 0 ? how->value_factor : 1) * (1 + (i % 2 ? how->noise : -how->noise)) *
                     (1 + how->warp * i / (n - 1));
      d.points[d.n++] = (verify_point){omega * (how->omega_factor > 0 ? how->omega_factor : 1), value, i + 1};
    }
    hbm_curve_free(&at);
  }
  hbm_curve_free(&curve);
  hbm_solver_free(hbm);
  return d;
}
