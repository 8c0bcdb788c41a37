/* modal_motion.h - one mode's motion in closed form, and where it leaves a region. libm only, nothing is allocated.
 *
 *     q'' + c q' + k q = d + Re(f e^{i theta})          c >= 0; k of either sign, or 0
 * with constant c, k, d, f. From (q, p) at `theta`, tau later:
 *     (q, p) = E(tau) (q, p) + d (s, s') + Re(f e^{i theta} (r, r'))
 * E: free motion; s, r: responses from rest to 1 and to e^{i tau}. Responses from rest stay small where a mode is soft
 * (k near 0) or resonant (k near 1, c near 0).
 *
 * A guard is a linear function of the state plus a constant; transitions are its roots. Between two points it is
 * bounded by its second derivative: with y = q' (or q''), y'' + c y' + k y is at most |f|, so sqrt(y'^2 + |k| y^2)
 * grows by at most |f| a unit of theta (and, where k < 0, by the factor e^(sqrt(-k) h) over h). The search steps only
 * as far as that bound lets the guard stay positive: no root is missed but an excursion below -noise. */
#pragma once

#include <complex.h>
#include <stdbool.h>

/* |k| below which the response to a constant force is not computed as a difference over k. */
#define MODE_SOFT 1e-2

typedef struct mode {
  double c, k;
  double complex response; /* 1/(k - 1 + i c): steady response to e^{i theta} */
  bool resonant, soft;     /* |1/response|, |k| so small that dividing by it would lose digits */
  double grows;            /* sqrt(-k) where k < 0, else 0 */
} mode;

mode mode_make(double c, double k);

/* The responses of a mode after tau. */
typedef struct mode_flow {
  double e[2][2];       /* free motion */
  double s;             /* response from rest to a constant 1; s' = e[0][1] */
  double complex r, dr; /* response from rest to e^{i tau}, and its rate */
} mode_flow;

typedef struct modal_motion {
  mode mode;
  double theta;   /* [rad] start of the motion */
  double q, p, d; /* state q, p at the start; constant force d */
  double complex f;
} modal_motion;

/* The motion at tau after its start; a = p', j = a'. */
typedef struct modal_point {
  double tau, q, p, a, j;
} modal_point;

modal_point modal_at(const modal_motion *m, double tau);

/* g = by_q q + by_p p + constant. Below -noise it is negative. */
typedef struct modal_guard {
  double by_q, by_p, constant, noise;
} modal_guard;

/* Index of the first guard that falls through 0 within `span` of the start, *at: the point where it does; -1 if none
 * does, *at is then the point at `span`. A guard below -noise at the start counts as falling there. *evaluations is
 * increased by the number of points evaluated. */
int modal_first_crossing(const modal_motion *m, double span, int n_guards, const modal_guard *guards, modal_point *at,
                         long *evaluations);

/* q at theta = from + j step, j = 0..count-1, all at or after the beginning. */
void modal_samples(const modal_motion *m, double from, double step, int count, double *samples);

/* Integrals of q, q cos(theta), q sin(theta) between two points of the motion; false where the mode is so soft or
 * resonant that the formulas lose digits. */
bool modal_fourier(const modal_motion *m, const modal_point *from, const modal_point *to, double out[3]);
