/* ways.c - checks that a structure written in another way has the same solution: degrees of freedom in
 * another order, other coordinates, other units, contacts split, copies, company, another time 0.
 *
 * Newton begins a little beside the solution that is known, so that it has to find it again. The two may differ by
 * rounding alone: that of the change of coordinates, some n^2 units, and of Newton's last step, times the condition of
 * the equations. 1e-11 of the largest response is let pass; and 2e-6 of the multiplier, for a double one splits by the
 * root of rounding, which in a product of exponentials is some 1e-12. Beyond that, what the scene itself makes of
 * errors of rounding (stress_condition). */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/stress/solved_scene.h"
#include "model/modes.h"
#include "numerics/base/constants.h"
#include "numerics/norm.h"
#include "numerics/random.h"
#include "numerics/series.h"

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
  rewritten other;
  stress_motion moved;
  if ((s->fatal = rewritten_nudged(s->model, nudge, &s->random, &other)) != HC_OK) return INFINITY;
  solve_again(s, other.model, 0, &moved);
  const double far = moved.status == HC_OK ? stress_motion_distance(s, moved.x, s->base.x, false) : INFINITY;
  if (moved.status == HC_OK && far > 0) *rate = fmax(*rate, stress_multipliers_apart(&moved, &s->base) / far);
  stress_motion_free(&moved);
  rewritten_clear(&other);
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
  if (s->conditioned) return;
  for (int i = 0; i < 2 && s->fatal == HC_OK; ++i)
    s->solution_errs = fmax(s->solution_errs, rounding / nudge * nudged(s, nudge, &s->multiplier_rate));
  for (int i = 0; i < 3 && s->fatal == HC_OK; ++i)
    s->solution_errs = fmax(s->solution_errs, scatter * found_elsewhere(s, pow(10, -3 - 2 * i)));
  s->multiplier_errs = s->multiplier_rate * s->solution_errs;
  s->conditioned = true;
}

/* ---- one way to write it ------------------------------------------------------------------------------- */

/* x(t) becomes x(t + delay/omega): coefficients of harmonic h turned by h delay. */
static void shift(const solved_scene *s, double delay, int n_coef, double *x)
{
  for (int h = 1; 2 * h < n_coef && delay != 0; ++h) {
    double *a = x + (2 * h - 1) * s->n;
    rewritten_turn(s->n, h * delay, a, a + s->n);
  }
}

/* The harmonics of what is beside it, alone, into the last entry of guess[2H+1][n]; where that fails they stay 0. */
static void guess_company(solved_scene *s, const rewritten *w, int n_harm, double *guess)
{
  hbm_settings how = s->how;
  hbm_solver *h = NULL;
  hbm_point point;
  how.harmonics = n_harm;
  const int n_coef = series_length(n_harm), last = w->model->n - 1;
  double *x = calloc((size_t)n_coef, sizeof *x);
  hc_status st = x ? hbm_solver_new(w->company, &how, &h) : HC_NO_MEMORY;
  if (st == HC_OK) st = hbm_first_solution(h, s->omega, &s->monitor, x, &point);
  for (int c = 0; c < n_coef && st == HC_OK; ++c) guess[c * w->model->n + last] = x[c];
  if (st == HC_NO_MEMORY) s->fatal = st;
  hbm_solver_free(h);
  free(x);
}

/* A solution as the other says it, [2H+1][w->model->n]. NULL: out of memory. */
static double *guess_of(solved_scene *s, const rewritten *w, const stress_motion *of)
{
  const size_t n = (size_t)s->n, n_other = (size_t)w->model->n, n_coef = (size_t)series_length(of->harmonics);
  double *guess = calloc(n_coef * n_other, sizeof *guess), *x = malloc(n_coef * n * sizeof *x);
  if (guess && x) {
    memcpy(x, of->x, n_coef * n * sizeof *x);
    shift(s, w->delay, (int)n_coef, x);
    for (size_t c = 0; c < n_coef; ++c) rewritten_motion(w, s->n, x + c * n, guess + c * n_other);
    for (size_t i = 0; i < n_coef * n_other; ++i) guess[i] *= w->length;
    for (size_t i = 0; i < n && w->offset; ++i) guess[i] += w->offset[i];
    if (w->company) guess_company(s, w, of->harmonics, guess);
  }
  free(x ? x : guess);
  return x ? guess : NULL;
}

