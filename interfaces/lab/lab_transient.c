/* lab_transient.c - see lab.h: steady states of the exact law. */
#include <math.h>
#include <string.h>

#include "compare/motion.h"
#include "compare/steady_states.h"
#include "interfaces/lab/lab_inside.h"

enum { COLUMNS = 13 /* before the wave */ };

static hc_status add_state(lab *l, const steady_row *s)
{
  const timeint_result *r = &s->result;
  const bool settled = s->status == HC_OK, measured = motion_is_measured(s->status);
  double *row = lab_row(l);
  if (!row) return HC_NO_MEMORY;
  row[0] = r->omega;
  row[1] = s->status;
  if (measured) {
    const double measures[] = {r->amplitude, r->max, r->min, r->rms, r->mean, r->harmonic_1};
    memcpy(row + 2, measures, sizeof measures);
    memcpy(row + COLUMNS, r->wave, sizeof r->wave);
  }
  row[8] = settled ? timeint_stability(r) : 0;
  if (settled) row[9] = r->multiplier;
  row[10] = settled ? r->period_multiple : 0;
  row[11] = r->periods;
  row[12] = r->free_sliders;
  return HC_OK;
}

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
  lab_begin(l, COLUMNS + TIMEINT_WAVE);
  hc_status st = asked_scene(l, n, omega, &sc);
  if (st != HC_OK) return lab_answer(l, st);
  if ((st = scene_setup(&sc, &setup)) == HC_OK) {
    st = steady_states_run(&setup, NULL, &found);
    for (int i = 0; i < found.n; ++i)
      if (add_state(l, &found.rows[i]) != HC_OK) st = HC_NO_MEMORY;
    steady_states_clear(&found);
  }
  scene_setup_clear(&setup);
  return lab_answer(l, st);
}
