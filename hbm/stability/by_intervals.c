/* by_intervals.c - multipliers by intervals (monodromy.h). The period starts at the end of its longest
 * interval. Few motions outlast that (interval_flow.h), and columns are made of them alone; where there is planar
 * friction or a smooth law, of all states there. */
#include <stdlib.h>
#include <string.h>

#include "hbm/stability/interval_flow.h"
#include "hbm/stability/monodromy.h"
#include "hbm/stability/variation.h"
#include "numerics/floquet.h"

typedef struct by_intervals {
  variation v;
  interval_flow *flow;
  planar_flow *planar; /* NULL: the model has neither planar friction nor smooth laws */
  bool bends;          /* a contact follows a smooth law */
  double *size;        /* [n_states] of a state, in the columns of phi, where there is `planar` */
  int *slider;         /* [n_states] contacts whose sliders have columns, where there is none */
  bool *sticks_on;     /* [n_states] of variation_held_sliders */
  double *map;         /* [n_states][n_states] by rows: the end of the period in coordinates of its first columns */
  int *column;         /* [n_states] the rows and columns of map that are the period's */
  floquet *floquet;
} by_intervals;

static void by_intervals_free(void *self)
{
  by_intervals *w = self;
  if (!w) return;
  floquet_free(w->floquet);
  interval_flow_free(w->flow);
  planar_flow_free(w->planar);
  variation_free(&w->v);
  free(w);
}

static hc_status by_intervals_make(const model *m, void **self, variation **v)
{
  by_intervals *w = *self = calloc(1, sizeof *w);
  if (!w) return HC_NO_MEMORY;
  *v = &w->v;
  hc_status st = variation_make(&w->v, m, 0);
  const size_t states = (size_t)w->v.n_states;
  workspace *memory = &w->v.memory;
  w->size = workspace_doubles(memory, states);
  w->slider = workspace_array(memory, states, sizeof *w->slider);
  w->sticks_on = workspace_array(memory, states, sizeof *w->sticks_on);
  w->column = workspace_array(memory, states, sizeof *w->column);
  w->map = workspace_doubles(memory, states * states);
  w->bends = model_is_smooth(m);
  if (st == HC_OK) st = memory->failed ? HC_NO_MEMORY : floquet_new(w->v.n_states, &w->floquet);
  if (st == HC_OK) st = interval_flow_new(m, &w->flow);
  if (st == HC_OK && (w->bends || model_has_circle(m))) st = planar_flow_new(m, &w->planar);
  return st;
}

/* Columns of all states there are behind the current interval: each in its size, for a slider that moves by 1 is
 * dheld = kt. */
static void begin_with_all(by_intervals *w)
{
  variation *v = &w->v;
  const size_t states = (size_t)v->n_states;
  v->columns = v->n_states;
  memset(v->phi, 0, states * states * sizeof *v->phi);
  for (int i = 0; i < v->n_states; ++i) {
    const int j = i - 2 * v->n;
    const bool is_slider = j >= 0 && !variation_slips(v, j) && v->m->contacts[j].law.kt > 0;
    v->phi[(size_t)i * (states + 1)] = w->size[i] = is_slider ? v->m->contacts[j].law.kt : 1;
  }
}

/* The columns of phi that the period begins with, behind the interval `last`, which is the current one then. */
static hc_status by_intervals_begin(by_intervals *w, int last)
{
  variation *v = &w->v;
  if (w->planar) {
    variation_find_states(v, last);
    begin_with_all(w);
    return HC_OK;
  }
  const double duration = (variation_end(v, last) - v->boundary[last]) / v->omega;
  const int sliders = variation_held_sliders(v, last, w->slider, w->sticks_on);
  return interval_flow_survivors(w->flow, v->interval, duration, sliders, w->slider, w->sticks_on, v->phi, &v->columns);
}

/* w->map, and w->column[count]: which of its rows and columns. */
static hc_status by_intervals_end(by_intervals *w, int *count)
{
  const variation *v = &w->v;
  const size_t states = (size_t)v->n_states;
  *count = w->planar ? v->n_active : v->columns;
  for (int i = 0; i < *count; ++i) w->column[i] = w->planar ? v->active[i] : i;
  if (!w->planar) return interval_flow_coordinates(w->flow, v->interval, w->slider, v->columns, v->phi, w->map);
  for (size_t i = 0; i < states; ++i)
    for (size_t q = 0; q < states; ++q) w->map[i * states + q] = v->phi[i * states + q] / w->size[i];
  return HC_OK;
}

static bool slopes_of(const void *orbit, int j, double th, double omega, contact_slopes *out)
{
  if (!contact_forces_bends(orbit, j)) return false;
  *out = contact_forces_slopes(orbit, j, th, omega);
  return true;
}

static hc_status by_intervals_find(void *self, int *count, double complex *lambda)
{
  by_intervals *w = self;
  variation *v = &w->v;
  const int n = v->n_intervals;
  if (30 * pow(2.0 * v->n, 3) * n > MONODROMY_MOST_OPERATIONS) /* of eigenvectors, each interval a state of its own */
    return HC_NOT_CONVERGED;
  int last = 0; /* at which the longest interval begins */
  for (int i = 1; i < n; ++i)
    if (variation_end(v, i) - v->boundary[i] > variation_end(v, last) - v->boundary[last]) last = i;
  hc_status st = by_intervals_begin(w, last);
  if (w->bends) planar_flow_bend(w->planar, slopes_of, v->orbit);
  for (int k = 1; k <= n && st == HC_OK; ++k) {
    const int i = (last + k) % n;
    const double from = v->boundary[i], to = variation_end(v, i);
    if (variation_is_empty(v, i)) continue;
    variation_start(v, i);
    st = v->n_slipping || w->bends
             ? planar_flow_advance(w->planar, v->interval, v->n_slipping, v->slipping, from, to, v->omega, v->columns,
                                   v->phi)
             : interval_flow_advance(w->flow, v->interval, (to - from) / v->omega, v->columns, v->phi);
  }
  if (st == HC_OK) st = by_intervals_end(w, count);
  return st == HC_OK ? floquet_multipliers(w->floquet, w->map, v->n_states, 1, *count, w->column, lambda) : st;
}

const multiplier_method multipliers_by_intervals = {by_intervals_make, by_intervals_free, by_intervals_find};
