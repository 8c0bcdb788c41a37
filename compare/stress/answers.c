/* answers.c - what the program says of a scene, as lists of numbers: special points, peak, solutions, transients,
 * verdicts, advice; and the same of the scene written another way (rewritten.h), which must be the same lists.
 *
 * Two lists are as far apart as the answer that is farthest from all of its kind in the other list. Two answers of a
 * kind nearer to each other than twice the bound are twins: a contact that reaches its limit and leaves it at once
 * changes twice or, by rounding, not at all, and what is found may be one of them. Two that multipliers tell, of one
 * kind, are twins if they are nearer than a step of the curve: between two of its points they undo each other
 * (special_points.h). Curves that begin at two solutions are two curves.
 *
 * Bounds are those of what is asked: special points are located to 1e-9 of omega, in numbers that have `ratio` times
 * the rounding; the peak is a row's amplitude; transients have errors of integration and of regularisation, the same
 * in both but for steps. What differs by more is held against what rounding makes of the scene itself: its numbers
 * changed at random by what the other way's rounding is, and asked again. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/accuracy/sufficient.h"
#include "compare/first_guess.h"
#include "compare/stress/solved_scene.h"
#include "numerics/base/thread_clock.h"
#include "numerics/norm.h"

/* What is found together, by one function of asking[]. */
typedef enum answer_group {
  ABOUT_CURVE,
  ABOUT_EXACT,
  ABOUT_DEFAULT,
  ABOUT_VERDICTS,
  ABOUT_ADVICE,
  GROUPS
} answer_group;
typedef enum answer_question {
  SPECIALS,
  HIGHEST,
  PEAK,
  SOLUTIONS,
  EXACT,
  BY_DEFAULT,
  VERDICTS,
  ADVICE,
  QUESTIONS
} answer_question;

static const struct {
  stress_reason reason; /* of a finding */
  answer_group group;
  double bound;  /* [1] relative */
  bool absolute; /* else: bound is of the number itself */
} questions[QUESTIONS] = {
    [SPECIALS] = {STRESS_SPECIALS, ABOUT_CURVE, 1e-6, false},
    [HIGHEST] = {STRESS_HIGHEST, ABOUT_CURVE, 1e-3, false},
    [PEAK] = {STRESS_PEAK, ABOUT_CURVE, 1e-6, false},
    [SOLUTIONS] = {STRESS_SOLUTIONS, ABOUT_CURVE, 1e-7, false},
    [EXACT] = {STRESS_TRANSIENT, ABOUT_EXACT, 2e-5, false},
    [BY_DEFAULT] = {STRESS_REGULARISED, ABOUT_DEFAULT, 2e-5, false},
    [VERDICTS] = {STRESS_VERDICTS, ABOUT_VERDICTS, 1e-6, false},
    [ADVICE] = {STRESS_ADVICE, ABOUT_ADVICE, 1, true},
};

/* [1] Sliders in the plane settle to some 5e-8, and so far off is the slip rate that reaches 0 where a short stick
 * begins: where it changes a hundredth as fast as omega, that is 5e-6 of omega beside. */
static const double in_the_plane = 10;

typedef struct answer {
  int code;                     /* kind of special point, verdict, ...: those of one code are held together */
  double value;                 /* frequency, amplitude, ... */
  bool border;                  /* a verdict between two: another may be said */
  contact_regime before, after; /* of a contact change, else the same */
} answer;

enum { MOST_ANSWERS = 256 };
struct stress_answers {
  bool asked[GROUPS];
  hc_status status[GROUPS];
  bool history[GROUPS]; /* a slider never slips in what was found */
  double step;          /* [1] of omega, the mean one of the curve */
  double first;         /* [length] amplitude where the curve begins */
  bool no_multipliers;  /* along the curve: they are costly */
  bool specials_too_dear;
  int n[QUESTIONS];
  answer of[QUESTIONS][MOST_ANSWERS];
};

static void put(stress_answers *a, answer_question q, answer what)
{
  if (a->n[q] < MOST_ANSWERS) a->of[q][a->n[q]++] = what;
}

