/* linear.c - see linear.h. */
#include "model/linear.h"

#include <math.h>

void linear_free_motion(double mass, double damping, double stiffness, double t, double e[2][2])
{
  double a = 0.5 * damping / mass, d = a * a - stiffness / mass, w = sqrt(fabs(d)), co, si;
  if (w * t <= 1e-8) { /* critical damping */
    co = exp(-a * t);
    si = t * co;
  } else if (d < 0) {
    co = exp(-a * t) * cos(w * t);
    si = exp(-a * t) * sin(w * t) / w;
  } else { /* exp(-a t) times cosh and sinh, as exponentials that decay: cosh alone could overflow */
    double slow = exp((w - a) * t), fast = exp(-(w + a) * t);
    co = 0.5 * (slow + fast);
    si = 0.5 * (slow - fast) / w;
  }
  e[0][0] = co + a * si;
  e[0][1] = si;
  e[1][0] = -si * stiffness / mass;
  e[1][1] = co - a * si;
}

double complex linear_response(double mass, double damping, double stiffness, double force, double omega)
{
  return force / (stiffness - mass * omega * omega + I * (damping * omega));
}
