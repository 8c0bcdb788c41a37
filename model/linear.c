/* linear.c - see linear.h. */
#include "model/linear.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

void linear_free_motion(double mass, double damping, double stiffness, double t, double e[2][2])
{
  double a = 0.5 * damping / mass, d = a * a - stiffness / mass, w = sqrt(fabs(d)), co, si;
  if (w * t <= 1e-8) { /* critical damping */
    co = exp(-a * t);
    si = t * co;
  } else if (d < 0) {
    co = exp(-a * t) * cos(w * t);
    si = exp(-a * t) * sin(w * t) / w;
  } else if (w * t < 1) { /* sinh without cancellation */
    co = exp(-a * t) * cosh(w * t);
    si = exp(-a * t) * sinh(w * t) / w;
  } else { /* exp(-a t) times cosh and sinh, as exponentials that decay: cosh alone could overflow */
    double slow = exp(-stiffness / mass / (a + w) * t), fast = exp(-(w + a) * t); /* w - a is a difference: c large */
    co = 0.5 * (slow + fast);
    si = 0.5 * (slow - fast) / w;
  }
  e[0][0] = co + a * si;
  e[0][1] = si;
  e[1][0] = -si * stiffness / mass;
  e[1][1] = co - a * si;
}

double linear_step_response(double c, double k, double t)
{
  const bool far_apart = c * t > 4 && c * c > 8 * k; /* the roots, which are real */
  if (fabs(k) * t * t > 0.5 && !far_apart) {
    double e[2][2];
    linear_free_motion(1, c, k, t, e);
    return (1 - e[0][0]) / k;
  }
  /* Powers of t: s = sum s_n t^n, (n + 2)(n + 1) s_(n+2) = -c (n + 1) s_(n+1) - k s_n, s_2 = 1/2. */
  if (!far_apart) {
    double before = 0, term = 0.5 * t * t, sum = term; /* s_(n+1) t^(n+1), s_(n+2) t^(n+2) */
    for (int n = 1; n < 100 && fabs(term) + fabs(before) > 0.25 * DBL_EPSILON * fabs(sum); ++n) {
      const double next = -(c * t * (n + 1) * term + k * t * t * before) / ((n + 2) * (n + 1));
      before = term;
      sum += term = next;
    }
    return sum;
  }
  /* slow root and its exponential without cancellation */
  const double root = sqrt(0.25 * c * c - k), fast = -0.5 * c - root, slow = -k / (0.5 * c + root);
  const double by_slow = slow != 0 ? expm1(slow * t) / slow : t;
  return (by_slow - expm1(fast * t) / fast) / (slow - fast);
}

double complex linear_response(double mass, double damping, double stiffness, double force, double omega)
{
  return force / (stiffness - mass * omega * omega + I * (damping * omega));
}