/* ---- asking ---- */

/* Amplitude of a solution; *history as in the answers. */
static hc_status amplitude_of(hbm_solver *h, const double *X, double *amplitude, bool *history)
{
  hbm_measures m = {0};
  hc_status st = hbm_measure(h, X, &m);
  *amplitude = m.amplitude;
  *history = *history || m.contact.free_sliders > 0;
  return st;
}

/* A special point beside an end of the sweep may be beyond it. */
static bool is_at_end(const solved_scene *s, double omega)
{
  return fmin(fabs(omega - s->from), fabs(omega - s->to)) <= 1e-5 * omega;
}

/* hbm_specials asks nobody whether to go on: it takes the multipliers of each point, and of tens to locate a change. In
 * the plane each may take as long as the curve. */
static bool specials_are_affordable(const solved_scene *s, hbm_solver *h, const hbm_curve *c)
{
  enum { LOCATING = 100 };
  const double start = thread_seconds();
  hbm_stability one;
  if (c->n == 0 || hbm_stability_is_costly(h)) return true;
  hbm_stability_at(h, c->points[0].omega, hbm_curve_X(c, 0), &one);
  return (thread_seconds() - start) * (c->n + LOCATING) <= s->deadline - start;
}

static hc_status ask_curve(solved_scene *s, const model *m, stress_answers *a)
{
  hbm_solver *h = NULL;
  hbm_curve curve = {0}, found = {0}, peak = {0};
  hbm_special *special = NULL;
  bool *history = &a->history[ABOUT_CURVE];
  double highest = 0, x = 0;
  int n = 0;
  hc_status st = guided_hbm_solver_new(m, &s->how, &h);
  a->no_multipliers = st == HC_OK && hbm_stability_is_costly(h);
  if (st == HC_OK) st = hbm_trace(h, s->from, s->to, &s->monitor, &curve);
  for (int k = 0; k < curve.n && st == HC_OK; ++k) {
    st = amplitude_of(h, hbm_curve_X(&curve, k), &x, history);
    highest = fmax(highest, x);
    if (k == 0) a->first = x;
    if (k > 0) a->step += fabs(curve.points[k].omega / curve.points[k - 1].omega - 1) / (curve.n - 1);
  }
  if (st == HC_OK) st = hbm_curve_peak(h, &curve, &peak);
  if (st == HC_OK) st = amplitude_of(h, hbm_curve_X(&peak, 0), &x, history);
  if (st == HC_OK) put(a, PEAK, (answer){.value = x}), put(a, HIGHEST, (answer){.value = highest});
  if (st == HC_OK) st = hbm_curve_at(h, &curve, s->omega, &found);
  for (int k = 0; k < found.n && st == HC_OK; ++k) {
    st = amplitude_of(h, hbm_curve_X(&found, k), &x, history);
    put(a, SOLUTIONS, (answer){.value = x});
  }
  a->specials_too_dear = st == HC_OK && !specials_are_affordable(s, h, &curve);
  if (st == HC_OK && !a->specials_too_dear) st = hbm_specials(h, &curve, &special, &n);
  for (int i = 0; i < n && i < MOST_ANSWERS && st == HC_OK; ++i) {
    const hbm_special *p = &special[i];
    if (is_at_end(s, p->omega)) continue;
    put(a, SPECIALS, (answer){.code = (int)p->kind, .value = p->omega, .before = p->before, .after = p->after});
  }
  free(special);
  hbm_curve_free(&peak);
  hbm_curve_free(&found);
  hbm_curve_free(&curve);
  hbm_solver_free(h);
  return st;
}

/* Is the orbit next to the solution one to which motions beside it go back? Where the motion goes from beside another,
 * and when it gets there, hangs on rounding. */
static bool attracts(const solved_scene *s) { return s->path.status == HC_OK && s->path.r.multiplier < 1 - 1e-3; }

