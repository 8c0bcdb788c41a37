/* scenes.h - the scenes of a stress run: one point of a shifted Sobol sequence each, mapped onto the whole range of
 * every quantity. */
#ifndef HC_STRESS_SCENES_H
#define HC_STRESS_SCENES_H

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

/* That structure with a second tangent of some of its contacts, likewise: space.c. */
hc_status stress_space_at(stress_scenes *s, long index, scene *out);

/* The scene of that number in any of the families. */
hc_status stress_scene_of(stress_scenes *s, stress_family family, long index, scene *out);

/* The same oscillator in smaller units: the number of every length, force and time is multiplied by its factor. */
scene stress_in_units(const scene *sc, double length, double force, double time);

#endif
