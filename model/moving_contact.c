/* moving_contact.c - see moving_contact.h. */
#include "model/moving_contact.h"

#include <stdlib.h>

hc_status moving_contacts_of_model(const model *m, moving_contact **out)
{
  *out = calloc((size_t)m->n_contacts + 1, sizeof **out);
  if (!*out) return HC_NO_MEMORY;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    (*out)[j] = (moving_contact){.law = c->law, .cu = {*c->tangent}, .cv = {*c->normal}};
  }
  return HC_OK;
}

bool moving_contact_has_slider(const moving_contact *c, int n_dof)
{
  bool moves = false;
  for (int d = 0; d < n_dof; ++d) moves |= c->cu[d] != 0;
  return moves && contact_has_friction(&c->law);
}
