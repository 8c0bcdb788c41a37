/* scenes.h - what the tests of timeint/ share: the reference scenes and others, settings at their defaults. */
#ifndef HC_TESTS_SCENES_H
#define HC_TESTS_SCENES_H

#include <string.h>

#include "casefile/scene.h"
#include "tests/reference_scenes.h"
#include "timeint/steady.h"
#include "timeint/timeint.h"

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

static inline scene scene_reference(const char *name)
{
  const reference_scene *r = reference_scene_named(name);
  scene sc = scene_linear(r->mass, r->damping, r->stiffness, r->force);
  scene_add(&sc, r->kt, r->kn, REFERENCE_FRICTION, r->gap, REFERENCE_ANGLE);
  return sc;
}

static inline scene scene_a10(void) { return scene_reference("a10"); }
static inline scene scene_b10(void) { return scene_reference("b10"); }
static inline scene scene_c2(void) { return scene_reference("c2"); }
static inline scene scene_c2kn1e4(void) { return scene_reference("c2kn1e4"); }
static inline scene scene_c2kt1e4(void) { return scene_reference("c2kt1e4"); }
static inline scene scene_gap1(void) { return scene_reference("gap1"); }
static inline scene scene_r1(void) { return scene_reference("r1"); }
static inline scene scene_r2(void) { return scene_reference("r2"); }

#endif
