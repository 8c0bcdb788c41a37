/* prove.c - see prove.h: frequencies, solutions, orbits, and the checker's answers as rows. */
#include "proof/prove/prove.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/comparison.h"
#include "hbm/hbm.h"
#include "numerics/base/growing.h"
#include "numerics/base/number.h"
#include "numerics/base/thread_clock.h"
#include "proof/prove/certificate.h"
#include "proof/prove/checker.h"

enum {
  MOST_PERIODS = 2000, /* most periods from an unstable orbit to a steady state */
  MOST_MOVES = 8,      /* most moves of sliders that never slip; the motion partly follows each */
  MOST_UNKNOWNS = 800, /* of HBM with more harmonics: tenths of a second for a solution */
  MOST_CUTS = 12,      /* most periods of the motion from a solution whose events are tried */
  MOST_FAILURES = 8    /* successive failures of HBM, each with a quarter more harmonics: up to six times as many */
};
static const double most_work = 5e8; /* most work of the checker, sum of unknowns^3 over the periods whose events are
                                        tried */
static const double enough = 0.01,
                    room = 0.02;        /* [slider's interval] a slider closer than `enough` to an end is moved to
                                           `room` from it */
static const double same_orbit = 1e-6;  /* [amplitude] orbits with a smaller difference of measures are one */
static const double same_motion = 1e-9; /* [amplitude] largest change by moving a slider that does not count */
static const double same_branch = 0.5;  /* [amplitude] largest change by moving a slider on the same branch */

typedef struct prover {
  const compare_setup *setup;
  const hc_monitor *monitor;
  response_curve response;
  timeint *ti; /* the exact law in closed form */
  proof_checker *checker;
  certificate_model model;
  double *state; /* [n_states] */
  proof_keep *keep;
  void *keeper;
  proofs *out;
  int n_found; /* number of orbits found at this frequency */
  timeint_result *found;
} prover;

/* ---- what the checker says ---- */

/* Distance of a multiplier from +1 within which a failure is attributed to a fold. */
static const double near_fold = 1e-2;

/* The reason for an answer: the first whose key its text contains. */
static proof_reason reason_of(const json_t *answer, const json_t *rest, const timeint_result *r)
{
  static const struct {
    const char *key;
    proof_reason reason;
  } keys[] = {{"transitions at once", PROOF_TWO_AT_ONCE},
              {"edge of the cone", PROOF_CONE_EDGE},
              {"singular", PROOF_FOLD},
              {"too stiff", PROOF_TOO_LARGE},
              {"too much work", PROOF_TOO_LARGE},
              {"a list of", PROOF_TOO_LARGE}, /* a list beyond the checker's limits */
              {"not decided", PROOF_GRAZE},
              {"is negative", PROOF_GRAZE},
              {"Newton", PROOF_NO_ORBIT}};
  const json_t *at = json_object_get(answer, "contact");
  const char *words = json_string_value(json_object_get(answer, "reason"));
  proof_reason reason = PROOF_NO_DIGITS;
  for (size_t i = sizeof keys / sizeof *keys; i-- > 0;)
    if (words && strstr(words, keys[i].key)) reason = keys[i].reason;
  const bool folds = hypot(r->multiplier_re - 1, r->multiplier_im) < near_fold;
  if (folds && (reason == PROOF_NO_DIGITS || reason == PROOF_NO_ORBIT)) reason = PROOF_FOLD;
  if (reason == PROOF_GRAZE && json_is_integer(at) &&
      json_object_get(rest, number_write((double)json_integer_value(at), (char[NUMBER_TEXT]){0})))
    reason = PROOF_SLIDER_AT_LIMIT;
  return reason;
}

static proof_bounds bounds_of(const json_t *claims, const char *name)
{
  return (proof_bounds){certificate_bound(claims, name, 0, -1), certificate_bound(claims, name, 1, +1)};
}

/* A difference that was rounded to nearest, so that the true one is not beyond it; 0 is exact. */
static double rounded(double difference, double towards)
{
  return difference == 0 ? 0 : nextafter(difference, towards);
}