/* Solve it from `beside` off the known solution, known[]; the distance of what is found. */
static double found_again(solved_scene *s, const rewritten *w, const double *known, double beside, stress_motion *out)
{
  const size_t n = (size_t)w->model->n * (size_t)s->n_coef;
  double *guess = malloc(n * sizeof *guess);
  for (size_t i = 0; guess && i < n; ++i) {
    const double rests = w->offset && i < (size_t)s->n ? w->offset[i] : 0;
    guess[i] = known[i] + beside * random_signed(&s->random) * (known[i] - rests);
  }
  if (!guess) s->fatal = HC_NO_MEMORY;
  stress_motion_solve(s, w->model, &s->how, s->omega / w->time, guess, w->length, out);
  free(guess);
  if (out->status != HC_OK) return NAN;
  for (int i = 0; i < s->n && w->offset; ++i) out->x[i] -= w->offset[i];
  shift(s, -w->delay, s->n_coef, out->x);
  return stress_motion_distance(s, out->x, s->base.x, false);
}

static stress_check same_multiplier(solved_scene *s, const stress_motion *other, double error, double bound)
{
  if (s->base.stability_status != other->stability_status) return stress_find(STRESS_DISAGREES, NAN, NAN);
  if (s->base.stability_status != HC_OK) return stress_agree(error, bound);
  const double apart = stress_multipliers_apart(other, &s->base);
  if (apart <= same_multipliers) return stress_agree(error, bound);
  stress_condition(s);
  if (s->solution_errs > STRESS_SAYS_SOMETHING) return stress_skip(STRESS_ILL_CONDITIONED);
  return stress_agree_within(apart, same_multipliers, s->multiplier_errs);
}

/* Is the base solution, moved a little to either side along a motion that K does not hold, in balance, too? */
static bool balanced_beside(solved_scene *s, const double *free_motion)
{
  const int n = s->n, length = n * s->n_coef;
  const double moves = norm_max(length, s->base.x), size = (moves > 0 ? moves : 1) / norm_max(n, free_motion);
  double *x = malloc((size_t)length * sizeof *x);
  bool balanced = false;
  for (int side = -1; x && side <= 1 && !balanced; side += 2) {
    memcpy(x, s->base.x, (size_t)length * sizeof *x);
    for (int i = 0; i < n; ++i) x[i] += side * elsewhere * size * free_motion[i];
    balanced = stress_imbalance(s, x) <= stress_balanced(s);
  }
  if (!x) s->fatal = HC_NO_MEMORY;
  free(x);
  return balanced;
}

/* Does nothing hold a motion at rest: no contact presses, K singular to rounding (eigenvalues of M^-1 K are good to n
 * units of the largest)? Wherever it rests is a solution, and rounding decides if Newton's matrix is singular. */
static bool floats(solved_scene *s)
{
  const size_t n = (size_t)s->n;
  double *omega2 = malloc(n * sizeof *omega2), *phi = malloc(n * n * sizeof *phi);
  const hc_status st = omega2 && phi ? model_modes(s->model, false, omega2, phi) : HC_NO_MEMORY;
  const bool is_free = st == HC_OK && fabs(omega2[0]) <= s->n * DBL_EPSILON * omega2[n - 1] && balanced_beside(s, phi);
  if (st == HC_NO_MEMORY) s->fatal = st;
  free(omega2);
  free(phi);
  return is_free;
}

/* Beyond the bound after the last guess: why, if there is a reason. Another motion in balance by the original equations
 * is a solution, too; so is one of which a slider never slips and `rests` where another time 0 has it. Where the scene
 * makes more than 1e-3 of rounding, `ratio` times as large in the other's numbers, or loses the solution, nothing is
 * said. */
static stress_check explain(solved_scene *s, hc_status refused, double error, double ratio, bool balanced, bool rests)
{
  stress_condition(s);
  const double errs = ratio * s->solution_errs;
  if (refused == HC_SINGULAR && floats(s)) return stress_explain(STRESS_FAMILY, error, NAN);
  if (error <= errs && errs <= STRESS_SAYS_SOMETHING) return stress_explain(STRESS_ILL_CONDITIONED, error, errs);
  if (error > elsewhere && balanced) return stress_explain(STRESS_OTHER_ORBIT, error, elsewhere);
  if (error > elsewhere && rests) return stress_explain(STRESS_FAMILY, error, elsewhere);
  if (errs > STRESS_SAYS_SOMETHING && (error <= errs || refused != HC_OK)) return stress_skip(STRESS_ILL_CONDITIONED);
  if (refused != HC_OK && errs > elsewhere) return stress_explain(STRESS_ILL_CONDITIONED, error, errs);
  return stress_find(refused == HC_OK && isnan(error) ? STRESS_INTERNAL : STRESS_DISAGREES, error,
                     fmax(ratio * close_enough, errs));
}

