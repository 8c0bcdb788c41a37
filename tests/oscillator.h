/* oscillator.h - scenes of one degree of freedom, made and changed by numbers, for tests, which copy them freely. */
#pragma once

#include <stdlib.h>
#include <string.h>

#include "model/casefile/scene.h"

/* The scene, whose structure lasts as long as the program. */
static inline scene scene_kept(scene sc)
{
  static scene_structure **kept;
  static size_t n;
  scene_structure **longer = realloc(kept, (n + 1) * sizeof *kept);
  if (!longer || !sc.structure) abort();
  (kept = longer)[n++] = sc.structure;
  return sc;
}

/* The same scene, with a structure of its own, to be changed. */
static inline scene scene_own(const scene *sc)
{
  scene own = *sc;
  own.structure = structure_copy(sc->structure);
  return scene_kept(own);
}

/* No contacts, no sweep, settings of zeros. */
static inline scene scene_oscillator(double mass, double damping, double stiffness, double force)
{
  scene sc;
  memset(&sc, 0, sizeof sc);
  sc.structure = structure_new_oscillator(mass, damping, stiffness, force);
  return scene_kept(sc);
}

static inline void scene_add_contact(scene *sc, scene_contact c)
{
  structure_contact *more = structure_add_contact(sc->structure);
  if (!more) abort();
  more->given = c;
}

/* The first n contacts are left. */
static inline void scene_keep_contacts(const scene *sc, int n)
{
  while (sc->structure->n_contacts > n) structure_drop_contact(sc->structure, sc->structure->n_contacts - 1);
}

/* The same numbers, to the bit. */
static inline bool scene_equals(const scene *a, const scene *b)
{
  const scene_structure *s = a->structure, *t = b->structure;
  scene one = *a, other = *b;
  one.structure = other.structure = NULL;
  bool same = !memcmp(&one, &other, sizeof one) && s->is_oscillator && t->is_oscillator;
  same &= !memcmp(s->mass.v, t->mass.v, sizeof *s->mass.v) && !memcmp(s->damping.v, t->damping.v, sizeof *s->mass.v) &&
          !memcmp(s->stiffness.v, t->stiffness.v, sizeof *s->mass.v);
  same &= !memcmp(&s->loads->amplitude, &t->loads->amplitude, sizeof s->loads->amplitude);
  same &= s->n_contacts == t->n_contacts;
  for (int j = 0; same && j < s->n_contacts; ++j)
    same = !memcmp(&s->contacts[j].given, &t->contacts[j].given, sizeof s->contacts[j].given);
  return same;
}
