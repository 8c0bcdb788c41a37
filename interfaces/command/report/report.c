/* report.c - see report.h: everything the page shows is computed here, in stages. */
#include "interfaces/command/report/report.h"

#include "compare/motion.h"
#include "compare/output/rows.h"
#include "compare/study/scene_solvers.h"
#include "interfaces/command/report/html.h"
#include "interfaces/command/report/parts.h"
#include "model/casefile/structure.h"

/* ---- the response curve ------------------------------------------------------------ */

/* As JSON, with what stands on it: points in the curve's order, for a folded curve is not a function of omega. */
enum { CURVE_MOST_RESPONSES = 12 };

/* [1] of the step that continuation needs: drawn with straight lines, the curve needs more points; of a structure of
 * many coordinates each costs more than it shows: its curve is the comparison's. */
static const double shorter_steps = 0.35;
enum { MANY_COORDINATES = 50 };

static const char *const point_columns[] = {"omega",  "amplitude", "harmonic_1", "mean", "mean_free",
                                            "branch", "stable",    "contact",    NULL};

/* The curve of sc over the comparison's frequencies, columns[n] of n responses. Without specials it is of another scene
 * than the comparison. */
static hc_status append_curve(const scene *sc, const comparison *c, const hc_monitor *monitor, int n,
                              json_t *const *columns, json_t *specials)
{
  hbm_solver *s = NULL;
  hbm_curve traced = {0};
  number_list asked = {0};
  double from, to;
  for (int i = 0; i < c->n_rows && asked.n < NUMBER_LIST_MAX; ++i) asked.v[asked.n++] = c->rows[i].omega;
  comparison_sweep(sc->omega_from, sc->omega_to, &asked, &from, &to);
  const bool large = sc->structure->n > MANY_COORDINATES;
  const hbm_curve *curve = large && specials ? &c->curve : &traced;
  scene solved = *sc;
  if (curve == &c->curve) solved.hbm = report_settings(sc, c);
  hc_status st = scene_hbm_solver(&solved, &s);
  if (st == HC_OK) hbm_leave_stability(s);
  if (st == HC_OK && sc->hbm.force == HBM_FORCE_EXACT && !large) hbm_scale_steps(s, shorter_steps);
  if (st == HC_OK && curve == &traced) st = hbm_trace_all(s, from, to, monitor, &traced);
  for (int k = 0; s && k < curve->n; ++k) {
    response_row row;
    if (response_row_of(s, curve, k, &row) != HC_OK) continue;
    html_append_row(columns[0], ROWS_FRF, &row, point_columns);
    for (int r = 1; r < n; ++r)
      if (response_row_turn(s, curve, k, r, &row) == HC_OK) html_append_row(columns[r], ROWS_FRF, &row, point_columns);
  }
  if (s && specials) {
    hbm_special *special;
    int n_special;
    hbm_specials(s, curve, &special, &n_special); /* if one cannot be located, the others are shown */
    for (int i = 0; i < n_special; ++i) {
      const hbm_special *p = &special[i];
      char text[ROWS_SPECIAL];
      json_array_append_new(specials, json_pack("{s:f, s:f, s:i, s:s}", "omega", p->omega, "amplitude", p->amplitude,
                                                "branch", p->branch, "what", rows_special_text(p, text)));
    }
    free(special);
  }
  hbm_curve_free(&traced);
  hbm_solver_free(s);
  return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK;
}

/* What is shown of one response, with what time integration came to in the rows of the comparison. */
static json_t *response_object(const scene *sc, const comparison *c, int response, json_t *curve, json_t *turned,
                               json_t *specials)
{
  json_t *list = json_array();
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    char text[24];
    if (!motion_is_measured(r->transient_status) || r->response != response) continue;
    comparison_verdict_text(r, text);
    json_array_append_new(list, json_pack("{s:f, s:o, s:o, s:o, s:b, s:i, s:s, s:o}", "omega", r->omega, "amplitude",
                                          json_finite(r->transient.amplitude), "harmonic_1",
                                          json_finite(r->transient.harmonic_1), "mean", json_finite(r->transient.mean),
                                          "mean_free", (int)comparison_mean_free(r), "branch", r->branch, "verdict",
                                          text, "error", json_finite(r->errors.amplitude)));
  }
  return json_pack("{s:o, s:o, s:b, s:o, s:o}", "curve", curve, "turned", turned, "mean_kept", (int)sc->hbm.keep_mean,
                   "specials", specials, "transient", list);
}

/* Without harmonic 0 a scene with one is another. */
static bool has_static_load(const scene *sc)
{
  for (int l = 0; l < sc->structure->n_loads; ++l)
    if (sc->structure->loads[l].harmonic == 0) return true;
  return false;
}

/* The first response's curve, and into *others a list of the same for the others of a structure, up to
 * CURVE_MOST_RESPONSES in all (special points are the first one's), for response.js: {curve: columns of points; turned:
 * the same, with harmonic 0 dropped if the scene keeps it, else kept, or nothing; specials; transient: the rows'
 * results}. A curve that stops early is shown as far as it goes. HC_INTERRUPTED, HC_NO_MEMORY. */
