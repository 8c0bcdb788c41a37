/* test_structures.c - a large structure's equations, one solution of them and its multipliers, and a small scene's
 * curve with more and more harmonics, where each allocation in turn fails: out of memory, or the same answer.
 * test_memory.c tries commands, on small scenes. */
#include <gsl/gsl_errno.h>

#include "compare/study/scene_solvers.h"
#include "numerics/norm.h"
#include "tests/faults/memory.h"
#include "tests/faults/small.h"

enum { DOF = 30, ROOM = 32 * DOF * DOF };

/* A chain of masses on the ground at either end, with a slider on the first and a stop on the last: what is left
 * without these has modes enough for a sum over them (condensation.c). Rayleigh's damping, or one damper that no mode
 * diagonalises. */
static scene chain(bool rayleigh)
{
  static char text[ROOM];
  scene sc;
  case_error err;
  int n = snprintf(text, ROOM, "structure:\n  mass: [1");
  for (int i = 1; i < DOF; ++i) n += snprintf(text + n, ROOM - (size_t)n, ", 1");
  for (int matrix = 0; matrix < (rayleigh ? 1 : 2); ++matrix) {
    n += snprintf(text + n, ROOM - (size_t)n, "]\n  %s: [", matrix ? "damping" : "stiffness");
    for (int i = 0; i < DOF; ++i)
      for (int j = 0; j < DOF; ++j) {
        const double k = i == j ? 2 : abs(i - j) == 1 ? -1 : 0, c = (i == j) * (i == 3 ? 1 : 0.01);
        n += snprintf(text + n, ROOM - (size_t)n, "%s%g%s",
                      j   ? ", "
                      : i ? ", ["
                          : "[",
                      matrix ? c : k, j + 1 < DOF ? "" : "]");
      }
  }
  snprintf(text + n, ROOM - (size_t)n,
           "]\n%sforcing: [{dof: 2, amplitude: 1}]\ncontacts:\n"
           "  - {tangential_stiffness: 2, friction: 1, preload: 0.2, tangent: {1: 1}}\n"
           "  - {normal_stiffness: 1, gap: 0.1, normal: {%d: 1}}\n"
           "sweep: {omega: [0.5, 1]}\nhbm: {harmonics: 2}\n",
           rayleigh ? "  damping: {rayleigh: [0.01, 0.02]}\n" : "", DOF);
  if (case_parse("chain.yaml", text, strlen(text), 0, NULL, &sc, &err) != HC_OK) fail_msg("%s", err.message);
  return sc;
}

static hc_status solve(const scene *sc, hbm_stability *out)
{
  hbm_solver *s;
  hbm_point point;
  hc_status st = scene_hbm_solver(sc, &s);
  if (st != HC_OK) return st;
  double X[5 * DOF] = {0};
  assert_true(hbm_n_coefficients(s) <= 5 * DOF);
  st = hbm_first_solution(s, 0.7, NULL, X, &point);
  if (st == HC_OK) st = hbm_stability_at(s, 0.7, X, out);
  hbm_solver_free(s);
  return st;
}

static void fails_honestly(bool rayleigh)
{
  scene sc = chain(rayleigh);
  hbm_stability good, found;
  assert_int_equal(solve(&sc, &good), HC_OK);
  assert_true(good.multiplier > 0 && good.multiplier < 1);
  long refused = 1, gave_up = 0;
  for (long n = 1; refused > 0; ++n) {
    memory_fail(n, MEMORY_ONE);
    const hc_status st = solve(&sc, &found);
    refused = memory_refused();
    memory_fail(0, MEMORY_ONE);
    if (st != HC_OK && st != HC_NO_MEMORY) fail_msg("allocation %ld: %s", n, hc_status_text(st));
    if (st == HC_OK) CHECK_NEAR(found.multiplier, good.multiplier, 1e-9, "allocation %ld", n);
    gave_up += st == HC_NO_MEMORY;
  }
  print_message("%ld allocations without which there is no answer\n", gave_up);
  assert_true(gave_up > 100);
  case_clear(&sc);
}

/* A curve along which harmonics are added: [length] the size of its last solution. */
static hc_status trace(const scene *sc, double *size)
{
  hbm_solver *s;
  hbm_curve curve = {0};
  hc_status st = scene_hbm_solver(sc, &s);
  if (st != HC_OK) return st;
  st = hbm_trace(s, sc->omega_from, sc->omega_to, NULL, &curve);
  if (st == HC_OK) *size = norm_2(curve.n_coef, hbm_curve_X(&curve, curve.n - 1));
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return st;
}

static void with_more_harmonics(CHECK_STATE)
{
  static const char *const set[] = {"hbm.harmonics=auto", "hbm.accuracy=1e-4", NULL};
  const scene sc = small_scene(set);
  double good, found;
  assert_int_equal(trace(&sc, &good), HC_OK);
  long refused = 1;
  for (long n = 1; refused > 0; ++n) {
    memory_fail(n, MEMORY_ONE);
    const hc_status st = trace(&sc, &found);
    refused = memory_refused();
    memory_fail(0, MEMORY_ONE);
    if (st != HC_OK && st != HC_NO_MEMORY) fail_msg("allocation %ld: %s", n, hc_status_text(st));
    if (st == HC_OK) CHECK_NEAR(found, good, 1e-6 * good, "allocation %ld", n);
  }
}

static void with_modes(CHECK_STATE) { fails_honestly(true); }
static void with_any_damping(CHECK_STATE) { fails_honestly(false); }

static int without_handler(void **state)
{
  (void)state;
  gsl_set_error_handler_off();
  return 0;
}

CHECK_TESTS_WITH("faults.structures", 240, without_handler, NULL, with_more_harmonics, with_modes, with_any_damping)