/* The claims of an accepted certificate. */
static void read_claims(const json_t *claims, proof_row *row)
{
  const char *stability = json_string_value(json_object_get(claims, "stability"));
  row->radius = certificate_bound(claims, "radius", -1, 0);
  row->amplitude = bounds_of(claims, "amplitude");
  row->mean = bounds_of(claims, "mean");
  row->harmonic_1 = bounds_of(claims, "harmonic_1");
  row->multiplier = bounds_of(claims, "multiplier");
  row->error.low = rounded(row->hbm_amplitude - row->amplitude.high, -INFINITY);
  row->error.high = rounded(row->hbm_amplitude - row->amplitude.low, INFINITY);
  row->stability = stability ? !strcmp(stability, "stable") - !strcmp(stability, "unstable") : 0;
  if (row->other_member) row->error = (proof_bounds){NAN, NAN};
}

/* ---- an orbit ---- */

/* Moves sliders that never slip but are close to a limit to `share` of their interval from it; false: an interval is
 * empty. */
static bool move_sliders(const prover *p, const orbit_events *e, double share, bool *moved)
{
  double *w = p->state + 2 * e->n_dof;
  *moved = false;
  for (int j = 0; j < e->n_contacts; ++j) {
    const double length = e->highest[j] - e->lowest[j], at = (e->rest[j] - e->lowest[j]) / length;
    if (isnan(e->rest[j])) continue;
    if (!(length > 0)) return false;
    if (at > enough && at < 1 - enough) continue;
    w[j] =
        at < 0.5 ? fmax(e->rest[j], e->lowest[j]) + share * length : fmin(e->rest[j], e->highest[j]) - share * length;
    *moved = true;
  }
  return true;
}

/* The events of the orbit *r, p->state being on it; or of one next to it, with sliders moved away from their limits. */
static hc_status find_events(prover *p, timeint_result *r, proof_row *row, orbit_events *e)
{
  const double amplitude = r->amplitude;
  hc_status st = timeint_events(p->ti, r->period_multiple, e);
  double share = room;
  for (int moves = 0; st == HC_OK; ++moves, share *= 2) { /* the motion partly follows, so the next move is larger */
    bool moved;
    const bool possible = move_sliders(p, e, share, &moved);
    if (possible && !moved) return HC_OK;
    row->reason = PROOF_SLIDER_AT_LIMIT;
    if (!possible || moves == MOST_MOVES) return HC_NOT_CONVERGED;
    row->moved = true;
    orbit_events_free(e);
    st = timeint_orbit(p->ti, r->omega, r->period_multiple, p->state, p->monitor, r);
    if (st == HC_OK && !(fabs(r->amplitude - amplitude) <= same_branch * amplitude)) st = HC_NOT_CONVERGED;
    row->other_member = st == HC_OK && !(fabs(r->amplitude - amplitude) <= same_motion * amplitude);
    if (st == HC_OK) st = timeint_events(p->ti, r->period_multiple, e);
  }
  return st;
}

/* The checker's answer to the candidate into *row; *certificate if it is proven. */
static hc_status ask(prover *p, const timeint_result *r, const orbit_events *e, proof_row *row, json_t **certificate)
{
  json_t *candidate = certificate_of(&p->model, row->omega, row->multiple, r->amplitude, e), *answer = NULL;
  const double began = wall_seconds();
  hc_status st = candidate ? proof_checker_ask(p->checker, candidate, &answer) : HC_NO_MEMORY;
  row->seconds = wall_seconds() - began;
  if (st == HC_IO && !hc_monitor_tick(p->monitor, -1)) st = HC_INTERRUPTED; /* a signal has ended the checker, too */
  const json_t *refined = json_object_get(answer, "certificate");
  const char *said = json_string_value(json_object_get(answer, "verdict"));
  const char *words = json_string_value(json_object_get(answer, "reason"));
  row->proven = said && !strcmp(said, "accepted") && certificate_is_of(refined, &p->model, row->omega, row->multiple);
  row->reason = row->proven ? PROOF_NO_REASON : reason_of(answer, json_object_get(candidate, "rest"), r);
  row->free_sliders = (int)json_object_size(json_object_get(candidate, "rest"));
  certificate_letters(candidate, row->states, sizeof row->states);
  snprintf(row->detail, sizeof row->detail, "%s", words ? words : "");
  if (row->proven) read_claims(json_object_get(refined, "claims"), row);
  if (row->proven) *certificate = json_incref((json_t *)refined);
  json_decref(candidate);
  json_decref(answer);
  return st;
}

