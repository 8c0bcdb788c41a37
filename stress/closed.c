/* closed.c - the exact law in closed form against CVODE. For every scene: the orbit next to the HBM solution, found in
 * closed form, closes under a period of CVODE's, and has the same measures. For one scene in 16, and all sub-harmonics:
 * CVODE alone, without a scout or its matrix, finds that orbit and, from rest, the same motion. CVODE's own errors are
 * what may lie between them. */
#include <math.h>

#include "compare/motion.h"
#include "stress/solved_scene.h"

static const double least = 1e-9; /* [1] of the amplitude: transient.tolerance */
enum { ALONE_EVERY = 16, MOST_PERIODS = 300 };

static hc_status make(const solved_scene *s, transient_method method, bool scout, timeint **ti)
{
  scene sc = s->exact;
  sc.transient.method = method;
  sc.transient.scout = scout;
  sc.transient.richardson = false;
  sc.transient.steady = TRANSIENT_STEADY_AUTO;
  sc.transient.start = TRANSIENT_START_REST;
  sc.transient.tolerance = least;
  sc.transient.max_periods = MOST_PERIODS;
  return scene_timeint(&sc, ti);
}

/* timeint_orbit of `multiple` periods from out->state, or timeint_steady where that is 0. */
static hc_status run(solved_scene *s, transient_method method, int multiple, stress_orbit *out)
{
  timeint *ti;
  hc_status st = make(s, method, false, &ti);
  if (st == HC_OK && multiple > 0) st = timeint_orbit(ti, s->omega, multiple, out->state.all, &s->monitor, &out->r);
  else if (st == HC_OK) st = timeint_steady(ti, s->omega, out->state.all, &s->monitor, &out->r);
  timeint_free(ti);
  if (st == HC_NO_MEMORY) s->fatal = st;
  return out->status = st;
}

/* CVODE's period from out->state on, and the measures of the orbit it closes. */
static hc_status confirm_by_cvode(solved_scene *s, stress_orbit *out)
{
  timeint *ti;
  hc_status st = make(s, TRANSIENT_METHOD_CVODE, true, &ti);
  if (st == HC_OK) st = timeint_again(ti, s->omega, 1, out->state.all, &s->monitor, &out->r);
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
  *bound = fmax(5 * least, errors >= 0 ? 3 * errors : 0); /* along a period a distance at its start may grow a little */
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

/* CVODE's orbit next to closed->state: with the closed form's matrix, or alone. */
static stress_check same_orbit(solved_scene *s, const stress_orbit *closed, bool alone)
{
  double bound;
  stress_orbit cvode = {.state = closed->state};
  const hc_status st = alone ? run(s, TRANSIENT_METHOD_CVODE, 1, &cvode) : confirm_by_cvode(s, &cvode);
  if (st != HC_OK) return stress_refuse(s, st);
  const double error = apart(closed, &cvode, &bound);
  return stress_agree(error, bound);
}

/* Where the motion goes from rest, by both: the same number of periods, and the same orbit. Not settled, by either: the
 * longer it takes, the more chance decides when. */
static stress_check same_motion(solved_scene *s, const stress_orbit *closed, stress_check so_far)
{
  double bound = least, worst = NAN;
  stress_orbit cvode = {.status = HC_OK};
  const hc_status st = run(s, TRANSIENT_METHOD_CVODE, 0, &cvode);
  if (st == HC_INTERRUPTED) return stress_refuse(s, st);
  if (closed->status == HC_NOT_SETTLED || st == HC_NOT_SETTLED || (st != HC_OK && st == closed->status)) return so_far;
  if (closed->status != HC_OK || st != HC_OK) return stress_refuse(s, st != HC_OK ? st : closed->status);
  const double error = apart(closed, &cvode, &bound);
  if (closed->r.period_multiple == cvode.r.period_multiple && error <= bound) return so_far;
  const int k =
      closed->r.period_multiple > cvode.r.period_multiple ? closed->r.period_multiple : cvode.r.period_multiple;
  if (both_exist(s, closed, &cvode, k, &worst)) return stress_explain(STRESS_OTHER_ORBIT, error, worst);
  return stress_find(STRESS_DISAGREES, error, worst);
}

stress_check stress_check_closed(solved_scene *s)
{
  if (s->base.status != HC_OK) return stress_skip(STRESS_NO_ORBIT);
  stress_orbit orbit = {.state = s->fine.start}, motion = {.status = HC_OK};
  hc_status st = run(s, TRANSIENT_METHOD_CLOSED_FORM, 1, &orbit);
  if (st != HC_OK) return stress_refuse(s, st);
  st = run(s, TRANSIENT_METHOD_CLOSED_FORM, 0, &motion);
  if (st == HC_INTERRUPTED) return stress_refuse(s, st);
  const bool alone = s->sc->hbm.samples % ALONE_EVERY == 0 || (st == HC_OK && motion.r.period_multiple > 1);
  const stress_check c = same_orbit(s, &orbit, alone);
  return alone && c.outcome == STRESS_AGREED ? same_motion(s, &motion, c) : c;
}
