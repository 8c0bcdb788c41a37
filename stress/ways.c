/* ways.c - checks that a structure written in another way has the same solution: degrees of freedom in
 * another order, other coordinates, other units, contacts split, copies, company, another time 0.
 *
 * Newton begins a little beside the solution that is known, so that it has to find it again. The two may differ by
 * rounding alone: that of the change of coordinates, some n^2 units, and of Newton's last step, times the condition of
 * the equations. 1e-11 of the largest response is let pass; and 2e-6 of the multiplier, for a double one splits by the
 * root of rounding, which in a product of exponentials is some 1e-12. Beyond that, what the scene itself makes of
 * errors of rounding (stress_condition). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/random.h"
#include "stress/solved_scene.h"

static const double close_enough = 1e-11, same_multipliers = 2e-6, elsewhere = 1e-6;

/* ---- the condition of a solution --------------------------------------------------------------------- */

/* m from the base solution, `beside` off. HC_NO_MEMORY goes to s->fatal. */
static void solve_again(solved_scene *s, const model *m, double beside, stress_motion *out)
{
  const int length = s->n * s->n_coef;
  double *guess = malloc((size_t)length * sizeof *guess);
  if (!guess) s->fatal = HC_NO_MEMORY;
  for (int i = 0; guess && i < length; ++i) guess[i] = s->base.x[i] * (1 + beside * random_signed(&s->random));
  stress_motion_solve(s, m, &s->how, s->omega, guess, 1, out);
  free(guess);
}

/* Data changed by `nudge`: how far the solution goes, and *rate, the multiplier for each unit of that. */
static double nudged(solved_scene *s, double nudge, double *rate)
{
  model *m;
  stress_motion moved;
  if ((s->fatal = rewritten_nudged(s->model, nudge, &s->random, &m)) != HC_OK) return INFINITY;
  solve_again(s, m, 0, &moved);
  const double far = moved.status == HC_OK ? stress_motion_distance(s, moved.x, s->base.x, false) : INFINITY;
  if (moved.status == HC_OK && far > 0) *rate = fmax(*rate, stress_multipliers_apart(&moved, &s->base) / far);
  stress_motion_free(&moved);
  model_free(m);
  return far;
}

/* The same equations from another guess; what is found must be a solution. */
static double found_elsewhere(solved_scene *s, double beside)
{
  stress_motion again;
  solve_again(s, s->model, beside, &again);
  double far = INFINITY;
  if (again.status == HC_OK) {
    far = stress_motion_distance(s, again.x, s->base.x, false);
    if (!(stress_imbalance(s, again.x) <= stress_balanced(s))) far = 0;
  }
  stress_motion_free(&again);
  return far;
}

/* Rounding of the data in other coordinates is n^2 units of their largest, 4e-14 for n = 13, times ten as the data here
 * are changed twice only. Newton's scatter is known by three: a hundred times as much is reckoned with. */
void stress_condition(solved_scene *s)
{
  const double nudge = 1e-9, rounding = 4e-13, scatter = 100;
  double rate = 0;
  if (s->conditioned) return;
  for (int i = 0; i < 2 && s->fatal == HC_OK; ++i)
    s->solution_errs = fmax(s->solution_errs, rounding / nudge * nudged(s, nudge, &rate));
  for (int i = 0; i < 3 && s->fatal == HC_OK; ++i)
    s->solution_errs = fmax(s->solution_errs, scatter * found_elsewhere(s, pow(10, -3 - 2 * i)));
  s->multiplier_errs = rate * s->solution_errs;
  s->conditioned = true;
}

/* ---- one way to write it ------------------------------------------------------------------------------- */

typedef struct way {
  model *model;  /* NULL: out of memory */
  double *guess; /* [2H+1][model->n] the known solution as the other model says it */
  double omega, length;
  double delay; /* [rad] that the other motion is ahead */
  bool company; /* whose own multiplier may be the largest */
} way;

static size_t guess_length(const solved_scene *s, int n) { return (size_t)n * (size_t)s->n_coef; }

/* The base solution in y, x = Q y. */
static double *turned_guess(const solved_scene *s, const double *Q)
{
  double *guess = malloc(guess_length(s, s->n) * sizeof *guess);
  for (int c = 0; guess && c < s->n_coef; ++c) turned_vector(s->n, Q, s->base.x + c * s->n, guess + c * s->n);
  return guess;
}

static void clear(way *w)
{
  model_free(w->model);
  free(w->guess);
}