static hc_status add_row(prover *p, proof_row *row, json_t *certificate)
{
  hc_status st = p->keep ? p->keep(p->keeper, row, certificate) : HC_OK;
  json_decref(certificate);
  if (st == HC_OK && !GROW(p->out->rows, p->out->n)) st = HC_NO_MEMORY;
  if (st == HC_OK) p->out->rows[p->out->n++] = *row;
  return st;
}

static bool fatal(hc_status st) { return st == HC_NO_MEMORY || st == HC_INTERRUPTED || st == HC_IO; }

/* Adds the row of the orbit *r, p->state being on it. */
static hc_status prove_orbit(prover *p, timeint_result *r, proof_row *row)
{
  orbit_events e = {0};
  json_t *certificate = NULL;
  row->reason = PROOF_NO_ORBIT;
  hc_status found = find_events(p, r, row, &e);
  if (found == HC_OK) {
    row->multiple = r->period_multiple;
    row->transitions = e.n > 1 ? e.n : 0;
    found = ask(p, r, &e, row, &certificate);
  }
  orbit_events_free(&e);
  return fatal(found) ? found : add_row(p, row, certificate);
}

/* ---- a frequency ---- */

static bool known(const prover *p, const timeint_result *r)
{
  for (int i = 0; i < p->n_found; ++i) {
    const timeint_result *o = &p->found[i];
    const double apart = fmax(fabs(o->max - r->max), fmax(fabs(o->min - r->min), fabs(o->rms - r->rms)));
    if (apart <= same_orbit * r->amplitude) return true;
  }
  return false;
}

static hc_status remember(prover *p, const timeint_result *r)
{
  if (!GROW(p->found, p->n_found)) return HC_NO_MEMORY;
  p->found[p->n_found++] = *r;
  return HC_OK;
}

/* X becomes HBM's solution with h harmonics, the mean and exact forces, from X as guess; p->state: a state on it. */
static hc_status solve_finer(prover *p, int h, double omega, double *X)
{
  hbm_settings how = p->setup->hbm;
  hbm_solver *finer;
  hbm_point point;
  how.harmonics = h, how.keep_mean = true, how.force = HBM_FORCE_EXACT;
  hc_status st = hbm_solver_new(p->setup->model, &how, &finer);
  if (st == HC_OK) st = hbm_solve(finer, omega, X, &point);
  if (st == HC_OK) st = comparison_orbit_start(finer, X, omega, p->state);
  hbm_solver_free(finer);
  return st;
}

/* True if the orbit is within three times the row's estimated error; else it belongs to another solution. */
static bool is_near(const timeint_result *r, const proof_row *row)
{
  return !(fabs(r->amplitude - row->hbm_amplitude) > 3 * row->predicted + same_orbit * r->amplitude);
}

/* The orbit next to X. If none is found, or only one farther than X's estimated error, HBM is solved from X with ever
 * more harmonics, and the mean, until an orbit is near; if none is, the first one found is taken. row->too_few: no
 * orbit, and HBM has no solution with the most harmonics; after a failure of HBM the next number is tried, too. */
static hc_status find_orbit(prover *p, double omega, const double *X, timeint_result *r, proof_row *row)
{
  const int length = hbm_n_coefficients(p->response.hbm), own = hbm_n_harmonics(p->response.hbm);
  const int dim = length / (2 * own + 1);
  const size_t most = (size_t)dim * (2 * HBM_MAX_HARMONICS + 1), n_states = (size_t)timeint_n_states(p->ti);
  hc_status solved = HC_OK, st = comparison_orbit_start(p->response.hbm, X, omega, p->state);
  double *finer = calloc(most + n_states, sizeof *finer);
  timeint_result first;
  int first_harmonics = -1;
  if (!finer) return HC_NO_MEMORY;
  double *first_state = finer + most;
  memcpy(finer, X, (size_t)length * sizeof *finer);
  if (st == HC_OK) st = timeint_orbit(p->ti, omega, 1, p->state, p->monitor, r);
  int h = p->setup->hbm.keep_mean ? own + own / 4 + (own < 4) : own;
  for (int failures = 0; !fatal(st) && !(st == HC_OK && is_near(r, row)) && failures < MOST_FAILURES;
       h += h / 4 + (h < 4)) {
    if (h > HBM_MAX_HARMONICS || dim * (2 * h + 1) > MOST_UNKNOWNS) break;
    if (st == HC_OK && first_harmonics < 0) {
      first = *r, first_harmonics = row->harmonics;
      memcpy(first_state, p->state, n_states * sizeof *first_state);
    }
    st = solved = solve_finer(p, h, omega, finer);
    failures = solved == HC_OK ? 0 : failures + 1;
    if (st == HC_OK) st = timeint_orbit(p->ti, omega, 1, p->state, p->monitor, r);
    row->harmonics = h;
  }
  if (first_harmonics >= 0 && !fatal(st) && !(st == HC_OK && is_near(r, row))) {
    *r = first, row->harmonics = first_harmonics, st = HC_OK;
    memcpy(p->state, first_state, n_states * sizeof *first_state);
  }
  row->too_few = st != HC_OK && solved != HC_OK;
  free(finer);
  return st;
}

