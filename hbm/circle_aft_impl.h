/* circle_aft_impl.h - the parts of a circle_aft, for circle_aft.c and circle_aft_jacobian.c. */
#ifndef HC_HBM_CIRCLE_AFT_IMPL_H
#define HC_HBM_CIRCLE_AFT_IMPL_H

#include "hbm/circle_aft.h"
#include "hbm/circle_slider.h"
#include "hbm/fft_plan.h"

enum { CIRCLE_PLAIN_PASSES = 4 /* periods dragged before any is guessed */ };

/* How the orbit of the last evaluation came about: what its slider depends on. */
typedef enum circle_orbit {
  CIRCLE_CLOSED,  /* it slips or separates: the one closed orbit there is */
  CIRCLE_DRAGGED, /* stuck, where `passes` periods from w = 0 have left it */
  CIRCLE_GUESSED, /* stuck, where `passes` or more have, some of them guessed; `last` is where one began that slipped */
  CIRCLE_ONE_PASS /* one period from w = 0, whether it closes or not */
} circle_orbit;

struct circle_aft {
  int n_dof, n_harm, n_time;
  hbm_restart restart;
  contact law;          /* of a half */
  double *motion[3];    /* [n_time] u_1, u_2 and r (circle_slider.h), of a constant normal force the same everywhere */
  double *traction[2];  /* [n_time] [force] */
  double *sample;       /* [n_time] what is transformed */
  fftw_complex *spec;   /* [n_time/2+1] consumed by to_time (c2r overwrites its input) */
  fftw_plan to_time;    /* spec -> motion[0], and with FFTW's new-array calls to the others */
  fftw_plan to_freq;    /* sample -> spec */
  double complex *root; /* [n_time] exp(i th_i) */
  unsigned char *move;  /* [n_time] circle_move that led to each sample, of the orbit */
  circle_orbit orbit;
  int passes;
  double start[2]; /* slider before sample 0 on the orbit; of CIRCLE_ONE_PASS 0 */
  double last[2];  /* of CIRCLE_GUESSED */
  double first[2]; /* slider at sample 0 */
  /* For the Jacobian; n_col = n_dof (2H+1) columns by X and two by the slider before sample 0. */
  double *symbol;   /* [4H+1] */
  double *basis[2]; /* [2H+1] harmonics at the sample before and at the one that is looked at */
  double *held;     /* [2H+1] their sum since w moved last */
  double *by[2];    /* [n_col] dw_1, dw_2 */
  double *whole;    /* [2 (2H+1)][n_col] by columns: d(T_1, T_2) */
};

/* The first period is entered as slider.c does: out of contact, or with w = 0 put into the circle at sample 0. */
static inline circle_sample circle_aft_sample(const circle_aft *a, int i)
{
  return (circle_sample){{a->motion[0][i], a->motion[1][i]}, a->motion[2][i]};
}

/* The step to sample i, from the one before; the first of the first period if `entering`. */
circle_move circle_aft_step(const circle_aft *a, int i, bool entering, double w[2], circle_slope *slope);

/* out[2 n_harm + 1] of the samples in a->sample; n_harm <= 2 H < n_time. */
void circle_aft_to_series(circle_aft *a, int n_harm, double *out);

/* x of (I - A) x = b, A by rows. False if A is the identity but for rounding: x is left alone. */
bool circle_aft_fixed_point(double A[2][2], const double b[2], double x[2]);

#endif
