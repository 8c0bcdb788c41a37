/* comparison.c - see hbmcheck.h: both sides at the same frequencies, and the gate. */
#include <math.h>
#include <stdlib.h>

#include "compare/comparison.h"
#include "compare/gate/gate.h"
#include "compare/motion.h"
#include "interfaces/library/inside.h"

struct hbmcheck_comparison {
  comparison found;
  hc_status end;      /* of the run */
  hbmcheck_gate gate; /* valid when end is HC_OK */
  int n_contacts;     /* of the case; those of a solution stand together in found.contacts */
};

hbmcheck_status hbmcheck_comparison_run(const hbmcheck_case *c, int n, const double *omega,
                                        const hbmcheck_monitor *monitor, hbmcheck_comparison **out)
{
  scene sc;
  compare_setup setup;
  const hc_monitor inner = library_monitor(monitor);
  if (out) *out = NULL;
  if (!c || !out || !library_scene(c, n, omega, &sc)) return HBMCHECK_BAD_INPUT;
  hbmcheck_comparison *run = calloc(1, sizeof *run);
  if (!run) return HBMCHECK_NO_MEMORY;
  run->n_contacts = scene_contact_count(&sc);
  hc_status st = library_setup(c, &sc, &setup);
  if (st == HC_OK) st = comparison_run(&setup, &inner, &run->found);
  /* The gate's checks, of which the totals are kept. */
  if (st == HC_OK) {
    gate_case g;
    st = gate_judge("", &setup, &run->found, &g);
    run->gate = (hbmcheck_gate){.checks = g.n,
                                .failed = g.failures,
                                .errors = g.errors,
                                .exit_code = gate_exit_code(1, &g),
                                .not_applicable = g.not_applicable};
    gate_clear(&g);
  }
  run->end = st;
  scene_setup_clear(&setup);
  if (has_result(st)) *out = run;
  else hbmcheck_comparison_free(run);
  return public_status(st);
}

int hbmcheck_comparison_count(const hbmcheck_comparison *c) { return c ? c->found.n_rows : 0; }

hbmcheck_status hbmcheck_comparison_get(const hbmcheck_comparison *c, int k, hbmcheck_row *out)
{
  if (!c || !out || k < 0 || k >= c->found.n_rows) return HBMCHECK_BAD_INPUT;
  const comparison_row *r = &c->found.rows[k];
  const bool hbm = r->branch >= 0 && r->hbm_status == HC_OK;
  const budget_parts *parts = &r->budget.amplitude;
  *out = (hbmcheck_row){.omega = r->omega,
                        .verdict = (hbmcheck_verdict)r->verdict,
                        .hbm_status = public_status(r->hbm_status),
                        .transient_status = public_status(r->transient_status),
                        .orbit_status = public_status(r->orbit_status),
                        .branch = r->branch,
                        .stable = hbm ? hbm_stability_verdict(&r->stability) : 0,
                        .period_multiple = r->transient_status == HC_OK ? r->transient.period_multiple : 0,
                        .accounted = r->accounted,
                        .multiplier = hbm ? r->stability.multiplier : NAN,
                        .hbm_amplitude = hbm ? r->hbm.amplitude : NAN,
                        .transient_amplitude = motion_is_measured(r->transient_status) ? r->transient.amplitude : NAN,
                        .orbit_amplitude = r->orbit_status == HC_OK ? r->orbit.amplitude : NAN,
                        .amplitude_error = r->errors.amplitude,
                        .harmonic_1_error = r->errors.harmonic_1,
                        .mean_error = r->errors.mean,
                        .waveform_error = r->errors.waveform,
                        .orbit_error = r->orbit_errors.waveform,
                        .from_aliasing = parts->aliasing,
                        .from_truncation = parts->truncation,
                        .from_regularisation = parts->regularisation,
                        .from_integration = parts->integration,
                        .from_settling = parts->settling,
                        .hbm_predicted = r->hbm_predicted.amplitude,
                        .transient_predicted = r->transient_predicted.amplitude,
                        .unexpected = r->unexpected,
                        .mean_free = comparison_mean_free(r),
                        .response = r->response,
                        .still = r->still,
                        .family = r->family};
  return HBMCHECK_OK;
}

/* The contacts of the row's solution, NULL: they were not measured. */
static const contact_comparison *contacts_of(const hbmcheck_comparison *c, const comparison_row *row)
{
  const contact_comparison *of = c->found.contacts;
  for (int i = 0; c->n_contacts && i < c->found.n_contacts; i += c->n_contacts)
    if (of[i].omega == row->omega && of[i].branch == row->branch) return &of[i];
  return NULL;
}

hbmcheck_status hbmcheck_comparison_contacts(const hbmcheck_comparison *c, int k, int cap, hbmcheck_contact_row *out,
                                             int *n)
{
  if (!c || !n || k < 0 || k >= c->found.n_rows || cap < 0 || (cap > 0 && !out)) return HBMCHECK_BAD_INPUT;
  const contact_comparison *found = contacts_of(c, &c->found.rows[k]);
  *n = found ? c->n_contacts : 0;
  for (int j = 0; j < cap && j < *n; ++j) {
    const hbmcheck_contact_period unknown = {NAN, NAN, NAN, NAN, NAN, HBMCHECK_CONTACT_LINEAR};
    out[j] = (hbmcheck_contact_row){
        .hbm = found[j].hbm_status == HC_OK ? library_period(&found[j].hbm) : unknown,
        .transient = found[j].transient_status == HC_OK ? library_period(&found[j].transient) : unknown,
        .work_error = found[j].work_error,
        .normal_error = found[j].normal_error,
        .compared = contact_comparison_made(&found[j]),
        .differs = found[j].differs,
        .hbm_status = public_status(found[j].hbm_status),
        .transient_status = public_status(found[j].transient_status)};
  }
  return HBMCHECK_OK;
}

int hbmcheck_comparison_exit_code(const hbmcheck_comparison *c)
{
  return c && c->end == HC_OK ? comparison_exit_code(&c->found) : 3;
}

hbmcheck_status hbmcheck_comparison_gate(const hbmcheck_comparison *c, hbmcheck_gate *out)
{
  if (!c || !out) return HBMCHECK_BAD_INPUT;
  if (c->end == HC_OK) *out = c->gate;
  return public_status(c->end);
}

void hbmcheck_comparison_free(hbmcheck_comparison *c)
{
  if (!c) return;
  comparison_clear(&c->found);
  free(c);
}
