/* moving_contact.h - a contact and the one or two coordinates that move it, for evaluators of its force. */
#pragma once

#include <stdlib.h>

#include "model/model.h"
#include "numerics/base/status.h"
#include "numerics/series.h"

/* u = sum cu[d] x_d, v = sum cv[d] x_d. */
typedef struct moving_contact {
  contact law;
  double cu[SERIES_MAX_DIM], cv[SERIES_MAX_DIM];
  double rest; /* [length] where the slider of a contact that is never lost begins */
} moving_contact;

/* The contacts of an oscillator, *out to be freed. HC_NO_MEMORY: *out is NULL. */
static inline hc_status moving_contacts_of_model(const model *m, moving_contact **out)
{
  *out = calloc((size_t)m->n_contacts + 1, sizeof **out);
  if (!*out) return HC_NO_MEMORY;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    (*out)[j] = (moving_contact){.law = c->law, .cu = {*c->tangent}, .cv = {*c->normal}};
  }
  return HC_OK;
}

/* Stiffness [force/length] of the stuck contact for its first coordinate: kt cu^2 + kn cv^2. */
static inline double moving_contact_stuck_stiffness(const moving_contact *c)
{
  return c->law.kt * c->cu[0] * c->cu[0] + c->law.kn * c->cv[0] * c->cv[0];
}

/* True if it has friction and its tangential motion u is not always 0. */
static inline bool moving_contact_has_slider(const moving_contact *c, int n_dof)
{
  bool moves = false;
  for (int d = 0; d < n_dof; ++d) moves |= c->cu[d] != 0;
  return moves && contact_has_friction(&c->law);
}
