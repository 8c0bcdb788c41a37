/* structure_path.c - see structure_path.h. */
#include "stress/structure_path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"

static const double least = 1e-10;
enum { MOST_PERIODS = 400 };

transient_settings stress_path_settings(void)
{
  return (transient_settings){.law = TRANSIENT_LAW_EXACT,
                              .method = TRANSIENT_METHOD_CLOSED_FORM,
                              .regularisation = 1e-4,
                              .steady = TRANSIENT_STEADY_AUTO,
                              .start = TRANSIENT_START_REST,
                              .tolerance = least,
                              .max_periods = MOST_PERIODS};
}

static size_t state_length(const model *m) { return 2 * (size_t)m->n + (size_t)m->n_contacts; }

void stress_path_make(solved_structure *s, const model *m, const double *from, stress_path *out)
{
  *out = (stress_path){.status = HC_NOT_CONVERGED};
  out->state = malloc(state_length(m) * sizeof *out->state);
  out->wave = calloc((size_t)s->n * TIMEINT_WAVE, sizeof *out->wave);
  if (!out->state || !out->wave) s->fatal = out->status = HC_NO_MEMORY;
  else if (from) memcpy(out->state, from, state_length(m) * sizeof *out->state);
}

void stress_path_free(stress_path *p)
{
  free(p->state);
  free(p->wave);
  *p = (stress_path){.status = HC_NOT_CONVERGED};
}

static hc_status follow(solved_structure *s, timeint *ti, double omega, path_way way, stress_path *p)
{
  switch (way) {
  case PATH_ORBIT: return timeint_orbit(ti, omega, 1, p->state, &s->monitor, &p->r);
  case PATH_AGAIN: return timeint_again(ti, omega, 1, p->state, &s->monitor, &p->r);
  case PATH_STEADY: break;
  }
  hc_status st = timeint_steady(ti, omega, p->state, &s->monitor, &p->r);
  return st == HC_OK && p->r.period_multiple != 1 ? HC_NOT_SETTLED : st;
}

static hc_status read_waves(const solved_structure *s, timeint *ti, double length, stress_path *p)
{
  timeint_result one = p->r;
  p->amplitude = 0;
  for (int i = 0; i < s->n; ++i) {
    hc_status st = timeint_response(ti, 1 + i, &one);
    if (st != HC_OK) return st;
    p->amplitude = fmax(p->amplitude, one.amplitude / length);
    for (int k = 0; k < TIMEINT_WAVE; ++k) p->wave[i * TIMEINT_WAVE + k] = one.wave[k] / length;
  }
  p->errors = (p->r.closure + p->r.attainable) * (p->r.amplitude / length) / p->amplitude;
  return HC_OK;
}

void stress_path_follow(solved_structure *s, const model *m, const transient_settings *how, double omega, path_way way,
                        double length, stress_path *p)
{
  timeint *ti = NULL;
  if (p->status == HC_NO_MEMORY) return;
  p->status = timeint_new(m, how, &ti);
  if (p->status == HC_OK) p->status = follow(s, ti, omega, way, p);
  if (p->status == HC_OK) p->status = read_waves(s, ti, length, p);
  timeint_free(ti);
  if (p->status == HC_NO_MEMORY) s->fatal = HC_NO_MEMORY;
}

double stress_paths_apart(const solved_structure *s, const stress_path *a, const stress_path *b, int shift)
{
  double apart = 0;
  for (int i = 0; i < s->n; ++i)
    for (int k = 0; k < TIMEINT_WAVE; ++k) {
      const double *of = b->wave + i * TIMEINT_WAVE,
                   d = fabs(a->wave[i * TIMEINT_WAVE + k] - of[(k + shift) % TIMEINT_WAVE]);
      if (!(d <= apart)) apart = d;
    }
  return apart / a->amplitude;
}

double stress_path_off(const solved_structure *s, int n_coef, const double *x, const stress_path *p)
{
  double off = 0;
  for (int k = 0; k < TIMEINT_WAVE; ++k)
    for (int i = 0; i < s->n; ++i) {
      double sum = x[i] - p->wave[i * TIMEINT_WAVE + k];
      for (int h = 1; 2 * h < n_coef; ++h) {
        const double turn = TWO_PI * ((long)h * k % TIMEINT_WAVE) / TIMEINT_WAVE;
        sum += x[(2 * h - 1) * s->n + i] * cos(turn) + x[2 * h * s->n + i] * sin(turn);
      }
      if (!(fabs(sum) <= off)) off = fabs(sum);
    }
  return off / p->amplitude;
}
