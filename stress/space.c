/* space.c - random structures in space, see scenes.h: those of structures.c, in which most contacts with friction get a
 * second tangent. One in seven has nearly the line of the first, by 1e-1 .. 1e-4: the motion then is nearly straight,
 * and slip turns about at once. The limit is the circle's in four of five. Numbers come from a generator of its own for
 * each scene: what structures.c draws is what it is without. */
#include <math.h>
#include <stdio.h>

#include "casefile/structure.h"
#include "numerics/random.h"
#include "stress/scenes_impl.h"

static bool is_zero(int n, const double *d)
{
  for (int i = 0; i < n; ++i)
    if (d[i] != 0) return false;
  return true;
}

/* |sin| of the angle between a and b, of which neither is 0. */
static double across(int n, const double *a, const double *b)
{
  double aa = 0, bb = 0, ab = 0;
  for (int i = 0; i < n; ++i) aa += a[i] * a[i], bb += b[i] * b[i], ab += a[i] * b[i];
  return sqrt(fmax(1 - ab * ab / (aa * bb), 0));
}

/* Not along the tangent, which a structure of one degree of freedom could not have. */
static void draw_second_tangent(uint64_t *r, int n, structure_contact *c)
{
  const double least = 0.05;
  do stress_draw_direction(r, n, c->tangent_2);
  while (across(n, c->tangent, c->tangent_2) < least);
  if (random_unit(r) > 1.0 / 7) return;
  const double by = pow(10, -1 - 3 * random_unit(r)), along = 2 * random_signed(r);
  for (int i = 0; i < n; ++i) c->tangent_2[i] = along * c->tangent[i] + by * c->tangent_2[i];
}

static void give_second_tangents(uint64_t *r, scene_structure *s)
{
  for (int j = 0; j < s->n_contacts && s->n > 1; ++j) {
    structure_contact *c = &s->contacts[j];
    if (is_zero(s->n, c->tangent) || random_unit(r) > 0.7) continue;
    draw_second_tangent(r, s->n, c);
    c->given.limit = random_unit(r) < 0.8 ? CONTACT_LIMIT_CIRCLE : CONTACT_LIMIT_SQUARE;
  }
}

static int directions(const scene_structure *s)
{
  int sum = 0;
  for (int j = 0; j < s->n_contacts; ++j) sum += 2 + !is_zero(s->n, s->contacts[j].tangent_2);
  return sum;
}

hc_status stress_space_at(stress_scenes *scenes, long index, scene *out)
{
  const uint64_t other = 0x5eedULL << 48; /* than that of structures.c */
  hc_status st = stress_structures_at(scenes, index, out);
  if (st != HC_OK) return st;
  uint64_t key = (((uint64_t)stress_scenes_seed(scenes) << 32) + (uint64_t)index) ^ other, r = random_bits(&key);
  snprintf(out->title, sizeof out->title, "Stress structure in space %ld of seed %lu", index,
           stress_scenes_seed(scenes));
  give_second_tangents(&r, out->structure);
  const int most = stress_most_harmonics(out->structure->n, directions(out->structure));
  if (out->hbm.harmonics > most) out->hbm.harmonics = most;
  return HC_OK;
}

hc_status stress_scene_of(stress_scenes *scenes, stress_family family, long index, scene *out)
{
  switch (family) {
  case STRESS_SPACE: return stress_space_at(scenes, index, out);
  case STRESS_STRUCTURES: return stress_structures_at(scenes, index, out);
  case STRESS_OSCILLATORS: break;
  }
  return stress_scenes_at(scenes, index, out);
}
