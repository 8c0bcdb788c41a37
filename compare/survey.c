/* survey.c - see survey.h. Proof: tests/compare/test_survey.c. */
#include "compare/survey.h"

#include <stdlib.h>
#include <string.h>

#include "compare/comparison.h"
#include "compare/first_guess.h"
#include "compare/gate_limits.h"
#include "compare/motion.h"
#include "compare/survey_starts.h"
#include "compare/work_limit.h"
#include "numerics/base/growing.h"
#include "numerics/base/workspace.h"
#include "numerics/workers.h"

/* [amplitude] Members of a family may be as far apart; of a continuum many starts leave smaller steps. */
static const double family_step = 0.1;

/* [amplitude] A response that moves less than this part of the largest one is not compared: rounding, as in compare. */
static const double still = 1e-9;

/* [amplitude] An HBM solution with few harmonics may be as far from the motion that Newton began at (is_next_to,
 * solution.c). */
static const double next_to = 0.5;

typedef struct survey_work {
  const compare_setup *setup;
  const survey_settings *how;
  transient_settings transient;
  hbm_solver *hbm;
  const hbm_curve *at;
  double omega;
  survey *out;
  const hc_monitor *monitor;
  workspace memory; /* of the arrays below */
  survey_starts *starts;
  int n_states, n_responses;
  int n_given; /* starts 1..n_given are on HBM solutions */
  int first;   /* start of the blocks under way */
  int last;    /* the next one after them */
  bool interrupted;
  /* [starts] */
  bool *made;
  hc_status *status;
  int *motion;             /* the first start of the same motion */
  double *states;          /* [starts][n_states] where it ended */
  double (*began)[2];      /* [starts] x and v of one degree of freedom; else NULL */
  timeint_result *results; /* [starts][n_responses] */
  /* HBM solutions, those found beside the curve behind the others; each with its mirror image behind it, where the
   * model has such */
  int n_known;
  periodic_motion *known; /* [n_known] of the first response */
  int *branch;            /* [n_known] */
} survey_work;

static double *state_of(const survey_work *w, int i) { return w->states + (size_t)i * (size_t)w->n_states; }

static timeint_result *result_of(const survey_work *w, int i)
{
  return w->results + (size_t)i * (size_t)w->n_responses;
}

/* ---- where each start goes ---- */

static transient_settings exact_settings(const compare_setup *setup)
{
  transient_settings t = setup->transient;
  t.law = TRANSIENT_LAW_EXACT;
  t.method = model_is_smooth(setup->model) ? TRANSIENT_METHOD_CVODE : TRANSIENT_METHOD_CLOSED_FORM;
  t.steady = TRANSIENT_STEADY_AUTO;
  t.start = TRANSIENT_START_REST;
  t.scout = false;
  return t;
}

static hc_status follow_start(survey_work *w, timeint *ti, int i, const hc_monitor *monitor)
{
  timeint_result *r = result_of(w, i);
  if (i == 0 || i > w->n_given) survey_starts_draw(w->starts, i, state_of(w, i));
  if (w->began) memcpy(w->began[i], state_of(w, i), sizeof w->began[i]);
  hc_status st = w->status[i] = timeint_steady(ti, w->omega, state_of(w, i), monitor, r);
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
  w->made[i] = true;
  st = HC_OK;
  for (int k = 1; k < w->n_responses; ++k) {
    r[k] = r[0];
    if (motion_is_measured(w->status[i]) && st == HC_OK) st = timeint_response(ti, k, &r[k]);
  }
  if (st == HC_OK || st == HC_NO_MEMORY) return st;
  w->made[i] = false; /* the periods could not be followed again: no row may hold another response's numbers */
  return st == HC_INTERRUPTED ? st : HC_OK;
}

/* For workers_run. With a handle of its own: no result depends on what was followed before. */
static hc_status follow_task(void *self, int task, const hc_monitor *monitor)
{
  survey_work *w = self;
  timeint *ti;
  hc_status st = timeint_new(w->setup->model, &w->transient, &ti);
  if (st == HC_OK) st = follow_start(w, ti, w->first + task, monitor);
  timeint_free(ti);
  return st;
}

/* The first quarter of the starts has the sizes of the linear response and of HBM, the others also those of what that
 * quarter came to. */
