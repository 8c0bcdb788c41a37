/* linear_regime.c - see linear_regime.h. Proof: tests/timeint/test_linear_regime.c. */
#include "timeint/steady/linear_regime.h"

#include <complex.h>

#include "model/linear.h"
#include "numerics/base/constants.h"
#include "timeint/steady/timeint_private.h"

static const double margin = 1e-9; /* of the sum of a guard's terms: far above the errors of an integration started
                                      at the same state */

/* A contact as the mass sees it: its law, u and v of X = 1, N0. */
typedef struct one_contact {
  const law_regularised *law;
  double cosine, sine, preload;
} one_contact;

static one_contact contact_of(const scaled_model *m, int j)
{
  const scaled_contact *c = &m->contact[j];
  return (one_contact){&c->law, m->base->tangent[j], m->base->normal[j], c->preload};
}

typedef struct linear { /* the oscillator while no contact changes its state; lengths in units of ti->length */
  double c;
  double k, center;      /* center: d/k                                */
  double complex steady; /* Z                                          */
  double free;           /* bound of |X - center - Re(Z e^{i theta})|  */
} linear;

static bool closed(const one_contact *c, double x) { return c->law->kn > 0 && c->sine * x + c->law->gap > 0; }

static linear linear_now(const timeint *ti)
{
  const scaled_model *m = &ti->scaled;
  const modal_base *b = m->base;
  const double x = ti->y[0], p = ti->y[1];
  linear l = {.c = m->by_C * b->C[0], .k = m->by_K * b->K[0]};
  double complex load = 0;
  double d = 0;
  for (int i = 0; i < b->n_loads; ++i) { /* a cos(theta) + b sin(theta) = Re (a - i b) e^{i theta}, or constant */
    if (b->harmonic[i] == 0) d += scaled_by_load(m, i) * b->cosine[i];
    else load += scaled_by_load(m, i) * (b->cosine[i] - I * b->sine[i]);
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    const one_contact c = contact_of(m, j);
    const double kt = c.law->has_friction ? c.law->kt : 0; /* without friction T = 0 */
    if (!closed(&c, x)) {
      d += c.preload * c.sine;
      continue;
    }
    l.k += kt * c.cosine * c.cosine + c.law->kn * c.sine * c.sine;
    d += kt * c.cosine * ti->y[2 + j] + (c.preload - c.law->kn * c.law->gap) * c.sine;
  }
  l.center = d / l.k;
  l.steady = load * linear_response(1, l.c, l.k, 1, 1);
  l.free = hypot(x - l.center - creal(l.steady), (p + cimag(l.steady)) / sqrt(l.k));
  return l;
}

/* Is a + b X > 0 wherever |X - center| <= reach? Phrased so that NaN and infinity say no. */
static bool positive_within(double a, double b, double center, double reach)
{
  double size = fabs(a) + fabs(b) * (fabs(center) + reach);
  return a + b * center - fabs(b) * reach > margin * size && isfinite(size);
}

/* Does the contact keep its state? Guards of separation, v + gap < 0, and of stick, v + gap > 0 and
 * mu N -+ kt (u - w) > 0: contact_law.h; v + gap stays clear of the regularised corner. */
static bool keeps_state(const one_contact *c, double x, double w, double center, double reach)
{
  const law_regularised *law = c->law;
  const double clear = LAW_SOFT_END * law->width;
  if (law->load != 0 || law->smooth.smooth != CONTACT_KINKED) return false;
  if (law->kn == 0) return true;     /* N = 0 always */
  if (law->overstress) return false; /* the slider of a separated contact acts on X as a dashpot */
  if (!closed(c, x)) return positive_within(-law->gap - clear, -c->sine, center, reach);
  if (!positive_within(law->gap - clear, c->sine, center, reach)) return false;
  if (!law->has_friction) return true;
  const double n = law->mu * law->kn, t = law->kt;
  return positive_within(n * law->gap + t * w, n * c->sine - t * c->cosine, center, reach) &&
         positive_within(n * law->gap - t * w, n * c->sine + t * c->cosine, center, reach);
}

