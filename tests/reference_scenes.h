/* reference_scenes.h - the eight scenes of the reference numbers in tests/reference/, once: what is simulated, and a
 * sweep that holds every reference frequency. What a solver needs beside them is its tests' own. */
#pragma once

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REFERENCE_FRICTION 0.3 /* in all, at 45 degrees */
#define REFERENCE_ANGLE    45

typedef struct reference_scene {
  const char *name;
  double mass, damping, stiffness, force, kt, kn, gap;
  double omega_from, omega_to;
} reference_scene;

static const reference_scene reference_scenes[] = {
    {"a10", 1, 0.4, 40, 10, 100, 200, 0.5, 3, 20},
    {"b10", 1, 0.4, 40, 10, 100, 200, -0.5, 3, 20},
    {"c2", 1, 0.4, 40, 100, 100, 1000, -5, 3, 20},
    {"c2kn1e4", 1, 0.4, 40, 100, 100, 1e4, -5, 3, 20},
    {"c2kt1e4", 1, 0.4, 40, 100, 1e4, 1000, -5, 3, 20},
    {"gap1", 1, 0.4, 40, 100, 100, 1000, 1, 3, 30},
    /* slow: contraction 0.9989 a period */
    {"r1", 1.6, 0.4, 8e5, 100, 5e5, 7e5, 0.3, 750, 1050},
    {"r2", 1.6, 0.4, 8e5, 100, 5e5, 7e5, -0.2, 600, 850},
};
enum { N_REFERENCE_SCENES = sizeof reference_scenes / sizeof *reference_scenes };

/* The program ends if there is none: benchmarks have no test to fail. */
static inline const reference_scene *reference_scene_named(const char *name)
{
  for (int i = 0; i < N_REFERENCE_SCENES; ++i)
    if (!strcmp(reference_scenes[i].name, name)) return &reference_scenes[i];
  fprintf(stderr, "no reference scene %s\n", name);
  abort();
}
