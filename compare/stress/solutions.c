/* solutions.c - the HBM solution against closed forms, samples, and its response curve. */
#include <complex.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/stress/solved_scene.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

/* ---- closed forms ------------------------------------------------------------------------------------------ */

/* x = Re sum_h z_h exp(i h omega t),   (K - (h omega)^2 M + i h omega C) z_h = p_h - i q_h
 *
 * Near a resonance the terms of the matrix cancel: rounding of each (and the tolerance of a residual that is judged
 * against them) makes up to |A^-1| |A| |z| of z (Skeel). */
typedef struct linear_motion {
  double *x;    /* [n_coef][n] */
  double bound; /* [1] what a rounding unit of each entry makes of the largest x, relative; INFINITY: singular */
} linear_motion;

/* z_h := the response to z_h, the load of harmonic h; *error: Skeel's sum of the largest entry. */
static hc_status respond(const model *m, double w, double complex *z, double *error)
{
  const int n = m->n;
  const size_t entries = (size_t)n * (size_t)n;
  double complex *A = malloc(entries * sizeof *A), *lu = malloc(entries * sizeof *lu),
                 *one = malloc(entries * sizeof *one);
  double *sizes = calloc((size_t)n, sizeof *sizes);
  int *pivot = malloc((size_t)n * sizeof *pivot);
  hc_status st = A && lu && one && sizes && pivot ? HC_OK : HC_NO_MEMORY;
  for (size_t i = 0; i < entries && st == HC_OK; ++i) {
    lu[i] = A[i] = m->stiffness[i] - w * w * m->mass[i] + I * w * m->damping[i];
    one[i] = i % (size_t)(n + 1) == 0;
    A[i] = fabs(m->stiffness[i]) + w * w * fabs(m->mass[i]) + fabs(w * m->damping[i]);
  }
  if (st == HC_OK) st = dense_factor_complex(n, lu, pivot);
  if (st == HC_OK) {
    dense_solve_complex(n, lu, pivot, false, 1, z);
    dense_solve_complex(n, lu, pivot, false, n, one);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) sizes[i] += creal(A[j * n + i]) * cabs(z[j]);
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += cabs(one[j * n + i]) * sizes[j];
      *error = fmax(*error, sum);
    }
  }
  free(A), free(lu), free(one), free(sizes), free(pivot);
  return st;
}

/* The steady state of m without its contacts. x is to be freed. Rounding moves the mean, too, as far as K lets it: a
 * structure that nothing holds has no one orbit. */
static hc_status linear_steady(const solved_scene *s, const model *m, linear_motion *out)
{
  const int n = s->n;
  double error = 0, size = 0;
  double complex *z = malloc((size_t)n * sizeof *z), *held = calloc((size_t)n, sizeof *held);
  *out = (linear_motion){.x = calloc((size_t)n * (size_t)s->n_coef, sizeof(double))};
  hc_status st = z && held && out->x ? HC_OK : HC_NO_MEMORY;
  for (int l = 0; l < m->n_loads && st == HC_OK; ++l) {
    const int h = m->loads[l].harmonic;
    if (h == 0 && !s->how.keep_mean) continue;
    for (int i = 0; i < n; ++i) z[i] = m->loads[l].cosine[i] - I * m->loads[l].sine[i];
    st = respond(m, h * s->omega, z, &error);
    for (int i = 0; i < n && st == HC_OK; ++i) {
      out->x[(h ? 2 * h - 1 : 0) * n + i] = creal(z[i]);
      if (h) out->x[2 * h * n + i] = -cimag(z[i]);
      size = fmax(size, cabs(z[i]));
      for (int j = 0; j < n; ++j) held[j] += m->stiffness[i * n + j] * z[i]; /* K times the sum of all motions */
    }
  }
  if (st == HC_OK) st = respond(m, 0, held, &error);
  free(z), free(held);
  if (st == HC_SINGULAR) out->bound = INFINITY, st = HC_OK;
  else if (size > 0) out->bound = DBL_EPSILON * error / size;
  return st;
}

