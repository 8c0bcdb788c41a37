/* slow_aft.h - the sampled contact force the slow way, for tests: direct sums instead of FFTs, the law written as a
 * clamp, six periods instead of two, no Jacobian. Shares nothing with hbm/contact/aft.c but the definition of what is
 * to be computed. */
#pragma once

#include "tests/hbm/scenes.h"
#include "tests/scene_parts.h"

enum { SLOW_MAX_TIME = 4096, SLOW_PERIODS = 6 };

typedef struct slow_aft {
  double x[SLOW_MAX_TIME], f[SLOW_MAX_TIME];
  uint64_t pattern; /* hash of the states of all contacts at all samples of the first two periods and the last */
  double w[SCENE_MAX_CONTACTS]; /* slider at th = 0 */
  bool never_slips; /* some contact is stuck all through the last period: w depends on where the first one began */
  bool rests;       /* some slider moves by rounding at most all through the last period, slipping or not */
  double moved;     /* largest change of w at th = 0 from the second period to the last */
} slow_aft;

/* T and the new w of one sample; 's' stuck, '+' '-' slipping, '0' separated. */
static inline char slow_clamp(const contact *c, double u, double normal, double *w, double *traction)
{
  if (normal <= 0) {
    *w = u;
    *traction = 0;
    return '0';
  }
  double elastic = c->kt * (u - *w), limit = c->mu * normal;
  *traction = fmin(fmax(elastic, -limit), limit);
  if (*traction == elastic) return 's';
  *w = u - *traction / c->kt;
  return *traction > 0 ? '+' : '-';
}

static inline void slow_contact(slow_aft *a, const scene *sc, int j, int n_time)
{
  const contact *c = &sc->structure->contacts[j].given.law;
  double co, si, w = 0, second = 0, low = INFINITY, high = -INFINITY, size = 0;
  scene_direction(&sc->structure->contacts[j].given, &co, &si);
  bool stuck = true;
  char before = c->kn * (si * a->x[n_time - 1] + c->gap) > 0 ? 's' : '0';
  for (int period = 0; period < SLOW_PERIODS; ++period)
    for (int i = 0; i < n_time; ++i) {
      double x = a->x[i], x_before = a->x[i ? i - 1 : n_time - 1], traction,
             normal = fmax(c->kn * (si * x + c->gap), 0);
      if (before == '0' && normal > 0) { /* w = u where the straight line between the samples touches, or at the last
                                            separated sample */
        double part = sc->hbm.restart == HBM_RESTART_SAMPLE ? 0 : (-c->gap - si * x_before) / (si * x - si * x_before);
        w = co * (x_before + part * (x - x_before));
      }
      before = slow_clamp(c, co * x, normal, &w, &traction);
      if (period < 2 || period == SLOW_PERIODS - 1) a->pattern = (a->pattern ^ (uint64_t)before) * 1099511628211u;
      if (period == 1 && i == 0) second = w;
      if (period < SLOW_PERIODS - 1) continue;
      stuck &= before == 's';
      low = fmin(low, w), high = fmax(high, w), size = fmax(size, fabs(x));
      if (i == 0) {
        a->w[j] = w;
        a->moved = larger(a->moved, fabs(w - second));
      }
      a->f[i] += co * traction + si * (normal - fmax(c->kn * c->gap, 0));
    }
  a->never_slips |= stuck;
  a->rests |= high - low <= 1e-12 * size;
}

/* F[2H+1] of the motion X[2H+1]. */
static inline void slow_force(slow_aft *a, const scene *sc, int n_harm, int n_time, const double *X, double *F)
{
  a->pattern = 14695981039346656037u;
  a->moved = 0;
  a->never_slips = a->rests = false;
  assert_true(n_time <= SLOW_MAX_TIME);
  for (int i = 0; i < n_time; ++i) {
    a->x[i] = X[0];
    for (int h = 1; h <= n_harm; ++h) {
      double th = 2 * PI * (((long)h * i) % n_time) / n_time;
      a->x[i] += X[2 * h - 1] * cos(th) + X[2 * h] * sin(th);
    }
    a->f[i] = 0;
  }
  for (int j = 0; j < sc->structure->n_contacts; ++j) slow_contact(a, sc, j, n_time);
  for (int h = 0; h <= n_harm; ++h) {
    long double re = 0, im = 0;
    for (int i = 0; i < n_time; ++i) {
      double th = 2 * PI * (((long)h * i) % n_time) / n_time;
      re += a->f[i] * cos(th);
      im += a->f[i] * sin(th);
    }
    F[h ? 2 * h - 1 : 0] = (double)((h ? 2 : 1) * re / n_time);
    if (h) F[2 * h] = (double)(2 * im / n_time);
  }
}

/* Largest |dF/dx| any sample can see of contact j: T moves with u and, slipping, with mu N; a slider remembers as
 * much once more. */
static inline double slow_stiffness(const scene_contact *c)
{
  double co, si;
  scene_direction(c, &co, &si);
  return 2 * co * (c->law.kt * co + c->law.mu * c->law.kn * si) + c->law.kn * si * si;
}

/* How far two right ways to compute F may lie apart. A sample x_i is good to (2H + 1 terms, angles to an eps each;
 * FFT: log2 N stages) (2H + 3) eps sum |X|, both ways together twice that, and 2 log2 N eps sum |X|; clamps do not
 * enlarge it, the force does by its stiffness K; gap adds an eps of itself. The transform back is another log2 N
 * stages of sizes |f| <= K (sum |X| + |gap|), times 2 for 2/N. */
static inline double slow_tolerance(const scene *sc, int n_harm, int n_time, const double *X)
{
  double tolerance = 0, size = sum_abs(2 * n_harm + 1, X), stages = log2(n_time);
  for (int j = 0; j < sc->structure->n_contacts; ++j)
    tolerance += slow_stiffness(&sc->structure->contacts[j].given) * (4 * n_harm + 6 + 2 * stages + 2 * stages) *
                 (size + fabs(sc->structure->contacts[j].given.law.gap));
  return 2 * DBL_EPSILON * tolerance;
}

/* n_contacts random contacts for motions of size about 1, at every angle. */
static inline scene random_contacts(uint64_t *seed, int n_contacts)
{
  scene sc = scene_oscillator(1, 0, 1, 0);
  for (int j = 0; j < n_contacts; ++j) {
    const contact law = random_law(seed);
    scene_add_contact(&sc, (scene_contact){.law = law, .angle_deg = random_angle(seed)});
  }
  return sc;
}
