/* contact_law.h - the exact contact law: Coulomb friction with a tangential spring, under a normal force that may
 * vanish. Written in the tangential motion u(t) and the normal motion v(t) [length]; the caller derives them from the
 * degrees of freedom. Needs libm only, allocates nothing, keeps no state, cannot fail.
 *
 *     N = max(kn (v + gap), 0) + load     N0 = max(kn gap, 0) + load     load = 0 where kn > 0
 *     stick      T = kt (u - w), |T| <= mu N, w constant
 *     slip(s)    T = s mu N, s = +1 or -1, w = u - s mu N / kt
 *     separated  T = 0, N = 0, w = u
 *
 * w is the displacement of the contact point (the slider). Source: Yang, Chu, Menq 1998 and Colonna et al. 2025, eq.
 * 9-12 ([1] in README.md).
 *
 * With two tangents and one limit for both, the circle |T| <= mu N, motion u, slider w and traction T are vectors in
 * the tangent plane:
 *     stick      T = kt (u - w), |T| <= mu N, w constant
 *     slip       T = mu N e, |e| = 1, w = u - (mu N/kt) e, w' = s e, s = u'.e - mu N'/kt >= 0
 *     separated  T = 0, N = 0, w = u
 * While it slips, the direction e = (cos phi, sin phi) follows the motion: (mu N/kt) phi' = u'.e_perp, e_perp = (-sin
 * phi, cos phi). With u, w and T on one line it is the law above. Source: Yang and Menq 1998, J. Sound Vib. 217,
 * 909-925 (the radial limit); the angle's equation is derived from it by differentiating w = u - (mu N/kt) e. */
#pragma once

#include <math.h>
#include <stdbool.h>

/* Laws that are smooth, and need no slider:
 *     polynomial   across the contact f(v) = sum over p of power_p v^p, and nothing else (kt = kn = mu = load = 0)
 *     tanh         T = mu N tanh(u'/epsilon) instead of the slider (kt = 0), N as above
 * Tables with a row for each law are made from this list; functions below tell the laws apart. */
#define CONTACT_SMOOTH_LIST(X)          X(CONTACT_POLYNOMIAL, polynomial) X(CONTACT_TANH, tanh)
#define CONTACT_SMOOTH_CODE(code, name) code,
typedef enum contact_smooth { CONTACT_KINKED, CONTACT_SMOOTH_LIST(CONTACT_SMOOTH_CODE) CONTACT_LAWS } contact_smooth;
#undef CONTACT_SMOOTH_CODE
enum { CONTACT_LEAST_POWER = 2, CONTACT_MOST_POWER = 9, CONTACT_POWERS = CONTACT_MOST_POWER - CONTACT_LEAST_POWER + 1 };

typedef struct contact {
  double kt;   /* [force/length] >= 0, tangential stiffness */
  double kn;   /* [force/length] >= 0, normal stiffness */
  double mu;   /* [1] >= 0, friction coefficient */
  double gap;  /* [length] > 0: preload N0 = kn gap; < 0: clearance */
  double load; /* [force] >= 0, N of a contact without a normal spring (kn = 0): a Jenkins element */
  contact_smooth smooth;
  double epsilon;               /* [length/time] > 0, velocity scale of tanh */
  double power[CONTACT_POWERS]; /* [force/length^p] coefficients of a polynomial, p = 2..9 */
  double across[2]; /* [force], [force/length] of a polynomial about rest (rest.h): its force and slope there, which are
                       part of the model's loads and K */
} contact;

typedef enum contact_state { CONTACT_SEPARATED, CONTACT_STICK, CONTACT_SLIP_PLUS, CONTACT_SLIP_MINUS } contact_state;

/* State of a contact over a period: never touches, sticks all the time, slips without separation, separates and
 * touches; CONTACT_BENDS: a smooth law, ranked between stick and slip. The `contact` column of tables shows the highest
 * rank of all contacts: contact_regime_larger. */
typedef enum contact_regime {
  CONTACT_LINEAR,
  CONTACT_STUCK,
  CONTACT_SLIPS,
  CONTACT_SEPARATES,
  CONTACT_BENDS
} contact_regime;
const char *contact_regime_name(contact_regime regime); /* "linear", "stick", "smooth", "slip", "separation" */

static inline contact_regime contact_regime_larger(contact_regime a, contact_regime b)
{
  if (b == CONTACT_BENDS) return a > CONTACT_STUCK ? a : b;
  return a == CONTACT_BENDS ? (b > CONTACT_STUCK ? b : a) : a > b ? a : b;
}

