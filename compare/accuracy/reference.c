/* reference.c - see reference.h. The peak is that of the exact law's orbits, by shooting: three frequencies that
 * enclose it, from the peak of the curve by harmonic balance, then a minimum search between them. By harmonic balance
 * alone it would take 160 harmonics to know it to 1e-8. */
#include "compare/accuracy/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/modes.h"
#include "numerics/roots.h"

enum { PEAK_LEVELS = 6 };

static const double reusable = 0.01; /* [amplitude] an orbit within this of a solution of the fine curve is taken as
                                        the one next to it */

static hc_status add_target(reference *r, double omega, const periodic_motion *orbit)
{
  if (r->n == r->cap) {
    int cap = r->cap ? 2 * r->cap : 16;
    target *targets = realloc(r->targets, (size_t)cap * sizeof *targets);
    if (!targets) return HC_NO_MEMORY;
    r->targets = targets;
    r->cap = cap;
  }
  r->targets[r->n++] = (target){omega, *orbit};
  return HC_OK;
}

static bool is_known(const reference *r, double omega, const periodic_motion *orbit)
{
  for (int i = 0; i < r->n; ++i)
    if (r->targets[i].omega == omega && motion_between(&r->targets[i].orbit, orbit).waveform <= 1e-6 * orbit->amplitude)
      return true;
  return false;
}

/* The orbit next to a solution: of the comparison's rows, else by shooting. False: none. */
static bool orbit_next_to(const comparison *c, timeint *ti, double *state, hbm_solver *hbm, const double *X,
                          double omega, const hc_monitor *monitor, periodic_motion *out)
{
  hbm_measures m;
  periodic_motion here;
  if (motion_of_response(hbm, omega, X, 0, &m, &here) != HC_OK) return false;
  for (int i = 0; i < c->n_rows; ++i) {
    if (c->rows[i].response != 0 || c->rows[i].omega != omega || c->rows[i].orbit_status != HC_OK) continue;
    *out = motion_of_transient(&c->rows[i].orbit);
    if (motion_between(&here, out).waveform <= reusable * out->amplitude) return true;
  }
  timeint_result r;
  if (comparison_orbit_start(hbm, X, omega, state) != HC_OK || timeint_orbit(ti, omega, 1, state, monitor, &r) != HC_OK)
    return false;
  *out = motion_of_transient(&r);
  return true;
}

static hc_status targets_at(const comparison *c, timeint *ti, double *state, hbm_solver *hbm, const hbm_curve *curve,
                            double omega, const hc_monitor *monitor, reference *r)
{
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(hbm, curve, omega, &at) == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    const double *X = at.X + (size_t)k * at.n_coef;
    periodic_motion orbit;
    if (!orbit_next_to(c, ti, state, hbm, X, omega, monitor, &orbit)) continue;
    if (!is_known(r, omega, &orbit)) st = add_target(r, omega, &orbit);
  }
  hbm_curve_free(&at);
  return st;
}

typedef struct climber {
  timeint *ti;
  const double *state; /* [n_states] next to an orbit */
  double *here;        /* [n_states] on it */
} climber;

/* *value = -amplitude of the orbit at omega next to the climber's state; NaN where there is none. */
static hc_status minus_amplitude(void *self, double omega, double *value)
{
  const climber *c = self;
  timeint_result r;
  memcpy(c->here, c->state, (size_t)timeint_n_states(c->ti) * sizeof *c->here);
  hc_status st = timeint_orbit(c->ti, omega, 1, c->here, NULL, &r);
  *value = st == HC_OK ? -r.amplitude : NAN;
  return st;
}

/* Three frequencies d apart, the one in the middle no lower than the others: from *omega uphill, closer together where
 * an orbit is missing or is no part of a hill. False: not within PEAK_LEVELS, or not within the sweep, at whose ends a
 * peak is where the sweep ends. *omega and f[1] are then the last middle, f[1] NaN if it has no orbit. f: minus the
 * amplitudes. */
