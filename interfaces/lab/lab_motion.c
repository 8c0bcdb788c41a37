/* lab_motion.c - see lab.h: what the contacts do along one motion, truly and at its samples. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/contact/exact_force.h"
#include "hbm/contact/slider.h"
#include "hbm/forces/contact_kind.h"
#include "hbm/forces/given_motion.h"
#include "interfaces/lab/lab_inside.h"
#include "numerics/base/constants.h"
#include "numerics/series.h"

enum { OF_CONTACT = 4 /* columns: u, v, N, T */, BEFORE = 2 /* th, x */ };

double *lab_motion(lab *l, int n_harm)
{
  const bool fits = n_harm >= 1 && n_harm <= HBM_MAX_HARMONICS;
  l->n_harm = fits ? n_harm : 0;
  return fits ? l->X : NULL;
}

static bool has_motion(const lab *l) { return l->has_case && l->n_harm > 0; }

/* ---- instants ---- */

/* f of a polynomial or a table, N of any other law. */
static double force_across(const scene_contact *c, const contact *law, double v)
{
  return scene_contact_is_composed(c) ? scene_contact_table(c, v) : contact_across(law, v);
}

/* n rows: th, x, and each contact's u, v, N. */
static hc_status add_instants(lab *l, int n, const moving_contact *contacts)
{
  const int n_contacts = scene_contact_count(&l->sc);
  lab_begin(l, BEFORE + OF_CONTACT * n_contacts);
  for (int i = 0; i < n; ++i) {
    double *row = lab_row(l);
    if (!row) return HC_NO_MEMORY;
    const double th = TWO_PI * i / n;
    row[0] = th;
    row[1] = series_at(l->n_harm, l->X, cos(th), sin(th)).x;
    for (int j = 0; j < n_contacts; ++j) {
      double *to = row + BEFORE + OF_CONTACT * j;
      to[0] = contacts[j].cu[0] * row[1];
      to[1] = contacts[j].cv[0] * row[1];
      to[2] = force_across(scene_contact_at(&l->sc, j), &contacts[j].law, to[1]);
    }
  }
  return HC_OK;
}

static double *instant(lab *l, int i, int j)
{
  return l->values + (size_t)i * (size_t)l->columns + BEFORE + OF_CONTACT * j;
}

static hc_status exact_tractions(lab *l, int n, const moving_contact *contacts)
{
  double F[LAB_MOST_COEF];
  exact_force *e;
  hc_status st = exact_force_new(l->n_harm, 1, scene_contact_count(&l->sc), contacts, &e);
  if (st == HC_OK) st = exact_force_eval(e, l->X, F, NULL, NULL);
  for (int j = 0; j < scene_contact_count(&l->sc) && st == HC_OK; ++j) {
    int n_intervals;
    const contact_interval *intervals = exact_force_intervals(e, j, &n_intervals);
    for (int i = 0; i < n; ++i) {
      double *at = instant(l, i, j);
      const contact_interval *now = contact_interval_at(n_intervals, intervals, TWO_PI * i / n);
      at[3] = contact_interval_traction(&contacts[j].law, now, at[0], at[2]);
    }
  }
  exact_force_free(e);
  return st;
}

/* The tractions by the n instants as samples. */
static hc_status sampled_tractions(lab *l, int n, const moving_contact *contacts)
{
  double *x = calloc(3 * (size_t)n, sizeof *x), *T = x ? x + n : NULL, *again = x ? T + n : NULL;
  sampled_interval *states = calloc(2 * (size_t)n, sizeof *states);
  hc_status st = x && states ? HC_OK : HC_NO_MEMORY;
  for (int i = 0; i < n && st == HC_OK; ++i) x[i] = l->values[(size_t)i * (size_t)l->columns + 1];
  for (int j = 0; j < scene_contact_count(&l->sc) && st == HC_OK; ++j) {
    const slider_motion motion = {x, x, contacts[j].cu[0], contacts[j].cv[0], 1, 0};
    const slider_rule rule = {.restart = l->sc.hbm.restart};
    slider_follow(&contacts[j].law, &rule, n, &motion, T, again, states, states + n);
    for (int i = 0; i < n; ++i) instant(l, i, j)[3] = T[i];
  }
  free(x);
  free(states);
  return st;
}

int lab_signal(lab *l, int force, int n)
{
  moving_contact contacts[SCENE_MAX_CONTACTS];
  lab_begin(l, 0);
  if (!has_motion(l) || n < 1 || force < 0 || force >= LAB_FORCES) return lab_answer(l, HC_BAD_INPUT);
  for (int j = 0; j < scene_contact_count(&l->sc); ++j) contacts[j] = scene_moving_contact(scene_contact_at(&l->sc, j));
  hc_status st = add_instants(l, n, contacts);
  if (st == HC_OK) st = force == LAB_EXACT ? exact_tractions(l, n, contacts) : sampled_tractions(l, n, contacts);
  return lab_answer(l, st);
}

