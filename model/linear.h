/* linear.h - the linear oscillator in closed form: M x'' + C x' + k x = F cos(omega t). In each contact state of the
 * exact law a model of one degree of freedom is such an oscillator. libm only. */
#pragma once

#include <complex.h>

/* e[row][column]: (x, x') after time t of M x'' + C x' + k x = 0 from (1, 0) and from (0, 1). k = 0 is a free mass; k <
 * 0 is unstable. Accurate for underdamped, critically damped and overdamped motion; nothing overflows. */
void linear_free_motion(double mass, double damping, double stiffness, double t, double e[2][2]);

/* x after time t >= 0 of x'' + c x' + k x = 1 from rest; c >= 0. Accurate also for c and k at or near 0. */
double linear_step_response(double c, double k, double t);

/* X of the steady state x = Re X exp(i omega t); infinite at an undamped resonance. */
double complex linear_response(double mass, double damping, double stiffness, double force, double omega);