/* Back to our time: coefficients of harmonic h turned by -h delay. */
static void undelay(const solved_scene *s, double delay, double *x)
{
  for (int h = 1; 2 * h < s->n_coef && delay != 0; ++h) {
    const double c = cos(h * delay), sine = sin(h * delay);
    double *a = x + (2 * h - 1) * s->n, *b = a + s->n;
    for (int i = 0; i < s->n; ++i) {
      const double kept = a[i];
      a[i] = c * kept - sine * b[i];
      b[i] = c * b[i] + sine * kept;
    }
  }
}

/* Solve it from `beside` off the known solution; the distance of what is found. */
static double found_again(solved_scene *s, const way *w, double beside, stress_motion *out)
{
  const size_t n = guess_length(s, w->model->n);
  double *guess = malloc(n * sizeof *guess);
  for (size_t i = 0; guess && i < n; ++i) guess[i] = w->guess[i] * (1 + beside * random_signed(&s->random));
  if (!guess) s->fatal = HC_NO_MEMORY;
  stress_motion_solve(s, w->model, &s->how, w->omega, guess, w->length, out);
  free(guess);
  if (out->status != HC_OK) return NAN;
  undelay(s, w->delay, out->x);
  return stress_motion_distance(s, out->x, s->base.x, false);
}

static stress_check same_multiplier(solved_scene *s, const stress_motion *other, double error)
{
  if (s->base.stability_status != other->stability_status) return stress_find(STRESS_DISAGREES, NAN, NAN);
  if (s->base.stability_status != HC_OK) return stress_agree(error, close_enough);
  const double apart = stress_multipliers_apart(other, &s->base);
  if (apart <= same_multipliers) return stress_agree(error, close_enough);
  stress_condition(s);
  return apart <= s->multiplier_errs ? stress_explain(STRESS_ILL_CONDITIONED, apart, s->multiplier_errs)
                                     : stress_find(STRESS_DISAGREES, apart, fmax(same_multipliers, s->multiplier_errs));
}

/* Beyond the bound, and after the last guess: the reason, if there is one. A motion that is another altogether, and in
 * balance by the equations as they were, is a solution, too; where the scene makes more than 1e-3 of rounding, or loses
 * the solution, nothing is said. */
static stress_check explain(solved_scene *s, hc_status refused, double error, bool balanced)
{
  stress_condition(s);
  if (error <= s->solution_errs && s->solution_errs <= STRESS_SAYS_SOMETHING)
    return stress_explain(STRESS_ILL_CONDITIONED, error, s->solution_errs);
  if (error > elsewhere && balanced) return stress_explain(STRESS_OTHER_ORBIT, error, elsewhere);
  if (s->solution_errs > STRESS_SAYS_SOMETHING && (error <= s->solution_errs || refused != HC_OK))
    return stress_skip(STRESS_ILL_CONDITIONED);
  if (refused != HC_OK && s->solution_errs > elsewhere)
    return stress_explain(STRESS_ILL_CONDITIONED, error, s->solution_errs);
  return stress_find(refused == HC_OK && isnan(error) ? STRESS_INTERNAL : STRESS_DISAGREES, error,
                     fmax(close_enough, s->solution_errs));
}

/* The check of one way, which it clears. */
static stress_check check_way(solved_scene *s, way w)
{
  static const double beside[] = {1e-3, 1e-5, 1e-7};
  stress_check result = stress_skip(STRESS_NO_REASON);
  hc_status refused = HC_OK;
  double error = NAN;
  bool same = false, agreed = false, balanced = false;
  if (!w.model || !w.guess) s->fatal = HC_NO_MEMORY;
  for (int i = 0; i < 3 && !agreed && s->fatal == HC_OK; ++i) {
    stress_motion other;
    error = found_again(s, &w, beside[i], &other);
    refused = other.status;
    same = error <= close_enough;
    if (same) result = w.company ? stress_agree(error, close_enough) : same_multiplier(s, &other, error);
    agreed = same && result.outcome == STRESS_AGREED; /* else a copy that is not read may have gone elsewhere */
    if (!same) balanced = refused == HC_OK && stress_imbalance(s, other.x) <= stress_balanced(s);
    stress_motion_free(&other);
  }
  clear(&w);
  return same || s->fatal != HC_OK ? result : explain(s, refused, error, balanced);
}

/* ---- coordinates ---------------------------------------------------------------------------------- */

static stress_check turn(solved_scene *s, void (*draw)(uint64_t *, int, double *))
{
  if (s->n == 1) return stress_skip(STRESS_NOT_APPLICABLE);
  way w = {.omega = s->omega, .length = 1};
  double *Q = malloc((size_t)s->n * (size_t)s->n * sizeof *Q);
  if (Q) {
    draw(&s->random, s->n, Q);
    rewritten_turned(s->model, Q, &w.model);
    w.guess = turned_guess(s, Q);
  }
  free(Q);
  return check_way(s, w);
}