/* Where the motion goes from the start, if to that orbit. */
static hc_status ask_transient(solved_scene *s, const model *m, const double *start, answer_question q,
                               stress_answers *a)
{
  transient_settings how = s->asked->transient;
  timeint *ti = NULL;
  timeint_result r = {0};
  if (!attracts(s)) return HC_OK;
  const bool closed = q == EXACT && !model_is_smooth(m);
  how.law = q == EXACT ? TRANSIENT_LAW_EXACT : TRANSIENT_LAW_REGULARISED;
  how.method = closed ? TRANSIENT_METHOD_CLOSED_FORM : TRANSIENT_METHOD_CVODE;
  how.start = TRANSIENT_START_HBM;
  hc_status st = timeint_new(m, &how, &ti);
  double *state = st == HC_OK ? malloc((size_t)timeint_n_states(ti) * sizeof *state) : NULL;
  if (st == HC_OK && !state) st = HC_NO_MEMORY;
  if (st == HC_OK) {
    memcpy(state, start, (size_t)timeint_n_states(ti) * sizeof *state);
    st = timeint_steady(ti, s->omega, state, &s->monitor, &r);
  }
  if (st == HC_OK) put(a, q, (answer){.code = r.period_multiple, .value = r.amplitude});
  a->history[questions[q].group] = r.free_sliders > 0;
  timeint_free(ti);
  free(state);
  return st == HC_NOT_SETTLED || st == HC_APERIODIC ? HC_OK : st;
}

/* A verdict may be another where an error is within a tenth of the gate, a multiplier as near to 1 as HBM's and time
 * integration's may differ, or where the motion leaves the solution, and rounding says where to; and where the mean
 * alone decides, which is not compared beside a slider that never slips, wherever that is. */
static hc_status ask_verdicts(solved_scene *s, const model *m, stress_answers *a)
{
  comparison c;
  hc_status st = stress_compare(s, m, &c);
  const discrepancy gate = gate_limits_at(&s->asked->gate, s->omega);
  discrepancy but_mean = gate;
  but_mean.mean = INFINITY;
  for (int i = 0; i < c.n_rows && st == HC_OK; ++i) {
    const comparison_row *r = &c.rows[i];
    const bool leaves = r->verdict == VERDICT_APERIODIC || r->verdict == VERDICT_NOT_SETTLED ||
                        r->verdict == VERDICT_PERIOD_K || r->transient.left_orbit;
    const bool by_gate = fabs(stress_gate_ratio(r, &gate) - 1) < 0.1;
    const bool rests = r->transient.free_sliders > 0 || r->hbm.contact.free_sliders > 0;
    const bool by_mean = (rests || r->verdict == VERDICT_DIFFERS) && stress_gate_ratio(r, &but_mean) < 1;
    const bool by_multiplier = r->orbit_status == HC_OK && fabs(r->orbit.multiplier - 1) < 1e-3;
    put(a, VERDICTS,
        (answer){.code = (int)r->verdict,
                 .value = r->hbm_status == HC_OK ? r->hbm.amplitude : 0,
                 .border = leaves || by_gate || by_multiplier || by_mean});
    a->history[ABOUT_VERDICTS] |= rests;
  }
  comparison_clear(&c);
  return st;
}

/* At the scene's omega, of few unknowns: with exact forces the harmonics; with sampled ones, for such harmonics, the
 * power of two of samples. One more or less may do where the error is at the limit. Of several solutions the curve of
 * few harmonics has one or another. */
static hc_status ask_advice(solved_scene *s, const model *m, stress_answers *a)
{
  enum { MOST_COORDINATES = 2 };
  const int coordinates = 2 * s->model->n_contacts < s->n ? 2 * s->model->n_contacts : s->n;
  sufficient found = {0};
  compare_setup setup;
  if (coordinates > MOST_COORDINATES) return HC_OK;
  hc_status st = scene_setup(s->asked, &setup);
  compare_setup asked = setup;
  asked.model = m;
  if (st == HC_OK) st = sufficient_run(&asked, 1e-3, false, &s->monitor, &found);
  for (int i = 0; i < found.n && found.solutions == 1 && st == HC_OK; ++i) {
    const sufficient_row *r = &found.rows[i];
    if (!r->sampled) put(a, ADVICE, (answer){.value = r->harmonics}); /* 0: none do */
    else if (r->harmonics > 0) put(a, ADVICE, (answer){.code = r->harmonics, .value = log2(r->samples)});
  }
  scene_setup_clear(&setup);
  return st;
}

