/* report.c - see report.h: everything the page shows is computed here, in stages. */
#include "command/report/report.h"

#include <math.h>
#include <stdio.h>

#include "casefile/structure_model.h"

#include "command/report/aliasing.h"
#include "command/report/assets.h"
#include "command/report/curve.h"
#include "command/report/structure.h"

bool report_has_charts(void) { return asset_chart.length > 0; }

/* The comparison's frequencies at which a contact changes its state in some HBM solution, ascending; how many. */
static int nonlinear_omegas(const comparison *c, double all[NUMBER_LIST_MAX])
{
  int n = 0;
  for (int i = 0; i < c->n_rows && n < NUMBER_LIST_MAX; ++i) {
    const comparison_row *r = &c->rows[i];
    bool nonlinear = r->branch >= 0 && r->hbm_status == HC_OK && r->hbm.contact.regime > CONTACT_STUCK;
    if (nonlinear && (n == 0 || r->omega != all[n - 1])) all[n++] = r->omega;
  }
  return n;
}

/* Of those the one nearest to the peak, and others spread over the rest, ascending; how many. *first: the index of the
 * nearest. */
static int choose_omegas(const comparison *c, double *omega, int *first)
{
  double all[NUMBER_LIST_MAX];
  int n = nonlinear_omegas(c, all), peak = 0, chosen = 0, step = (n + ALIASING_MOST_OMEGAS - 1) / ALIASING_MOST_OMEGAS;
  for (int i = 1; i < n; ++i)
    if (fabs(all[i] - c->summary.peak_omega) < fabs(all[peak] - c->summary.peak_omega)) peak = i;
  *first = 0;
  for (int i = 0; i < n; ++i) {
    if ((i - peak) % step || chosen == ALIASING_MOST_OMEGAS) continue;
    if (i == peak) *first = chosen;
    omega[chosen++] = all[i];
  }
  return chosen;
}

static hc_status gather_aliasing(const scene *sc, const hc_monitor *monitor, report_data *out)
{
  double omega[ALIASING_MOST_OMEGAS];
  int first, n = choose_omegas(&out->comparison, omega, &first);
  if (n > 0 && !sc->structure && sc->n_contacts > 0) /* the section is of one degree of freedom */
    return aliasing_answers(sc, n, omega, first, out->setup.jobs, monitor, &out->aliasing);
  out->aliasing = json_null();
  return HC_OK;
}

/* What a structure's responses and contacts are called. */
static void name_rows(const scene *sc, comparison *c)
{
  if (!sc->structure) return;
  for (int i = 0; i < c->n_rows; ++i)
    structure_response_name(sc->structure, c->rows[i].response, c->rows[i].response_name, RESPONSE_NAME);
  for (int i = 0; i < c->n_contacts; ++i)
    snprintf(c->contacts[i].name, RESPONSE_NAME, "%s", scene_contact_at(sc, c->contacts[i].contact)->name);
}

static void announce_stage(void (*announce)(void *, const char *), void *self, const char *stage)
{
  if (announce) announce(self, stage);
}

hc_status report_gather(const scene *sc, int jobs, const hc_monitor *monitor,
                        void (*announce)(void *self, const char *stage), void *self, report_data *out)
{
  *out = (report_data){.sc = sc};
  announce_stage(announce, self, "comparing");
  hc_status st = scene_setup(sc, &out->setup);
  out->setup.jobs = jobs;
  out->setup.contacts = sc->structure != NULL;
  if (st == HC_OK) st = comparison_run(&out->setup, monitor, &out->comparison);
  if (st != HC_OK) return st;
  name_rows(sc, &out->comparison);
  announce_stage(announce, self, "response curve");
  json_t *others = NULL;
  st = curve_json(sc, &out->comparison, monitor, &out->response, &others);
  if (st == HC_OK) st = structure_json(sc, &out->comparison, others, monitor, &out->structure);
  json_decref(others);
  if (st != HC_OK) return st;
  announce_stage(announce, self, "aliasing");
  st = gather_aliasing(sc, monitor, out);
  if (st != HC_OK) return st;
  announce_stage(announce, self, "samples and truncation orders");
  out->tabled = accuracy_run(&out->setup, &out->comparison, monitor, &out->accuracy);
  return out->tabled == HC_INTERRUPTED || out->tabled == HC_NO_MEMORY ? out->tabled : HC_OK;
}

void report_clear(report_data *d)
{
  json_decref(d->response);
  json_decref(d->structure);
  json_decref(d->aliasing);
  accuracy_clear(&d->accuracy);
  comparison_clear(&d->comparison);
  scene_setup_clear(&d->setup);
  *d = (report_data){0};
}