/* The check of one way. `company`: its multiplier may be the largest. */
static stress_check hold_way(solved_scene *s, hc_status made, const rewritten *w, bool company)
{
  static const double beside[] = {1e-3, 1e-5, 1e-7};
  const double bound = w->ratio * close_enough;
  stress_check result = stress_skip(STRESS_NO_REASON);
  hc_status refused = HC_OK;
  double error = NAN, *known = made == HC_OK ? guess_of(s, w, &s->base) : NULL;
  bool same = false, agreed = false, balanced = false, rests = false;
  if (!known) s->fatal = HC_NO_MEMORY;
  for (int i = 0; i < 3 && !agreed && s->fatal == HC_OK; ++i) {
    stress_motion other;
    error = found_again(s, w, known, beside[i], &other);
    refused = other.status;
    same = error <= bound;
    if (same) result = company ? stress_agree(error, bound) : same_multiplier(s, &other, error, bound);
    agreed = same && result.outcome == STRESS_AGREED; /* else a copy that is not read may have gone elsewhere */
    if (!same) balanced = refused == HC_OK && stress_imbalance(s, other.x) <= w->ratio * stress_balanced(s);
    if (!same) rests = refused == HC_OK && w->history && other.m.contact.free_sliders > 0;
    stress_motion_free(&other);
  }
  free(known);
  if (refused == HC_INTERRUPTED) return stress_refuse(s, refused);
  return same || s->fatal != HC_OK ? result : explain(s, refused, error, w->ratio, balanced, rests);
}

/* The same, which it clears. */
static stress_check check_way(solved_scene *s, hc_status made, rewritten *w, bool company)
{
  stress_check c = hold_way(s, made, w, company);
  rewritten_clear(w);
  return c;
}

/* ---- the ways ------------------------------------------------------------------------------------------ */

stress_check stress_check_permuted(solved_scene *s)
{
  rewritten w;
  if (s->n == 1) return stress_skip(STRESS_NOT_APPLICABLE);
  return check_way(s, rewritten_permuted(s->model, &s->random, &w), &w, false);
}

stress_check stress_check_rotated(solved_scene *s)
{
  rewritten w;
  if (s->n == 1) return stress_skip(STRESS_NOT_APPLICABLE);
  return check_way(s, rewritten_rotated(s->model, &s->random, &w), &w, false);
}

/* Powers of four change no mantissa and no root's: from nothing, the same to the last bit but for what libraries do.
 * (Where a free body hardly touches anything, that much decides where it goes.) */
stress_check stress_check_units(solved_scene *s)
{
  rewritten w;
  stress_motion binary;
  if ((s->fatal = rewritten_in_units(s->model, 0x1p-10, 0x1p6, 0x1p4, &w)) != HC_OK)
    return stress_skip(STRESS_NO_REASON);
  stress_motion_solve(s, w.model, &s->how, s->omega / w.time, NULL, w.length, &binary);
  rewritten_clear(&w);
  const hc_status st = binary.status;
  const double error = st == HC_OK ? stress_motion_distance(s, binary.x, s->base.x, false) : NAN;
  const bool balanced = st == HC_OK && stress_imbalance(s, binary.x) <= stress_balanced(s);
  stress_motion_free(&binary);
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return stress_refuse(s, st);
  if (!(error <= close_enough)) return explain(s, st, error, 1, balanced, false);
  return check_way(s, rewritten_in_units(s->model, 39.3701, 0.224809, 1.0 / 60, &w), &w, false);
}

stress_check stress_check_split(solved_scene *s)
{
  rewritten w;
  return check_way(s, rewritten_split(s->model, 0.1 + 0.8 * random_unit(&s->random), &w), &w, false);
}

stress_check stress_check_copies(solved_scene *s)
{
  rewritten w;
  return check_way(s, rewritten_copies(s->model, &w), &w, false);
}

stress_check stress_check_bystander(solved_scene *s)
{
  rewritten w;
  return check_way(s, rewritten_bystander(s->model, &s->random, &w), &w, true);
}

/* One limit for both of a contact's tangents does not know which two they are. */
stress_check stress_check_other_tangents(solved_scene *s)
{
  rewritten w;
  if (!model_has_circle(s->model)) return stress_skip(STRESS_NOT_APPLICABLE);
  return check_way(s, rewritten_other_tangents(s->model, &s->random, &w), &w, false);
}

stress_check stress_check_delayed(solved_scene *s)
{
  rewritten w;
  const double delay = random_unit(&s->random) < 0.5 ? PI : TWO_PI * random_unit(&s->random);
  return check_way(s, rewritten_delayed(s->model, delay, &w), &w, false);
}

/* ---- other sizes: the solution, and all that the program says --------------------------------------------- */

static const double most_shift = 1e5, least_beside = 1e-3, most_beside = 1e5, most_stretch = 1e5;

