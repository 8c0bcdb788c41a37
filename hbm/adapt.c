/* adapt.c - hbm.harmonics: auto and hbm.samples: auto. Harmonics change along the curve, as far as the last point
 * needs. Samples do not: sampled equations of another N turn elsewhere, so a curve that needs more starts again with
 * twice as many. */
#include <math.h>
#include <string.h>

#include "hbm/path.h"
#include "numerics/series.h"

enum { EASY_POINTS = 4 };

/* Solve the last point again with the equations as they are now, across its own tangent. */
static hc_status redo_last(path *p)
{
  hbm_curve *c = p->curve;
  hbm_point *tip = &c->points[c->n - 1];
  double *X = hbm_curve_X(c, c->n - 1), *dX = hbm_curve_dX(c, c->n - 1);
  size_t bytes = (size_t)c->n_coef * sizeof(double);
  hbm_trim(p->s, c->n_coef, X);
  hbm_trim(p->s, c->n_coef, dX);
  memcpy(p->X, X, bytes);
  memcpy(p->dX, dX, bytes);
  p->omega = tip->omega;
  p->d_omega = tip->d_omega;
  bool end = c->n == 1 || tip->omega == p->to || tip->omega == p->from; /* ends of the sweep stay where they are */
  hc_status st = end ? hbm_solve_fixed(p->s, p->omega, path_size(p), p->X, &p->point) : path_correct_in_plane(p);
  if (end && st == HC_OK) {
    st = hbm_tangent_fixed(p->s, p->X, p->dX);
    p->d_omega = 1;
    p->sign = newton_sign(p->s->fixed);
  }
  c->iterations += p->point.iterations;
  if (st != HC_OK) return st;
  /* The sense of the curve is the same for coarser and finer equations (a further harmonic adds a block of positive
   * determinant): it tells forward, where the old tangent may have followed a fold that only the coarse equations
   * have. */
  if (p->sign != p->sense) {
    for (int i = 0; i < c->n_coef; ++i) p->dX[i] = -p->dX[i];
    p->d_omega = -p->d_omega;
  }
  if (c->n > 1) tip->branch = tip[-1].branch + ((tip[-1].d_omega > 0) != (p->d_omega > 0));
  c->turning_points = tip->branch;
  memcpy(X, p->X, bytes);
  memcpy(dX, p->dX, bytes);
  tip->omega = p->omega;
  tip->d_omega = p->d_omega;
  tip->residual = p->point.residual;
  tip->harmonics = p->s->sys.n_harm;
  tip->iterations += p->point.iterations;
  p->fresh = true;
  return HC_OK;
}

/* The same, going back to earlier points as long as the finer equations have no solution near the last: a fold of
 * the coarse ones alone. */
static hc_status redo_back(path *p)
{
  hc_status st = redo_last(p);
  while (st != HC_OK && st != HC_NO_MEMORY && p->curve->n > 1) {
    --p->curve->n;
    if (p->left >= p->curve->n) p->left = 0;
    p->h *= 0.5;
    st = redo_last(p);
  }
  return st;
}

/* Size of what X has in the harmonics that the next lower rung of the ladder would drop, relative to X. */
static double tail(const path *p, const double *X)
{
  int n = p->s->sys.n_coef, kept = series_length(refine_next_harmonics(p->s->sys.n_harm, false));
  return hbm_norm(n - kept, X + kept) / path_size(p);
}

/* hbm.harmonics: auto and hbm.samples: auto. As many as the last point needs, estimated there; HC_OK once
 * hbm.accuracy is met or no finer equations are to be had. Fewer again after EASY_POINTS in a row whose dropped
 * harmonics would not show. */
hc_status path_adapt(path *p)
{
  hbm_solver *s = p->s;
  hbm_curve *c = p->curve;
  const hbm_settings *asked = &s->how;
  hc_status st = HC_OK;
  while (st == HC_OK && (s->finer_harmonics || s->finer_samples)) {
    hbm_point *tip = &c->points[c->n - 1];
    const double *X = hbm_curve_X(c, c->n - 1);
    double by_harmonics = s->finer_harmonics ? refinement_error(s->finer_harmonics, tip->omega, s->sys.n_harm, X) : 0;
    double by_samples = s->finer_samples ? refinement_error(s->finer_samples, tip->omega, s->sys.n_harm, X) : 0;
    tip->error = fmax(by_harmonics, by_samples);
    int n_harm = by_harmonics > asked->accuracy ? refine_next_harmonics(s->sys.n_harm, true) : s->sys.n_harm;
    bool sparse = s->finer_samples && (by_samples > asked->accuracy || s->n_time < 4 * n_harm);
    if (sparse && s->n_time < REFINE_MOST_SAMPLES) {
      p->more_samples = true;
      return HC_OK;
    }
    if (n_harm == s->sys.n_harm) {
      c->inaccurate |= tip->error > asked->accuracy;
      break;
    }
    if ((st = hbm_solver_resize(s, n_harm, s->n_time)) == HC_OK) st = redo_back(p);
    p->easy = 0;
  }
  bool easy = st == HC_OK && s->finer_harmonics && s->sys.n_harm > 1 &&
              tail(p, hbm_curve_X(c, c->n - 1)) < 0.05 * asked->accuracy;
  p->easy = easy ? p->easy + 1 : 0;
  if (p->easy < EASY_POINTS) return st;
  int before = s->sys.n_harm;
  p->easy = 0;
  if ((st = hbm_solver_resize(s, refine_next_harmonics(before, false), s->n_time)) == HC_OK) st = redo_back(p);
  if (st == HC_OK) st = path_adapt(p); /* measured, and taken back if it was too much */
  if (s->sys.n_harm >= before) p->easy = -4 * EASY_POINTS;
  return st;
}

hc_status path_compact(hbm_solver *s, hbm_curve *c)
{
  int most = 1, before = c->n_coef;
  for (int k = 0; k < c->n; ++k) most = c->points[k].harmonics > most ? c->points[k].harmonics : most;
  int n = series_length(most);
  for (int k = 0; k < c->n; ++k) {
    memmove(c->X + (size_t)k * n, c->X + (size_t)k * before, (size_t)n * sizeof(double));
    memmove(c->dX + (size_t)k * n, c->dX + (size_t)k * before, (size_t)n * sizeof(double));
  }
  c->n_coef = n;
  return most == s->sys.n_harm ? HC_OK : hbm_solver_resize(s, most, s->n_time);
}
