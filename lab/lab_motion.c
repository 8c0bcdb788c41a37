/* lab_motion.c - see lab.h: what the contacts do along one motion, truly and at its samples. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/contact/aft.h"
#include "hbm/contact/exact_force.h"
#include "hbm/contact/slider.h"
#include "lab/lab_inside.h"
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

/* n rows: th, x, and each contact's u, v, N. */
static hc_status add_instants(lab *l, int n, int n_contacts, const moving_contact *contacts)
{
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
      to[2] = contact_normal(&contacts[j].law, to[1]);
    }
  }
  return HC_OK;
}

static double *instant(lab *l, int i, int j)
{
  return l->values + (size_t)i * (size_t)l->columns + BEFORE + OF_CONTACT * j;
}

static hc_status exact_tractions(lab *l, int n, const model *m, const moving_contact *contacts)
{
  double F[LAB_MOST_COEF];
  exact_force *e;
  hc_status st = exact_force_new_of_model(l->n_harm, m, &e);
  if (st == HC_OK) st = exact_force_eval(e, l->X, F, NULL, NULL);
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
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
static hc_status sampled_tractions(lab *l, int n, const model *m, const moving_contact *contacts)
{
  double *x = calloc(3 * (size_t)n, sizeof *x), *T = x ? x + n : NULL, *again = x ? T + n : NULL;
  sampled_interval *states = calloc(2 * (size_t)n, sizeof *states);
  hc_status st = x && states ? HC_OK : HC_NO_MEMORY;
  for (int i = 0; i < n && st == HC_OK; ++i) x[i] = l->values[(size_t)i * (size_t)l->columns + 1];
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    const slider_motion motion = {x, x, contacts[j].cu[0], contacts[j].cv[0], 1, 0};
    slider_follow(&contacts[j].law, l->sc.hbm.restart, n, &motion, T, again, states, states + n);
    for (int i = 0; i < n; ++i) instant(l, i, j)[3] = T[i];
  }
  free(x);
  free(states);
  return st;
}

int lab_signal(lab *l, int force, int n)
{
  model *m = NULL;
  moving_contact *contacts = NULL;
  lab_begin(l, 0);
  if (!has_motion(l) || n < 1 || force < 0 || force >= LAB_FORCES) return lab_answer(l, HC_BAD_INPUT);
  hc_status st = scene_model(&l->sc, &m);
  if (st == HC_OK) st = moving_contacts_of_model(m, &contacts);
  if (st == HC_OK) st = add_instants(l, n, m->n_contacts, contacts);
  if (st == HC_OK) st = force == LAB_EXACT ? exact_tractions(l, n, m, contacts) : sampled_tractions(l, n, m, contacts);
  free(contacts);
  model_free(m);
  return lab_answer(l, st);
}

/* ---- harmonics ---- */

static hc_status sampled_harmonics(const lab *l, const model *m, int n, double *F)
{
  aft *a;
  if (n < 2 * l->n_harm + 1) return HC_OK;
  hc_status st = aft_new_of_model(m, l->sc.hbm.restart, l->n_harm, n, &a);
  if (st == HC_OK) st = aft_eval(a, l->X, F, NULL, NULL);
  aft_free(a);
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
  /* F[2 n_shown + 1] of the motion, whose harmonics above n_harm are 0. */
  if (st == HC_OK) {
    double X[LAB_MOST_COEF] = {0};
    exact_force *e;
    memcpy(X, l->X, (size_t)(2 * l->n_harm + 1) * sizeof *X);
    st = exact_force_new_of_model(n_shown, m, &e);
    if (st == HC_OK) st = exact_force_eval(e, X, F, NULL, NULL);
    exact_force_free(e);
  }
  if (st == HC_OK) st = sampled_harmonics(l, m, n, sampled);
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

static hc_status add_work(lab *l, const moving_contact *c)
{
  double u[LAB_MOST_COEF], v[LAB_MOST_COEF];
  contact_period p;
  for (int i = 0; i < 2 * l->n_harm + 1; ++i) {
    u[i] = c->cu[0] * l->X[i];
    v[i] = c->cv[0] * l->X[i];
  }
  hc_status st = contact_measures_of(&c->law, l->n_harm, u, v, &p);
  if (st != HC_OK) return st;
  return LAB_ADD(l, p.regime, p.normal_min, p.normal_max, p.traction_max, p.slip_distance, p.work);
}

int lab_work(lab *l)
{
  enum { COLUMNS = 6 };
  model *m = NULL;
  moving_contact *contacts = NULL;
  lab_begin(l, COLUMNS);
  if (!has_motion(l)) return lab_answer(l, HC_BAD_INPUT);
  hc_status st = scene_model(&l->sc, &m);
  if (st == HC_OK) st = moving_contacts_of_model(m, &contacts);
  for (int j = 0; st == HC_OK && j < m->n_contacts; ++j) st = add_work(l, &contacts[j]);
  free(contacts);
  model_free(m);
  return lab_answer(l, st);
}