static hc_status follow_all(survey_work *w)
{
  const int n = w->how->starts;
  hc_status st = HC_OK;
  for (int i = 0; i < w->at->n && w->hbm && w->n_given + 1 < n && st == HC_OK; ++i) {
    double *state = state_of(w, w->n_given + 1);
    st = comparison_orbit_start(w->hbm, hbm_curve_X(w->at, i), w->omega, state);
    if (st == HC_OK) survey_starts_see(w->starts, state), ++w->n_given;
    else if (st != HC_NO_MEMORY) st = HC_OK;
  }
  for (int part = 0; part < 2 && st == HC_OK; ++part) {
    const int n_part = part ? n - n / 4 : n / 4;
    w->first = part ? n / 4 : 0;
    for (int i = 0; i < w->first; ++i)
      if (w->status[i] == HC_OK) survey_starts_see(w->starts, state_of(w, i));
    const hc_monitor_part progress = {w->monitor, (double)w->first / n, (double)n_part / n};
    st = workers_run(w->how->jobs, n_part, follow_task, w, &(hc_monitor){hc_monitor_tick_part, (void *)&progress});
  }
  return st;
}

/* ---- which of them are one motion ---- */

/* [amplitude] Two results for one orbit are as far apart: of the order of transient.tolerance, and as far from it as
 * each says. */
static double same_orbit(const survey_work *w, const timeint_result *a, const timeint_result *b)
{
  const double most = 1e-3; /* of a distance that is only an upper bound */
  return fmax(1e-6, 100 * w->transient.tolerance) + fmin(a->closure, most) + fmin(b->closure, most);
}

/* [length] between two orbits of k periods. Where k > 1 the same orbit may have begun in another of them: held together
 * are measures that know no beginning. */
static double distance(const timeint_result *a, const timeint_result *b)
{
  const double harmonic_1 = hypot(a->a1 - b->a1, a->b1 - b->b1), amplitude = fabs(a->amplitude - b->amplitude);
  if (a->period_multiple == 1) {
    const periodic_motion of_a = motion_of_transient(a), of_b = motion_of_transient(b);
    return fmax(amplitude, motion_between(&of_a, &of_b).waveform);
  }
  double most = fmax(amplitude, harmonic_1);
  if (a->free_sliders == 0 && b->free_sliders == 0)
    most = fmax(fmax(most, fabs(a->mean - b->mean)), fmax(fabs(a->max - b->max), fabs(a->min - b->min)));
  return most;
}

static double largest_amplitude(const survey_work *w, int i)
{
  double most = 0;
  for (int k = 0; k < w->n_responses; ++k) most = fmax(most, result_of(w, i)[k].amplitude);
  return most;
}

static bool is_same(const survey_work *w, int i, int j)
{
  const timeint_result *a = result_of(w, i), *b = result_of(w, j);
  char texts[2][24];
  const steady_row of_a = {.status = w->status[i], .result = *a}, of_b = {.status = w->status[j], .result = *b};
  if (strcmp(steady_verdict_text(&of_a, texts[0]), steady_verdict_text(&of_b, texts[1])) != 0) return false;
  if (w->status[i] != HC_OK) return true;
  if (a->free_sliders != b->free_sliders) return false;
  const double least = still * fmax(largest_amplitude(w, i), largest_amplitude(w, j));
  for (int k = 0; k < w->n_responses; ++k) {
    const double size = fmax(a[k].amplitude, b[k].amplitude);
    const double most = a->free_sliders > 0 ? family_step : same_orbit(w, &a[k], &b[k]);
    if (size > least && !(distance(&a[k], &b[k]) <= most * size)) return false;
  }
  return true;
}

/* motion[]: of one that has no family the first start is held against the others, of a family every member. */
static void find_motions(survey_work *w)
{
  for (int i = 0; i < w->how->starts; ++i) {
    w->motion[i] = i;
    for (int j = 0; j < i && w->made[i]; ++j) {
      const int a = w->motion[j], b = w->motion[i];
      const bool stands_for_others = a == j || (w->status[j] == HC_OK && result_of(w, j)->free_sliders > 0);
      if (!w->made[j] || a == b || !stands_for_others || !is_same(w, i, j)) continue;
      for (int k = 0; k <= i; ++k)
        if (w->motion[k] == (a > b ? a : b)) w->motion[k] = a < b ? a : b;
    }
  }
}

/* ---- what harmonic balance has ---- */

/* The first response of X, and of its mirror image, into known[]. */
static hc_status add_known(survey_work *w, double *X, int branch)
{
  bool twice = true;
  for (int k = 0; k < 2 && twice; ++k) {
    if (!GROW(w->known, w->n_known) || !GROW(w->branch, w->n_known)) return HC_NO_MEMORY;
    if (motion_of_response(w->hbm, w->omega, X, 0, NULL, &w->known[w->n_known]) == HC_OK)
      w->branch[w->n_known++] = branch;
    twice = hbm_mirror(w->hbm, X); /* the second time back */
  }
  return HC_OK;
}

