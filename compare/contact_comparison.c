/* contact_comparison.c - see contact_comparison.h. Proof: tests/compare/test_contacts.c. */
#include "compare/contact_comparison.h"

#include <math.h>
#include <stdio.h>

#include "compare/discrepancy.h"

static const double negligible = 1e-6; /* [1] work, of T^2/kt */

static double spring_energy(const contact *law, const contact_period *p)
{
  return law->kt > 0 ? p->traction_max * p->traction_max / law->kt : 0;
}

/* [force length] What work is measured by: the largest of any contact on either side. */
static double work_unit(int n, const model_contact *contacts, const contact_comparison *c)
{
  double most = 0;
  const model_contact *of = contacts;
  for (int j = 0; j < n; ++j) {
    most = fmax(most, fmax(c[j].hbm.work, c[j].transient.work));
    most = fmax(most, negligible * spring_energy(&of->law, &c[j].hbm));
    most = fmax(most, negligible * spring_energy(&of->law, &c[j].transient));
    of += of->pair == CONTACT_FIRST ? 2 : 1;
  }
  return most;
}

static void judge(double unit, double allowed, bool mean_free, contact_comparison *c)
{
  const contact_period *h = &c->hbm, *t = &c->transient;
  c->work_error = discrepancy_relative(h->work - t->work, unit);
  c->normal_error =
      mean_free ? NAN : discrepancy_relative(h->normal_min - t->normal_min, fmax(h->normal_max, t->normal_max));
  const bool both_touch = (h->regime == CONTACT_LINEAR) == (t->regime == CONTACT_LINEAR);
  const bool same = both_touch && c->work_error <= allowed && (mean_free || c->normal_error <= allowed);
  c->differs = c->one_orbit && !same;
}

void contact_comparison_judge(int n, const model_contact *contacts, double allowed, bool mean_free,
                              contact_comparison *c)
{
  bool known = true;
  for (int j = 0; j < n; ++j) known = known && c[j].hbm_status == HC_OK && c[j].transient_status == HC_OK;
  const double unit = known ? work_unit(n, contacts, c) : NAN;
  for (int j = 0; j < n; ++j) {
    c[j].work_error = c[j].normal_error = NAN;
    c[j].differs = false;
    if (known) judge(unit, allowed, mean_free, &c[j]);
  }
}

bool contact_comparison_made(const contact_comparison *c) { return c->one_orbit && !isnan(c->work_error); }

const char *contact_comparison_text(const contact_comparison *c, char text[CONTACT_COMPARISON_TEXT])
{
  const contact_period *h = &c->hbm, *t = &c->transient;
  char who[RESPONSE_NAME];
  if (*c->name) snprintf(who, sizeof who, "%s", c->name);
  else snprintf(who, sizeof who, "%d", c->contact);
  if (h->regime != t->regime)
    snprintf(text, CONTACT_COMPARISON_TEXT, "contact %s: %s by HBM, %s by the transient; work %.4g and %.4g", who,
             contact_regime_name(h->regime), contact_regime_name(t->regime), h->work, t->work);
  else if (c->work_error > c->normal_error || isnan(c->normal_error))
    snprintf(text, CONTACT_COMPARISON_TEXT,
             "contact %s: work %.4g by HBM, %.4g by the transient, %.2g %% of the largest apart: so is the damping",
             who, h->work, t->work, 100 * c->work_error);
  else
    snprintf(text, CONTACT_COMPARISON_TEXT, "contact %s: least normal force %.4g by HBM, %.4g by the transient", who,
             h->normal_min, t->normal_min);
  return text;
}
