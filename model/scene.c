/* scene.c - geometry of a scene, and which limits hold where. */
#include "model/scene.h"

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

scene_gate scene_gate_at(const scene *sc, double omega)
{
  const scene_gate_ranges *r = &sc->gate_ranges;
  scene_gate g = sc->gate;
  for (int i = 0; 2 * i + 1 < r->omega.n; ++i) {
    if (omega < r->omega.v[2 * i] || omega > r->omega.v[2 * i + 1]) continue;
    g.amplitude = r->amplitude.n ? r->amplitude.v[i] : sc->gate.amplitude;
    g.harmonic_1 = r->harmonic_1.n ? r->harmonic_1.v[i] : sc->gate.harmonic_1;
    g.mean = r->mean.n ? r->mean.v[i] : sc->gate.mean;
    g.waveform = r->waveform.n ? r->waveform.v[i] : sc->gate.waveform;
  }
  return g;
}