/* For orbits that Newton on the period map does not find, as where a stiff contact closes for an instant only: the
 * checker's Newton starts from the events of a period of the motion from X, or of a later one if t = 0 lies within a
 * contact. */
static hc_status prove_events(prover *p, const double *X, proof_row *row)
{
  json_t *certificate = NULL;
  hc_status st = HC_OK;
  double work = 0;
  row->reason = row->too_few ? PROOF_TOO_FEW : PROOF_NO_ORBIT;
  for (int after = 0; after < MOST_CUTS && !row->proven && !fatal(st); ++after) {
    if (work > most_work) row->reason = row->too_few ? PROOF_TOO_FEW : PROOF_TOO_LARGE;
    if (work > most_work) break;
    timeint_result r = {.amplitude = row->hbm_amplitude, .rms = NAN, .multiplier_re = NAN};
    orbit_events e = {0};
    proof_row led = *row;
    led.multiple = 1, led.harmonics = 0, led.by_events = true;
    st = comparison_orbit_start(p->response.hbm, X, row->omega, p->state);
    if (st == HC_OK) st = timeint_motion_events(p->ti, row->omega, p->state, after, &e);
    led.transitions = e.n > 1 ? e.n : 0;
    work += pow(e.n * (2.0 * e.n_dof + 1), 3);
    if (st == HC_OK && e.n > 0) st = ask(p, &r, &e, &led, &certificate);
    orbit_events_free(&e);
    if (st != HC_OK || !led.proven) continue;
    *row = led;
    r.max = certificate_bound(json_object_get(certificate, "claims"), "max", 0, 0);
    r.min = certificate_bound(json_object_get(certificate, "claims"), "min", 0, 0);
    st = remember(p, &r);
  }
  if (!fatal(st)) return add_row(p, row, certificate);
  json_decref(certificate);
  return st;
}

/* True if a contact's law is not piecewise linear. */
static bool is_curved(const model *m) { return model_has_circle(m) || model_is_smooth(m); }

/* Proves the orbit next to solution k. *leads_on: it is unstable, or none was found, so that motions leave. */
static hc_status prove_solution(prover *p, const hbm_curve *at, int k, bool *leads_on)
{
  const double *X = hbm_curve_X(at, k), omega = at->points[k].omega;
  proof_row row = {.omega = omega,
                   .branch = at->points[k].branch,
                   .radius = NAN,
                   .amplitude = {NAN, NAN},
                   .mean = {NAN, NAN},
                   .harmonic_1 = {NAN, NAN},
                   .error = {NAN, NAN},
                   .predicted = NAN};
  hbm_measures measures;
  motion_error expected;
  timeint_result r;
  hc_status st = hbm_measure(p->response.hbm, X, &measures);
  row.hbm_amplitude = st == HC_OK ? measures.amplitude : NAN;
  if (st == HC_OK && hbm_predict(p->response.hbm, omega, X, &expected) == HC_OK) row.predicted = expected.amplitude;
  if (is_curved(p->setup->model)) {
    row.reason = model_is_smooth(p->setup->model) ? PROOF_SMOOTH : PROOF_CIRCLE;
    return add_row(p, &row, NULL);
  }
  if (st == HC_OK) st = find_orbit(p, omega, X, &r, &row);
  *leads_on = st != HC_OK || timeint_stability(&r) < 0;
  if (st == HC_OK && remember(p, &r) != HC_OK) st = HC_NO_MEMORY;
  if (fatal(st)) return st;
  return st == HC_OK ? prove_orbit(p, &r, &row) : prove_events(p, X, &row);
}

