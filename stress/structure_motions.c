/* structure_motions.c - checks of time integration against itself: the orbit next to the HBM solution in other
 * coordinates, other units and at another time; from beside it; by CVODE and by the regularised law. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/random.h"
#include "numerics/series.h"
#include "stress/outcomes.h"
#include "stress/structure_path.h"

/* Of the largest response. Closed forms: rounding through (I - Phi)^-1 is counted besides. CVODE's are those of
 * docs/transient.md. */
static const double same_in_closed_form = 1e-9, same_by_cvode = 1e-8, same_law = 1e-6;
static const double beside = 1e-5, nearby = 1e-4;
enum { ALONE_EVERY = 8 }; /* scenes for which CVODE finds the orbit by itself */

/* What the errors of both alone may set apart. */
static double sensitive(const stress_path *a, const stress_path *b)
{
  return a->errors + b->errors >= 0 ? 3 * (a->errors + b->errors) : 0;
}

static const stress_path *known(const solved_structure *s) { return s->path->status == HC_OK ? s->path : NULL; }

/* The orbit found in another way beside the one that is known. */
static stress_check hold(solved_structure *s, const stress_path *other, int shift, double least)
{
  if (other->status != HC_OK) return stress_motion_refuse(s, other->status);
  return stress_agree_within(stress_paths_apart(s, s->path, other, shift), least, sensitive(s->path, other));
}

static stress_check worse(stress_check a, stress_check b)
{
  return b.outcome > a.outcome || (b.outcome == a.outcome && b.error > a.error) ? b : a;
}

/* ---- written in another way --------------------------------------------------------------------------- */

/* s->path->state in y, x = Q y. */
static void turn_state(const solved_structure *s, const double *Q, double *state)
{
  const int n = s->n;
  memcpy(state, s->path->state, (2 * (size_t)n + (size_t)s->model->n_contacts) * sizeof *state);
  turned_vector(n, Q, s->path->state, state);
  turned_vector(n, Q, s->path->state + n, state + n);
}

static stress_check turned(solved_structure *s, void (*draw)(uint64_t *, int, double *))
{
  const transient_settings how = stress_path_settings();
  stress_path other;
  model *m = NULL;
  double *Q = malloc((size_t)s->n * (size_t)s->n * sizeof *Q);
  stress_path_make(s, s->model, NULL, &other);
  if (Q) draw(&s->random, s->n, Q);
  if (!Q || rewritten_turned(s->model, Q, &m) != HC_OK) s->fatal = HC_NO_MEMORY;
  if (s->fatal == HC_OK) {
    turn_state(s, Q, other.state);
    stress_path_follow(s, m, &how, s->omega, PATH_ORBIT, 1, &other);
  }
  free(Q);
  model_free(m);
  const stress_check c = hold(s, &other, 0, same_in_closed_form);
  stress_path_free(&other);
  return c;
}

static stress_check in_units(solved_structure *s, double length, double force, double time)
{
  const transient_settings how = stress_path_settings();
  const int n = s->n;
  stress_path other;
  model *m = NULL;
  stress_path_make(s, s->model, s->path->state, &other);
  if (rewritten_in_units(s->model, length, force, time, &m) != HC_OK) s->fatal = HC_NO_MEMORY;
  if (s->fatal == HC_OK) {
    for (int i = 0; i < 2 * n + m->n_contacts; ++i) other.state[i] *= i >= n && i < 2 * n ? length / time : length;
    stress_path_follow(s, m, &how, s->omega / time, PATH_ORBIT, length, &other);
  }
  model_free(m);
  const stress_check c = hold(s, &other, 0, same_in_closed_form);
  stress_path_free(&other);
  return c;
}

/* From the HBM solution of the later loads next to the orbit's own harmonics, later; where that is not next to the
 * orbit the start says nothing. Where a slider that never slips rests hangs on time 0. */
static stress_check delayed(solved_structure *s)
{
  const transient_settings how = stress_path_settings();
  const int shift = random_int(&s->random, 1, TIMEINT_WAVE - 1);
  stress_path other;
  stress_motion h = {.status = HC_NOT_CONVERGED};
  model *m = NULL;
  if (rewritten_delayed(s->model, TWO_PI * shift / TIMEINT_WAVE, &m) != HC_OK) s->fatal = HC_NO_MEMORY;
  if (s->fatal == HC_OK) stress_motion_beside(s, m, s->path, shift, s->fine_harmonics, &h);
  stress_path_make(s, s->model, h.start, &other);
  if (h.status == HC_OK && s->fatal == HC_OK) stress_path_follow(s, m, &how, s->omega, PATH_ORBIT, 1, &other);
  model_free(m);
  stress_check c = hold(s, &other, TIMEINT_WAVE - shift, same_in_closed_form);
  if (c.outcome == STRESS_REFUSED ||
      !(stress_path_off(s, series_length(s->fine_harmonics), s->fine.x, s->path) <= nearby))
    c = stress_skip(STRESS_NO_ORBIT);
  stress_motion_free(&h);
  stress_path_free(&other);
  return c;
}

