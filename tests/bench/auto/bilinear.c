/* bilinear.c - case 2 of the paper for AUTO-07p, the yardstick of versus_auto.sh. Not part of hbmcheck: built with
 * AUTO's own library.
 *
 *     x'' + 0.4 x' + 40 x + 550 softplus(x - 5/sin 45) = 100 cos(omega t),     softplus(z) = e log(1 + exp(z/e)), e
 *                                                                              = 1e-2
 *
 * A contact of case 2 that starts from a separation sticks until the next one (kt <= mu kn tan 45), so the system is
 * exactly bilinear: kt cos^2 + kn sin^2 = 550 more stiffness beyond the clearance 5/sin 45; softplus makes it smooth
 * enough for collocation. The forcing is the usual attracting circle p' = p + omega q - p r^2, q' = -omega p + q - q
 * r^2: p = sin, q = cos (omega t). The start is the closed form of the separated response. State: x, x', p, q.
 * PAR(1) omega, PAR(11) period. Settings: c.bilinear. */
#include "auto_f2c.h"

static const double DAMPING = 0.4, STIFFNESS = 40, FORCE = 100, CONTACT = 550, CLEARANCE = 7.0710678118654755,
                    WIDTH = 1e-2;
static const double TWO_PI = 6.283185307179586476925;

int func(integer ndim, const doublereal *u, const integer *icp, const doublereal *par, integer ijac, doublereal *f,
         doublereal *dfdu, doublereal *dfdp)
{
  (void)ndim, (void)icp;
  double omega = par[0], z = (u[0] - CLEARANCE) / WIDTH, r2 = u[2] * u[2] + u[3] * u[3];
  double positive = z > 0 ? z + log1p(exp(-z)) : log1p(exp(z)), step = 1 / (1 + exp(-z));
  f[0] = u[1];
  f[1] = FORCE * u[3] - DAMPING * u[1] - STIFFNESS * u[0] - CONTACT * WIDTH * positive;
  f[2] = u[2] + omega * u[3] - u[2] * r2;
  f[3] = -omega * u[2] + u[3] - u[3] * r2;
  if (ijac == 0) return 0;
  for (int i = 0; i < 16; ++i) dfdu[i] = 0; /* dfdu[row + 4 column] */
  dfdu[0 + 4 * 1] = 1;
  dfdu[1 + 4 * 0] = -STIFFNESS - CONTACT * step;
  dfdu[1 + 4 * 1] = -DAMPING;
  dfdu[1 + 4 * 3] = FORCE;
  dfdu[2 + 4 * 2] = 1 - r2 - 2 * u[2] * u[2];
  dfdu[2 + 4 * 3] = omega - 2 * u[2] * u[3];
  dfdu[3 + 4 * 2] = -omega - 2 * u[2] * u[3];
  dfdu[3 + 4 * 3] = 1 - r2 - 2 * u[3] * u[3];
  if (ijac == 1) return 0;
  dfdp[0] = dfdp[1] = 0; /* by omega, the only parameter in f */
  dfdp[2] = u[3];
  dfdp[3] = -u[2];
  return 0;
}

int stpnt(integer ndim, doublereal t, doublereal *u, doublereal *par)
{
  (void)ndim;
  double omega = 0.5 * sqrt(STIFFNESS), k = STIFFNESS - omega * omega, c = DAMPING * omega,
         size = FORCE / (k * k + c * c);
  double C = cos(TWO_PI * t), S = sin(TWO_PI * t);
  par[0] = omega;
  par[10] = TWO_PI / omega;
  u[0] = size * (k * C + c * S);
  u[1] = size * omega * (c * C - k * S);
  u[2] = S;
  u[3] = C;
  return 0;
}

int pvls(integer ndim, const doublereal *u, doublereal *par)
{
  (void)ndim, (void)u, (void)par;
  return 0;
}

int bcnd(integer ndim, const doublereal *par, const integer *icp, integer nbc, const doublereal *u0,
         const doublereal *u1, integer ijac, doublereal *fb, doublereal *dbc)
{
  (void)ndim, (void)par, (void)icp, (void)nbc, (void)u0, (void)u1, (void)ijac, (void)fb, (void)dbc;
  return 0;
}

int icnd(integer ndim, const doublereal *par, const integer *icp, integer nint, const doublereal *u,
         const doublereal *uold, const doublereal *udot, const doublereal *upold, integer ijac, doublereal *fi,
         doublereal *dint)
{
  (void)ndim, (void)par, (void)icp, (void)nint, (void)u, (void)uold, (void)udot, (void)upold, (void)ijac, (void)fi,
      (void)dint;
  return 0;
}

int fopt(integer ndim, const doublereal *u, const integer *icp, const doublereal *par, integer ijac, doublereal *fs,
         doublereal *dfdu, doublereal *dfdp)
{
  (void)ndim, (void)u, (void)icp, (void)par, (void)ijac, (void)fs, (void)dfdu, (void)dfdp;
  return 0;
}
