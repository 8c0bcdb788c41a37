/* remedy.c - see remedy.h. */
#include "compare/remedy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/first_guess.h"
#include "compare/gate_limits.h"
#include "compare/motion.h"
#include "compare/response.h"
#include "compare/work_limit.h"
#include "numerics/base/message.h"
#include "numerics/base/thread_clock.h"

/* What may be changed, in the order in which it is tried. */
typedef enum move { STATIC, EXACT_FORCES, HARMONICS, START, LAW, TOLERANCE, N_MOVES } move;

/* Greater H that have to pass, too; transients; harmonics. */
enum { AFTERWARDS = 2, MOST_FAILURES = 8, MOST_SAMPLES = 65536, ENOUGH_MOSTLY = 30, LAST_RESORT = 50 };
static const double most_work = 3e9; /* [unknowns^3] of all solutions tried: about 2 s */
static const double patience = 3;    /* [s] of all transients and curves tried */
static const double at_last = 6;     /* [s] and of the last resort */
static const double fine = 1e-10;    /* transient.tolerance below which shooting seldom converges */

typedef struct trial {
  hbm_settings hbm;
  transient_settings transient;
} trial;

typedef struct remedy_search {
  comparison_work *w;
  const comparison_row *row, *first; /* first: of the same solution, a row for each response */
  trial given;
  int n_harm;           /* of the row's solution */
  double *X, *guess;    /* [n_coef of most harmonics] that solution, and where Newton starts */
  bool by_transient;    /* else the orbit is what the row is held against */
  double work, seconds; /* spent */
  double patience;      /* [s] `seconds` may become this much */
  int most_tried;       /* harmonics */
  int failures;         /* transients since the last that was periodic */
  /* What the solution is held against: the row's own transient or orbit, or that of the settings under way. */
  timeint_result *target; /* [responses] */
  bool has_target;
  bool unfollowed; /* the curve of what passes took too long */
  bool cut;        /* work or time did not suffice for something that was to be tried */
} remedy_search;

/* Newton's start: next to the orbit, else the transient if one response's harmonics are all, else the last one. */
static void start_from(const remedy_search *s, const hbm_solver *hbm, int n_harm, double *X)
{
  const size_t n = (size_t)hbm_n_coefficients(hbm);
  const comparison_row *row = s->row;
  if (hbm_n_dof(hbm) == 1 && (row->orbit_status == HC_OK || s->by_transient)) {
    const periodic_motion orbit = motion_of_transient(row->orbit_status == HC_OK ? &row->orbit : &row->transient);
    motion_harmonics(&orbit, n_harm, X);
    return;
  }
  memset(X, 0, n * sizeof *X);
  const size_t known = n / (size_t)(2 * n_harm + 1) * (size_t)(2 * s->n_harm + 1);
  memcpy(X, s->X, (known < n ? known : n) * sizeof *X);
}

/* Which member of a family a transient that starts on the solution runs on depends on the solution. */
static bool target_moves(const remedy_search *s, const trial *t)
{
  return s->row->family && s->by_transient && t->transient.start == TRANSIENT_START_HBM;
}

/* s->target becomes the transient of the trial; sweeps, which come from far, are not repeated. */
static hc_status integrate(remedy_search *s, const trial *t, hbm_solver *hbm, const double *X)
{
  const transient_start start = t->transient.start;
  const double began = thread_seconds();
  timeint *ti = NULL;
  work_limit limit = {.outer = s->w->monitor, .until = began + s->patience - s->seconds};
  s->has_target = false;
  hc_status st = start == TRANSIENT_START_HBM || start == TRANSIENT_START_REST ? HC_OK : HC_UNSUPPORTED;
  if (st == HC_OK) st = timeint_new(s->w->setup->model, &t->transient, &ti);
  if (st == HC_OK && start == TRANSIENT_START_REST) timeint_rest(ti, s->w->scratch);
  else if (st == HC_OK) st = comparison_orbit_start(hbm, X, s->row->omega, s->w->scratch);
  if (st == HC_OK)
    st = timeint_steady(ti, s->row->omega, s->w->scratch, &(hc_monitor){work_limit_tick, &limit}, s->target);
  for (int r = 1; r < s->w->setup->model->n_responses && st == HC_OK; ++r) {
    s->target[r] = s->target[0];
    st = timeint_response(ti, r, &s->target[r]);
  }
  timeint_free(ti);
  s->seconds += thread_seconds() - began;
  s->cut |= s->seconds >= s->patience;
  s->has_target = st == HC_OK && s->target[0].period_multiple == 1;
  s->failures = s->has_target ? 0 : s->failures + 1;
  return limit.stopped ? HC_INTERRUPTED : st == HC_NO_MEMORY ? st : HC_OK;
}

