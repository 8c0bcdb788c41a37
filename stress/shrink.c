/* shrink.c - stress_shrink: the fewest contacts, loads, degrees of freedom, harmonics and digits with which a finding
 * is still one. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "casefile/case_file.h"
#include "casefile/structure.h"
#include "numerics/norm.h"
#include "stress/stress.h"

typedef struct shrinker {
  stress_kind kind;
  double seconds;
  const hc_monitor *monitor;
  hc_status status;
} shrinker;

static bool still(shrinker *s, const scene *sc)
{
  stress_result r;
  if (s->status != HC_OK) return false;
  s->status = stress_scene(sc, s->seconds, s->monitor, &r);
  return s->status == HC_OK && r.check[s->kind].outcome == STRESS_FINDING;
}

static bool try(shrinker *s, scene *sc, const scene *smaller)
{
  if (!still(s, smaller)) return false;
  *sc = *smaller;
  return true;
}

/* ---- an oscillator ---- */

static void drop_contacts(shrinker *s, scene *sc)
{
  for (int j = sc->n_contacts - 1; j >= 0 && sc->n_contacts > 1; --j) {
    scene smaller = *sc;
    for (int k = j; k + 1 < smaller.n_contacts; ++k) smaller.contacts[k] = smaller.contacts[k + 1];
    --smaller.n_contacts;
    try(s, sc, &smaller);
  }
}

static void fewer_harmonics(shrinker *s, scene *sc)
{
  static const int few[] = {1, 2, 3, 5, 10, 20};
  for (int i = 0; i < 6 && few[i] < sc->hbm.harmonics; ++i) {
    scene smaller = *sc;
    smaller.hbm.harmonics = few[i];
    if (try(s, sc, &smaller)) return;
  }
}

static double rounded(double x, int digits)
{
  char text[32];
  snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return number_read(text, strlen(text), &x) == NUMBER_FINE ? x : 0;
}

/* One number at a time: with 1 digit, else with 2, 3. `spread`: a frequency, which the sweep goes along with. */
static void round_number(shrinker *s, scene *sc, double *number, bool frequency)
{
  const double full = *number;
  for (int digits = 1; digits <= 3; ++digits) {
    const scene before = *sc;
    *number = rounded(full, digits);
    if (*number == full) return;
    if (frequency) sc->omega_from = 0.8 * *number, sc->omega_to = 1.2 * *number;
    const scene smaller = *sc;
    *sc = before;
    if (try(s, sc, &smaller)) return;
  }
}

static void round_numbers(shrinker *s, scene *sc)
{
  round_number(s, sc, &sc->compare.omega.v[0], true);
  double *const own[] = {&sc->mass, &sc->damping, &sc->stiffness, &sc->force};
  for (int i = 0; i < 4; ++i) round_number(s, sc, own[i], false);
  for (int j = 0; j < sc->n_contacts; ++j) {
    scene_contact *c = &sc->contacts[j];
    double *const its[] = {&c->law.kn, &c->law.kt, &c->law.mu, &c->law.gap, &c->angle_deg};
    for (int i = 0; i < 5; ++i) round_number(s, sc, its[i], false);
  }
}

/* ---- a structure ---- */

/* A scene with a structure of its own to make smaller; false: out of memory, or stopped. */
static bool copy(shrinker *s, const scene *sc, scene *out)
{
  *out = *sc;
  if (s->status != HC_OK) return false;
  out->structure = structure_copy(sc->structure);
  if (!out->structure) s->status = HC_NO_MEMORY;
  return out->structure != NULL;
}

/* *smaller takes *sc's place where it is still a finding; else it is forgotten. */
static bool take(shrinker *s, scene *sc, scene *smaller)
{
  double *x = malloc((size_t)smaller->structure->n * sizeof *x);
  bool adrift = true;
  if (s->status == HC_OK) s->status = x ? structure_free_motion(smaller->structure, false, x, &adrift) : HC_NO_MEMORY;
  free(x);
  const bool finds = !adrift && still(s, smaller);
  case_clear(finds ? sc : smaller);
  if (finds) *sc = *smaller;
  return finds;
}

/* What a structure may do without, one at a time and the last first; drop() is false where it cannot be. */
typedef struct part {
  int (*count)(const scene_structure *);
  int least;
  bool (*drop)(scene_structure *, int);
} part;

static void drop_parts(shrinker *s, scene *sc, const part *p)
{
  scene smaller;
  for (int i = p->count(sc->structure) - 1; i >= 0 && p->count(sc->structure) > p->least; --i) {
    if (!copy(s, sc, &smaller)) return;
    if (p->drop(smaller.structure, i)) take(s, sc, &smaller);
    else case_clear(&smaller);
  }
}

static int count_contacts(const scene_structure *t) { return t->n_contacts; }
static int count_loads(const scene_structure *t) { return t->n_loads; }
static int count_dofs(const scene_structure *t) { return t->n; }

static bool drop_contact(scene_structure *t, int j)
{
  free(t->contacts[j].tangent); /* with the others behind it */
  t->contacts[j] = t->contacts[--t->n_contacts];
  return true;
}

static bool drop_load(scene_structure *t, int i)
{
  free(t->loads[i].direction);
  t->loads[i] = t->loads[--t->n_loads];
  return true;
}

static bool drop_second_tangent(scene_structure *t, int j)
{
  if (structure_is_zero(t->contacts[j].tangent_2, t->n)) return false;
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

/* Could a case file say it? No contact may have lost what it acts along. */
static bool is_whole(const scene_structure *t)
{
  for (int j = 0; j < t->n_contacts; ++j) {
    const structure_contact *c = &t->contacts[j];
    if ((c->given.law.kt != 0 && structure_is_zero(c->tangent, t->n)) ||
        (c->given.law.kn != 0 && structure_is_zero(c->normal, t->n)))
      return false;
    if (!structure_is_zero(c->tangent_2, t->n) && is_line(t->n, c->tangent, c->tangent_2)) return false;
  }
  return true;
}

/* Degree of freedom k held: of a structure without names, nodes and damping by modes. */
static bool hold_dof(scene_structure *t, int k)
{
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
  return is_whole(t);
}

static int highest_load(const scene_structure *t)
{
  int most = 1;
  for (int i = 0; i < t->n_loads; ++i)
    if (t->loads[i].harmonic > most) most = t->loads[i].harmonic;
  return most;
}

static void fewer_structure_harmonics(shrinker *s, scene *sc)
{
  scene smaller;
  for (int h = highest_load(sc->structure); h < sc->hbm.harmonics; ++h) {
    if (!copy(s, sc, &smaller)) return;
    smaller.hbm.harmonics = h;
    if (take(s, sc, &smaller)) return;
  }
}

hc_status stress_shrink(scene *sc, stress_kind kind, double seconds, const hc_monitor *monitor)
{
  shrinker s = {kind, seconds, monitor, HC_OK};
  if (sc->structure) {
    static const part parts[] = {{count_contacts, 1, drop_contact},
                                 {count_contacts, 0, drop_second_tangent},
                                 {count_loads, 1, drop_load},
                                 {count_dofs, 1, hold_dof}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) drop_parts(&s, sc, &parts[i]);
    fewer_structure_harmonics(&s, sc);
  } else {
    drop_contacts(&s, sc);
    fewer_harmonics(&s, sc);
    round_numbers(&s, sc);
  }
  return s.status;
}