/* The largest |d . x(t)|, or more. */
static double reach(const solved_scene *s, const double *d, const double *x)
{
  double sum = 0;
  for (int c = 0; c < s->n_coef; ++c) {
    double part = 0;
    for (int i = 0; i < s->n; ++i) part += d[i] * x[c * s->n + i];
    sum += fabs(part);
  }
  return sum;
}

/* HBM by Newton from 1.4 times the solution, and the orbit next to it, against the closed form. The mean of a stuck
 * contact's motion depends on where its slider rests: HBM's is left out. Of smooth laws, which have no closed form, HBM
 * alone. */
static stress_check hold_linear(solved_scene *s, const model *m, const linear_motion *exact, bool means_out)
{
  /* a Newton step of a linear equation, its LU, and the force as a sum of 2H+1 terms: some units of rounding each */
  const double bound = 50 * s->n_coef * s->n * exact->bound;
  const int length = s->n * s->n_coef;
  hbm_settings how = s->how;
  stress_motion hbm;
  stress_path path;
  double multiplier = INFINITY; /* of the linear motion; a table's springs that never close may leave it a negative
                                   stiffness, and none that is finite */
  double *guess = malloc((size_t)length * sizeof *guess);
  double *start = calloc(2 * (size_t)m->n + (size_t)m->n_contacts, sizeof *start);
  stress_check c = stress_skip(STRESS_NO_REASON);
  if (!guess || !start) s->fatal = HC_NO_MEMORY;
  if (s->fatal == HC_OK) {
    for (int i = 0; i < length; ++i) guess[i] = 1.4 * exact->x[i];
    how.skip_linear = false; /* or the closed form would be held against itself */
    stress_motion_solve(s, m, &how, s->omega, guess, 1, &hbm);
    c = hbm.status != HC_OK ? stress_refuse(s, hbm.status)
                            : stress_agree(stress_motion_distance(s, hbm.x, exact->x, means_out), bound);
    if (hbm.stability_status == HC_OK) multiplier = hbm.stability.multiplier;
    stress_motion_free(&hbm);
  }
  /* An unstable one's rounding grows over the period, and may leave it for another orbit. */
  const double lost = bound * fmax(1, multiplier);
  if (s->fatal == HC_OK && c.outcome == STRESS_AGREED && !model_is_smooth(m) && lost < STRESS_SAYS_SOMETHING) {
    /* Where the motion starts, its sliders at 0. */
    for (int i = 0; i < s->n; ++i) {
      start[i] = exact->x[i];
      for (int h = 1; 2 * h < s->n_coef; ++h) {
        start[i] += exact->x[(2 * h - 1) * s->n + i];
        start[s->n + i] += h * s->omega * exact->x[2 * h * s->n + i];
      }
    }
    stress_path_of(s, m, start, &path);
    const double grown = fmax(3 * path.errors, lost); /* undamped, no period map has one orbit */
    if (path.status == HC_OK)
      c = stress_worse(c, stress_agree_within(stress_path_off(s, s->n_coef, exact->x, &path), bound, grown));
    stress_path_free(&path);
  }
  free(guess), free(start);
  return c;
}

