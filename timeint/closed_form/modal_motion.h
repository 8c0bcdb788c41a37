/* modal_motion.h - a linear motion in closed form, and where it leaves a region. libm only, nothing is allocated.
 *
 * Between two changes of contact state the exact law's motion is that of n modes, each
 *     q'' + c q' + k q = d + Re(f e^{i theta})          c >= 0; k of either sign, or 0
 * with constant c, k, d, f. A contact state is a set of (c, k); for one degree of freedom there is one mode, the
 * oscillator itself. From (q, p) at `theta`, tau later:
 *     (q, p) = E(tau) (q, p) + d (s, s') + Re(f e^{i theta} (r, r'))
 * E the free motion, s and r the responses from rest to 1 and to e^{i tau}. Written from rest, nothing is large where a
 * mode is soft (k near 0) or resonant (k near 1, c near 0).
 *
 * A guard is a linear function of the state plus a constant; transitions are its roots. Between two points it is
 * bounded by its second derivative: with y = q' (or q''), y'' + c y' + k y is at most |f|, so sqrt(y'^2 + |k| y^2)
 * grows by at most |f| a unit of theta (and, where k < 0, by the factor e^(sqrt(-k) h) over h). The search steps only
 * as far as that bound lets the guard stay positive: no root is missed but an excursion below -noise. */
#pragma once

#include <complex.h>
#include <stdbool.h>

/* Of k: below, the response to a constant force is not computed as a difference divided by k. */
#define MODE_SOFT 1e-2

typedef struct mode {
  double c, k;
  double complex response; /* 1/(k - 1 + i c): of the steady state to e^{i theta} */
  bool resonant, soft;     /* |1/response|, |k| so small that dividing by it would lose digits */
  double grows;            /* sqrt(-k) where k < 0, else 0 */
} mode;

mode mode_make(double c, double k);

/* What tau does to a mode. */
typedef struct mode_flow {
  double e[2][2];       /* free motion */
  double s;             /* response from rest to a constant 1; s' = e[0][1] */
  double complex r, dr; /* to e^{i tau} */
} mode_flow;

void mode_advance(const mode *m, double tau, mode_flow *out);

/* From theta on. The arrays are the owner's. */
typedef struct modal_motion {
  int n;             /* modes */
  double theta;      /* [rad] where it begins */
  const mode *mode;  /* [n] */
  double *q, *p;     /* [n] there */
  double *d;         /* [n] */
  double complex *f; /* [n] */
} modal_motion;

/* q, p and the next two derivatives, tau after the beginning. */
typedef struct modal_point {
  double tau;
  double *q, *p, *a, *j; /* [n] j = a' */
} modal_point;

void modal_at(const modal_motion *m, double tau, modal_point *at);

/* g = sum by_q[i] q_i + by_p[i] p_i + constant. NULL: all 0. Below -noise it is negative. */
typedef struct modal_guard {
  const double *by_q, *by_p; /* [n] */
  double constant, noise;
} modal_guard;

/* The first guard to fall through 0 within `span` of the beginning: its number, and in *at the point where it does;
 * -1 if none does, *at is then the point at `span`. A guard that is below -noise at the beginning is there already.
 * *evaluations is increased by the points evaluated. scratch: room for another point. */
int modal_first_crossing(const modal_motion *m, double span, int n_guards, const modal_guard *guards, modal_point *at,
                         modal_point *scratch, long *evaluations);

/* q_i at theta = from + j step, j = 0..count-1, all at or after the beginning. */
void modal_samples(const modal_motion *m, int i, double from, double step, int count, double *samples);

/* Integrals of q_i, q_i cos(theta), q_i sin(theta) between two points of the motion; false where the mode is
 * so soft or resonant that the formulas lose digits. */
bool modal_fourier(const modal_motion *m, int i, const modal_point *from, const modal_point *to, double out[3]);