static hc_status know_curve(survey_work *w)
{
  hc_status st = HC_OK;
  for (int i = 0; i < w->at->n && w->hbm && st == HC_OK; ++i)
    st = add_known(w, hbm_curve_X(w->at, i), w->at->points[i].branch);
  return st;
}

/* Is a start of that motion within the gate of a solution? The nearest one into the row. */
static bool runs_on_known(const survey_work *w, int motion, survey_row *row)
{
  for (int i = motion; i < w->how->starts; ++i) {
    if (!w->made[i] || w->motion[i] != motion) continue;
    const periodic_motion here = motion_of_transient(result_of(w, i));
    for (int k = 0; k < w->n_known; ++k) {
      const discrepancy e = motion_discrepancy(&w->known[k], &here);
      if (!gate_limits_hold(w->setup->limits, w->omega, &e, here.mean_free)) continue;
      if (row->hbm_branch < 0 || e.waveform < row->hbm_error)
        row->hbm_branch = w->branch[k], row->hbm_error = e.waveform;
    }
    if (row->hbm_branch >= 0) return true;
  }
  return false;
}

/* X[n_coef]: Newton from the harmonics of the motion; HC_NOT_CONVERGED where that comes to another one. */
static hc_status solve_beside(survey_work *w, int start, double *X, hbm_point *point, periodic_motion *found)
{
  hc_status st =
      solution_of_motion(w->hbm, w->setup->model, &w->transient, w->omega, state_of(w, start), w->monitor, X, point);
  if (st == HC_OK) st = motion_of_response(w->hbm, w->omega, X, 0, NULL, found);
  if (st != HC_OK) return st;
  const periodic_motion here = motion_of_transient(result_of(w, start));
  return motion_discrepancy(found, &here).waveform <= next_to ? HC_OK : HC_NOT_CONVERGED;
}

/* The solution that Newton comes to from the motion: one that is known, or one beside the curve. */
static hc_status look_beside(survey_work *w, int start, survey_row *row)
{
  const double newton = 1e-6; /* [amplitude] two solutions by Newton are apart, even next to a fold: 1e-10 squared */
  const int n = hbm_n_coefficients(w->hbm), longer = n > w->at->n_coef ? n : w->at->n_coef;
  double *X = calloc(2 * (size_t)longer, sizeof *X); /* and a tangent, which is not known */
  hbm_point point;
  periodic_motion found;
  hc_status st = X ? solve_beside(w, start, X, &point, &found) : HC_NO_MEMORY;
  if (st == HC_OK) {
    const periodic_motion here = motion_of_transient(result_of(w, start));
    row->hbm_error = motion_discrepancy(&found, &here).waveform;
    for (int k = 0; k < w->n_known && row->hbm_branch < 0; ++k)
      if (motion_between(&w->known[k], &found).waveform <= newton * found.amplitude) row->hbm_branch = w->branch[k];
    if (row->hbm_branch < 0) {
      survey *out = w->out;
      const bool again = out->beside.n > 0 && out->beside.points[out->beside.n - 1].omega == w->omega;
      point.branch = point.part = again ? out->beside.points[out->beside.n - 1].branch + 1 : w->how->first_branch;
      point.d_omega = 1;
      compare_lock(w->setup);
      st = hbm_curve_append(&out->beside, longer, X, X + longer, &point);
      compare_unlock(w->setup);
      if (st == HC_OK) st = add_known(w, X, row->hbm_branch = point.branch);
    }
  }
  free(X);
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK;
}

/* ---- rows ---- */

/* The row of the first response of the motion that this start stands for. */
static hc_status measure_motion(survey_work *w, int start, int n_made, survey_row *row)
{
  *row =
      (survey_row){.steady = {.status = w->status[start], .result = *result_of(w, start), .from_regularisation = NAN},
                   .hbm_branch = -1,
                   .hbm_error = NAN};
  for (int i = start; i < w->how->starts; ++i) row->starts += w->made[i] && w->motion[i] == start;
  row->share = (double)row->starts / n_made;
  const bool periodic = row->steady.status == HC_OK && row->steady.result.period_multiple == 1;
  if (!w->hbm || !periodic || runs_on_known(w, start, row) || w->interrupted) return HC_OK;
  const hc_status st = look_beside(w, start, row);
  w->interrupted = st == HC_INTERRUPTED;
  return w->interrupted ? HC_OK : st;
}

