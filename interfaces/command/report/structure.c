/* structure.c - see parts.h. Responses of the model solved here: the case's first, in whose coordinates the
 * comparison's curve is, its DOFs, then the contacts' u and v. */
#include "interfaces/command/report/parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/casefile/structure.h"
#include "model/contact_law.h"
#include "numerics/base/constants.h"
#include "numerics/norm.h"
#include "numerics/series.h"

enum { MOST_OMEGAS = 12, MOST_SOLUTIONS = 24, MOST_CONTACTS = 24, SAMPLES = 240, STEPS = 20, DIGITS = 6, NAME = 64 };

typedef struct shown {
  const scene *sc;
  const comparison *c;     /* its curve is what solutions are of */
  const model *m;          /* the case's */
  hbm_solver *s;           /* of the model with those responses */
  double *series[3];       /* [2H+1] each: u, v and of two tangents the second u of a contact, or one of x */
  double *w;               /* [n_contacts] sliders at t = 0 */
  contact_period *periods; /* [n_contacts], as the case counts them */
  const hc_monitor *monitor;
} shown;

/* As it is drawn: a page is no place for 17 digits. */
static json_t *number(double value)
{
  char text[32];
  snprintf(text, sizeof text, "%.*g", DIGITS, value);
  return isfinite(value) ? json_real(strtod(text, NULL)) : json_null();
}

/* ---- the model ---- */

static hc_status model_to_look_at(const model *m, model **out)
{
  const size_t n = (size_t)m->n, bytes = n * sizeof(double);
  hc_status st = model_copy_sized(m, m->n_contacts, 1 + m->n + 2 * m->n_contacts, out);
  if (st != HC_OK) return st;
  double *row = (*out)->responses + n; /* behind the first, which is copied */
  for (size_t i = 0; i < n; ++i, row += n)
    for (size_t k = 0; k < n; ++k) row[k] = i == k;
  for (int j = 0; j < m->n_contacts; ++j, row += 2 * n) {
    memcpy(row, m->contacts[j].tangent, bytes);
    memcpy(row + n, m->contacts[j].normal, bytes);
  }
  return HC_OK;
}

static hc_status shown_open(const scene *sc, shown *d)
{
  model *looked_at;
  hc_status st = model_to_look_at(d->m, &looked_at);
  const hbm_settings how = report_settings(sc, d->c);
  if (st == HC_OK) st = hbm_solver_new(looked_at, &how, &d->s);
  model_free(looked_at);
  if (st != HC_OK) return st;
  const size_t length = 2 * (size_t)hbm_n_harmonics(d->s) + 1, n = (size_t)d->m->n_contacts + 1;
  for (int i = 0; i < 3; ++i) d->series[i] = malloc(length * sizeof *d->series[i]);
  d->w = calloc(n, sizeof *d->w);
  d->periods = calloc(n, sizeof *d->periods);
  return d->series[0] && d->series[1] && d->series[2] && d->w && d->periods ? HC_OK : HC_NO_MEMORY;
}

/* ---- one solution ---- */

/* T over u of a contact with friction, of two tangents T_2 over T_1, else N over v: a period that follows one in which
 * the slider settles. Two tangents go by short steps, which are of first order where the direction of slip turns
 * (contact_law.h). `first` is the model's contact, j the case's. A table is drawn as it was given, with f(0). */
