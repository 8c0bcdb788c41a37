/* prove.c - from a certificate to a verdict. */
#include "proof/prove.h"
#include <math.h>

void decision_init(decision *v)
{
  *v = (decision){.failure = {.segment = -1, .contact = -1, .from = NAN, .to = NAN}};
  for (int q = 0; q < CLAIMS; q++) arb_init(v->quantities.value[q]);
}

void decision_clear(decision *v)
{
  for (int q = 0; q < CLAIMS; q++) arb_clear(v->quantities.value[q]);
}

/* A claimed interval must contain what was found. */
static bool claims_hold(const certificate *c, decision *v)
{
  const quantities *q = &v->quantities;
  const slong precision = 2L * c->precision + 64;
  LOCAL(arb) low = {0}, high = {0};
  bool hold = true;
  if ((c->stability == STABILITY_STABLE || c->stability == STABILITY_UNSTABLE) && q->stability != c->stability)
    hold = q->stability == STABILITY_UNPROVEN
               ? refute(&v->failure, -1, -1, "stability unproven")
               : refute(&v->failure, -1, -1, "claim is false: it is %s", stability_names[q->stability]);
  for (int i = 0; i < CLAIMS && hold; i++) {
    if (!c->claimed[i]) continue;
    arb_set_fmpq(low, c->claims + 2L * i, precision);
    arb_set_fmpq(high, c->claims + 2L * i + 1, precision);
    if (i == CLAIM_MULTIPLIER && !q->multiplier_known) hold = refute(&v->failure, -1, -1, "stability unproven");
    else if (arb_lt(q->value[i], low) || arb_gt(q->value[i], high))
      hold = refute(&v->failure, -1, -1, "claim is false: %s", claim_names[i]);
    else if (!arb_le(low, q->value[i]) || !arb_le(q->value[i], high))
      hold = refute(&v->failure, -1, -1, "claim is too narrow: %s", claim_names[i]);
  }
  return hold;
}

bool prove(const certificate *c, const double *inverse, decision *v)
{
  krawczyk k = {0};
  failure *f = &v->failure;
  orbit *o = orbit_new(c, f);
  bool holds = o && flow_prepare(o, f) && existence_prepare(&k, o, inverse, f);
  if (holds) {
    /* the larger radius first, so that k.image is finally that of the smaller one */
    LOCAL(arb) radius = {0};
    double ratio;
    existence_measure(&k);
    for (int i = 1; i >= 0 && holds; i--) {
      arb_set_fmpq(radius, i ? c->uniqueness_radius : c->radius, o->precision);
      holds = existence_holds(&k, radius, &ratio);
      if (!holds)
        refute(f, -1, -1, "existence: Krawczyk gives %.2g of the %s", ratio, i ? "uniqueness radius" : "radius");
    }
    v->exists = holds;
  }
  if (holds) box_set(o, k.image);
  holds = holds && sequence_check(o, f);
  if (holds) multipliers(o, &v->quantities, f);
  holds = holds && response_quantities(o, &v->quantities, f) && claims_hold(c, v);
  existence_free(&k);
  orbit_free(o);
  return holds;
}
