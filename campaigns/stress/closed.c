/* closed.c - the exact law in closed form against CVODE alone, without a scout: the same orbit next to the HBM solution
 * and, for one scene in 64 and all sub-harmonics, the same motion from rest. CVODE's own errors are what may lie between
 * them. */
#include <math.h>

#include "campaigns/stress/solved_scene.h"
#include "compare/motion.h"

static const double least = 1e-9; /* [1] of the amplitude: transient.tolerance */
enum { FROM_REST_EVERY = 64, MOST_PERIODS = 300 };

/* timeint_orbit of `multiple` periods from out->state, or timeint_steady where that is 0. */
static hc_status run(solved_scene *s, transient_method method, int multiple, stress_orbit *out)
{
  scene sc = s->exact;
  timeint *ti = NULL;
  sc.transient.method = method;
  sc.transient.scout = false;
  sc.transient.richardson = false;
  sc.transient.steady = TRANSIENT_STEADY_AUTO;
  sc.transient.start = TRANSIENT_START_REST;
  sc.transient.tolerance = least;
  sc.transient.max_periods = MOST_PERIODS;
  hc_status st = scene_timeint(&sc, &ti);
  if (st == HC_OK && multiple > 0) st = timeint_orbit(ti, s->omega, multiple, out->state.all, &s->monitor, &out->r);
  else if (st == HC_OK) st = timeint_steady(ti, s->omega, out->state.all, &s->monitor, &out->r);
  timeint_free(ti);
  if (st == HC_NO_MEMORY) s->fatal = st;
  return out->status = st;
}

/* How far apart two orbits are, and how far their own errors let them be: the distance from the orbit, and the scatter
 * of periods through (I - Phi)^-1, CVODE's and that of rounding. */
static double apart(const stress_orbit *closed, const stress_orbit *cvode, double *bound)
{
  const periodic_motion a = motion_of_transient(&closed->r), b = motion_of_transient(&cvode->r);
  const double errors = cvode->r.closure + closed->r.closure + cvode->r.attainable + closed->r.attainable;
  *bound = fmax(least, errors >= 0 ? 3 * errors : 0);
  return motion_discrepancy(&a, &b).waveform;
}

/* Does each method stay on the orbit that the other found? */
static bool both_exist(solved_scene *s, const stress_orbit *closed, const stress_orbit *cvode, int k, double *worst)
{
  double bound;
  stress_orbit mine = *cvode, theirs = *closed;
  if (run(s, TRANSIENT_METHOD_CLOSED_FORM, k, &mine) != HC_OK) return false;
  if (run(s, TRANSIENT_METHOD_CVODE, k, &theirs) != HC_OK) return false;
  *worst = apart(&mine, cvode, &bound);
  if (!(*worst <= bound)) return false;
  *worst = apart(closed, &theirs, &bound);
  return *worst <= bound;
}

/* The orbit next to the HBM solution in closed form, and CVODE's next to that. */
static stress_check same_orbit(solved_scene *s)
{
  double bound;
  stress_orbit closed = {.state = s->fine.start};
  hc_status st = run(s, TRANSIENT_METHOD_CLOSED_FORM, 1, &closed);
  if (st != HC_OK) return stress_refuse(s, st);
  stress_orbit cvode = {.state = closed.state};
  st = run(s, TRANSIENT_METHOD_CVODE, 1, &cvode);
  if (st != HC_OK) return stress_refuse(s, st);
  const double error = apart(&closed, &cvode, &bound);
  return stress_agree(error, bound);
}

/* Where the motion goes from rest, by both: the same number of periods, and the same orbit. */
static stress_check same_motion(solved_scene *s, stress_check so_far)
{
  double bound = least, worst = NAN;
  stress_orbit closed = {.status = HC_OK}, cvode = {.status = HC_OK};
  const hc_status st = run(s, TRANSIENT_METHOD_CLOSED_FORM, 0, &closed);
  const bool asked = s->sc->hbm.samples % FROM_REST_EVERY == 0 || (st == HC_OK && closed.r.period_multiple > 1);
  if (st == HC_INTERRUPTED || !asked) return so_far;
  const hc_status other = run(s, TRANSIENT_METHOD_CVODE, 0, &cvode);
  if (other == HC_INTERRUPTED) return stress_refuse(s, other);
  if (st != HC_OK || other != HC_OK) { /* not settled: the longer it takes, the more chance decides when */
    if (st == other || st == HC_NOT_SETTLED || other == HC_NOT_SETTLED) return so_far;
    return stress_refuse(s, st != HC_OK ? st : other);
  }
  const double error = closed.r.period_multiple == cvode.r.period_multiple ? apart(&closed, &cvode, &bound) : INFINITY;
  if (error <= bound) return so_far;
  const int k = closed.r.period_multiple > cvode.r.period_multiple ? closed.r.period_multiple : cvode.r.period_multiple;
  if (both_exist(s, &closed, &cvode, k, &worst)) return stress_explain(STRESS_OTHER_ORBIT, error, worst);
  return stress_find(STRESS_DISAGREES, error, worst);
}

stress_check stress_check_closed(solved_scene *s)
{
  if (s->base.status != HC_OK) return stress_skip(STRESS_NO_ORBIT);
  stress_check c = same_orbit(s);
  return c.outcome == STRESS_AGREED ? same_motion(s, c) : c;
}
