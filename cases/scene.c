/* scene.c - geometry of a scene. */
#include "cases/scene.h"

void scene_projection(const scene_contact *c, double *cosine, double *sine)
{
  const double deg = 0.017453292519943295769; /* pi/180 */
  *cosine = c->angle_deg == 90 ? 0.0 : cos(c->angle_deg * deg);
  *sine = c->angle_deg == 0 ? 0.0 : sin(c->angle_deg * deg);
}

double scene_stuck_stiffness(const scene_contact *c)
{
  double co, si;
  scene_projection(c, &co, &si);
  return c->law.kt * co * co + c->law.kn * si * si;
}

double scene_max_stiffness(const scene *sc)
{
  double k = sc->stiffness;
  for (int j = 0; j < sc->n_contacts; ++j) k += scene_stuck_stiffness(&sc->contacts[j]);
  return k;
}