static hc_status curve_json(const scene *sc, const comparison *c, const hc_monitor *monitor, json_t **out,
                            json_t **others)
{
  enum { MOST = CURVE_MOST_RESPONSES };
  json_t *curve[MOST] = {NULL}, *turned[MOST] = {NULL}, *specials = json_array();
  scene other_mean = *sc; /* with harmonic 0 dropped if *sc keeps it, and the other way round */
  const int all = structure_response_count(sc->structure), n = all < MOST ? all : MOST;
  other_mean.hbm.keep_mean = !sc->hbm.keep_mean;
  for (int r = 0; r < n; ++r) curve[r] = json_object(), turned[r] = json_object();
  hc_status st = append_curve(sc, c, monitor, n, curve, specials);
  const bool comparable = !sc->hbm.keep_mean || !has_static_load(sc);
  if (st == HC_OK && comparable) st = append_curve(&other_mean, c, monitor, n, turned, NULL);
  *out = response_object(sc, c, 0, curve[0], turned[0], specials);
  *others = json_array();
  for (int r = 1; r < n; ++r)
    json_array_append_new(*others, response_object(sc, c, r, curve[r], turned[r], json_array()));
  if (st == HC_OK && (!*out || json_array_size(*others) + 1 != (size_t)n)) st = HC_NO_MEMORY;
  return st;
}

bool report_has_charts(void) { return asset_chart.length > 0; }

/* Chooses among the comparison's frequencies at which a contact changes its state in some HBM solution: the one nearest
 * to the peak, and others spread over the rest, ascending; how many. *first: the index of the nearest. */
static int choose_omegas(const comparison *c, double *omega, int *first)
{
  double all[NUMBER_LIST_MAX];
  int n = 0, peak = 0, chosen = 0;
  for (int i = 0; i < c->n_rows && n < NUMBER_LIST_MAX; ++i) {
    const comparison_row *r = &c->rows[i];
    bool nonlinear = r->branch >= 0 && r->hbm_status == HC_OK && r->hbm.contact.regime > CONTACT_STUCK;
    if (nonlinear && (n == 0 || r->omega != all[n - 1])) all[n++] = r->omega;
  }
  const int step = (n + ALIASING_MOST_OMEGAS - 1) / ALIASING_MOST_OMEGAS;
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

hc_status report_gather(const scene *sc, int jobs, progress *bar, report_data *out)
{
  const hc_monitor watch = progress_monitor(bar), *const monitor = &watch;
  *out = (report_data){.sc = sc};
  progress_relabel(bar, "comparing");
  hc_status st = scene_setup(sc, &out->setup);
  out->setup.jobs = jobs;
  out->setup.contacts = !scene_is_oscillator(sc);
  out->setup.advise = true;
  out->setup.spare = out->setup.model->n > COMPARE_LARGE; /* page.html says so */
  if (st == HC_OK) st = comparison_run(&out->setup, monitor, &out->comparison);
  if (st != HC_OK) return st;
  comparison *c = &out->comparison;
  for (int i = 0; i < c->n_rows && !scene_is_oscillator(sc); ++i)
    structure_response_name(sc->structure, c->rows[i].response, c->rows[i].response_name, RESPONSE_NAME);
  for (int i = 0; i < c->n_contacts && !scene_is_oscillator(sc); ++i)
    snprintf(c->contacts[i].name, RESPONSE_NAME, "%s", scene_contact_at(sc, c->contacts[i].contact)->name);
  progress_relabel(bar, "response curve");
  json_t *others = NULL;
  st = curve_json(sc, &out->comparison, monitor, &out->response, &others);
  if (st == HC_OK) st = structure_json(sc, &out->comparison, others, monitor, &out->structure);
  json_decref(others);
  if (st != HC_OK) return st;
  progress_relabel(bar, "aliasing");
  double omega[ALIASING_MOST_OMEGAS];
  int first;
  const int n = choose_omegas(&out->comparison, omega, &first);
  if (n > 0 && scene_is_oscillator(sc) && scene_contact_count(sc) > 0) /* the section is of one degree of freedom */
    st = aliasing_answers(sc, n, omega, first, jobs, monitor, &out->aliasing);
  else out->aliasing = json_null();
  if (st != HC_OK) return st;
  progress_relabel(bar, "samples and truncation orders");
  out->tabled = accuracy_run(&out->setup, &out->comparison, monitor, &out->accuracy);
  return out->tabled == HC_INTERRUPTED || out->tabled == HC_NO_MEMORY ? out->tabled : HC_OK;
}

void report_clear(report_data *d)
{
  json_decref(d->response);
  json_decref(d->structure);
  json_decref(d->aliasing);
  accuracy_clear(&d->accuracy);
  proofs_clear(&d->proofs);
  comparison_clear(&d->comparison);
  scene_setup_clear(&d->setup);
  *d = (report_data){0};
}