stress_check stress_check_permuted(solved_scene *s) { return turn(s, random_permutation); }
stress_check stress_check_rotated(solved_scene *s) { return turn(s, random_rotation); }

/* ---- units ------------------------------------------------------------------------------------------ */

static stress_check check_units(solved_scene *s, double length, double force, double time)
{
  way w = {.omega = s->omega / time, .length = length};
  rewritten_in_units(s->model, length, force, time, &w.model);
  w.guess = malloc(guess_length(s, s->n) * sizeof *w.guess);
  for (size_t i = 0; w.guess && i < guess_length(s, s->n); ++i) w.guess[i] = length * s->base.x[i];
  return check_way(s, w);
}

/* Powers of four change no mantissa and no root's: from nothing, the same to the last bit but for what libraries do.
 * (Where a free body hardly touches anything, that much decides where it goes.) */
stress_check stress_check_units(solved_scene *s)
{
  const double length = 0x1p-10, force = 0x1p6, time = 0x1p4;
  model *m;
  stress_motion binary;
  if ((s->fatal = rewritten_in_units(s->model, length, force, time, &m)) != HC_OK) return stress_skip(STRESS_NO_REASON);
  stress_motion_solve(s, m, &s->how, s->omega / time, NULL, length, &binary);
  model_free(m);
  const hc_status st = binary.status;
  const double error = st == HC_OK ? stress_motion_distance(s, binary.x, s->base.x, false) : NAN;
  const bool balanced = st == HC_OK && stress_imbalance(s, binary.x) <= stress_balanced(s);
  stress_motion_free(&binary);
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return stress_refuse(s, st);
  if (!(error <= close_enough)) return explain(s, st, error, balanced);
  return check_units(s, 39.3701, 0.224809, 1.0 / 60);
}

/* ---- contacts, copies, company ----------------------------------------------------------------------- */

static double *copied_guess(const solved_scene *s, int n, bool twice)
{
  double *guess = calloc(guess_length(s, n), sizeof *guess);
  for (int c = 0; guess && c < s->n_coef; ++c) {
    memcpy(guess + c * n, s->base.x + c * s->n, (size_t)s->n * sizeof *guess);
    if (twice) memcpy(guess + c * n + s->n, s->base.x + c * s->n, (size_t)s->n * sizeof *guess);
  }
  return guess;
}

stress_check stress_check_split(solved_scene *s)
{
  way w = {.omega = s->omega, .length = 1};
  rewritten_split(s->model, 0.1 + 0.8 * random_unit(&s->random), &w.model);
  w.guess = copied_guess(s, s->n, false);
  return check_way(s, w);
}

stress_check stress_check_copies(solved_scene *s)
{
  way w = {.omega = s->omega, .length = 1};
  rewritten_beside(s->model, s->n, true, &w.model);
  w.guess = copied_guess(s, 2 * s->n, true);
  return check_way(s, w);
}

stress_check stress_check_bystander(solved_scene *s)
{
  const int n = s->n + 1;
  way w = {.omega = s->omega, .length = 1, .company = true};
  model *m;
  double *Q = malloc((size_t)n * (size_t)n * sizeof *Q), *straight = copied_guess(s, n, false);
  w.guess = malloc(guess_length(s, n) * sizeof *w.guess);
  if (Q && straight && w.guess && rewritten_beside(s->model, 1, false, &m) == HC_OK) {
    random_rotation(&s->random, n, Q);
    for (int c = 0; c < s->n_coef; ++c) turned_vector(n, Q, straight + c * n, w.guess + c * n);
    rewritten_turned(m, Q, &w.model);
    model_free(m);
  }
  free(Q);
  free(straight);
  return check_way(s, w);
}

/* One limit for both of a contact's tangents does not know which two they are. */
stress_check stress_check_other_tangents(solved_scene *s)
{
  way w = {.omega = s->omega, .length = 1};
  if (!model_has_circle(s->model)) return stress_skip(STRESS_NOT_APPLICABLE);
  rewritten_other_tangents(s->model, &s->random, &w.model);
  w.guess = copied_guess(s, s->n, false);
  return check_way(s, w);
}

/* ---- time -------------------------------------------------------------------------------------------- */

/* Where a slider that never slips rests hangs on time 0. */
stress_check stress_check_delayed(solved_scene *s)
{
  if (s->base.m.contact.free_sliders > 0) return stress_skip(STRESS_NOT_APPLICABLE);
  const double delay = random_unit(&s->random) < 0.5 ? PI : TWO_PI * random_unit(&s->random);
  way w = {.omega = s->omega, .length = 1, .delay = delay};
  rewritten_delayed(s->model, delay, &w.model);
  w.guess = copied_guess(s, s->n, false);
  if (w.guess) undelay(s, -delay, w.guess);
  return check_way(s, w);
}
