/* structure_variations.c - see structure_variations.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/structure_variations.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/norm.h"
hc_status structure_variations_make(structure_variations *v, const modal_base *base)
{
  const size_t n = (size_t)base->n, states = 2 * n + (size_t)base->n_contacts;
  *v = (structure_variations){.n = base->n, .n_states = (int)states};
  v->matrix = calloc(states * states + 2 * n, sizeof *v->matrix);
  if (!v->matrix) return HC_NO_MEMORY;
  v->moved = v->matrix + states * states;
  return motion_series_make(&v->series, base);
}

void structure_variations_free(structure_variations *v)
{
  motion_series_free(&v->series);
  free(v->matrix);
}

static double *column_of(const structure_variations *v, int q) { return v->matrix + (size_t)q * (size_t)v->n_states; }

/* dU and dV of contact j in a column. */
static void motion_of(const modal_base *b, int j, const double *column, double *du, double *dv)
{
  *du = dot_product(b->n, b->tangent + (size_t)j * (size_t)b->n, column);
  *dv = dot_product(b->n, b->normal + (size_t)j * (size_t)b->n, column);
}

void structure_variations_begin(structure_variations *v, const scaled_model *m, const contact_track *track)
{
  const size_t n = (size_t)v->n_states;
  memset(v->matrix, 0, n * n * sizeof *v->matrix);
  for (size_t i = 0; i < 2 * (size_t)v->n; ++i) v->matrix[i * (n + 1)] = 1;
  for (int j = 0; j < m->n_contacts; ++j) {
    const int w = 2 * v->n + j;
    const contact_track *t = &track[j];
    if (t->state != CONTACT_STICK || !m->contact[j].law.has_friction) continue;
    if (t->since_start) column_of(v, w)[w] = 1;
    for (int q = 0; q < 2 * v->n && !t->since_start; ++q) { /* on its limit: put there, as the motion has it */
      double du, dv;
      motion_of(m->base, j, column_of(v, q), &du, &dv);
      const contact_state slip = t->limit > 0 ? CONTACT_SLIP_PLUS : CONTACT_SLIP_MINUS;
      column_of(v, q)[w] = contact_track_vary_rest(&m->contact[j], slip, &(contact_motion){0}, du, dv);
    }
  }
}

/* One column over a span, in steps as long as its own series allows. */
static hc_status advance_column(structure_variations *v, const scaled_model *m, const contact_track *track, double span,
                                double *column)
{
  const size_t n = (size_t)v->n;
  double size = 0;
  for (int i = 0; i < v->n_states; ++i) size += fabs(column[i]);
  if (size == 0) return HC_OK;
  for (double done = 0; done < span;) {
    const double reach = motion_series_vary(&v->series, m, track, column, column + 2 * n), left = span - done;
    if (!(reach > 0)) return HC_NOT_FINITE;
    motion_series_at(&v->series, fmin(reach, left), 0, v->moved);
    memcpy(column, v->moved, 2 * n * sizeof *column);
    if (reach >= left) return HC_OK;
    done += reach;
  }
  return HC_OK;
}

hc_status structure_variations_advance(structure_variations *v, const scaled_model *m, const contact_track *track,
                                       double theta)
{
  const double span = theta - v->theta;
  v->theta = theta;
  for (int q = 0; q < v->n_states && span > 0; ++q) {
    hc_status st = advance_column(v, m, track, span, column_of(v, q));
    if (st != HC_OK) return st;
  }
  return HC_OK;
}

void structure_variations_stick(structure_variations *v, const scaled_model *m, int j, contact_state before,
                                const contact_motion *at)
{
  if (!m->contact[j].law.has_friction) return;
  for (int q = 0; q < v->n_states; ++q) {
    double du, dv, *column = column_of(v, q);
    motion_of(m->base, j, column, &du, &dv);
    column[2 * v->n + j] = contact_track_vary_rest(&m->contact[j], before, at, du, dv);
  }
}

void structure_variations_end(structure_variations *v, const scaled_model *m, const contact_track *track,
                              double *monodromy)
{
  const size_t n = (size_t)v->n_states;
  for (int j = 0; j < m->n_contacts; ++j) {
    if (m->contact[j].law.has_friction && track[j].state == CONTACT_STICK) continue;
    for (int q = 0; q < v->n_states; ++q) {
      double du, dv;
      motion_of(m->base, j, column_of(v, q), &du, &dv);
      column_of(v, q)[2 * v->n + j] = contact_track_vary_slider(&track[j], &m->contact[j], du, dv);
    }
  }
  memcpy(monodromy, v->matrix, n * n * sizeof *monodromy);
}