/* The model with other contacts, against the closed form of K with the springs of those that stick. */
static stress_check check_contacts(solved_scene *s, bool stuck)
{
  const double solvable = 1e-10;
  model *m = NULL, *linear = NULL;
  linear_motion exact = {.x = NULL};
  hc_status st = model_copy(s->model, &m);
  for (int l = 0; st == HC_OK && l < m->n_loads && !s->how.keep_mean; ++l)
    for (int i = 0; i < s->n && m->loads[l].harmonic == 0; ++i) m->loads[l].cosine[i] = 0; /* not in HBM's equations */
  if (st == HC_OK) st = model_copy(m, &linear);
  for (int j = 0; st == HC_OK && j < m->n_contacts && stuck; ++j) {
    contact *law = &m->contacts[j].law;
    law->mu = fmax(law->mu, 1);
    if (law->kt > 0) add_outer(s->n, law->kt, m->contacts[j].tangent, m->contacts[j].tangent, linear->stiffness);
    if (law->kn > 0) add_outer(s->n, law->kn, m->contacts[j].normal, m->contacts[j].normal, linear->stiffness);
  }
  if (st == HC_OK) st = linear_steady(s, linear, &exact);
  stress_check c = st == HC_OK ? stress_skip(STRESS_NOT_APPLICABLE) : stress_refuse(s, st);
  double moves = 0;
  for (int i = 0; i < s->n * s->n_coef && st == HC_OK; ++i) moves = fmax(moves, fabs(exact.x[i]));
  /* Contact j of m so that the motion x, whose largest entry is `moves`, never closes it, or never slips nor opens. */
  bool sticks = true; /* could */
  for (int j = 0; exact.x && moves > 0 && j < m->n_contacts; ++j) {
    model_contact *of = &m->contacts[j];
    contact *law = &of->law;
    memset(law->power, 0, sizeof law->power);
    sticks = sticks && law->smooth != CONTACT_TANH;
    if (law->smooth == CONTACT_POLYNOMIAL) continue;
    const double v = reach(s, of->normal, exact.x);
    const double u =
        reach(s, of->tangent, exact.x) + (of->pair == CONTACT_FIRST ? reach(s, of[1].tangent, exact.x) : 0);
    if (of->pair == CONTACT_SECOND) *law = of[-1].law; /* one law for both */
    else if (!stuck) law->gap = -3 * (v + 1e-3 * moves), law->load = 0;
    else if (law->kn > 0) law->gap = 10 * (v + moves + law->kt * u / (law->mu * law->kn));
    else law->load = 10 * law->kt * (u + moves) / law->mu;
  }
  if (exact.x && moves > 0 && (sticks || !stuck) && exact.bound < solvable && moves < 1e150)
    c = hold_linear(s, m, &exact, stuck);
  free(exact.x);
  model_free(m);
  model_free(linear);
  return c;
}

stress_check stress_check_free(solved_scene *s) { return check_contacts(s, false); }
stress_check stress_check_stuck(solved_scene *s) { return check_contacts(s, true); }

/* ---- samples ----------------------------------------------------------------------------------------------- */

static const double near = 1e-6;

/* The solution with N samples is in balance with each contact's law stepped through the same instants, and with the
 * exact forces but for what such steps may do. Sliders in the plane are stepped until 5e-8 of where they are is left to
 * go, if each period moves them by a constant factor less; by one that grows they have up to twice that to go. */
static stress_check hold_samples(solved_scene *s, const double *x, int N)
{
  bool circle = false;
  for (int j = 0; j < s->model->n_contacts; ++j) circle = circle || s->model->contacts[j].circle;
  double bound;
  const double allowed = circle ? 1e-7 : stress_balanced(s), off = stress_imbalance_sampled(s, x, N, &bound);
  if (isnan(off)) return circle ? stress_skip(STRESS_NOT_APPLICABLE) : stress_find(STRESS_INTERNAL, off, allowed);
  if (!(off <= allowed)) return stress_find(STRESS_DISAGREES, off, allowed);
  return stress_agree(stress_imbalance(s, x), bound + allowed);
}

/* Sliders that never slip rest where they like. */
static double off_base(const solved_scene *s, const double *x)
{
  return stress_motion_distance(s, x, s->base.x, s->base.m.contact.free_sliders > 0);
}

/* Beyond the bound with the most samples: all of it is the samples' where each solution is in balance with its own
 * forces, these differ by no more than they must, and Newton on the exact forces leads from the one to the other. */
static stress_check explain_samples(solved_scene *s, const double *x, double error)
{
  stress_motion exact;
  stress_motion_solve(s, s->model, &s->how, s->omega, x, 1, &exact);
  const bool solved = exact.status == HC_OK, same = solved && off_base(s, exact.x) <= near;
  const bool balanced = solved && stress_imbalance(s, exact.x) <= stress_balanced(s);
  stress_motion_free(&exact);
  if (same) return stress_explain(STRESS_ALIASED, error, near);
  stress_condition(s);
  if (error <= s->solution_errs) return stress_agree_within(error, near, s->solution_errs);
  return balanced ? stress_explain(STRESS_OTHER_ORBIT, error, near) : stress_find(STRESS_DISAGREES, error, near);
}

