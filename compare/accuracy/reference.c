/* reference.c - see reference.h. The peak is looked for on the exact law's orbits themselves, by shooting, from the
 * peak of a curve that is near: parabolas through three frequencies, ever closer together. Harmonic balance would
 * have to keep 160 harmonics for 1e-8 of it. */
#include "compare/accuracy/reference.h"

#include <math.h>
#include <stdlib.h>

enum { PEAK_LEVELS = 6 };

static const double reusable = 0.01; /* [amplitude] an orbit that near to a solution of the fine curve is the one
                                        next to it */

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
static bool orbit_next_to(const comparison *c, timeint *ti, hbm_solver *hbm, const hbm_measures *m, const double *X,
                          double omega, const hc_monitor *monitor, periodic_motion *out)
{
  periodic_motion here = motion_of_series(m, hbm_n_harmonics(hbm), X);
  for (int i = 0; i < c->n_rows; ++i) {
    if (c->rows[i].omega != omega || c->rows[i].orbit_status != HC_OK) continue;
    *out = motion_of_transient(&c->rows[i].orbit);
    if (motion_between(&here, out).waveform <= reusable * out->amplitude) return true;
  }
  timeint_result r;
  timeint_state state;
  if (comparison_orbit_start(hbm, X, omega, &state) != HC_OK ||
      timeint_orbit(ti, omega, 1, &state, monitor, &r) != HC_OK)
    return false;
  *out = motion_of_transient(&r);
  return true;
}

static hc_status targets_at(const comparison *c, timeint *ti, hbm_solver *hbm, const hbm_curve *curve, double omega,
                            const hc_monitor *monitor, reference *r)
{
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(hbm, curve, omega, &at) == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    const double *X = at.X + (size_t)k * at.n_coef;
    hbm_measures m;
    periodic_motion orbit;
    if (hbm_measure(hbm, X, &m) != HC_OK || !orbit_next_to(c, ti, hbm, &m, X, omega, monitor, &orbit)) continue;
    if (!is_known(r, omega, &orbit)) st = add_target(r, omega, &orbit);
  }
  hbm_curve_free(&at);
  return st;
}

/* Amplitude of the orbit at omega next to *state, which moves there only if it is found. Negative: none. */
static double amplitude_at(timeint *ti, double omega, const timeint_state *state)
{
  timeint_result r;
  timeint_state here = *state;
  return timeint_orbit(ti, omega, 1, &here, NULL, &r) == HC_OK ? r.amplitude : -1;
}

/* From omega on, where *state is next to an orbit. False: *out is untouched. */
static bool climb(const compare_setup *setup, timeint *ti, double omega, const timeint_state *state, reference *out)
{
  const double low = fmin(setup->omega_from, setup->omega_to), high = fmax(setup->omega_from, setup->omega_to);
  const model *m = setup->model;
  const double width = fmin(m->damping > 0 ? m->damping / (2 * m->mass) : omega, 0.1 * omega);
  double top = amplitude_at(ti, omega, state), d = 0.02 * width;
  for (int level = 0; level < PEAK_LEVELS && top >= 0; ++level) {
    if (omega - d < low || omega + d > high) break; /* a peak at the end of the sweep is where the sweep ends */
    double left = amplitude_at(ti, omega - d, state), right = amplitude_at(ti, omega + d, state);
    double bend = left - 2 * top + right;
    if (left < 0 || right < 0 || !(bend < 0)) {
      d /= 4;
      continue;
    }
    double step = 0.5 * d * (left - right) / bend;
    omega += fmax(fmin(step, 2 * d), -2 * d);
    top = amplitude_at(ti, omega, state);
    if (fabs(step) <= d) d /= 3;
  }
  if (!(top >= 0)) return false;
  out->peak_amplitude = top;
  out->peak_omega = omega;
  return out->peak_by_orbit = true;
}

static void find_peak(const compare_setup *setup, timeint *ti, hbm_solver *hbm, const hbm_curve *curve, reference *out)
{
  hbm_curve peak = {0};
  hbm_measures m;
  out->peak_amplitude = out->peak_omega = NAN;
  if (curve->n > 0 && hbm_curve_peak(hbm, curve, &peak) == HC_OK && peak.n > 0 &&
      hbm_measure(hbm, peak.X, &m) == HC_OK) {
    double omega = peak.points[0].omega;
    timeint_state state;
    if (comparison_orbit_start(hbm, peak.X, omega, &state) != HC_OK || !climb(setup, ti, omega, &state, out))
      out->peak_amplitude = m.amplitude, out->peak_omega = omega;
  }
  hbm_curve_free(&peak);
}

hc_status reference_make(const compare_setup *setup, const comparison *c, hbm_solver *hbm, const hbm_curve *curve,
                         const hc_monitor *monitor, reference *out)
{
  timeint *ti = NULL;
  *out = (reference){.harmonics = hbm_n_harmonics(hbm)};
  hc_status st = comparison_referee(setup, &ti);
  for (int i = 0; i < c->n_rows && st == HC_OK; ++i) {
    if (i > 0 && c->rows[i].omega == c->rows[i - 1].omega) continue;
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
    else st = targets_at(c, ti, hbm, curve, c->rows[i].omega, monitor, out);
  }
  if (st == HC_OK) find_peak(setup, ti, hbm, curve, out);
  timeint_free(ti);
  return st;
}

void reference_clear(reference *r)
{
  free(r->targets);
  *r = (reference){0};
}
