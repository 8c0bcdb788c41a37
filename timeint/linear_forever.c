/* linear_forever.c - see linear_forever.h. Proof: tests/timeint/test_linear_forever.c. */
#include "timeint/linear_forever.h"

#include <complex.h>
#include <math.h>

#include "base/constants.h"
#include "model/linear.h"
#include "timeint/internal.h"

static const double margin = 1e-9; /* of what a guard is made of: far above the errors of an integration started at
                                      the same state */
static const double corner = 40; /* [width] beyond which softplus is exact to rounding: SOFT_END of law_regularised.c */

typedef struct linear {  /* the oscillator that ti->y belongs to as long as nothing happens; lengths in units of
                           ti->length */
  double k, center;      /* center: d/k                                */
  double complex steady; /* Z                                          */
  double free;           /* bound of |X - center - Re(Z e^{i theta})|  */
} linear;

static bool closed(const scaled_contact *c, double x) { return c->law.kn > 0 && c->sine * x + c->law.gap > 0; }

static linear linear_now(const timeint *ti)
{
  const scaled_model *m = &ti->scaled;
  const double x = ti->y[SCALED_X], p = ti->y[SCALED_P];
  linear l = {.k = m->k};
  double d = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    const double kt = c->law.slides ? c->law.kt : 0; /* without friction T = 0 */
    if (!closed(c, x)) {
      d += c->preload * c->sine;
      continue;
    }
    l.k += kt * c->cosine * c->cosine + c->law.kn * c->sine * c->sine;
    d += kt * c->cosine * ti->y[SCALED_W + j] + (c->preload - c->law.kn * c->law.gap) * c->sine;
  }
  l.center = d / l.k;
  l.steady = linear_response(1, m->c, l.k, m->f, 1);
  l.free = hypot(x - l.center - creal(l.steady), (p + cimag(l.steady)) / sqrt(l.k));
  return l;
}

/* Is a + b X > 0 wherever |X - center| <= reach? Phrased so that NaN and infinity say no. */
static bool stays(double a, double b, double center, double reach)
{
  double size = fabs(a) + fabs(b) * (fabs(center) + reach);
  return a + b * center - fabs(b) * reach > margin * size && isfinite(size);
}

/* Guards of separation, v + gap < 0, and of stick, v + gap > 0 and mu N -+ kt (u - w) > 0: contact_law.h, the first
 * clear of the corner. */
static bool contact_stays(const scaled_contact *c, double x, double w, double center, double reach)
{
  const law_regularised *law = &c->law;
  const double clear = corner * law->width;
  if (law->kn == 0) return true;     /* N = 0 always */
  if (law->overstress) return false; /* a separated slider drags */
  if (!closed(c, x)) return stays(-law->gap - clear, -c->sine, center, reach);
  if (!stays(law->gap - clear, c->sine, center, reach)) return false;
  if (!law->slides) return true;
  const double n = law->mu * law->kn, t = law->kt;
  return stays(n * law->gap + t * w, n * c->sine - t * c->cosine, center, reach) &&
         stays(n * law->gap - t * w, n * c->sine + t * c->cosine, center, reach);
}

bool linear_forever(const timeint *ti)
{
  const scaled_model *m = &ti->scaled;
  const linear l = linear_now(ti);
  const double amplitude = cabs(l.steady), reach = amplitude + l.free;
  if (!(l.k > 0) || !isfinite(fabs(l.center) + reach)) return false;
  if (!(m->c > 0) && !(l.free <= ti->how.tolerance * amplitude)) return false;
  for (int j = 0; j < m->n_contacts; ++j)
    if (!contact_stays(&m->contact[j], ti->y[SCALED_X], ti->y[SCALED_W + j], l.center, reach)) return false;
  return true;
}

/* The eigenvalue of X'' + c X' + k X = 0 that decays slowest, after a turn. */
static double complex slowest(double c, double k)
{
  const double d = 0.25 * c * c - k;
  if (d < 0) return cexp(TWO_PI * (-0.5 * c + I * sqrt(-d)));
  return exp(-TWO_PI * k / (0.5 * c + sqrt(d))); /* k/a for a - sqrt(d): nothing cancels */
}

static void fill_measures(const linear *l, double length, timeint_result *r)
{
  const double amplitude = cabs(l->steady);
  r->amplitude = r->harmonic_1 = amplitude * length;
  r->max = (l->center + amplitude) * length;
  r->min = (l->center - amplitude) * length;
  r->mean = l->center * length;
  r->rms = hypot(l->center, amplitude * sqrt(0.5)) * length;
  r->a1 = creal(l->steady) * length; /* Re(Z e^{i theta}) = Re Z cos - Im Z sin */
  r->b1 = -cimag(l->steady) * length;
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double theta = TWO_PI * i / TIMEINT_WAVE;
    r->wave[i] = l->center * length + r->a1 * cos(theta) + r->b1 * sin(theta);
  }
}

static void fill_stability(const scaled_model *m, double k, timeint_result *r)
{
  const double complex lambda = slowest(m->c, k);
  r->multiplier = r->contraction = cabs(lambda);
  r->multiplier_re = creal(lambda);
  r->multiplier_im = cimag(lambda);
  r->period_multiple = 1;
  r->closure = 0;
}

void linear_steady(timeint *ti, timeint_result *r)
{
  const scaled_model *m = &ti->scaled;
  const linear l = linear_now(ti);
  const bool exact = ti->how.law == TRANSIENT_LAW_EXACT;
  r->method = TIMEINT_BY_CLOSED_FORM;
  r->regime = CONTACT_LINEAR;
  r->free_sliders = r->switches = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    if (closed(c, ti->y[SCALED_X])) {
      r->regime = CONTACT_STUCK;
      r->free_sliders += c->law.slides;
    } else if (c->law.slides) { /* it follows u: w' = (u - w) kt/eta */
      double lag = exact ? 0 : c->law.eta / c->law.kt;
      ti->y[SCALED_W + j] = c->cosine * (l.center + creal(l.steady / (1 + I * lag)));
    }
  }
  fill_measures(&l, ti->length, r);
  fill_stability(m, l.k, r);
  ti->y[SCALED_X] = l.center + creal(l.steady);
  ti->y[SCALED_P] = -cimag(l.steady);
}
