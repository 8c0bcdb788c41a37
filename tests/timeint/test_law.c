/* test_law.c - law_regularised: values on the branches, the error orders it claims, its derivatives, its limits. */
#include "tests/check.h"

#include <float.h>

#include "numerics/random.h"
#include "timeint/law/contact_track.h"
#include "timeint/law/law_regularised.h"

static const contact steel = {.kt = 3, .kn = 5, .mu = 0.3, .gap = 0.2};

/* Away from the corners the law is linear: N = kn g to rounding, since softplus(z) - z = log1p(exp(-z)) < exp(-40)
 * there. */
static void branches_are_exact(CHECK_STATE)
{
  law_regularised c = law_regularised_make(&steel, 1e-3, 1e-2);
  law_value stick = law_regularised_eval(&c, 0.1, 1, 0.05), slip = law_regularised_eval(&c, 2, 1, 0),
            off = law_regularised_eval(&c, 2, -1, 0);
  CHECK_NEAR(stick.n, 6.0, 4 * DBL_EPSILON * 6, "N in contact");
  CHECK_NEAR(stick.t, 0.15, 4 * DBL_EPSILON, "T in stick");
  CHECK_LE(fabs(stick.rate), 0, "w' in stick");
  CHECK_NEAR(slip.t, 1.8, 8 * DBL_EPSILON * 6, "T in slip is mu N: 6 and 1.8 cancel");
  CHECK_NEAR(slip.rate, (6 - 1.8) / 0.03, 1e-14 * 140, "w' in slip");
  CHECK_LE(fabs(off.n) + fabs(off.t), 0, "separated");
  CHECK_NEAR(off.rate, 2 / 1e-2, 1e-13 * 200, "w follows u at the rate 1/relaxation");
  c.overstress = true;
  CHECK_NEAR(law_regularised_eval(&c, 2, 1, 0).t, 6.0, 4 * DBL_EPSILON * 6, "the dashpot's force is in T");
}

/* The law is odd: (u, w) -> (-u, -w) turns T and w' round. */
static void sign_follows_the_motion(CHECK_STATE)
{
  law_regularised c = law_regularised_make(&steel, 1e-3, 1e-2);
  law_value a = law_regularised_eval(&c, 2, 1, 0.1), b = law_regularised_eval(&c, -2, 1, -0.1);
  CHECK_LE(fabs(a.t + b.t) + fabs(a.rate + b.rate), 0, "odd");
  CHECK_LE(0.1, a.rate, "slides after u");
}

/* integral of (kn width softplus(g/width) - kn max(g, 0)) dg = kn width^2 pi^2/6 (Bose integral): the second order
 * the header claims, with its constant. Trapezoid on [-45, 45] widths, step 1/64 width, the corner on a node: the
 * kink costs h^2/12 (jump of its derivative by 1); what is beyond the ends is 2 exp(-45). */
static void softplus_errs_by_second_order(CHECK_STATE)
{
  for (double width = 1e-1; width > 1e-4; width *= 0.1) {
    law_regularised c = law_regularised_make(&steel, width, 1e-2);
    double sum = 0, h = width / 64;
    for (int i = -45 * 64; i <= 45 * 64; ++i)
      sum += law_regularised_eval(&c, 0, i * h - steel.gap, 0).n - steel.kn * fmax(i * h, 0);
    /* every N carries rounding of v + gap, DBL_EPSILON of the gap; 5760 of them add up at worst */
    double bound = steel.kn * h * h / 12 * 1.01 + h * 5760 * steel.kn * DBL_EPSILON * 45;
    CHECK_NEAR(sum * h, steel.kn * width * width * PI * PI / 6, bound, "width %g", width);
  }
}

