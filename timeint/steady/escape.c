/* escape.c - see escape.h. Proof: tests/timeint/test_escape.c. */
#include "timeint/steady/escape.h"

#include <math.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/norm.h"
#include "timeint/steady/timeint_private.h"

/* [least_length] Loads alone cause so much only within a thousandth of a resonance. */
static const double large = 1e3;
/* [1] A beat of detuning delta grows as sin(delta t/2): at twice the time by 2 cos(delta t/4) - 1 of what it grew
 * before. Within this it reaches 16 times the present size and more, after max_periods. */
static const double steady_growth = 1e-3;
/* [1] CVODE's errors are 1e-9 of the place the body has come to, up to a hundred steps d away */
static const double same_step = 1e-6;
static const double rounding = 1e-9; /* [1] of K d, beside the terms it is made of; of d, beside the motion */

hc_status escape_size(const timeint *ti)
{
  const double unbounded = 1e9, grown = 1e3; /* [least_length]; [size of the start], which may be any */
  const double size = timeint_size(ti);
  if (!isfinite(size)) return HC_NOT_FINITE;
  return size <= fmax(unbounded * ti->least_length, grown * ti->start_size) ? HC_OK : HC_UNBOUNDED;
}

bool escape_note(timeint *ti)
{
  if (ti->periods < 2 * ti->noted[1].periods || ti->periods == 0) return false;
  ti->noted[0] = ti->noted[1];
  ti->noted[1].periods = ti->periods;
  ti->noted[1].size = timeint_size(ti);
  return true;
}

bool escape_grows(const timeint *ti)
{
  const double undamped = 1 - 1e-12; /* [1] a period, by rounding of the matrix of damping in modes */
  const size_noted *a = &ti->noted[0], *b = &ti->noted[1];
  const double size = timeint_size(ti);
  if (a->periods == 0 || ti->periods <= b->periods || !(ti->contraction >= undamped)) return false;
  const double before = (b->size - a->size) / (b->periods - a->periods),
               now = (size - b->size) / (ti->periods - b->periods);
  return size > large * ti->least_length && before > 0 && fabs(now - before) <= steady_growth * before;
}

/* ---- creep ---- */

bool timeint_may_creep(const timeint *ti)
{
  const modal_base *b = ti->base;
  if (!b->diagonal_K) return true;
  for (int i = 0; i < b->n; ++i)
    if (fabs(b->K[i]) <= rounding * b->highest * b->highest) return true;
  return false;
}

/* True if springs, and contacts but by sliders that move with it, do not feel the step d[n_dof] of size `step`. */
static bool is_free(const timeint *ti, const double *d, const double *sliders, double step)
{
  const model *m = ti->model;
  const int n = m->n;
  for (int i = 0; i < n; ++i) {
    double sum = 0, terms = 0;
    for (int k = 0; k < n; ++k) {
      const double term = m->stiffness[i + (size_t)n * (size_t)k] * d[k];
      sum += term, terms += fabs(m->stiffness[i + (size_t)n * (size_t)k]) * step;
    }
    if (!(fabs(sum) <= same_step * terms)) return false;
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    const contact *law = &m->contacts[j].law;
    const double across = dot_product(n, m->contacts[j].normal, d), along = dot_product(n, m->contacts[j].tangent, d);
    const bool slides = contact_has_friction(law) || law->smooth == CONTACT_TANH;
    if (!(fabs(across) <= same_step * step) || (!slides && !(fabs(along) <= same_step * step))) return false;
    if (contact_has_friction(law) && !(fabs(sliders[j] - along) <= same_step * step)) return false;
  }
  return true;
}

hc_status escape_look_for_creep(timeint *ti, bool *creeps)
{
  const int n = ti->n_dof;
  double step = 0, speed = 0, differs = 0, changes = 0;
  hc_status st = HC_OK;
  *creeps = ti->creeps = false;
  if (!timeint_may_creep(ti)) return HC_OK;
  const double tolerance = ti->tolerance;
  st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  for (int k = 0; k < 3 && st == HC_OK; ++k) {
    if (k > 0) st = timeint_period(ti, false);
    timeint_get_state(ti, ti->states[k]);
  }
  if (st == HC_OK) st = timeint_set_tolerance(ti, tolerance);
  if (st != HC_OK) return st;
  const double *a = ti->states[0], *b = ti->states[1], *c = ti->states[2];
  double *d = ti->states[0]; /* [n] the last step: what a was is not needed where d is written */
  for (int i = 0; i < n; ++i) {
    step = larger(step, fabs(c[i] - b[i]));
    differs = larger(differs, fabs(c[i] - b[i] - (b[i] - a[i])));
    speed = larger(speed, fabs(c[n + i]));
    changes = larger(changes, fabs(c[n + i] - b[n + i]));
  }
  for (int i = 0; i < ti->n; ++i) d[i] = c[i] - b[i];
  *creeps = step > rounding * ti->least_length && differs <= same_step * step &&
            changes <= same_step * (speed + step * ti->omega / TWO_PI) && is_free(ti, d, d + 2 * n, step);
  ti->creeps = *creeps;
  if (*creeps) memcpy(ti->drift, d, sizeof *d * (size_t)n);
  return HC_OK;
}
