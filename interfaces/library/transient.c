/* transient.c - see hbmcheck.h: steady states by time integration. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/motion.h"
#include "compare/steady_states.h"
#include "interfaces/library/inside.h"

struct hbmcheck_transient {
  steady_states found;
  int n_contacts; /* of the case; those of a state stand together in found.contacts */
};

static const steady_row *steady_row_at(const hbmcheck_transient *t, int k)
{
  return t && k >= 0 && k < t->found.n ? &t->found.rows[k] : NULL;
}

hbmcheck_status hbmcheck_transient_run(const hbmcheck_case *c, int n, const double *omega,
                                       const hbmcheck_monitor *monitor, hbmcheck_transient **out)
{
  scene sc;
  compare_setup setup;
  const hc_monitor inner = library_monitor(monitor);
  if (out) *out = NULL;
  if (!c || !out || !library_scene(c, n, omega, &sc)) return HBMCHECK_BAD_INPUT;
  hbmcheck_transient *t = calloc(1, sizeof *t);
  if (!t) return HBMCHECK_NO_MEMORY;
  t->n_contacts = scene_contact_count(&sc);
  hc_status st = library_setup(c, &sc, &setup);
  if (st == HC_OK) st = steady_states_run(&setup, &inner, &t->found);
  scene_setup_clear(&setup);
  if (has_result(st)) *out = t;
  else hbmcheck_transient_free(t);
  return public_status(st);
}

int hbmcheck_transient_count(const hbmcheck_transient *t) { return t ? t->found.n : 0; }

hbmcheck_status hbmcheck_transient_get(const hbmcheck_transient *t, int k, hbmcheck_steady *out)
{
  const steady_row *row = steady_row_at(t, k);
  if (!out || !row) return HBMCHECK_BAD_INPUT;
  const timeint_result *r = &row->result;
  const bool settled = row->status == HC_OK;
  hbmcheck_steady s = {.status = public_status(row->status),
                       .without_hbm = public_status(row->without_hbm),
                       .omega = r->omega,
                       .amplitude = r->amplitude,
                       .max = r->max,
                       .min = r->min,
                       .rms = r->rms,
                       .mean = r->mean,
                       .harmonic_1 = r->harmonic_1,
                       .closure = r->closure,
                       .multiplier = settled ? r->multiplier : NAN,
                       .from_regularisation = settled ? row->from_regularisation : NAN,
                       .stable = settled ? timeint_stability(r) : 0,
                       .period_multiple = settled ? r->period_multiple : 0,
                       .periods = r->periods,
                       .steps = r->steps,
                       .free_sliders = r->free_sliders,
                       .left_orbit = r->left_orbit,
                       .response = row->response,
                       .contact = (hbmcheck_contact)r->regime};
  if (!motion_is_measured(row->status)) s.amplitude = s.max = s.min = s.rms = s.mean = s.harmonic_1 = s.closure = NAN;
  *out = s;
  return HBMCHECK_OK;
}

hbmcheck_status hbmcheck_transient_wave(const hbmcheck_transient *t, int k, int cap, double *x, int *n)
{
  const steady_row *row = steady_row_at(t, k);
  if (!n || !row || cap < 0 || (cap > 0 && !x)) return HBMCHECK_BAD_INPUT;
  *n = motion_is_measured(row->status) ? TIMEINT_WAVE : 0;
  library_copy(*n, row->result.wave, cap, x);
  return HBMCHECK_OK;
}

/* The contacts of that state, NULL: they were not measured. */
static const steady_contact *contacts_of(const hbmcheck_transient *t, const steady_row *row)
{
  const steady_contact *c = t->found.contacts;
  for (int i = 0; t->n_contacts && i < t->found.n_contacts; i += t->n_contacts)
    if (c[i].omega == row->result.omega && strcmp(c[i].start, row->start) == 0) return &c[i];
  return NULL;
}

hbmcheck_status hbmcheck_transient_contacts(const hbmcheck_transient *t, int k, int cap, hbmcheck_contact_period *out,
                                            int *n)
{
  const steady_row *row = steady_row_at(t, k);
  if (!n || !row || cap < 0 || (cap > 0 && !out)) return HBMCHECK_BAD_INPUT;
  const steady_contact *found = contacts_of(t, row);
  *n = found ? t->n_contacts : 0;
  for (int j = 0; j < cap && j < *n; ++j) out[j] = library_period(&found[j].period);
  return HBMCHECK_OK;
}

void hbmcheck_transient_free(hbmcheck_transient *t)
{
  if (!t) return;
  steady_states_clear(&t->found);
  free(t);
}
