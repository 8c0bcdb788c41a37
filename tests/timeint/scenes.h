/* scenes.h - the reference scenes, as C. M, C, K of the paper; mu = 0.3, alpha = 45 degrees; options at their
 * defaults. */
#ifndef HC_TESTS_SCENES_H
#define HC_TESTS_SCENES_H

#include <string.h>

#include "cases/scene.h"
#include "timeint/steady.h"

static inline scene scene_linear(double mass, double damping, double stiffness, double force)
{
  scene sc;
  memset(&sc, 0, sizeof sc);
  sc.mass = mass, sc.damping = damping, sc.stiffness = stiffness, sc.force = force;
  sc.transient.regularisation = 1e-4;
  sc.transient.tolerance = 1e-9;
  sc.transient.max_periods = 20000;
  return sc;
}

static inline void scene_add(scene *sc, double kt, double kn, double mu, double gap, double angle_deg)
{
  sc->contacts[sc->n_contacts++] =
      (scene_contact){.law = {.kt = kt, .kn = kn, .mu = mu, .gap = gap}, .angle_deg = angle_deg};
}

static inline scene scene_paper(double force, double kt, double kn, double gap)
{
  scene sc = scene_linear(1, 0.4, 40, force);
  scene_add(&sc, kt, kn, 0.3, gap, 45);
  return sc;
}

static inline scene scene_a10(void) { return scene_paper(10, 100, 200, 0.5); }
static inline scene scene_b10(void) { return scene_paper(10, 100, 200, -0.5); }
static inline scene scene_c2(void) { return scene_paper(100, 100, 1000, -5); }
static inline scene scene_c2kt1e4(void) { return scene_paper(100, 1e4, 1000, -5); }
static inline scene scene_gap1(void) { return scene_paper(100, 100, 1000, 1); }

static inline scene scene_blade(double gap) /* slow: contraction 0.9989 a period */
{
  scene sc = scene_linear(1.6, 0.4, 8e5, 100);
  scene_add(&sc, 5e5, 7e5, 0.3, gap, 45);
  return sc;
}

static inline scene scene_r1(void) { return scene_blade(0.3); }
static inline scene scene_r2(void) { return scene_blade(-0.2); }

#endif
