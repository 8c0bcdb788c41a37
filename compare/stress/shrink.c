/* shrink.c - stress_shrink: the fewest contacts, loads, DOFs, harmonics and digits of a finding. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/stress/stress.h"
#include "model/casefile/case_file.h"
#include "model/casefile/structure.h"
#include "numerics/base/number.h"
#include "numerics/norm.h"

typedef struct shrinker {
  stress_kind kind;
  double seconds;
  const hc_monitor *monitor;
  hc_status status;
} shrinker;

/* A scene to make smaller, with a structure of its own; false: out of memory, or stopped. */
static bool copy(shrinker *s, const scene *sc, scene *out)
{
  *out = *sc;
  if (s->status != HC_OK) return false;
  if (!(out->structure = structure_copy(sc->structure))) s->status = HC_NO_MEMORY;
  return s->status == HC_OK;
}

/* *smaller becomes *sc if it still finds and holds together, as a case file must; else it is forgotten. */
static bool take(shrinker *s, scene *sc, scene *smaller)
{
  const scene_structure *t = smaller->structure;
  double *x = malloc((size_t)t->n * sizeof *x);
  bool finds = false, adrift = false;
  stress_result r;
  if (!t->is_oscillator && s->status == HC_OK)
    s->status = x ? structure_free_motion(t, false, x, &adrift) : HC_NO_MEMORY;
  free(x);
  if (s->status == HC_OK && !adrift) {
    s->status = stress_scene(smaller, s->kind, s->seconds, s->monitor, &r);
    finds = s->status == HC_OK && r.check[s->kind].outcome == STRESS_FINDING;
  }
  case_clear(finds ? sc : smaller);
  if (finds) *sc = *smaller;
  return finds;
}

/* ---- its numbers ---- */

static double rounded(double x, int digits)
{
  char text[32];
  snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return number_read(text, strlen(text), &x) == NUMBER_FINE ? x : 0;
}

enum { FREQUENCY, OF_OSCILLATOR = 5, OF_CONTACT = 5 };

/* Number k of an oscillator's scene, the frequency first; NULL past the last one. */
static double *number_of(scene *sc, int k)
{
  scene_structure *t = sc->structure;
  double *const own[OF_OSCILLATOR] = {sc->compare.omega.v, t->mass.v, t->damping.v, t->stiffness.v,
                                      &t->loads->amplitude};
  if (k < OF_OSCILLATOR) return own[k];
  if (k >= OF_OSCILLATOR + OF_CONTACT * t->n_contacts) return NULL;
  scene_contact *c = &t->contacts[(k - OF_OSCILLATOR) / OF_CONTACT].given;
  double *const its[OF_CONTACT] = {&c->law.kn, &c->law.kt, &c->law.mu, &c->law.gap, &c->angle_deg};
  return its[(k - OF_OSCILLATOR) % OF_CONTACT];
}

/* One number at a time: with 1 digit, else with 2, 3. The sweep goes along with the frequency. */
static void round_number(shrinker *s, scene *sc, int k)
{
  const double full = *number_of(sc, k);
  scene smaller;
  for (int digits = 1; digits <= 3; ++digits) {
    if (rounded(full, digits) == full || !copy(s, sc, &smaller)) return;
    const double number = *number_of(&smaller, k) = rounded(full, digits);
    if (k == FREQUENCY) smaller.omega_from = 0.8 * number, smaller.omega_to = 1.2 * number;
    if (take(s, sc, &smaller)) return;
  }
}

/* ---- its parts ----
 *
 * What a scene may do without, one at a time and the last first; drop() is false where it cannot be. */
typedef struct part {
  int (*count)(const scene *);
  int least;
  bool (*drop)(scene *, int);
} part;

static void drop_parts(shrinker *s, scene *sc, const part *p)
{
  scene smaller;
  for (int i = p->count(sc) - 1; i >= 0 && p->count(sc) > p->least; --i) {
    if (!copy(s, sc, &smaller)) return;
    if (p->drop(&smaller, i)) take(s, sc, &smaller);
    else case_clear(&smaller);
  }
}