/* *yes: every response of the solution X that is compared is within the limits of the target. */
static hc_status hold_against_target(const remedy_search *s, hbm_solver *hbm, const double *X, bool *yes)
{
  hc_status st = HC_OK;
  *yes = true;
  for (int r = 0; r < s->w->setup->model->n_responses && *yes && st == HC_OK; ++r) {
    if (s->first[r].still) continue;
    periodic_motion motion;
    const periodic_motion target = motion_of_transient(&s->target[r]);
    st = motion_of_response(hbm, s->row->omega, X, r, NULL, &motion);
    const discrepancy d = motion_discrepancy(&motion, &target);
    *yes = st == HC_OK && gate_limits_hold(s->w->setup->limits, s->row->omega, &d, motion_mean_is_free(&s->target[r]));
  }
  return st;
}

/* *yes: with these settings the row's solution is within the limits, in all responses. */
static hc_status try_it(remedy_search *s, const trial *t, bool *yes)
{
  const model *m = s->w->setup->model;
  hbm_solver *hbm;
  hbm_point point;
  *yes = false;
  hc_status st = guided_hbm_solver_new(m, &t->hbm, &hbm);
  if (st != HC_OK) return st == HC_NO_MEMORY ? st : HC_OK;
  const int n_harm = hbm_n_harmonics(hbm);
  const double work = pow(hbm_newton_work(hbm).unknowns, 3);
  if (!hc_monitor_tick(s->w->monitor, -1)) st = HC_INTERRUPTED;
  else if (s->work + work > most_work) st = HC_TOO_MANY_POINTS, s->cut = true;
  else {
    s->work += work;
    if (n_harm > s->most_tried) s->most_tried = n_harm;
    start_from(s, hbm, n_harm, s->guess);
    st = hbm_solve(hbm, s->row->omega, s->guess, &point);
  }
  if (st != HC_OK && !s->given.hbm.keep_mean) st = hbm_first_solution(hbm, s->row->omega, NULL, s->guess, &point);
  const bool solved = st == HC_OK;
  if (solved && (!s->has_target || target_moves(s, t))) st = integrate(s, t, hbm, s->guess);
  if (solved && st == HC_OK && s->has_target) st = hold_against_target(s, hbm, s->guess, yes);
  if (solved) { /* the next one starts here */
    s->n_harm = n_harm;
    memcpy(s->X, s->guess, (size_t)hbm_n_coefficients(hbm) * sizeof *s->X);
  }
  hbm_solver_free(hbm);
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK;
}

/* The number of the solution in *at whose amplitude is nearest to this one; -1: there is none. */
static int nearest_solution(hbm_solver *hbm, const hbm_curve *at, const comparison_row *row, double amplitude)
{
  int nearest = -1;
  double least = INFINITY;
  for (int k = 0; k < at->n; ++k) {
    hbm_measures m;
    if (hbm_measure_response(hbm, row->omega, hbm_curve_X(at, k), row->response, &m) != HC_OK) continue;
    const double d = fabs(m.amplitude - amplitude);
    if (d < least) least = d, nearest = k;
  }
  return nearest;
}

/* *yes: the curve over the setup's sweep has a solution within the limits of the target. If the target depends on the
 * solution, only the one nearest to the row's transient is tried. */
static hc_status curve_passes(remedy_search *s, const trial *t, const compare_setup *setup, const hc_monitor *monitor,
                              bool *yes)
{
  const bool to_start = !s->has_target || target_moves(s, t);
  response_curve c;
  hbm_curve at = {0};
  hc_status st = response_trace(setup, NULL, monitor, &c);
  if (st == HC_OK && c.hbm && c.curve.n) st = hbm_curve_at(c.hbm, &c.curve, s->row->omega, &at);
  const int n = st == HC_OK ? at.n : 0;
  const int only = n && to_start ? nearest_solution(c.hbm, &at, s->row, s->row->transient.amplitude) : -1;
  for (int k = 0; k < n && !*yes && st != HC_NO_MEMORY; ++k) {
    if (to_start && k != only) continue;
    st = to_start ? integrate(s, t, c.hbm, hbm_curve_X(&at, k)) : HC_OK;
    if (st == HC_OK && s->has_target) st = hold_against_target(s, c.hbm, hbm_curve_X(&at, k), yes);
  }
  hbm_curve_free(&at);
  response_curve_free(&c);
  return st;
}

