/* scenes_impl.h - what the two ways of drawing scenes, scenes.c and structures.c, share. */
#ifndef HC_STRESS_SCENES_IMPL_H
#define HC_STRESS_SCENES_IMPL_H

#include <stdint.h>

#include "stress/scenes.h"

enum { STRESS_DIMENSIONS = 33 };

unsigned long stress_scenes_seed(const stress_scenes *s);

/* Point number `index` of the shifted sequence, each entry in [0, 1). */
void stress_scenes_point(stress_scenes *s, long index, double p[STRESS_DIMENSIONS]);

/* Entries d[n] of a degree of freedom, of a difference of two, or of all. Not all are 0. */
void stress_draw_direction(uint64_t *random, int n, double *d);

/* How many harmonics a structure may have whose contacts act along so many directions. */
int stress_most_harmonics(int n, int n_directions);

#endif
