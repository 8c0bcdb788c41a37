/* contact_model.c - the contacts of the model that a contact of the case is; see contact_model.h. */
#include "model/casefile/contact_model.h"

#include <math.h>
#include <string.h>

contact scene_contact_law(const scene_contact *c)
{
  const contact *given = &c->law;
  const bool kinked = c->kind == CONTACT_KINKED, rubs = kinked || c->kind == CONTACT_TANH;
  contact law = {.smooth = scene_contact_is_composed(c) ? CONTACT_KINKED : (contact_smooth)c->kind};
  if (kinked) law.kt = given->kt;
  if (rubs) law.kn = given->kn, law.mu = given->mu, law.gap = given->gap;
  if (c->kind == CONTACT_TANH) law.epsilon = given->epsilon;
  if (c->kind == CONTACT_POLYNOMIAL) memcpy(law.power, given->power, sizeof law.power);
  if (!rubs || !(law.kn > 0)) law.load = rubs ? c->preload : 0;
  else if (c->preload > 0) law.gap = c->preload / law.kn;
  return law;
}

moving_contact scene_moving_contact(const scene_contact *c)
{
  moving_contact out = {.law = scene_contact_law(c), .cv = {1}};
  const bool rubs = c->kind == CONTACT_KINKED || c->kind == CONTACT_TANH;
  if (rubs) model_direction(c->angle_deg, &out.cu[0], &out.cv[0]);
  return out;
}

int scene_contact_parts(const scene_contact *c)
{
  return c->kind == SCENE_LAW_TABLE && c->n_points > 3 ? c->n_points - 2 : 1;
}

static double slope(const scene_contact *c, int i)
{
  return (c->points[i + 1][1] - c->points[i][1]) / (c->points[i + 1][0] - c->points[i][0]);
}

double scene_contact_table(const scene_contact *c, double d)
{
  int i = 0;
  while (i + 2 < c->n_points && d > c->points[i + 1][0]) ++i;
  return c->points[i][1] + slope(c, i) * (d - c->points[i][0]);
}

double scene_contact_slope(const scene_contact *c)
{
  double k = c->kind == SCENE_LAW_TABLE ? slope(c, 0) : 0;
  for (int i = 1; c->kind == SCENE_LAW_TABLE && i + 1 < c->n_points; ++i) k += fmin(slope(c, i) - slope(c, i - 1), 0);
  return k;
}

double scene_contact_stiffness(const scene_contact *c, bool at_rest)
{
  double k = scene_contact_slope(c);
  for (int i = 1; c->kind == SCENE_LAW_TABLE && i + 1 < c->n_points; ++i) {
    const double change = slope(c, i) - slope(c, i - 1);
    if (!at_rest || change * c->points[i][0] < 0) k += fabs(change);
  }
  return k;
}

bool scene_contact_restores(const scene_contact *c, bool at_rest)
{
  const contact law = scene_contact_law(c);
  const int degree = contact_degree(&law);
  bool somewhere = false;
  for (int p = CONTACT_LEAST_POWER; p <= degree; ++p) {
    const double k = law.power[p - CONTACT_LEAST_POWER];
    somewhere |= p % 2 ? k > 0 : k != 0;
  }
  return at_rest ? degree % 2 && law.power[degree - CONTACT_LEAST_POWER] > 0 : somewhere;
}

/* Where the table's slope rises by k at d, there is one spring more: it closes there. Where it falls, one less: it
 * opens there, k long before that; hence the mirrored direction, and scene_contact_slope. */
void scene_contact_put(const scene_contact *c, int n, const double *direction, model_contact *to)
{
  for (int i = 0; i < scene_contact_parts(c); ++i) {
    const double k = i + 2 < c->n_points ? slope(c, i + 1) - slope(c, i) : 0, side = k < 0 ? -1 : 1;
    to[i].law = (contact){.kn = fabs(k), .gap = k == 0 ? 0 : -side * c->points[i + 1][0]};
    to[i].pair = i == 0 ? CONTACT_ALONE : CONTACT_MORE;
    for (int d = 0; d < n; ++d) to[i].normal[d] = side * direction[d];
  }
}