/* *yes: the curve of these settings has a solution within the limits; `or_slow`: or takes more than half of the time
 * that is left, which is said. The curve as far as the row's omega is tried first: it is shorter. All of it is needed
 * to tell which solution is nearest to a transient that is not integrated yet. */
static hc_status confirm(remedy_search *s, const trial *t, bool or_slow, bool *yes)
{
  const double began = thread_seconds(), omega = s->row->omega;
  compare_setup setup = *s->w->setup;
  work_limit limit = {.outer = s->w->monitor, .until = began + 0.5 * (s->patience - s->seconds)};
  const hc_monitor monitor = {work_limit_tick, &limit};
  double to;
  hc_status st = HC_OK;
  setup.hbm = t->hbm;
  comparison_sweep(setup.omega_from, setup.omega_to, &setup.compare.omega, &setup.omega_from, &to);
  setup.omega_to = omega;
  *yes = false;
  if (s->has_target && !target_moves(s, t) && omega != setup.omega_from) st = curve_passes(s, t, &setup, &monitor, yes);
  setup.omega_to = to;
  if (!*yes && st != HC_NO_MEMORY) st = curve_passes(s, t, &setup, &monitor, yes);
  s->seconds += thread_seconds() - began;
  const bool slow = thread_seconds() >= limit.until;
  s->unfollowed = !*yes && or_slow && slow;
  *yes |= s->unfollowed;
  s->cut |= slow;
  return limit.stopped ? HC_INTERRUPTED : st == HC_NO_MEMORY ? st : HC_OK;
}

/* More harmonics than t has: the first that pass, and after which AFTERWARDS more do; by half of what is left. */
static hc_status try_harmonics(remedy_search *s, trial *t, int from, bool *yes)
{
  const int most_failures = target_moves(s, t) ? MOST_FAILURES : 1; /* another H starts another transient */
  const double work = 0.5 * (s->work + most_work), seconds = 0.5 * (s->seconds + s->patience);
  hc_status st = HC_OK;
  *yes = false;
  for (int n = from; n < HBM_MAX_HARMONICS && !*yes && s->failures < most_failures && st == HC_OK;) {
    n = n + 1 + n / 16 < HBM_MAX_HARMONICS ? n + 1 + n / 16 : HBM_MAX_HARMONICS;
    bool still = true;
    for (int k = 0; k <= AFTERWARDS && n + k <= HBM_MAX_HARMONICS && still && st == HC_OK; ++k) {
      t->hbm.harmonics = n + k;
      st = try_it(s, t, &still);
    }
    t->hbm.harmonics = n;
    if (still && st == HC_OK) st = confirm(s, t, true, yes);
    if (!*yes && (s->seconds > seconds || s->work > work)) {
      s->cut = true;
      break;
    }
  }
  const bool has_aim = s->has_target || target_moves(s, t);
  if (!*yes && st == HC_OK && has_aim && from < ENOUGH_MOSTLY) { /* Newton may have come to an unstable one */
    t->hbm.harmonics = ENOUGH_MOSTLY;
    st = confirm(s, t, false, yes);
  }
  return st;
}

/* The first power of two that passes, if there is one. */
static hc_status try_samples(remedy_search *s, trial *t, bool *yes)
{
  hc_status st = HC_OK;
  *yes = false;
  int n = 2;
  while (n <= s->given.hbm.samples || n < 2 * s->n_harm + 2) n *= 2;
  for (; n <= MOST_SAMPLES && !*yes && st == HC_OK; n *= 2) {
    t->hbm.samples = n;
    st = try_it(s, t, yes);
    if (*yes && st == HC_OK) st = confirm(s, t, true, yes);
  }
  return st;
}

/* False: it is so already. */
static bool change(const remedy_search *s, move m, trial *t)
{
  switch (m) {
  case STATIC: return !t->hbm.keep_mean && (t->hbm.keep_mean = true);
  case EXACT_FORCES:
    if (t->hbm.force == HBM_FORCE_EXACT) return false;
    t->hbm.force = HBM_FORCE_EXACT;
    return true;
  case HARMONICS: return true;
  default: break; /* the others change the transient */
  }
  if (!s->by_transient) return false;
  if (m == START) {
    if (t->transient.start == TRANSIENT_START_HBM) return false;
    t->transient.start = TRANSIENT_START_HBM;
  } else if (m == LAW) {
    if (t->transient.law == TRANSIENT_LAW_EXACT) return false;
    t->transient.law = TRANSIENT_LAW_EXACT;
  } else {
    if (t->transient.tolerance <= fine) return false;
    t->transient.tolerance = fine;
  }
  return true;
}

