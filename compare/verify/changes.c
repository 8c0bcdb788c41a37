/* changes.c - see changes.h. A constant force on the mass is carried by a static displacement d: with x = d + y the
 * contacts feel y at the gap + n d (n: normal direction), so that
 *     K d + sum_j n_j kn_j (n_j d) [+ what the constant force is] = 0
 * and y moves as x does in the model with those gaps. A slider follows d, and feels nothing of it. */
#include "compare/verify/changes.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"

static const struct {
  int cause;
  const char *words;
  bool factor;
} changes[] = {
#define VERIFY_CHANGE_WORDS(code, cause, words, factor) {cause, words, factor},
    VERIFY_CHANGE_LIST(VERIFY_CHANGE_WORDS)
#undef VERIFY_CHANGE_WORDS
};

int verify_change_cause(verify_change c) { return changes[c].cause; }
const char *verify_change_words(verify_change c) { return changes[c].words; }
bool verify_change_has_factor(verify_change c) { return changes[c].factor; }

/* ---- numbers of the model ---- */

static void turn(model_contact *c, double angle_deg) { model_direction(angle_deg, c->tangent, c->normal); }

static void change_contact(model_contact *c, verify_change change, double factor)
{
  const double kt = c->law.kt, tangent = *c->tangent, angle = atan2(*c->normal, *c->tangent), degree = TWO_PI / 360;
  switch (change) {
  case CHANGE_KT: c->law.kt *= factor; break;
  case CHANGE_KN: c->law.kn *= factor; break;
  case CHANGE_FRICTION: c->law.mu *= factor; break;
  case CHANGE_GAP: c->law.gap *= factor; break;
  case CHANGE_CONTACT_FORCE: c->law.kt *= factor, c->law.kn *= factor; break;
  case CHANGE_GAP_SIGN: c->law.gap = -c->law.gap; break;
  case CHANGE_ANGLE_COMPLEMENT: *c->tangent = *c->normal, *c->normal = tangent; break;
  case CHANGE_ANGLE_IN_RADIANS: turn(c, angle / (degree * degree)); break;
  case CHANGE_ANGLE_IN_DEGREES: turn(c, angle); break;
  case CHANGE_EXCHANGED: c->law.kt = c->law.kn, c->law.kn = kt; break;
  case CHANGE_NO_FRICTION: c->law.mu = 0; break;
  case CHANGE_NO_KT: c->law.kt = 0; break;
  default: break;
  }
}

static void change_mass(model *m, verify_change change, double factor)
{
  if (change == CHANGE_FORCE) *m->loads[0].cosine *= factor;
  if (change == CHANGE_MASS) *m->mass *= factor;
  if (change == CHANGE_DAMPING) *m->damping *= factor;
  if (change == CHANGE_STIFFNESS) *m->stiffness *= factor;
  if (change == CHANGE_STUCK) *m->stiffness = model_max_stiffness(m);
  if (change == CHANGE_STUCK || change == CHANGE_NO_CONTACT) m->n_contacts = 0;
}

/* ---- constant forces ---- */

/* The displacement by a constant force on the mass, with mean_factor times the contacts' force in the balance; the gaps
 * follow it. HC_BAD_INPUT if that opens a contact under preload. */
static hc_status displace(model *m, double force, double mean_factor, bool all_linear, double *d)
{
  double stiffness = *m->stiffness;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    if (all_linear || c->law.gap > 0) stiffness += mean_factor * c->law.kn * *c->normal * *c->normal;
  }
  if (!(stiffness > 0)) return HC_BAD_INPUT;
  *d = force / stiffness;
  for (int j = 0; j < m->n_contacts; ++j) {
    model_contact *c = &m->contacts[j];
    const double before = c->law.gap;
    c->law.gap += *c->normal * *d;
    if (!all_linear && (c->law.gap > 0) != (before > 0)) return HC_BAD_INPUT;
  }
  return HC_OK;
}

/* sum_j n_j kn_j gap_j of the contacts under preload, or of those with a clearance. */
static double static_force(const model *m, bool preloaded)
{
  double sum = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    if ((c->law.gap > 0) == preloaded) sum += *c->normal * c->law.kn * c->law.gap;
  }
  return sum;
}

/* ---- more contacts ---- */

/* A contact on the other side, which pulls where the first would be separated: max(kn g, 0) - max(-kn g, 0) = kn g. */
static void other_side(const model_contact *c, bool rubs, model_contact *other)
{
  other->law = c->law;
  *other->tangent = *c->tangent;
  *other->normal = -*c->normal;
  other->law.gap = -c->law.gap;
  if (!rubs) other->law.kt = other->law.mu = 0;
}

/* T of a contact with N0, N of it without friction. */
static void held_by_preload(const model_contact *c, model_contact *held)
{
  held->law = c->law;
  *held->tangent = *c->tangent;
  *held->normal = 0;
}

