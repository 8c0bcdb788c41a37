/* scenes.h - what the tests of hbm/ share: the reference scenes with settings, the reference numbers of
 * tests/reference/, and random motions. */
#pragma once

#include <float.h>

#include "model/casefile/scene.h"
#include "numerics/random.h"
#include "tests/oscillator.h"
#include "tests/reference_scenes.h"
#include "tests/reference_table.h"

/* A scene by its name, sampled with n_time samples, slider restart interpolated, continuation auto, tolerance 1e-10. */
static inline scene scene_named(const char *name, int n_harm, bool keep_mean, int n_time)
{
  const reference_scene *r = reference_scene_named(name);
  scene sc = scene_oscillator(r->mass, r->damping, r->stiffness, r->force);
  sc.omega_from = r->omega_from, sc.omega_to = r->omega_to;
  scene_add_contact(
      &sc, (scene_contact){{.kt = r->kt, .kn = r->kn, .mu = REFERENCE_FRICTION, .gap = r->gap}, REFERENCE_ANGLE});
  sc.hbm = (hbm_settings){.harmonics = n_harm,
                          .keep_mean = keep_mean,
                          .force = HBM_FORCE_SAMPLED,
                          .samples = n_time,
                          .restart = HBM_RESTART_INTERPOLATED,
                          .continuation = HBM_CONTINUATION_AUTO,
                          .tolerance = 1e-10};
  return sc;
}

/* Likewise with exact forces. */
static inline scene exact_scene(const char *name, int n_harm, bool keep_mean)
{
  scene sc = scene_named(name, n_harm, keep_mean, 1024);
  sc.hbm.force = HBM_FORCE_EXACT;
  return sc;
}

/* As exact_scene, the exact law, too, solved as far as rounding lets: what is left is what a test is about. */
static inline scene exact_reference_scene(const char *name, int n_harm)
{
  scene sc = exact_scene(name, n_harm, true);
  sc.hbm.tolerance = 1e-12;
  sc.hbm.skip_linear = true;
  sc.transient = (transient_settings){
      .law = TRANSIENT_LAW_EXACT, .regularisation = 1e-4, .tolerance = 1e-10, .max_periods = 20000};
  return sc;
}

/* A row of hbm_exact.csv. */
typedef struct reference_row {
  char name[16];
  int n_harm, keep_mean, branch;
  double omega, amplitude, max, min, harmonic_1, mean;
} reference_row;

/* A row of hbm_peak.csv. */
typedef struct reference_peak {
  char name[16];
  int n_harm, keep_mean;
  double omega, amplitude, harmonic_1;
} reference_peak;

enum { MAX_REFERENCE = 1000 };

static inline bool parse_reference_row(const char *line, void *row)
{
  reference_row *r = row;
  return sscanf(line, "%15[^,],%d,%d,%d,%lf,%lf,%lf,%lf,%lf,%lf", r->name, &r->n_harm, &r->keep_mean, &r->branch,
                &r->omega, &r->amplitude, &r->max, &r->min, &r->harmonic_1, &r->mean) == 10;
}

/* All rows of hbm_exact.csv into row[MAX_REFERENCE]; how many. */
static inline int read_reference_rows(reference_row *row)
{
  return read_reference("hbm_exact.csv", "case,harmonics,static,branch,omega,amplitude,max,min,harmonic_1,mean",
                        parse_reference_row, MAX_REFERENCE, sizeof *row, row);
}

static inline bool parse_reference_peak(const char *line, void *row)
{
  reference_peak *r = row;
  return sscanf(line, "%15[^,],%d,%d,%lf,%lf,%lf", r->name, &r->n_harm, &r->keep_mean, &r->omega, &r->amplitude,
                &r->harmonic_1) == 6;
}

static inline int read_reference_peaks(reference_peak *row)
{
  return read_reference("hbm_peak.csv", "case,harmonics,static,omega_at_peak,peak_amplitude,harmonic_1_at_peak",
                        parse_reference_peak, MAX_REFERENCE, sizeof *row, row);
}

/* Stiffnesses over three decades, preloads and clearances, now and then no friction or no tangential spring. */
static inline contact random_law(uint64_t *seed)
{
  const double pick = random_signed(seed);
  contact law = {.kt = pow(10, 1.5 * random_signed(seed))};
  law.kn = pow(10, 1.5 * random_signed(seed));
  law.mu = 0.5 + 0.5 * random_signed(seed);
  law.gap = random_signed(seed);
  if (pick < -0.9) law.mu = 0;
  if (pick > 0.9) law.kt = 0;
  return law;
}

static inline double random_angle(uint64_t *seed)
{
  static const double angles[] = {0, 30, 45, 90, 80, 5};
  return angles[(int)(2.999999 * (1 + random_signed(seed)))];
}

/* A random motion X[2H+1] of size about `size`, harmonics decaying like 1/h^decay. */
static inline void random_motion(uint64_t *seed, int n_harm, double size, double decay, double *X)
{
  X[0] = 0.3 * size * random_signed(seed);
  for (int h = 1; h <= n_harm; ++h)
    for (int i = 2 * h - 1; i <= 2 * h; ++i) X[i] = size * random_signed(seed) / pow(h, decay);
}

/* X -> the motion x(th + shift). */
static inline void shift_motion(int n_harm, const double *X, double shift, double *Y)
{
  Y[0] = X[0];
  for (int h = 1; h <= n_harm; ++h) {
    double c = cos(h * shift), s = sin(h * shift);
    Y[2 * h - 1] = X[2 * h - 1] * c + X[2 * h] * s;
    Y[2 * h] = X[2 * h] * c - X[2 * h - 1] * s;
  }
}

static inline double sum_abs(int n, const double *v)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += fabs(v[i]);
  return sum;
}
