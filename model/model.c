/* model.c - see model.h. */
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

hc_status model_new(int n_contacts, model **out)
{
  *out = NULL;
  if (n_contacts < 0) return HC_BAD_INPUT;
  model *m = calloc(1, sizeof *m);
  if (!m) return HC_NO_MEMORY;
  m->n_contacts = n_contacts;
  if (n_contacts > 0 && !(m->contacts = calloc((size_t)n_contacts, sizeof *m->contacts))) {
    free(m);
    return HC_NO_MEMORY;
  }
  *out = m;
  return HC_OK;
}

hc_status model_copy(const model *m, model **out)
{
  hc_status st = model_new(m->n_contacts, out);
  if (st != HC_OK) return st;
  model_contact *contacts = (*out)->contacts;
  **out = *m;
  (*out)->contacts = contacts;
  if (contacts) memcpy(contacts, m->contacts, (size_t)m->n_contacts * sizeof *contacts);
  return HC_OK;
}

void model_free(model *m)
{
  if (!m) return;
  free(m->contacts);
  free(m);
}

void model_direction(double angle_deg, double *tangent, double *normal)
{
  const double deg = 0.017453292519943295769; /* pi/180 */
  *tangent = angle_deg == 90 ? 0.0 : cos(angle_deg * deg);
  *normal = angle_deg == 0 ? 0.0 : sin(angle_deg * deg);
}

double model_stuck_stiffness(const model_contact *c)
{
  return c->law.kt * c->tangent * c->tangent + c->law.kn * c->normal * c->normal;
}

double model_max_stiffness(const model *m)
{
  double k = m->stiffness;
  for (int j = 0; j < m->n_contacts; ++j) k += model_stuck_stiffness(&m->contacts[j]);
  return k;
}
