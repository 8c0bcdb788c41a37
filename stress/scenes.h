/* scenes.h - the scenes of a stress run: one point of a shifted Sobol sequence each, mapped onto the whole range of
 * every quantity. */
#pragma once

#include "base/status.h"
#include "casefile/scene.h"
#include "stress/stress.h"

typedef struct stress_scenes stress_scenes; /* one a thread */

hc_status stress_scenes_new(unsigned long seed, stress_scenes **out);
void stress_scenes_free(stress_scenes *s);

/* Scene number `index` >= 0; cheap where indices rise. Its one frequency is compare.omega, its sweep lies around it. */
hc_status stress_scenes_at(stress_scenes *s, long index, scene *out);

/* The structure of that number, likewise: structures.c. To be cleared with case_clear. */
hc_status stress_structures_at(stress_scenes *s, long index, scene *out);

/* The scene of that number in any of the families, of which that in space has the structure of that number with a
 * second tangent of some of its contacts. */
hc_status stress_scene_of(stress_scenes *s, stress_family family, long index, scene *out);

/* ---- what both files draw from ---- */

enum { STRESS_DIMENSIONS = 33 };

unsigned long stress_scenes_seed(const stress_scenes *s);

/* Point number `index` of the shifted sequence, each entry in [0, 1). */
void stress_scenes_point(stress_scenes *s, long index, double p[STRESS_DIMENSIONS]);