static bool enclose_peak(climber *c, double low, double high, double *omega, double *d, double f[3])
{
  for (int level = 0; level < PEAK_LEVELS; ++level) {
    if (*omega - *d < low || *omega + *d > high) return false;
    bool both = minus_amplitude(c, *omega - *d, &f[0]) == HC_OK && minus_amplitude(c, *omega + *d, &f[2]) == HC_OK;
    if (both && f[1] <= f[0] && f[1] <= f[2]) return true;
    double bend = both ? f[0] - 2 * f[1] + f[2] : NAN;
    if (!(bend > 0)) {
      *d /= 4;
      continue;
    }
    *omega += fmax(fmin(0.5 * *d * (f[0] - f[2]) / bend, 2 * *d), -2 * *d);
    if (minus_amplitude(c, *omega, &f[1]) != HC_OK) return false;
  }
  return false;
}

/* [rad/time] of the narrowest resonance; 0: not known, or without damping. */
static double half_width(const model *m)
{
  model_scales scales;
  if (model_is_oscillator(m)) return *m->damping / (2 * *m->mass);
  return model_find_scales(m, &scales) == HC_OK ? scales.half_width : 0;
}

/* From omega on, where c->state is next to an orbit. False: *out is untouched. */
static bool climb(const compare_setup *setup, climber *c, double omega, reference *out)
{
  const double low = fmin(setup->omega_from, setup->omega_to), high = fmax(setup->omega_from, setup->omega_to);
  const double half = half_width(setup->model), width = fmin(half > 0 ? half : omega, 0.1 * omega);
  double d = 0.02 * width, f[3] = {NAN, NAN, NAN};
  if (minus_amplitude(c, omega, &f[1]) != HC_OK) return false;
  root_point peak;
  if (enclose_peak(c, low, high, &omega, &d, f)) /* flat: 2e-5 of the width are 2e-10 of the amplitude */
    root_minimum(minus_amplitude, c, omega - d, f[0], omega, f[1], omega + d, f[2], 2e-5 * width, &peak);
  else peak = (root_point){.x = omega, .f = f[1]};
  if (isnan(peak.f)) return false;
  out->peak_amplitude = -peak.f; /* the highest found, also where an orbit in between is missing */
  out->peak_omega = peak.x;
  return out->peak_by_orbit = true;
}

static void find_peak(const compare_setup *setup, timeint *ti, double *states, hbm_solver *hbm, const hbm_curve *curve,
                      reference *out)
{
  hbm_curve peak = {0};
  hbm_measures m;
  out->peak_amplitude = out->peak_omega = NAN;
  if (curve->n > 0 && hbm_curve_peak(hbm, curve, &peak) == HC_OK && peak.n > 0 &&
      hbm_measure(hbm, peak.X, &m) == HC_OK) {
    double omega = peak.points[0].omega;
    climber c = {ti, states, states + timeint_n_states(ti)};
    if (comparison_orbit_start(hbm, peak.X, omega, states) != HC_OK || !climb(setup, &c, omega, out))
      out->peak_amplitude = m.amplitude, out->peak_omega = omega;
  }
  hbm_curve_free(&peak);
}

hc_status reference_make(const compare_setup *setup, const comparison *c, hbm_solver *hbm, const hbm_curve *curve,
                         const hc_monitor *monitor, reference *out)
{
  timeint *ti = NULL;
  double *states = NULL; /* [2][n_states] */
  *out = (reference){.harmonics = hbm_n_harmonics(hbm)};
  hc_status st = comparison_referee(setup, &ti);
  if (st == HC_OK && !(states = calloc(2 * (size_t)timeint_n_states(ti), sizeof *states))) st = HC_NO_MEMORY;
  for (int i = 0; i < c->n_rows && st == HC_OK; ++i) {
    if (i > 0 && c->rows[i].omega == c->rows[i - 1].omega) continue;
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
    else st = targets_at(c, ti, states, hbm, curve, c->rows[i].omega, monitor, out);
  }
  if (st == HC_OK) find_peak(setup, ti, states, hbm, curve, out);
  free(states);
  timeint_free(ti);
  return st;
}

void reference_clear(reference *r)
{
  free(r->targets);
  *r = (reference){0};
}