static double between(solved_scene *s, double low, double high)
{
  return low * pow(high / low, random_unit(&s->random));
}

/* [length] Largest |x[n]| of harmonics along d, or, where that is NULL, of any degree of freedom. */
static double vibration(const solved_scene *s, const double *d)
{
  double most = 0;
  for (int c = 1; c < s->n_coef; ++c) {
    const double *x = s->base.x + c * s->n;
    most = fmax(most, d ? fabs(dot_product(s->n, d, x)) : norm_max(s->n, x));
  }
  return most;
}

/* Transients begin at the other's own solution, of as many harmonics as `orbit` needed. */
static stress_check hold_all(solved_scene *s, hc_status made, rewritten *w, bool company)
{
  const bool applies = made != HC_BAD_INPUT && !(w->history && s->base.m.contact.free_sliders > 0);
  stress_check c = stress_skip(applies ? STRESS_NO_ORBIT : STRESS_NOT_APPLICABLE);
  if (applies && s->fine.status == HC_OK) c = hold_way(s, made, w, company);
  if (applies && s->fine.status == HC_OK && s->fatal == HC_OK) {
    hbm_settings how = s->how;
    how.harmonics = s->fine.harmonics;
    stress_motion other = {.status = HC_NO_MEMORY};
    double *guess = guess_of(s, w, &s->fine);
    if (guess) stress_motion_solve(s, w->model, &how, s->omega, guess, w->length, &other);
    else s->fatal = HC_NO_MEMORY;
    if (other.status == HC_OK) c = stress_worse(c, stress_hold_answers(s, w, other.start));
    stress_motion_free(&other);
    free(guess);
  }
  rewritten_clear(w);
  return c;
}

/* [1] Static loads, relative to those that vibrate: what rounding of the model's numbers is multiplied by. */
static double static_share(const model *m)
{
  double rests = 0, vibrates = 0;
  for (int l = 0; l < m->n_loads; ++l) {
    const double size = norm_2(m->n, m->loads[l].cosine) + norm_2(m->n, m->loads[l].sine);
    *(m->loads[l].harmonic == 0 ? &rests : &vibrates) += size;
  }
  return rests / vibrates;
}

/* Without harmonic 0 static loads are left out. */
stress_check stress_check_shifted(solved_scene *s)
{
  rewritten w;
  if (!s->how.keep_mean) return stress_skip(STRESS_NOT_APPLICABLE);
  const double ratio = between(s, 1, most_shift);
  hc_status made = rewritten_shifted(s->model, ratio * vibration(s, NULL), &s->random, &w);
  w.ratio = made == HC_OK ? fmax(ratio, static_share(w.model)) : ratio;
  return hold_all(s, made, &w, false);
}

stress_check stress_check_beside(solved_scene *s)
{
  rewritten w;
  double moves = 0;
  for (int j = 0; j < s->model->n_contacts; ++j)
    moves = fmax(moves, fmax(vibration(s, s->model->contacts[j].tangent), vibration(s, s->model->contacts[j].normal)));
  const rewritten_company kind = (rewritten_company)random_int(&s->random, 0, COMPANY_KINDS - 1);
  moves = (moves > 0 ? moves : 1) * between(s, least_beside, most_beside);
  return hold_all(s, rewritten_beside(s->model, s->omega, moves, kind, &w), &w, true);
}

/* One coordinate so many times as long, and the others. Where coordinates are combined, the longest one's rounding goes
 * into all. */
static stress_check stretched(solved_scene *s, double one, double others)
{
  rewritten w;
  double *by = malloc((size_t)s->n * sizeof *by);
  if (!by) return stress_refuse(s, HC_NO_MEMORY);
  for (int i = 0; i < s->n; ++i) by[i] = others;
  by[random_int(&s->random, 0, s->n - 1)] = one;
  const hc_status made = rewritten_stretched(s->model, by, &w);
  if (s->n > 1) w.ratio = fmax(one / others, others / one);
  free(by);
  return hold_all(s, made, &w, false);
}

stress_check stress_check_stretched(solved_scene *s)
{
  return stretched(s, between(s, 1 / most_stretch, most_stretch), 1);
}
stress_check stress_check_mirrored(solved_scene *s) { return stretched(s, -1, -1); }

/* By whole samples, where forces are sampled: between them they are others. */
stress_check stress_check_turned(solved_scene *s)
{
  rewritten w;
  const int samples = s->asked->hbm.samples, by = random_int(&s->random, 1, samples - 1);
  const double delay = s->asked->hbm.force == HBM_FORCE_SAMPLED ? (double)by / samples : random_unit(&s->random);
  return hold_all(s, rewritten_delayed(s->model, TWO_PI * delay, &w), &w, false);
}