/* ---- harmonics ---- */

/* F[2 n_harm + 1] of the contacts along X, by n_time samples or exactly, with what of a table is linear. */
static hc_status force_harmonics(const lab *l, const model *m, int n_harm, int n_time, double *F)
{
  double X[LAB_MOST_COEF] = {0};
  moving_contact *contacts;
  memcpy(X, l->X, (size_t)(2 * l->n_harm + 1) * sizeof *X); /* above n_harm there is none */
  hc_status st = moving_contacts_of_model(m, &contacts);
  const given_motion of = {.n_harm = n_harm, .n_dof = 1, .n_contacts = m->n_contacts, .contacts = contacts, .X = X};
  if (st == HC_OK) st = given_motion_force(&of, l->sc.hbm.restart, n_time, F);
  free(contacts);
  for (int j = 0; j < scene_contact_count(&l->sc) && st == HC_OK; ++j)
    for (int i = 0; i < 2 * n_harm + 1; ++i) F[i] += scene_contact_slope(scene_contact_at(&l->sc, j)) * X[i];
  return st;
}

int lab_spectrum(lab *l, int n, int n_shown)
{
  enum { COLUMNS = 5 };
  double F[LAB_MOST_COEF] = {0}, sampled[LAB_MOST_COEF] = {0};
  model *m = NULL;
  lab_begin(l, COLUMNS);
  if (!has_motion(l) || n < 1 || n_shown < l->n_harm || n_shown > HBM_MAX_HARMONICS) return lab_answer(l, HC_BAD_INPUT);
  hc_status st = scene_model(&l->sc, &m);
  if (st == HC_OK) st = force_harmonics(l, m, n_shown, GIVEN_EXACT, F);
  if (st == HC_OK && n >= 2 * l->n_harm + 1) st = force_harmonics(l, m, l->n_harm, n, sampled);
  /* h, cosine and sine of both. */
  if (st == HC_OK) {
    st = LAB_ADD(l, 0, F[0], 0, sampled[0], 0);
    for (int h = 1; h <= n_shown && st == HC_OK; ++h)
      st = LAB_ADD(l, h, F[2 * h - 1], F[2 * h], sampled[2 * h - 1], sampled[2 * h]);
  }
  model_free(m);
  return lab_answer(l, st);
}

/* ---- work ---- */

/* What the model's contacts m of the lab's contact j do; N of a table, which is piecewise linear, at its points and the
 * motion's extrema. */
static hc_status add_work(lab *l, int j, const model_contact *m)
{
  const scene_contact *c = scene_contact_at(&l->sc, j);
  double u[LAB_MOST_COEF], v[LAB_MOST_COEF], most, least;
  contact_period p = {0};
  hc_status st = HC_OK;
  for (int k = 0; k < scene_contact_parts(c) && st == HC_OK; ++k) {
    const placed_contact one = {.law = m[k].law};
    const contact_regime before = p.regime;
    for (int i = 0; i < 2 * l->n_harm + 1; ++i) u[i] = *m[k].tangent * l->X[i], v[i] = *m[k].normal * l->X[i];
    st = contact_kind_of(&one)->measures(&m[k].law, l->n_harm, u, NULL, v, &p);
    p.regime = contact_regime_larger(p.regime, before);
  }
  if (st == HC_OK && scene_contact_is_composed(c)) {
    series_extrema(l->n_harm, l->X, &most, &least);
    const double first = scene_contact_table(c, most), last = scene_contact_table(c, least);
    p.normal_min = fmin(first, last), p.normal_max = fmax(first, last);
    for (int i = 0; i < c->n_points; ++i) {
      if (!(c->points[i][0] > least && c->points[i][0] < most)) continue;
      p.normal_min = fmin(p.normal_min, c->points[i][1]), p.normal_max = fmax(p.normal_max, c->points[i][1]);
    }
  }
  if (st != HC_OK) return st;
  return LAB_ADD(l, p.regime, p.normal_min, p.normal_max, p.traction_max, p.slip_distance, p.work);
}

int lab_work(lab *l)
{
  enum { COLUMNS = 6 };
  model *m = NULL;
  lab_begin(l, COLUMNS);
  if (!has_motion(l)) return lab_answer(l, HC_BAD_INPUT);
  hc_status st = scene_model(&l->sc, &m);
  for (int j = 0; st == HC_OK && j < scene_contact_count(&l->sc); ++j)
    st = add_work(l, j, &m->contacts[scene_model_contact(&l->sc, j)]);
  model_free(m);
  return lab_answer(l, st);
}