/* The target: the row's, or that of the settings, which is yet to be integrated. */
static void aim(remedy_search *s, bool transient_too)
{
  for (int r = 0; r < s->w->setup->model->n_responses; ++r)
    s->target[r] = s->by_transient ? s->first[r].transient : s->first[r].orbit;
  s->has_target = !transient_too;
}

/* Tries t, which may be changed to have more harmonics; from the row's solution. */
static hc_status try_with(remedy_search *s, bool more_harmonics, bool transient_too, const double *X, int n_harm,
                          trial *t, bool *yes)
{
  s->n_harm = n_harm;
  memcpy(s->X, X, (size_t)hbm_n_coefficients(s->w->hbm) * sizeof *X);
  aim(s, transient_too);
  s->failures = 0;
  if (more_harmonics) return try_harmonics(s, t, n_harm, yes);
  const hc_status st = try_it(s, t, yes);
  return *yes && st == HC_OK ? confirm(s, t, true, yes) : st;
}

/* What acts on the largest part of what failed. */
static move first_move(const comparison_row *row, const gate_limits *limits)
{
  const discrepancy at = gate_limits_at(limits, row->omega);
  const budget_parts *p = budget_find_worst(&row->budget, &at).parts;
  if (!p || (row->verdict == VERDICT_DIFFERS && !row->budget.against_transient)) return LAW;
  const double hbm = fmax(p->truncation, p->aliasing), time = fmax(p->integration, p->settling);
  if (p->regularisation >= fmax(hbm, time)) return row->budget.family ? START : LAW;
  return time > hbm ? TOLERANCE : STATIC;
}

/* "use hbm.static: true and hbm.harmonics >= 9". */
static void say(const remedy_search *s, const trial *t, char text[COMPARISON_ADVICE_TEXT])
{
  const trial *g = &s->given;
  const bool changed[N_MOVES] = {[STATIC] = t->hbm.keep_mean != g->hbm.keep_mean,
                                 [EXACT_FORCES] = t->hbm.force != g->hbm.force,
                                 [HARMONICS] = t->hbm.harmonics != g->hbm.harmonics,
                                 [START] = t->transient.start != g->transient.start,
                                 [LAW] = t->transient.law != g->transient.law,
                                 [TOLERANCE] = t->transient.tolerance != g->transient.tolerance};
  message m;
  int left = 0;
  message_start(&m, text, COMPARISON_ADVICE_TEXT);
  for (int i = 0; i < N_MOVES; ++i) left += changed[i];
  const int n = left;
  for (move i = 0; i < N_MOVES; ++i) {
    if (!changed[i]) continue;
    message_add(&m, "%s", left == n ? "use " : left == 1 ? " and " : ", ");
    --left;
    switch (i) {
    case STATIC: message_add(&m, "hbm.static: true"); break;
    case EXACT_FORCES: message_add(&m, "hbm.force: exact"); break;
    case HARMONICS: message_add(&m, "hbm.harmonics >= %d", t->hbm.harmonics); break;
    case START: message_add(&m, "transient.start: hbm"); break;
    case LAW: message_add(&m, "transient.law: exact"); break;
    default: message_add(&m, "transient.tolerance <= %.0e", t->transient.tolerance);
    }
  }
  if (s->unfollowed) message_add(&m, ", if its curve comes there");
}

/* One change alone, and more harmonics alone. */
static hc_status try_alone(remedy_search *s, move m, const double *X, int n_harm, trial *t, bool *yes)
{
  *t = s->given;
  return change(s, m, t) ? try_with(s, m == HARMONICS, m > HARMONICS, X, n_harm, t, yes) : HC_OK;
}

/* Harmonic 0 and exact forces, and the transient's changes from..to, then more harmonics with them. */
static hc_status try_together(remedy_search *s, move from, move to, const double *X, int n_harm, trial *t, bool *yes)
{
  bool transient_too = false;
  *t = s->given;
  const int changed = change(s, STATIC, t) + change(s, EXACT_FORCES, t);
  for (move m = from; m <= to; ++m) transient_too |= change(s, m, t);
  if (from <= to ? !transient_too : changed == 0) return HC_OK;
  hc_status st = try_with(s, false, transient_too, X, n_harm, t, yes);
  if (st == HC_OK && !*yes) st = try_with(s, true, transient_too, X, n_harm, t, yes);
  return st;
}