/* True if the contact has a slider; else T = 0. */
static inline bool contact_has_friction(const contact *c)
{
  return c->kt > 0 && (c->kn > 0 || c->load > 0) && c->mu > 0;
}

/* True if T is not always 0: a slider, or tanh in its place. */
static inline bool contact_rubs(const contact *c) { return contact_has_friction(c) || c->smooth == CONTACT_TANH; }

/* True if the force does not depend on the sign of v + gap. */
static inline bool contact_never_opens(const contact *c) { return c->smooth == CONTACT_POLYNOMIAL; }

/* Static force [force] of the normal spring: N0 without the constant `load`. */
static inline double contact_preload(const contact *c) { return c->gap > 0 ? c->kn * c->gap : 0.0; }

/* Length scale [length] of the contact's law: the lesser of |gap| and the slip length mu N0/kt, without those that are
 * 0; 0: none. */
static inline double contact_length(const contact *c)
{
  const double gap = c->kn > 0 ? fabs(c->gap) : 0, N0 = contact_preload(c) + c->load;
  const double slip = contact_has_friction(c) ? c->mu * N0 / c->kt : 0;
  return gap > 0 && slip > 0 ? fmin(gap, slip) : fmax(gap, slip);
}

/* Normal force [force] at normal motion v. */
static inline double contact_normal(const contact *c, double v)
{
  double g = v + c->gap;
  return (g > 0 ? c->kn * g : 0.0) + c->load;
}

/* f(v) of a polynomial [force]; *slope = df/dv. */
static inline double contact_polynomial(const contact *c, double v, double *slope)
{
  double f = 0, by_v = 0;
  for (int i = CONTACT_POWERS; i-- > 0;) {
    by_v = by_v * v + f;
    f = f * v + c->power[i];
  }
  *slope = v * (2 * f + v * by_v); /* derivative of v^2 f */
  return v * v * f;
}

/* Normal force [force] of any law at v; tangential force [force] of tanh for N and the rate u', 0 for other laws. */
static inline double contact_across(const contact *c, double v)
{
  if (!contact_never_opens(c)) return contact_normal(c, v);
  return contact_polynomial(c, v, &(double){0}) + c->across[0] + c->across[1] * v;
}
static inline double contact_along(const contact *c, double N, double du)
{
  return c->smooth == CONTACT_TANH ? c->mu * N * tanh(du / c->epsilon) : 0;
}

/* The law in units of stiffness [force/length], length and rate [length/time]. */
contact contact_in_units(const contact *c, double stiffness, double length, double rate);

/* The degree of a polynomial; 0 for other laws. */
static inline int contact_degree(const contact *c)
{
  int degree = 0;
  for (int i = 0; i < CONTACT_POWERS; ++i)
    if (c->power[i] != 0) degree = i + CONTACT_LEAST_POWER;
  return degree;
}

/* +1 for CONTACT_SLIP_PLUS, -1 for CONTACT_SLIP_MINUS, else 0. */
static inline int contact_slip_sign(contact_state st) { return (st == CONTACT_SLIP_PLUS) - (st == CONTACT_SLIP_MINUS); }

/* N - N0 [force], the part of the normal force that moves the mass. Not computed as a difference, which for a preload
 * of a million times the forcing would be rounding error. */
static inline double contact_normal_change(const contact *c, double v)
{
  if (!(c->gap > 0)) return v + c->gap > 0 ? c->kn * (v + c->gap) : 0.0;
  return v + c->gap > 0 ? c->kn * v : -contact_preload(c);
}

/* One step of the law from slider position *w to motion (u, v): elastic predictor, Coulomb corrector. Exact if u -
 * mu N/kt and u + mu N/kt are monotone over the step. *w becomes the new position, *t the tangential force. Returns
 * the state at the end. */
contact_state contact_step(const contact *c, double u, double v, double *w, double *t);

/* The same with two tangents: radial return to the limit; w becomes the new position, T [force] the traction. Slip is
 * CONTACT_SLIP_PLUS, whatever its direction, which is T's. Exact if predictor and traction have one direction, else of
 * first order: the slider moves the whole step in the direction of slip at its end (hbm/planar/planar_slider.h follows
 * the turning direction). Only mu N matters, so c may be the law of the contact or of one of its two halves (model.h),
 * whose mu N is the same. NaN anywhere gives NaN. */
contact_state contact_step_planar(const contact *c, const double u[2], double v, double w[2], double T[2]);

/* State just after v + gap rises through 0, from the velocities du and dv > 0 there: slip with sign s if s kt du > mu
 * kn dv, else stick. */
contact_state contact_on_touch(const contact *c, double du, double dv);