static int by_share(const void *a, const void *b)
{
  const survey_row *x = a, *y = b;
  return x->starts != y->starts ? (x->starts < y->starts) - (x->starts > y->starts) : x->motion - y->motion;
}

/* The starts that came to motion m, of which `first` is the first one; for them there is room. */
static void add_starts(survey_work *w, int m, int first)
{
  const double part = w->setup->model->responses[0];
  survey *out = w->out;
  for (int i = first; i < w->how->starts; ++i)
    if (w->made[i] && w->motion[i] == first)
      out->starts[out->n_starts++] = (survey_start){w->omega, part * w->began[i][0], part * w->began[i][1], m};
}

/* Numbers the rows[n] of the motions, each of which has its first start as `motion`, and appends those of all their
 * responses. */
static hc_status add_rows(survey_work *w, int n, survey_row *rows)
{
  survey *out = w->out;
  if (n == 0) return HC_OK;
  qsort(rows, (size_t)n, sizeof *rows, by_share);
  survey_row *grown = growing_by(out->rows, out->n_rows, n * w->n_responses, sizeof *grown);
  if (!grown) return HC_NO_MEMORY;
  out->rows = grown;
  if (w->began) {
    survey_start *more = growing_by(out->starts, out->n_starts, w->how->starts, sizeof *more);
    if (!more) return HC_NO_MEMORY;
    out->starts = more;
    for (int m = 0; m < n; ++m) add_starts(w, m, rows[m].motion);
  }
  for (int m = 0; m < n; ++m)
    for (int k = 0; k < w->n_responses; ++k) {
      const int start = rows[m].motion;
      survey_row *row = &out->rows[out->n_rows++];
      *row = rows[m];
      row->motion = m;
      row->steady.response = k;
      row->steady.result = result_of(w, start)[k];
      row->amplitude_low = INFINITY;
      row->amplitude_high = -INFINITY;
      for (int i = start; i < w->how->starts; ++i) {
        if (!w->made[i] || w->motion[i] != start) continue;
        row->amplitude_low = fmin(row->amplitude_low, result_of(w, i)[k].amplitude);
        row->amplitude_high = fmax(row->amplitude_high, result_of(w, i)[k].amplitude);
      }
    }
  return HC_OK;
}

static hc_status measure_motions(survey_work *w)
{
  int n = 0, n_made = 0;
  survey_row *rows = NULL;
  hc_status st = know_curve(w);
  for (int i = 0; i < w->how->starts; ++i) n_made += w->made[i];
  for (int i = 0; i < w->how->starts && st == HC_OK; ++i) {
    if (!w->made[i] || w->motion[i] != i) continue;
    if (!GROW(rows, n)) st = HC_NO_MEMORY;
    if (st == HC_OK) st = measure_motion(w, i, n_made, &rows[n]);
    if (st == HC_OK) rows[n++].motion = i;
  }
  compare_lock(w->setup);
  if (st == HC_OK) st = add_rows(w, n, rows);
  compare_unlock(w->setup);
  free(rows);
  return st;
}

static hc_status prepare(survey_work *w)
{
  const size_t n = (size_t)w->how->starts;
  timeint *ti;
  hc_status st = timeint_new(w->setup->model, &w->transient, &ti);
  if (st != HC_OK) return st;
  w->n_states = timeint_n_states(ti);
  w->n_responses = w->setup->model->n_responses;
  w->made = workspace_array(&w->memory, n, sizeof *w->made);
  w->status = workspace_array(&w->memory, n, sizeof *w->status);
  w->motion = workspace_array(&w->memory, n, sizeof *w->motion);
  w->states = workspace_doubles(&w->memory, n * (size_t)w->n_states);
  w->results = workspace_array(&w->memory, n * (size_t)w->n_responses, sizeof *w->results);
  if (w->setup->model->n == 1) w->began = workspace_array(&w->memory, n, sizeof *w->began);
  st = w->memory.failed ? HC_NO_MEMORY : HC_OK;
  if (st == HC_OK) timeint_rest(ti, w->states);
  if (st == HC_OK)
    st = survey_starts_new(w->setup->model, w->omega, w->states, w->how->starts, w->how->seed, &w->starts);
  timeint_free(ti);
  return st;
}

