/* frequencies.c - see frequencies.h. */
#include "compare/frequencies.h"

#include <math.h>
#include <stdlib.h>

#include "base/number.h"

void comparison_sweep(double omega_from, double omega_to, const number_list *asked, double *from, double *to)
{
  double low = fmin(omega_from, omega_to), high = fmax(omega_from, omega_to);
  for (int i = 0; i < asked->n; ++i) {
    low = fmin(low, asked->v[i]);
    high = fmax(high, asked->v[i]);
  }
  bool up = omega_from <= omega_to;
  *from = up ? low : high;
  *to = up ? high : low;
}

static void sort_unique(number_list *list)
{
  qsort(list->v, (size_t)list->n, sizeof *list->v, ascending);
  int n = 0;
  for (int i = 0; i < list->n; ++i)
    if (n == 0 || list->v[i] != list->v[n - 1]) list->v[n++] = list->v[i];
  list->n = n;
}

/* length[k]: arc length of the plotted curve from its start to point k. */
static hc_status drawn_lengths(hbm_solver *hbm, const hbm_curve *c, double *amplitude, double *length)
{
  double top = 0, span = fabs(c->points[c->n - 1].omega - c->points[0].omega);
  for (int k = 0; k < c->n; ++k) {
    hbm_measures m;
    hc_status st = hbm_measure(hbm, c->X + (size_t)k * c->n_coef, &m);
    if (st != HC_OK) return st;
    amplitude[k] = m.amplitude;
    top = fmax(top, m.amplitude);
  }
  length[0] = 0;
  for (int k = 1; k < c->n; ++k) {
    double across = span > 0 ? (c->points[k].omega - c->points[k - 1].omega) / span : 0;
    double upward = top > 0 ? (amplitude[k] - amplitude[k - 1]) / top : 0;
    length[k] = length[k - 1] + hypot(across, upward);
  }
  return HC_OK;
}

static void spread_points(const hbm_curve *c, const double *length, int n, number_list *out)
{
  int k = 0;
  if (n > NUMBER_LIST_MAX) n = NUMBER_LIST_MAX;
  for (int i = 0; i < n; ++i) {
    double at = length[c->n - 1] * (i + 0.5) / n;
    while (k + 2 < c->n && length[k + 1] < at) ++k;
    double part = length[k + 1] > length[k] ? (at - length[k]) / (length[k + 1] - length[k]) : 0;
    out->v[out->n++] = c->points[k].omega + part * (c->points[k + 1].omega - c->points[k].omega);
  }
}

hc_status comparison_frequencies(const compare_settings *where, double omega_from, hbm_solver *hbm, const hbm_curve *c,
                                 number_list *out)
{
  *out = where->omega;
  hc_status st = HC_OK;
  if (out->n == 0 && c->n >= 2) {
    double *work = malloc(2 * (size_t)c->n * sizeof *work);
    if (!work) return HC_NO_MEMORY;
    st = drawn_lengths(hbm, c, work, work + c->n);
    if (st == HC_OK) spread_points(c, work + c->n, where->points, out);
    free(work);
  }
  if (out->n == 0) out->v[out->n++] = omega_from; /* no curve at all: one row that says so */
  sort_unique(out);
  return st;
}
