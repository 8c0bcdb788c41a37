/* lab_transient.c - see lab.h: steady states of the exact law. */
#include <math.h>

#include "compare/steady_states.h"
#include "interfaces/lab/lab_inside.h"

/* The case with its transients by the exact law at omega[n]. */
static hc_status asked_scene(const lab *l, int n, const double *omega, scene *sc)
{
  hc_status st = lab_scene(l, LAB_EXACT, sc);
  if (st != HC_OK) return st;
  if (n < 1 || n > NUMBER_LIST_MAX) return HC_BAD_INPUT;
  lab_exact_law(sc);
  sc->compare.omega.n = n;
  for (int i = 0; i < n; ++i) {
    if (!(isfinite(omega[i]) && omega[i] > 0)) return HC_BAD_INPUT;
    sc->compare.omega.v[i] = omega[i];
  }
  return HC_OK;
}

int lab_transients(lab *l, int n, const double *omega)
{
  scene sc;
  compare_setup setup;
  steady_states found;
  lab_begin_results(l, ROWS_TRANSIENT, TIMEINT_WAVE);
  hc_status st = asked_scene(l, n, omega, &sc);
  if (st != HC_OK) return lab_answer(l, st);
  if ((st = scene_setup(&sc, &setup)) == HC_OK) {
    st = steady_states_run(&setup, NULL, &found);
    for (int i = 0; i < found.n; ++i)
      if (lab_add_result(l, ROWS_TRANSIENT, &found.rows[i]) != HC_OK) st = HC_NO_MEMORY;
    steady_states_clear(&found);
  }
  scene_setup_clear(&setup);
  return lab_answer(l, st);
}