hc_status survey_at(const compare_setup *setup, hbm_solver *hbm, const hbm_curve *at, double omega,
                    const survey_settings *how, const hc_monitor *monitor, survey *out)
{
  survey_work w = {.setup = setup,
                   .how = how,
                   .transient = exact_settings(setup),
                   .hbm = hbm,
                   .at = at,
                   .omega = omega,
                   .out = out,
                   .monitor = monitor};
  if (how->starts < 1 || !(omega > 0)) return HC_BAD_INPUT;
  hc_status st = prepare(&w);
  if (st == HC_OK) {
    st = follow_all(&w);
    w.interrupted = st == HC_INTERRUPTED;
    if (st == HC_OK || w.interrupted) {
      find_motions(&w);
      st = measure_motions(&w);
      if (st == HC_OK && w.interrupted) st = HC_INTERRUPTED;
    }
  }
  survey_starts_free(w.starts);
  free(w.known);
  free(w.branch);
  workspace_free(&w.memory);
  return st;
}

int survey_first_branch(const hbm_curve *curve)
{
  int most = -1;
  for (int k = 0; k < curve->n; ++k) most = curve->points[k].branch > most ? curve->points[k].branch : most;
  return most + 2; /* one more is that of the motion in which no contact changes state, segment.h */
}

static const double curve_share = 0.05; /* of the work, roughly */

hc_status survey_run(const compare_setup *setup, const survey_settings *given, const hc_monitor *monitor, survey *out)
{
  response_curve response;
  number_list asked;
  *out = (survey){0};
  if (setup->compare.omega.n == 0) return HC_BAD_INPUT;
  hc_status st = comparison_frequencies(&setup->compare, setup->omega_from, NULL, &(hbm_curve){0}, &asked);
  if (st != HC_OK) return st;
  hc_monitor_part part = {monitor, 0, curve_share};
  const hc_monitor inner = {hc_monitor_tick_part, &part};
  st = response_trace(setup, &asked, &inner, &response);
  survey_settings how = *given;
  how.first_branch = survey_first_branch(&response.curve);
  for (int i = 0; i < asked.n && st == HC_OK; ++i) {
    hbm_curve at = {0};
    part.width = (1 - curve_share) / asked.n;
    part.from = curve_share + i * part.width;
    if (response.hbm) st = hbm_curve_at(response.hbm, &response.curve, asked.v[i], &at);
    if (st != HC_NO_MEMORY && st != HC_INTERRUPTED)
      st = survey_at(setup, response.hbm, &at, asked.v[i], &how, &inner, out);
    hbm_curve_free(&at);
    if (setup->added) setup->added(setup->added_to);
  }
  response_curve_free(&response);
  return st;
}

hc_status survey_append_beside(const survey *s, int from, hbm_curve *found)
{
  hc_status st = HC_OK;
  found->asked = true;
  for (int k = from; k < s->beside.n && st == HC_OK; ++k)
    st = hbm_curve_append(found, found->n ? found->n_coef : s->beside.n_coef, hbm_curve_X(&s->beside, k),
                          hbm_curve_dX(&s->beside, k), &s->beside.points[k]);
  return st;
}

int survey_others(const survey *s, int from)
{
  int n = 0;
  for (int i = from; i < s->n_rows; ++i) {
    const steady_row *r = &s->rows[i].steady;
    n += r->response == 0 && (r->status == HC_OK || r->status == HC_APERIODIC) && s->rows[i].hbm_branch < 0;
  }
  return n;
}

void survey_clear(survey *s)
{
  free(s->rows);
  free(s->starts);
  hbm_curve_free(&s->beside);
  *s = (survey){0};
}

double survey_seconds(const compare_setup *setup, int starts)
{
  enum { MOST_TIMED = 5 };
  const double patience = 10; /* [s] */
  const number_list *at = &setup->compare.omega;
  const transient_settings how = exact_settings(setup);
  const int timed = at->n < MOST_TIMED ? at->n : MOST_TIMED;
  timeint *ti;
  if (timed == 0 || timeint_new(setup->model, &how, &ti) != HC_OK) return 0;
  double *state = calloc((size_t)timeint_n_states(ti), sizeof *state);
  const double began = thread_seconds();
  work_limit limit = {.until = began + patience};
  int done = 0;
  for (int i = 0; i < timed && state && thread_seconds() < limit.until; ++i, ++done) {
    timeint_result r;
    timeint_rest(ti, state);
    timeint_steady(ti, at->v[(2 * i + 1) * at->n / (2 * timed)], state, &(hc_monitor){work_limit_tick, &limit}, &r);
  }
  const double seconds = thread_seconds() - began;
  free(state);
  timeint_free(ti);
  return done > 0 ? seconds / done * at->n * starts : 0;
}
