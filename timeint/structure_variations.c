/* structure_variations.c - see structure_variations.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/structure_variations.h"

#include <stdlib.h>
#include <string.h>

hc_status structure_variations_make(structure_variations *v, const modal_base *base, phase_modes *modes)
{
  const size_t states = 2 * (size_t)base->n + (size_t)base->n_contacts;
  *v = (structure_variations){.n = base->n, .n_states = (int)states, .modes = modes};
  v->rows = calloc(states * (states + 2), sizeof *v->rows);
  v->state = calloc(states, sizeof *v->state);
  if (!v->rows || !v->state) return HC_NO_MEMORY;
  v->du = v->rows + states * states;
  v->dv = v->du + states;
  hc_status st = series_columns_make(&v->series, base);
  return st == HC_OK && modes ? modes_columns_make(&v->by_modes, base) : st;
}

void structure_variations_free(structure_variations *v)
{
  series_columns_free(&v->series);
  modes_columns_free(&v->by_modes);
  free(v->rows);
  free(v->state);
}

static double *row_of(const structure_variations *v, int i) { return v->rows + (size_t)i * (size_t)v->n_states; }
static double *slider_of(const structure_variations *v, int j) { return row_of(v, 2 * v->n + j); }

/* out[n_columns] := along . D */
static void project(const structure_variations *v, const double *along, double *restrict out)
{
  memset(out, 0, (size_t)v->n_columns * sizeof *out);
  for (int i = 0; i < v->n; ++i) {
    const double *row = row_of(v, i), a = along[i];
    for (int q = 0; q < v->n_columns && a != 0; ++q) out[q] += a * row[q];
  }
}

/* v->du and v->dv of contact j. */
static void find_motion(structure_variations *v, const modal_base *b, int j)
{
  project(v, b->tangent + (size_t)j * (size_t)b->n, v->du);
  project(v, b->normal + (size_t)j * (size_t)b->n, v->dv);
}

void structure_variations_begin(structure_variations *v, const scaled_model *m, const contact_track *track)
{
  const size_t n = (size_t)v->n_states;
  memset(v->rows, 0, n * n * sizeof *v->rows);
  v->n_columns = 0;
  for (int i = 0; i < v->n_states; ++i) {
    const int j = i - 2 * v->n;
    const bool moves = j < 0 || (m->contact[j].law.has_friction && track[j].since_start);
    if (!moves) continue;
    row_of(v, i)[v->n_columns] = 1;
    v->state[v->n_columns++] = i;
  }
  for (int j = 0; j < m->n_contacts; ++j) { /* on its limit: put there, as the motion has it */
    const contact_track *t = &track[j];
    if (t->state != CONTACT_STICK || !m->contact[j].law.has_friction || t->since_start) continue;
    const contact_state slip = t->limit > 0 ? CONTACT_SLIP_PLUS : CONTACT_SLIP_MINUS;
    structure_variations_stick(v, m, j, slip, &(contact_motion){0});
  }
}

hc_status structure_variations_advance(structure_variations *v, const scaled_model *m, const contact_track *track,
                                       double theta)
{
  const double span = theta - v->theta;
  v->theta = theta;
  if (!(span > 0)) return HC_OK;
  const complex_modes *modes = NULL;
  hc_status st = HC_OK;
  if (phase_modes_pay(v->modes, 1 / m->by_C, span)) st = phase_modes_of(v->modes, m, track, &modes);
  if (st != HC_OK) return st;
  if (modes) {
    modes_columns_advance(&v->by_modes, m, modes, track, span, v->n_columns, v->n_states, v->rows);
    return HC_OK;
  }
  series_columns_begin(&v->series, m, track);
  return series_columns_advance(&v->series, m, span, v->n_columns, v->n_states, v->rows);
}

void structure_variations_stick(structure_variations *v, const scaled_model *m, int j, contact_state before,
                                const contact_motion *at)
{
  if (!m->contact[j].law.has_friction) return;
  double *slider = slider_of(v, j);
  find_motion(v, m->base, j);
  for (int q = 0; q < v->n_columns; ++q)
    slider[q] = contact_track_vary_rest(&m->contact[j], before, at, v->du[q], v->dv[q]);
}

void structure_variations_end(structure_variations *v, const scaled_model *m, const contact_track *track,
                              double *monodromy)
{
  const size_t n = (size_t)v->n_states;
  for (int j = 0; j < m->n_contacts; ++j) {
    if (m->contact[j].law.has_friction && track[j].state == CONTACT_STICK) continue;
    double *slider = slider_of(v, j);
    find_motion(v, m->base, j);
    for (int q = 0; q < v->n_columns; ++q)
      slider[q] = contact_track_vary_slider(&track[j], &m->contact[j], v->du[q], v->dv[q]);
  }
  memset(monodromy, 0, n * n * sizeof *monodromy);
  for (int q = 0; q < v->n_columns; ++q)
    for (size_t i = 0; i < n; ++i) monodromy[(size_t)v->state[q] * n + i] = row_of(v, (int)i)[q];
}
