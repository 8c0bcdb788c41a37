/* law_line.c - see law_kind.h: a contact with one tangent, T = +-mu N where it slips. The regularised law is
 * law_regularised.h's; under the exact law
 *
 *     stick   mu N - s kt (U - rest), s = +-1        slip(s)   s kt U' - mu kn V'
 * are its guards. Proof: tests/timeint/test_law.c, test_structure.c. */
#include "timeint/law/law_kind.h"

static planar_value evaluate(const law_regularised *c, const contact_motion *at, const double *w)
{
  const law_value l = law_regularised_eval(c, *at->u, at->v, *w);
  return (planar_value){.n = l.n, .change = l.change, .t = {l.t}, .rate = {l.rate}};
}

static planar_derivatives derivatives(const law_regularised *c, const contact_motion *at, const double *w)
{
  const law_derivatives s = law_regularised_derivatives(c, *at->u, at->v, *w);
  return (planar_derivatives){
      .n_v = s.n_v, .t_u = {{s.t_u}}, .t_v = {s.t_v}, .rate_u = {{s.rate_u}}, .rate_v = {s.rate_v}};
}

static int conditions(const contact_track *t, const scaled_contact *c, track_condition conditions[TRACK_GUARDS])
{
  const double kt = c->law.kt, friction = c->law.mu * c->law.kn;
  if (t->state != CONTACT_STICK) {
    conditions[0] =
        (track_condition){.event = TRACK_STICKS, .of_rates = true, .by_u = t->along * kt, .by_v = -friction};
    return 1;
  }
  for (int i = 0; i < 2; ++i)
    conditions[i] = (track_condition){.event = i == 0 ? TRACK_SLIPS_PLUS : TRACK_SLIPS_MINUS,
                                      .by_u = i == 0 ? -kt : kt,
                                      .by_v = friction,
                                      .from_u = t->rest,
                                      .gap = c->law.gap,
                                      .constant = c->law.mu * c->law.load};
  return 2;
}

/* A slip of zero length is not counted: where traction and limit vanish together (a contact that stuck when it touched,
 * one degree of freedom), or where the motion turns at the limit, rounding decides whether it occurs. */
static int counts(contact_track *t, track_event event, double theta)
{
  const double at_once = 1e-6; /* [rad] longest slip that counts as zero: around a turn or a touch it moves the slider
                                  by its square */
  const bool slipped = contact_slip_sign(t->state) != 0, no_length = slipped && theta - t->changed <= at_once;
  t->changed = event == TRACK_TOUCHES ? -INFINITY : theta;
  if (no_length && event == TRACK_SEPARATES) return 0;
  return no_length && event == TRACK_STICKS ? -1 : 1;
}

const law_kind law_line = {
    .directions = 1, .evaluate = evaluate, .derivatives = derivatives, .conditions = conditions, .counts = counts};