/* Has it one degree of freedom under loads that are constant or have the period's own harmonic? */
static bool is_single(const model *m)
{
  bool one = m->n == 1;
  for (int l = 0; l < m->n_loads; ++l) one = one && m->loads[l].harmonic <= 1;
  return one;
}

bool linear_regime_is_final(const timeint *ti)
{
  const scaled_model *m = &ti->scaled;
  if (!is_single(ti->model)) return false; /* Newton finds a structure's linear motion in one step */
  const linear l = linear_now(ti);
  const double amplitude = cabs(l.steady), reach = amplitude + l.free;
  if (!(l.k > 0) || !isfinite(fabs(l.center) + reach)) return false;
  if (!(l.c > 0) && !(l.free <= ti->how.tolerance * amplitude)) return false;
  for (int j = 0; j < m->n_contacts; ++j) {
    const one_contact c = contact_of(m, j);
    if (!keeps_state(&c, ti->y[0], ti->y[2 + j], l.center, reach)) return false;
  }
  return true;
}

/* The multiplier, over 2 pi, of the slowest solution of X'' + c X' + k X = 0. */
static double complex slowest_multiplier(double c, double k)
{
  const double d = 0.25 * c * c - k;
  if (d < 0) return cexp(TWO_PI * (-0.5 * c + I * sqrt(-d)));
  return exp(-TWO_PI * k / (0.5 * c + sqrt(d))); /* c/2 - sqrt(d) without cancellation */
}

/* The steady motion times `unit`, what the response is in lengths of X. */
static void measure_linear(const linear *l, double unit, timeint_result *r)
{
  const double amplitude = cabs(l->steady) * fabs(unit);
  r->amplitude = r->harmonic_1 = amplitude;
  r->mean = l->center * unit;
  r->max = r->mean + amplitude;
  r->min = r->mean - amplitude;
  r->rms = hypot(r->mean, amplitude * sqrt(0.5));
  r->a1 = creal(l->steady) * unit; /* Re(Z e^{i theta}) = Re Z cos - Im Z sin */
  r->b1 = -cimag(l->steady) * unit;
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    const double theta = TWO_PI * i / TIMEINT_WAVE;
    r->wave[i] = r->mean + r->a1 * cos(theta) + r->b1 * sin(theta);
  }
}

bool linear_regime_response(const timeint *ti, int i, timeint_result *r)
{
  if (r->method != TIMEINT_BY_CLOSED_FORM || !linear_regime_is_final(ti)) return false;
  const linear l = linear_now(ti);
  measure_linear(&l, ti->scaled.base->response[i] * ti->length, r);
  timeint_shift_result(ti, i, r);
  return true;
}

bool linear_regime_steady(timeint *ti, timeint_result *r)
{
  if (!linear_regime_is_final(ti)) return false;
  const scaled_model *m = &ti->scaled;
  const linear l = linear_now(ti);
  const bool exact = ti->how.law == TRANSIENT_LAW_EXACT;
  r->method = TIMEINT_BY_CLOSED_FORM;
  r->regime = CONTACT_LINEAR;
  r->free_sliders = r->switches = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const one_contact c = contact_of(m, j);
    if (closed(&c, ti->y[0])) {
      r->regime = CONTACT_STUCK;
      r->free_sliders += c.law->has_friction;
    } else if (c.law->has_friction) { /* separated: w' = (u - w) kt/eta */
      double lag = exact ? 0 : c.law->eta / c.law->kt;
      ti->y[2 + j] = c.cosine * (l.center + creal(l.steady / (1 + I * lag)));
    }
  }
  measure_linear(&l, m->base->response[0] * ti->length, r);
  timeint_shift_result(ti, 0, r);
  const double complex lambda = slowest_multiplier(l.c, l.k);
  r->multiplier = r->contraction = cabs(lambda);
  r->multiplier_re = creal(lambda);
  r->multiplier_im = cimag(lambda);
  r->period_multiple = 1;
  r->closure = r->attainable = 0;
  ti->y[0] = l.center + creal(l.steady);
  ti->y[1] = -cimag(l.steady);
  return true;
}