/* With ever more samples, until the solution is the exact one to 1e-6. */
stress_check stress_check_sampled(solved_scene *s)
{
  enum { LEAST = 256, MOST = 32768 };
  hbm_settings how = s->how;
  hc_status failed = HC_OK;
  stress_check result = stress_skip(STRESS_NO_REASON);
  if (s->base.m.contact.regime == CONTACT_LINEAR) return stress_skip(STRESS_NOT_APPLICABLE);
  how.force = HBM_FORCE_SAMPLED;
  how.restart = HBM_RESTART_INTERPOLATED;
  for (how.samples = LEAST + 2 * how.harmonics; how.samples <= MOST && s->fatal == HC_OK; how.samples *= 4) {
    stress_motion sampled;
    bool done = false;
    stress_motion_solve(s, s->model, &how, s->omega, s->base.x, 1, &sampled);
    if (sampled.status != HC_OK) failed = sampled.status;
    else {
      const double error = off_base(s, sampled.x);
      result = hold_samples(s, sampled.x, how.samples);
      done = result.outcome == STRESS_FINDING || error <= near;
      if (result.outcome != STRESS_FINDING && error <= near) result = stress_agree(error, near);
      else if (result.outcome != STRESS_FINDING && 4 * how.samples > MOST)
        result = explain_samples(s, sampled.x, error);
    }
    stress_motion_free(&sampled);
    if (done) return result;
  }
  return result.outcome == STRESS_EXPLAINED || failed == HC_OK ? result : stress_refuse(s, failed);
}

/* ---- the curve ------------------------------------------------------------------------------------------ */

/* The solutions found at omega: each in balance; *nearest is the least distance to the one that is known. */
static stress_check hold_found(solved_scene *s, hbm_solver *h, const hbm_curve *found, double *nearest)
{
  double worst = 0, *x = malloc((size_t)s->n * (size_t)s->n_coef * sizeof *x);
  hc_status st = x ? HC_OK : HC_NO_MEMORY;
  *nearest = INFINITY;
  for (int k = 0; k < found->n && st == HC_OK; ++k) {
    hbm_stability stability;
    st = stress_motion_read(s, h, s->omega, hbm_curve_X(found, k), s->n_coef, x);
    if (st != HC_OK) break;
    const double off = stress_imbalance(s, x);
    worst = larger(worst, off);
    *nearest = fmin(*nearest, off_base(s, x));
    st = hbm_stability_at(h, s->omega, hbm_curve_X(found, k), &stability);
    if (st == HC_OK && !(stability.multiplier >= 0)) worst = NAN;
  }
  free(x);
  return st == HC_OK ? stress_agree(worst, stress_balanced(s)) : stress_refuse(s, st);
}

/* Another solution than the known one is no mistake where both are in balance: the curve is another branch. */
stress_check stress_check_curve(solved_scene *s)
{
  hbm_solver *h = NULL;
  hbm_curve curve = {0}, found = {0};
  stress_check result;
  double nearest = INFINITY;
  hc_status st = hbm_solver_new(s->model, &s->how, &h);
  if (st == HC_OK) st = hbm_trace(h, s->from, s->to, &s->monitor, &curve);
  if (st == HC_OK) st = hbm_curve_at(h, &curve, s->omega, &found);
  if (st != HC_OK) result = stress_refuse(s, st);
  else result = hold_found(s, h, &found, &nearest);
  const bool good = result.outcome == STRESS_AGREED;
  if (good && found.n == 0 && !curve.left_at_start) result = stress_find(STRESS_DISAGREES, NAN, near);
  else if (good && !(nearest <= near)) result = stress_explain(STRESS_OTHER_ORBIT, nearest, near);
  hbm_curve_free(&found);
  hbm_curve_free(&curve);
  hbm_solver_free(h);
  return result;
}