/* As a user has it, with the first response alone. */
static void ask(solved_scene *s, const model *m, const double *start, answer_group g, stress_answers *a)
{
  model *alone;
  if (a->asked[g]) return;
  hc_status st = model_copy_sized(m, m->n_contacts, 1, &alone);
  if (st == HC_OK) switch (g) {
    case ABOUT_CURVE: st = ask_curve(s, alone, a); break;
    case ABOUT_EXACT: st = ask_transient(s, alone, start, EXACT, a); break;
    case ABOUT_DEFAULT: st = ask_transient(s, alone, start, BY_DEFAULT, a); break;
    case ABOUT_VERDICTS: st = ask_verdicts(s, alone, a); break;
    default: st = ask_advice(s, alone, a);
    }
  model_free(alone);
  if (st == HC_NO_MEMORY) s->fatal = st;
  a->status[g] = st;
  a->asked[g] = true;
}

/* ---- held against each other ---- */

typedef struct scale {
  double bound;
  bool absolute;
  double step;           /* [1] of special points */
  bool no_multipliers;   /* on one side */
  contact_regime hidden; /* contact changes up to this regime may be missing */
} scale;

static double apart(const answer *a, const answer *b, const scale *of)
{
  if (a->code != b->code && !(a->border && b->border)) return INFINITY;
  const double d = fabs(a->value - b->value);
  return d == 0 || of->absolute ? d : d / fmax(fabs(a->value), fabs(b->value));
}

/* May a[i] be missing in the other list? */
static bool may_miss(int n, const answer *a, int i, const scale *of)
{
  const bool by_points = of->step > 0 && a[i].code != HBM_TURNING_POINT && a[i].code != HBM_CONTACT_CHANGE;
  for (int k = 0; k < n; ++k)
    if (k != i && apart(&a[k], &a[i], of) <= fmax(2 * of->bound, by_points ? of->step : 0)) return true;
  if (by_points && of->no_multipliers) return true;
  if (of->absolute && a[i].code > 0) return true; /* a pair of other harmonics and samples costs a little less */
  return a[i].before != a[i].after && contact_regime_larger(a[i].before, of->hidden) == of->hidden &&
         contact_regime_larger(a[i].after, of->hidden) == of->hidden;
}

static double one_sided(int n_a, const answer *a, int n_b, const answer *b, const scale *of)
{
  double worst = 0;
  for (int i = 0; i < n_a; ++i) {
    double nearest = INFINITY;
    for (int k = 0; k < n_b; ++k) nearest = fmin(nearest, apart(&a[i], &b[k], of));
    if (nearest > of->bound && may_miss(n_a, a, i, of)) continue;
    worst = fmax(worst, nearest);
  }
  return worst;
}

static double lists_apart(const stress_answers *a, const stress_answers *b, answer_question q, const scale *of)
{
  if (b->status[questions[q].group] != HC_OK) return INFINITY;
  return fmax(one_sided(a->n[q], a->of[q], b->n[q], b->of[q], of), one_sided(b->n[q], b->of[q], a->n[q], a->of[q], of));
}

/* What the scene says with its numbers changed by the rounding of one `ratio` times as large (ways.c), ten times over,
 * as it is changed once only. An answer that is lost or new is no number: that it is so by rounding is said only if the
 * changed scene says what the `other` does. */