static int count_contacts(const scene *sc) { return sc->structure->n_contacts; }
static int count_loads(const scene *sc) { return sc->structure->n_loads; }
static int count_dofs(const scene *sc) { return sc->structure->n; }

static bool drop_contact(scene *sc, int j)
{
  structure_drop_contact(sc->structure, j);
  return true;
}

static bool drop_load(scene *sc, int i)
{
  scene_structure *t = sc->structure;
  free(t->loads[i].direction);
  t->loads[i] = t->loads[--t->n_loads];
  return true;
}

static bool drop_second_tangent(scene *sc, int j)
{
  const scene_structure *t = sc->structure;
  if (is_zero(t->n, t->contacts[j].tangent_2)) return false;
  memset(t->contacts[j].tangent_2, 0, (size_t)t->n * sizeof(double));
  return true;
}

/* Without row and column k, in place. */
static void drop_row(int n, int k, double *A)
{
  double *to = A;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      if (i != k && j != k) *to++ = A[(size_t)j * (size_t)n + (size_t)i];
}

static void drop_entry(int n, int k, double *v)
{
  for (int i = k; i + 1 < n; ++i) v[i] = v[i + 1];
}

/* Are the tangents along one line, or nearly? A case file has no such two. */
static bool is_line(int n, const double *a, const double *b)
{
  const double ab = dot_product(n, a, b);
  return ab * ab >= (1 - 4e-12) * dot_product(n, a, a) * dot_product(n, b, b);
}

/* Degree of freedom k held: of a structure without names, nodes and damping by modes. */
static bool hold_dof(scene *sc, int k)
{
  scene_structure *t = sc->structure;
  drop_row(t->n, k, t->mass.v);
  drop_row(t->n, k, t->stiffness.v);
  drop_row(t->n, k, t->damping.v);
  for (int i = 0; i < t->n_loads; ++i) drop_entry(t->n, k, t->loads[i].direction);
  for (int j = 0; j < t->n_contacts; ++j) {
    drop_entry(t->n, k, t->contacts[j].tangent);
    drop_entry(t->n, k, t->contacts[j].tangent_2);
    drop_entry(t->n, k, t->contacts[j].normal);
  }
  structure_clear_responses(t);
  t->how = STRUCTURE_DAMPING_MATRIX;
  --t->n;
  /* Could a case file say it? No contact may have lost what it acts along. */
  for (int j = 0; j < t->n_contacts; ++j) {
    const structure_contact *c = &t->contacts[j];
    const bool across = c->given.kind == CONTACT_POLYNOMIAL || c->given.kind == SCENE_LAW_TABLE;
    if (is_zero(t->n, across ? c->normal : c->tangent) && c->given.kind != CONTACT_KINKED) return false;
    if ((c->given.law.kt != 0 && is_zero(t->n, c->tangent)) || (c->given.law.kn != 0 && is_zero(t->n, c->normal)))
      return false;
    if (!is_zero(t->n, c->tangent_2) && is_line(t->n, c->tangent, c->tangent_2)) return false;
  }
  return true;
}

/* With the fewest: a structure not without the harmonics of its loads. */
static void fewer_harmonics(shrinker *s, scene *sc)
{
  scene smaller;
  int least = 1;
  for (int i = 0; i < count_loads(sc); ++i)
    if (sc->structure->loads[i].harmonic > least) least = sc->structure->loads[i].harmonic;
  for (int h = least; h < sc->hbm.harmonics; ++h) {
    if (!copy(s, sc, &smaller)) return;
    smaller.hbm.harmonics = h;
    if (take(s, sc, &smaller)) return;
  }
}

hc_status stress_shrink(scene *sc, stress_kind kind, double seconds, const hc_monitor *monitor)
{
  static const part parts[] = {{count_contacts, 1, drop_contact},
                               {count_contacts, 0, drop_second_tangent},
                               {count_loads, 1, drop_load},
                               {count_dofs, 1, hold_dof}};
  shrinker s = {kind, seconds, monitor, HC_OK};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) drop_parts(&s, sc, &parts[i]);
  fewer_harmonics(&s, sc);
  for (int k = 0; scene_is_oscillator(sc) && number_of(sc, k); ++k) round_number(&s, sc, k);
  return s.status;
}