static json_t *loop_of(const shown *d, int j, int first, double omega)
{
  const structure_contact *given = &d->sc->structure->contacts[j];
  const model_contact *of = &d->m->contacts[first];
  const bool pair = of->pair == CONTACT_FIRST, smooth = of->law.smooth != CONTACT_KINKED;
  const bool rubs = contact_rubs(&of->law), table = scene_contact_is_composed(&given->given);
  const double side = table && dot_product(d->m->n, of->normal, given->normal) < 0 ? -1 : 1;
  const int H = hbm_n_harmonics(d->s), steps = SAMPLES * (pair ? STEPS : 1);
  double w[2] = {d->w[first], pair ? d->w[first + 1] : 0}, T[2] = {0};
  json_t *x = json_array(), *y = json_array();
  for (int i = -steps; i <= steps; ++i) {
    const double th = TWO_PI * i / steps, c = cos(th), s = sin(th), v = series_at(H, d->series[1], c, s).x;
    const double u[2] = {series_at(H, d->series[0], c, s).x, pair ? series_at(H, d->series[2], c, s).x : 0};
    const double normal = contact_normal(&of->law, v);
    if (smooth) T[0] = contact_along(&of->law, normal, omega * series_at(H, d->series[0], c, s).d1);
    else if (pair && of->circle) contact_step_planar(&of->law, u, v, w, T);
    else
      for (int k = 0; k < 1 + pair && (pair || rubs); ++k) contact_step(&of->law, u[k], v, &w[k], &T[k]);
    if (i < 0 || i % (steps / SAMPLES)) continue;
    const double f = table ? scene_contact_table(&given->given, side * v) : contact_across(&of->law, v);
    json_array_append_new(x, number(pair ? T[0] : rubs ? u[0] : side * v));
    json_array_append_new(y, number(pair ? T[1] : rubs ? T[0] : f));
  }
  return json_pack("{s:s, s:o, s:o, s:o}", "of",
                   pair                                  ? "T_2 over T_1"
                   : rubs                                ? "T over u"
                   : given->given.kind != CONTACT_KINKED ? "f over d"
                                                         : "N over v",
                   "x", x, "y", y, "work", number(d->periods[j].work));
}

static hc_status shape_of(shown *d, double omega, const double *X, json_t *amplitude, json_t *cosine, json_t *sine)
{
  hc_status st = HC_OK;
  for (int i = 0; i < d->m->n && st == HC_OK; ++i) {
    hbm_measures m;
    st = hbm_measure_response(d->s, omega, X, 1 + i, &m);
    if (st == HC_OK) st = hbm_response(d->s, omega, X, 1 + i, d->series[0]);
    if (st != HC_OK) return st;
    json_array_append_new(amplitude, number(m.amplitude));
    json_array_append_new(cosine, number(d->series[0][1]));
    json_array_append_new(sine, number(d->series[0][2]));
  }
  return st;
}

/* Stability of solution k at omega, in the comparison's k-th row there: by HBM's multipliers if they were computed,
 * else by those of the exact orbit next to it. */
static int shown_stability(const comparison *c, double omega, int k)
{
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *row = &c->rows[i];
    if (row->omega != omega || row->response != 0 || k-- != 0) continue;
    const bool by_orbit = isnan(row->stability.multiplier) && row->orbit_status == HC_OK;
    return by_orbit ? timeint_stability(&row->orbit) : hbm_stability_verdict(&row->stability);
  }
  return 0;
}

/* Solution k of *at, appended to the list; one that cannot be measured is left out. */
static hc_status append_solution(shown *d, const hbm_curve *at, int k, json_t *list)
{
  const hbm_point *p = &at->points[k];
  const double *X = hbm_curve_X(at, k);
  json_t *amplitude = json_array(), *cosine = json_array(), *sine = json_array(), *loops = json_array();
  hc_status st = shape_of(d, p->omega, X, amplitude, cosine, sine);
  if (st == HC_OK) {
    st = hbm_sliders(d->s, X, d->w);
    if (st == HC_OK) st = hbm_measure_contacts(d->s, p->omega, X, d->periods);
    for (int j = 0, first = 0; first < d->m->n_contacts && j < MOST_CONTACTS && st == HC_OK; ++j, ++first) {
      const bool pair = d->m->contacts[first].pair == CONTACT_FIRST;
      for (int i = 0; i < 2 + pair && st == HC_OK; ++i)
        st = hbm_response(d->s, p->omega, X, 1 + d->m->n + 2 * first + i, d->series[i]);
      if (st == HC_OK) json_array_append_new(loops, loop_of(d, j, first, p->omega));
      first += pair;
      while (d->m->contacts[first + 1].pair == CONTACT_MORE) ++first; /* the list ends with an empty one */
    }
  }
  json_t *solution = json_pack("{s:f, s:i, s:i, s:o, s:o, s:o, s:o}", "omega", p->omega, "branch", p->branch, "stable",
                               shown_stability(d->c, p->omega, k), "amplitude", amplitude, "cosine", cosine, "sine",
                               sine, "loops", loops);
  if (st == HC_OK) json_array_append_new(list, solution);
  else json_decref(solution);
  return st == HC_NO_MEMORY ? st : HC_OK;
}

