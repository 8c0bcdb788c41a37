/* scenes.h - the scenes of a stress run, points of a shifted Sobol sequence over every range. */
#pragma once

#include <stdint.h>

#include "compare/stress/stress.h"
#include "model/casefile/scene.h"
#include "numerics/base/status.h"

typedef struct stress_scenes stress_scenes; /* one a thread */

hc_status stress_scenes_new(unsigned long seed, stress_scenes **out);
void stress_scenes_free(stress_scenes *s);

/* Scene number `index` >= 0; cheap where indices rise. Its one frequency is compare.omega, its sweep lies around it. */
hc_status stress_scenes_at(stress_scenes *s, long index, scene *out);

/* The structure of that number, likewise: structures.c. To be cleared with case_clear. */
hc_status stress_structures_at(stress_scenes *s, long index, scene *out);

/* A scene of any family; one in space has the structure of that number with more tangents. */
hc_status stress_scene_of(stress_scenes *s, stress_family family, long index, scene *out);

/* ---- what both files draw from ---- */

enum { STRESS_DIMENSIONS = 33 };

unsigned long stress_scenes_seed(const stress_scenes *s);

/* Has scene number `index` of any family a spring that is cubic, or nearly? Then *random is to be drawn from for it. */
bool stress_scenes_cubic(const stress_scenes *s, long index, uint64_t *random);

/* Do equal stops face each other in scene number `index` of any family; has one in space circles in two contacts or
 * more, under static and turning loads? *random is to be drawn from for it. */
bool stress_scenes_facing(const stress_scenes *s, long index, uint64_t *random);
bool stress_scenes_circles(const stress_scenes *s, long index, uint64_t *random);

/* What is left of a linear stiffness [1] beside it: 1e-6 to 1e-3, or in a third of them as good as nothing. */
double stress_scenes_weak(uint64_t *random);

/* Point number `index` of the shifted sequence, each entry in [0, 1). */
void stress_scenes_point(stress_scenes *s, long index, double p[STRESS_DIMENSIONS]);