static double sensitive(solved_scene *s, double ratio, answer_question q, const scale *of, const stress_answers *other,
                        stress_answers *changed)
{
  const double rounding = 4e-13, draws = of->absolute ? 1 : 10;
  const answer_group g = questions[q].group;
  rewritten nudged;
  stress_motion beside = {0};
  if (!changed->asked[g]) {
    s->fatal = rewritten_nudged(s->model, rounding * ratio, &s->random, &nudged);
    if (s->fatal == HC_OK) {
      hbm_settings how = s->how;
      how.harmonics = s->fine.harmonics;
      stress_motion_solve(s, nudged.model, &how, s->omega, s->fine.x, 1, &beside);
    }
    changed->status[g] = beside.status;
    if (s->fatal == HC_OK && beside.status == HC_OK) ask(s, nudged.model, beside.start, g, changed);
    changed->asked[g] = true;
    stress_motion_free(&beside);
    rewritten_clear(&nudged);
  }
  const double moved = lists_apart(s->plain, changed, q, of);
  return isinf(moved) && isinf(lists_apart(other, changed, q, of)) ? 0 : draws * moved;
}

static stress_check hold_question(solved_scene *s, const rewritten *w, answer_question q, const stress_answers *other,
                                  stress_answers *changed)
{
  const bool specials = q == SPECIALS, no_multipliers = s->plain->no_multipliers || other->no_multipliers;
  const double bound = questions[q].bound * (specials && model_has_circle(s->model) ? in_the_plane : 1);
  const scale of = {bound, questions[q].absolute, specials ? s->plain->step : 0, no_multipliers, w->regime};
  const double error = lists_apart(s->plain, other, q, &of);
  if (specials && (s->plain->specials_too_dear || other->specials_too_dear)) return stress_refuse(s, HC_INTERRUPTED);
  const double begins = fabs(s->plain->first / other->first - 1); /* two solutions there, and two curves */
  if (questions[q].group == ABOUT_CURVE && other->status[ABOUT_CURVE] == HC_OK && begins > 1e-3 && isfinite(begins))
    return stress_explain(STRESS_OTHER_ORBIT, begins, 1e-3);
  const bool none = s->plain->n[q] == 0, no_other = other->n[q] == 0;
  if (q == ADVICE ? none || no_other : none && (no_other || q == EXACT || q == BY_DEFAULT))
    return stress_skip(STRESS_NOT_APPLICABLE); /* not asked */
  if (error <= of.bound) return stress_agree(error, of.bound);
  stress_check c = stress_agree_within(error, of.bound, sensitive(s, w->ratio, q, &of, other, changed));
  const hc_status asked = changed->status[questions[q].group];
  if (asked != HC_OK) return stress_refuse(s, asked);
  if (c.outcome == STRESS_FINDING) c.reason = questions[q].reason;
  return c;
}

stress_check stress_hold_answers(solved_scene *s, const rewritten *w, const double *start)
{
  stress_check worst = stress_skip(STRESS_NOT_APPLICABLE);
  stress_answers *other = calloc(1, sizeof *other), *changed = calloc(1, sizeof *changed);
  if (!s->plain && (s->plain = calloc(1, sizeof *s->plain))) {
    solved_scene_clock(s, 1);
    for (int g = 0; g < GROUPS && s->fatal == HC_OK; ++g) ask(s, s->model, s->fine.start, (answer_group)g, s->plain);
    solved_scene_clock(s, 1);
  }
  if (!other || !changed || !s->plain) s->fatal = HC_NO_MEMORY;
  for (int q = 0; q < QUESTIONS && s->fatal == HC_OK; ++q) {
    const answer_group g = questions[q].group;
    stress_check c = stress_skip(STRESS_NOT_APPLICABLE);
    if (s->plain->status[g] != HC_OK) c = stress_refuse(s, s->plain->status[g]);
    else {
      ask(s, w->model, start, g, other);
      if (other->status[g] == HC_INTERRUPTED) c = stress_refuse(s, HC_INTERRUPTED);
      else if (!w->history || !(s->plain->history[g] || other->history[g]))
        c = hold_question(s, w, (answer_question)q, other, changed);
    }
    worst = stress_worse(worst, c);
  }
  free(other);
  free(changed);
  return worst;
}