static void derivatives_are_those_of_the_values(CHECK_STATE)
{
  law_regularised c = law_regularised_make(&steel, 0.5, 1e-2);
  int stuck = 0, forward = 0, backward = 0;
  for (int both = 0; both < 2; ++both)
    for (int i = 0; i < 2000; ++i) {
      double u = 2 * sin(1.1 * i), v = 1.5 * sin(1.7 * i + 1), w = 2 * cos(2.3 * i), t = c.kt * (u - w);
      c.overstress = both;
      double limit = c.mu * law_regularised_eval(&c, u, v, w).n;
      if (fabs(fabs(t) - limit) < 1e-3 || fabs(v + c.gap) > 38 * c.width) continue;
      stuck += fabs(t)<limit, forward += t> limit, backward += t < -limit;
      /* Central differences, step h: error h^2/6 |f'''| + eps |f|/h. f''' of N is <= kn/(6 sqrt 3 width^2) (largest
       * of softplus'''), of w' mu times that over eta. Points keep farther than h from the corners of max, where
       * there is no derivative. */
      const double h = 1e-5;
      law_derivatives s = law_regularised_derivatives(&c, u, v, w);
      law_value up = law_regularised_eval(&c, u + h, v, w), um = law_regularised_eval(&c, u - h, v, w);
      law_value vp = law_regularised_eval(&c, u, v + h, w), vm = law_regularised_eval(&c, u, v - h, w);
      law_value wp = law_regularised_eval(&c, u, v, w + h), wm = law_regularised_eval(&c, u, v, w - h);
      double size = c.kn * (fabs(v) + 1) + c.kt * (fabs(u) + fabs(w) + 1);
      double tol = h * h / 6 * c.kn / (6 * sqrt(3) * c.width * c.width) + 8 * DBL_EPSILON * size / h;
      double tol_rate = tol * (1 + c.mu) / c.eta;
      CHECK_NEAR(s.n_v, (vp.n - vm.n) / (2 * h), tol, "dN/dv at %g %g %g", u, v, w);
      CHECK_NEAR(s.t_u, (up.t - um.t) / (2 * h), tol, "dT/du at %g %g %g", u, v, w);
      CHECK_NEAR(s.t_v, (vp.t - vm.t) / (2 * h), tol, "dT/dv at %g %g %g", u, v, w);
      CHECK_NEAR(-s.t_u, (wp.t - wm.t) / (2 * h), tol, "dT/dw at %g %g %g", u, v, w);
      CHECK_NEAR(s.rate_u, (up.rate - um.rate) / (2 * h), tol_rate, "dw'/du at %g %g %g", u, v, w);
      CHECK_NEAR(s.rate_v, (vp.rate - vm.rate) / (2 * h), tol_rate, "dw'/dv at %g %g %g", u, v, w);
      CHECK_NEAR(-s.rate_u, (wp.rate - wm.rate) / (2 * h), tol_rate, "dw'/dw at %g %g %g", u, v, w);
    }
  CHECK_LE(100, stuck, "points in stick");
  CHECK_LE(100, forward < backward ? forward : backward, "points in slip, each way");
}

/* kt, kn or mu = 0: no tangential force, w stays. Width 0: the exact corner. Nothing overflows. */
static void limits(CHECK_STATE)
{
  contact none[3] = {steel, steel, steel};
  none[0].kt = 0, none[1].kn = 0, none[2].mu = 0;
  for (int i = 0; i < 3; ++i) {
    law_regularised c = law_regularised_make(&none[i], 1e-3, 1e-2);
    law_value l = law_regularised_eval(&c, 2, 1, 0);
    law_derivatives s = law_regularised_derivatives(&c, 2, 1, 0);
    CHECK_LE(fabs(l.t) + fabs(l.rate) + fabs(s.t_u) + fabs(s.t_v) + fabs(s.rate_u) + fabs(s.rate_v), 0, "i=%d", i);
  }
  law_regularised sharp = law_regularised_make(&steel, 0, 1e-2);
  CHECK_NEAR(law_regularised_eval(&sharp, 0, 0.1, 0).n, 1.5, 4 * DBL_EPSILON, "width 0, in contact");
  CHECK_LE(fabs(law_regularised_eval(&sharp, 0, -0.2, 0).n), 0, "width 0, on the corner");
  law_regularised c = law_regularised_make(&steel, 1e-12, 1e-2);
  CHECK_NEAR(law_regularised_eval(&c, 0, 1e9, 0).n, 5 * (1e9 + 0.2), 4 * DBL_EPSILON * 5e9, "far in");
  CHECK_LE(law_regularised_eval(&c, 0, -1e9, 0).n, 0, "far out");
  CHECK_LE(1, isnan(law_regularised_eval(&c, 0, NAN, 0).n), "NaN is not swallowed");
}

/* Of either sign and any size: sums of three terms, of which each and each partial sum is rounded once, are off by less
 * than five half units of the sizes of what they are made of. */
static void guards_are_noisier_than_rounding(CHECK_STATE)
{
  const law_regularised l = law_regularised_make(&steel, 0, 1);
  const scaled_contact c = {.law = l};
  uint64_t seed = 25;
  for (int i = 0; i < 10000; ++i) {
    double x[3];
    for (int k = 0; k < 3; ++k) x[k] = pow(10, 3 * random_signed(&seed)) * random_signed(&seed);
    const double half = 0.5 * DBL_EPSILON, u = fabs(x[0]), v = fabs(x[1]), w = fabs(x[2]);
    CHECK_LE(5 * half * (v + l.gap), contact_track_distance_noise(&c, x[1]), "V + gap at %g", x[1]);
    CHECK_LE(5 * half * (l.kt * (u + w) + l.mu * l.kn * (v + l.gap)), contact_track_force_noise(&c, x[0], x[1], x[2]),
             "forces at %g, %g, %g", x[0], x[1], x[2]);
    CHECK_LE(5 * half * (l.kt * u + l.mu * l.kn * v), contact_track_rate_noise(&c, x[0], x[1]), "rates at %g, %g", x[0],
             x[1]);
  }
}

CHECK_TESTS("timeint.law", 60, branches_are_exact, sign_follows_the_motion, softplus_errs_by_second_order,
            derivatives_are_those_of_the_values, limits, guards_are_noisier_than_rounding)