static hc_status double_contacts(const model *m, verify_change change, bool keep_mean, model **out, double *offset)
{
  const int n = m->n_contacts;
  hc_status st = model_oscillator(*m->mass, *m->damping, *m->stiffness, model_force(m), 2 * n, out);
  if (st != HC_OK) return st;
  model_contact *contacts = (*out)->contacts;
  for (int j = 0; j < n; ++j) {
    contacts[j].law = m->contacts[j].law;
    *contacts[j].tangent = *m->contacts[j].tangent;
    *contacts[j].normal = *m->contacts[j].normal;
  }
  (*out)->n_contacts = n; /* the others follow */
  const bool linear = change == CHANGE_NO_SEPARATION || change == CHANGE_NO_SEPARATION_PULLS;
  if (linear && keep_mean) st = displace(*out, -static_force(m, false), 1, true, offset);
  for (int j = 0; j < n; ++j) {
    model_contact *c = &contacts[j];
    if (linear) other_side(c, change == CHANGE_NO_SEPARATION_PULLS, &contacts[n + j]);
    else held_by_preload(c, &contacts[n + j]);
    if (!linear) c->law.kt = c->law.mu = 0;
    if (change == CHANGE_CONSTANT_LIMIT_LINEAR) *(*out)->stiffness += c->law.kn * *c->normal * *c->normal;
    if (change == CHANGE_CONSTANT_LIMIT_LINEAR || change == CHANGE_CONSTANT_N) c->law.kn = 0;
  }
  (*out)->n_contacts = 2 * n;
  return st;
}

/* ---- all of them ---- */

static bool doubles(verify_change c) { return c >= CHANGE_NO_SEPARATION && c <= CHANGE_CONSTANT_LIMIT_LINEAR; }

static bool same_model(const model *a, const model *b)
{
  if (a->n_contacts != b->n_contacts) return false;
  bool same = *a->mass == *b->mass && *a->damping == *b->damping && *a->stiffness == *b->stiffness;
  same &= model_force(a) == model_force(b);
  for (int j = 0; j < a->n_contacts; ++j) {
    const model_contact *p = &a->contacts[j], *q = &b->contacts[j];
    same &= p->law.kt == q->law.kt && p->law.kn == q->law.kn && p->law.mu == q->law.mu && p->law.gap == q->law.gap;
    same &= fabs(*p->tangent - *q->tangent) < 1e-12 && fabs(*p->normal - *q->normal) < 1e-12;
  }
  return same;
}

static bool any_preload(const model *m)
{
  bool any = false;
  for (int j = 0; j < m->n_contacts; ++j) any |= m->contacts[j].law.gap > 0;
  return any;
}

/* A fit passes through it. */
static bool factor_is_one(verify_change c, double factor) { return verify_change_has_factor(c) && factor == 1; }

static hc_status change_copy(const model *m, verify_change c, double factor, bool keep_mean, model *own, double *offset,
                             double *mean_error)
{
  change_mass(own, c, factor);
  for (int j = 0; j < own->n_contacts; ++j) change_contact(&own->contacts[j], c, factor);
  const double preload = static_force(m, true);
  if (c == CHANGE_MEAN || c == CHANGE_MEAN_OF_N) {
    if (!keep_mean || m->n_contacts == 0) return HC_BAD_INPUT;
    *mean_error = factor - 1;
    if (c == CHANGE_MEAN) return HC_OK;
    return preload != 0 ? displace(own, -(factor - 1) * preload, factor, false, offset) : HC_BAD_INPUT;
  }
  if (c == CHANGE_PRELOAD_ADDED && (!keep_mean || preload == 0)) return HC_BAD_INPUT;
  if (c == CHANGE_PRELOAD_ADDED) return displace(own, -preload, 1, false, offset);
  return factor_is_one(c, factor) || !same_model(m, own) ? HC_OK : HC_BAD_INPUT;
}

hc_status verify_changed_model(const model *m, verify_change c, double factor, bool keep_mean, model **out,
                               double *offset, double *mean_error)
{
  const bool constant = c >= CHANGE_CONSTANT_N && c <= CHANGE_CONSTANT_LIMIT_LINEAR;
  *out = NULL;
  *offset = *mean_error = 0;
  if (doubles(c) && (m->n_contacts == 0 || (constant && !any_preload(m)))) return HC_BAD_INPUT;
  hc_status st = doubles(c) ? double_contacts(m, c, keep_mean, out, offset) : model_copy(m, out);
  if (st == HC_OK && c != CHANGE_NONE && !doubles(c))
    st = change_copy(m, c, factor, keep_mean, *out, offset, mean_error);
  if (st == HC_OK) return HC_OK;
  model_free(*out);
  *out = NULL;
  return st;
}
