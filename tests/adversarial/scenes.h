/* scenes.h - a scene of cases/adversarial with fields changed, and all its HBM solutions at a frequency. */
#pragma once

#include "compare/study/scene_solvers.h"
#include "tests/case_scene.h"

/* set: "PATH=VALUE", ended by NULL. */
static inline scene load(const char *name, const char *const *set)
{
  char below[128];
  int n = 0;
  while (set && set[n]) ++n;
  snprintf(below, sizeof below, "adversarial/%s", name);
  return case_scene(below, n, set);
}

#define LOAD(name, ...) load(name, (const char *const[]){__VA_ARGS__, NULL})

/* The scene's response curve, to be asked at several frequencies. */
typedef struct response {
  hbm_solver *s;
  hbm_curve curve;
} response;

static inline response response_of(const scene *sc)
{
  response r = {0};
  assert_int_equal(scene_hbm_solver(sc, &r.s), HC_OK);
  hc_status st = hbm_trace(r.s, sc->omega_from, sc->omega_to, NULL, &r.curve);
  if (st != HC_OK)
    fail_msg("%s: %s at %.17g", sc->title, hc_status_text(st),
             r.curve.n ? r.curve.points[r.curve.n - 1].omega : sc->omega_from);
  return r;
}

static inline void response_free(response *r)
{
  hbm_curve_free(&r->curve);
  hbm_solver_free(r->s);
}

static inline hbm_curve response_at(const response *r, double omega)
{
  hbm_curve at = {0};
  assert_int_equal(hbm_curve_at(r->s, &r->curve, omega, &at), HC_OK);
  if (at.n == 0) fail_msg("no solution at %g", omega);
  return at;
}

static inline hbm_curve solutions(const scene *sc, double omega)
{
  response r = response_of(sc);
  hbm_curve at = response_at(&r, omega);
  response_free(&r);
  return at;
}

static inline double norm_of(int n, const double *X)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += X[i] * X[i];
  return sqrt(sum);
}

static inline const double *solution(const hbm_curve *at, int k) { return at->X + (size_t)k * at->n_coef; }

/* b's solutions are `factor` times a's at all of a's compare.omega, to `tolerance` of their size. */
static inline void same_answers(const scene *a, const scene *b, double factor, double tolerance)
{
  response of_a = response_of(a), of_b = response_of(b);
  for (int i = 0; i < a->compare.omega.n; ++i) {
    double omega = a->compare.omega.v[i];
    hbm_curve p = response_at(&of_a, omega), q = response_at(&of_b, omega);
    if (p.n != q.n) fail_msg("%s at %g: %d solutions, and %d", a->title, omega, p.n, q.n);
    for (int k = 0; k < p.n; ++k) {
      double size = factor * norm_of(p.n_coef, solution(&p, k));
      for (int j = 0; j < p.n_coef; ++j)
        CHECK_NEAR(solution(&q, k)[j], factor * solution(&p, k)[j], tolerance * size, "%s at %g, solution %d, X[%d]",
                   a->title, omega, k, j);
    }
    hbm_curve_free(&p);
    hbm_curve_free(&q);
  }
  response_free(&of_a);
  response_free(&of_b);
}