/* Everything at once, by the curve. */
static hc_status try_last(remedy_search *s, trial *t, bool *yes)
{
  bool transient_too = false;
  s->patience = s->seconds + at_last;
  *t = s->given;
  for (move m = 0; m < N_MOVES; ++m) transient_too |= change(s, m, t) && m > HARMONICS;
  aim(s, transient_too);
  if (t->hbm.harmonics < LAST_RESORT) t->hbm.harmonics = LAST_RESORT;
  return confirm(s, t, false, yes);
}

/* All that is tried, in order, what needs a new transient late; *yes, and t has what passes. */
static hc_status find(remedy_search *s, move first, const double *X, int n_harm, trial *t, bool *yes)
{
  hc_status st = try_alone(s, first, X, n_harm, t, yes);
  for (move m = 0; m <= HARMONICS && !*yes && st == HC_OK; ++m)
    if (m != first) st = try_alone(s, m, X, n_harm, t, yes);
  if (!*yes && st == HC_OK) st = try_together(s, START, HARMONICS, X, n_harm, t, yes);
  for (move m = START; m < N_MOVES && !*yes && st == HC_OK; ++m)
    if (m != first) st = try_alone(s, m, X, n_harm, t, yes);
  if (!*yes && st == HC_OK && first >= START) st = try_together(s, first, first, X, n_harm, t, yes);
  if (!*yes && st == HC_OK) st = try_together(s, START, N_MOVES - 1, X, n_harm, t, yes);
  return *yes || st != HC_OK ? st : try_last(s, t, yes);
}

hc_status remedy_find(comparison_work *w, const comparison_row *row, char text[COMPARISON_ADVICE_TEXT])
{
  text[0] = 0;
  if (!comparison_row_is_beyond(row, w->setup->limits)) return HC_OK;
  const size_t longest = (size_t)(2 * HBM_MAX_HARMONICS + 1) * (size_t)w->setup->model->n;
  workspace memory = {0};
  remedy_search s = {.w = w,
                     .row = row,
                     .first = row - row->response,
                     .given = {w->setup->hbm, w->setup->transient},
                     .patience = patience};
  s.by_transient = row->budget.against_transient || row->verdict == VERDICT_DIFFERS;
  s.X = workspace_doubles(&memory, longest);
  s.guess = workspace_doubles(&memory, longest);
  s.target = workspace_array(&memory, (size_t)w->setup->model->n_responses, sizeof *s.target);
  hbm_curve at = {0};
  hc_status st = memory.failed ? HC_NO_MEMORY : hbm_curve_at(w->hbm, &w->out->curve, row->omega, &at);
  const int k = memory.failed ? -1 : nearest_solution(w->hbm, &at, row, row->hbm.amplitude);
  if (k >= 0) {
    trial t;
    bool yes = false;
    const double *X = hbm_curve_X(&at, k);
    st = find(&s, first_move(row, w->setup->limits), X, at.points[k].harmonics, &t, &yes);
    message m;
    if (st == HC_OK && yes) {
      say(&s, &t, text);
      const transient_settings *a = &t.transient, *b = &s.given.transient;
      const bool exact_alone = t.hbm.force != s.given.hbm.force && t.hbm.harmonics == s.given.hbm.harmonics &&
                               t.hbm.keep_mean == s.given.hbm.keep_mean && a->law == b->law && a->start == b->start &&
                               a->tolerance == b->tolerance;
      if (exact_alone) {
        trial sampled = t;
        sampled.hbm.force = HBM_FORCE_SAMPLED;
        st = try_samples(&s, &sampled, &yes);
        message_start(&m, text + strlen(text), COMPARISON_ADVICE_TEXT - strlen(text));
        if (yes) message_add(&m, " or hbm.samples >= %d", sampled.hbm.samples);
      }
    } else if (st == HC_OK) {
      message_start(&m, text, COMPARISON_ADVICE_TEXT);
      message_add(&m, "nothing %swithin %d harmonics, exact forces%s passes", s.cut ? "that was tried " : "",
                  s.most_tried, s.by_transient ? ", the exact law and transient.tolerance >= 1e-10" : "");
    }
  }
  hbm_curve_free(&at);
  workspace_free(&memory);
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK;
}