/* ---- all of them ---- */

/* The comparison's frequencies, ascending as they are there, at most MOST_OMEGAS spread over all; how many. */
static int choose_omegas(const comparison *c, double omega[MOST_OMEGAS])
{
  double all[NUMBER_LIST_MAX];
  int n = 0, chosen = 0;
  for (int i = 0; i < c->n_rows && n < NUMBER_LIST_MAX; ++i)
    if (n == 0 || c->rows[i].omega != all[n - 1]) all[n++] = c->rows[i].omega;
  for (int i = 0; i < n && chosen < MOST_OMEGAS; i += (n + MOST_OMEGAS - 1) / MOST_OMEGAS) omega[chosen++] = all[i];
  return chosen;
}

hc_status structure_json(const scene *sc, const comparison *c, json_t *others, const hc_monitor *monitor, json_t **out)
{
  model *m = NULL;
  *out = NULL;
  if (scene_is_oscillator(sc)) return *out = json_null(), HC_OK;
  hc_status st = scene_model(sc, &m);
  if (st != HC_OK) return st;
  shown d = {.sc = sc, .c = c, .m = m, .monitor = monitor};
  json_t *list = json_array();
  st = shown_open(sc, &d);
  if (st == HC_OK) {
    double omega[MOST_OMEGAS];
    const int n = choose_omegas(c, omega);
    for (int i = 0; i < n && st == HC_OK; ++i) {
      hbm_curve at = {0};
      if (hbm_curve_at(d.s, &c->curve, omega[i], &at) == HC_NO_MEMORY) st = HC_NO_MEMORY;
      for (int k = 0; k < at.n && json_array_size(list) < MOST_SOLUTIONS && st == HC_OK; ++k)
        st = append_solution(&d, &at, k, list);
      hbm_curve_free(&at);
      if (!hc_monitor_tick(d.monitor, -1)) st = HC_INTERRUPTED;
    }
  }
  json_t *dofs = json_array(), *responses = json_array(), *contacts = json_array();
  /* What the degrees of freedom, responses and contacts are called. */
  char text[NAME];
  double *direction = calloc((size_t)m->n, sizeof *direction);
  for (int i = 0; i < m->n && direction; ++i) {
    direction[i] = 1;
    json_array_append_new(dofs, json_string(structure_direction_name(sc->structure, direction, text, sizeof text)));
    direction[i] = 0;
  }
  free(direction);
  for (int r = 0; r < structure_response_count(sc->structure); ++r)
    json_array_append_new(responses, json_string(structure_response_name(sc->structure, r, text, sizeof text)));
  for (int j = 0; j < scene_contact_count(sc); ++j) {
    const char *name = scene_contact_at(sc, j)->name;
    snprintf(text, sizeof text, *name ? "%d %s" : "%d", j, name);
    json_array_append_new(contacts, json_string(text));
  }
  *out = json_pack("{s:o, s:O, s:o, s:o, s:o}", "names", responses, "responses", others, "dofs", dofs, "contacts",
                   contacts, "solutions", list);
  for (int i = 0; i < 3; ++i) free(d.series[i]);
  free(d.w);
  free(d.periods);
  hbm_solver_free(d.s);
  model_free(m);
  return st == HC_OK && !*out ? HC_NO_MEMORY : st;
}
