/* contact_period.c - see contact_period.h. */
#include "model/contact_period.h"

contact_period contact_period_of_pair(const contact_period *first, const contact_period *second)
{
  return (contact_period){.regime = contact_regime_larger(first->regime, second->regime),
                          .normal_min = first->normal_min + second->normal_min,
                          .normal_max = first->normal_max + second->normal_max,
                          .traction_max = fmax(first->traction_max, second->traction_max),
                          .slip_distance = first->slip_distance + second->slip_distance,
                          .work = first->work + second->work};
}

void contact_periods_merge(const model *m, contact_period *p)
{
  int n = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const bool second = contact_goes_on(m->contacts[j].pair) && n > 0;
    if (second) p[n - 1] = contact_period_of_pair(&p[n - 1], &p[j]);
    else p[n++] = p[j];
  }
}