stress_check stress_structure_rewritten(solved_structure *s)
{
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  stress_check c = turned(s, random_permutation);
  c = worse(c, turned(s, random_rotation));
  c = worse(c, in_units(s, 39.3701, 0.224809, 1.0 / 60));
  return s->path->r.free_sliders == 0 ? worse(c, delayed(s)) : c;
}

/* ---- from beside it ----------------------------------------------------------------------------------- */

/* Does CVODE stay on that orbit, too? Then there are two. */
static bool is_orbit(solved_structure *s, const stress_path *p)
{
  transient_settings how = stress_path_settings();
  how.method = TRANSIENT_METHOD_CVODE;
  how.tolerance = 1e-9;
  stress_path again;
  stress_path_make(s, s->model, p->state, &again);
  if (s->fatal == HC_OK) stress_path_follow(s, s->model, &how, s->omega, PATH_ORBIT, 1, &again);
  const double bound = fmax(same_by_cvode, sensitive(p, &again));
  const bool same = again.status == HC_OK && stress_paths_apart(s, p, &again, 0) <= bound;
  stress_path_free(&again);
  return same;
}

/* Where the motion goes from next to a stable orbit: back to it. Sliders that never slip would rest elsewhere. */
stress_check stress_structure_returns(solved_structure *s)
{
  const transient_settings how = stress_path_settings();
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  if (!(s->path->r.multiplier < 1 - 1e-3) || s->path->r.free_sliders > 0) return stress_skip(STRESS_NOT_APPLICABLE);
  stress_path other;
  stress_path_make(s, s->model, s->path->state, &other);
  for (int i = 0; i < 2 * s->n && s->fatal == HC_OK; ++i)
    other.state[i] += beside * s->path->amplitude * (i < s->n ? 1 : s->omega) * random_signed(&s->random);
  if (s->fatal == HC_OK) stress_path_follow(s, s->model, &how, s->omega, PATH_STEADY, 1, &other);
  stress_check c = hold(s, &other, 0, same_in_closed_form);
  if (c.outcome == STRESS_FINDING && is_orbit(s, &other)) c = stress_explain(STRESS_OTHER_ORBIT, c.error, c.bound);
  stress_path_free(&other);
  return c;
}

/* ---- by other integrators ----------------------------------------------------------------------------- */

/* The known orbit once more. */
static stress_check by(solved_structure *s, const transient_settings *how, path_way way, double least)
{
  stress_path other;
  stress_path_make(s, s->model, s->path->state, &other);
  if (s->fatal == HC_OK) stress_path_follow(s, s->model, how, s->omega, way, 1, &other);
  const stress_check c = hold(s, &other, 0, least);
  stress_path_free(&other);
  return c;
}

/* CVODE from event to event closes the orbit; for some scenes by itself, without the closed form's matrix. */
stress_check stress_structure_cvode(solved_structure *s)
{
  transient_settings how = stress_path_settings();
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  how.method = TRANSIENT_METHOD_CVODE;
  how.tolerance = 1e-9;
  how.scout = random_int(&s->random, 1, ALONE_EVERY) > 1;
  return by(s, &how, how.scout ? PATH_AGAIN : PATH_ORBIT, same_by_cvode);
}

/* Where a slider never slips beside other contacts, and with another law rests elsewhere, the orbit is another member
 * of the family. */
static stress_check unless_family(const solved_structure *s, stress_check c)
{
  const bool family = s->model->n_contacts > 1 && s->path->r.free_sliders > 0;
  return c.outcome == STRESS_FINDING && family ? stress_explain(STRESS_FAMILY, c.error, c.bound) : c;
}

/* Of first or second order: with a tenth of the regularisation the difference falls to a quarter or less. */
stress_check stress_structure_regularised(solved_structure *s)
{
  transient_settings how = stress_path_settings();
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  how.method = TRANSIENT_METHOD_CVODE;
  how.law = TRANSIENT_LAW_REGULARISED;
  how.tolerance = 1e-8;
  how.scout = true;
  stress_check c = stress_skip(STRESS_NO_ORBIT);
  double before = -1;
  int solved = 0;
  for (how.regularisation = 1e-4; how.regularisation >= 0.9e-7; how.regularisation /= 10) {
    c = by(s, &how, PATH_AGAIN, same_law);
    if (isnan(c.error) && solved >= 2) /* it did not shrink */
      return unless_family(s, stress_find(STRESS_DISAGREES, before, same_law));
    if (c.outcome != STRESS_FINDING || isnan(c.error)) return c;
    ++solved;
    if (c.error <= before / 4) return stress_explain(STRESS_SMOOTHED, c.error, before / 4);
    before = c.error;
  }
  return unless_family(s, c);
}