/* Proves the steady state from p->state, unless it is known already. */
static hc_status prove_steady(prover *p, double omega)
{
  proof_row row = {
      .omega = omega, .branch = -1, .radius = NAN, .error = {NAN, NAN}, .predicted = NAN, .hbm_amplitude = NAN};
  timeint_result r;
  const hc_status st = timeint_steady(p->ti, omega, p->state, p->monitor, &r);
  if (fatal(st)) return st;
  if (st != HC_OK || known(p, &r)) return HC_OK;
  const hc_status kept = remember(p, &r);
  return kept == HC_OK ? prove_orbit(p, &r, &row) : kept;
}

/* All solutions first, so that steady states reached from unstable ones are proven once. */
static hc_status prove_at(prover *p, double omega)
{
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(p->response.hbm, &p->response.curve, omega, &at);
  bool *leads_on = calloc((size_t)at.n + 1, sizeof *leads_on);
  p->n_found = 0;
  if (!leads_on) st = HC_NO_MEMORY;
  for (int k = 0; k < at.n && !fatal(st); ++k) st = prove_solution(p, &at, k, &leads_on[k]);
  for (int k = 0; k < at.n && !fatal(st); ++k) {
    if (!leads_on[k]) continue;
    st = comparison_orbit_start(p->response.hbm, hbm_curve_X(&at, k), omega, p->state);
    if (st == HC_OK) st = prove_steady(p, omega);
  }
  if (at.n == 0 && !fatal(st) && !is_curved(p->setup->model)) {
    timeint_rest(p->ti, p->state);
    st = prove_steady(p, omega);
  }
  free(leads_on);
  hbm_curve_free(&at);
  return fatal(st) ? st : HC_OK;
}

/* All frequencies; progress by their number. */
static hc_status prove_all(prover *p)
{
  number_list omega;
  hc_status st =
      comparison_frequencies(&p->setup->compare, p->setup->omega_from, p->response.hbm, &p->response.curve, &omega);
  for (int i = 0; i < omega.n && st == HC_OK; ++i) {
    st = prove_at(p, omega.v[i]);
    if (st == HC_OK && !hc_monitor_tick(p->monitor, (i + 1.0) / omega.n)) st = HC_INTERRUPTED;
  }
  return st;
}

hc_status prove_run(const scene *sc, const compare_setup *setup, const hc_monitor *monitor, proof_keep *keep,
                    void *keeper, proofs *out)
{
  prover p = {.setup = setup, .monitor = monitor, .keep = keep, .keeper = keeper, .out = out};
  transient_settings how = setup->transient;
  how.law = TRANSIENT_LAW_EXACT;
  how.method = model_is_smooth(setup->model) ? TRANSIENT_METHOD_CVODE : TRANSIENT_METHOD_CLOSED_FORM;
  how.scout = false;
  how.steady = TRANSIENT_STEADY_AUTO;
  how.start = TRANSIENT_START_HBM;
  how.tolerance = fmin(how.tolerance, 1e-10);
  if (how.max_periods > MOST_PERIODS) how.max_periods = MOST_PERIODS;
  *out = (proofs){0};
  hc_status st = proof_checker_new(&p.checker);
  if (st == HC_OK) st = certificate_model_make(sc, setup->model, 0, &p.model);
  if (st == HC_OK) st = timeint_new(setup->model, &how, &p.ti);
  if (st == HC_OK && !(p.state = calloc((size_t)timeint_n_states(p.ti), sizeof *p.state))) st = HC_NO_MEMORY;
  if (st == HC_OK)
    st = response_trace(setup, &setup->compare.omega, &(hc_monitor){hc_monitor_tick_aside, (void *)(size_t)monitor},
                        &p.response);
  if (st == HC_OK) {
    out->curve_end = p.response.status;
    st = p.response.hbm ? prove_all(&p) : p.response.status;
  }
  response_curve_free(&p.response);
  timeint_free(p.ti);
  certificate_model_free(&p.model);
  proof_checker_free(p.checker);
  free(p.state);
  free(p.found);
  return st;
}

void proofs_clear(proofs *p)
{
  free(p->rows);
  *p = (proofs){0};
}
