/* shrink.c - stress_shrink: the fewest contacts, harmonics and digits with which a finding is still one. */
#include <stdio.h>
#include <string.h>

#include "base/number.h"
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

hc_status stress_shrink(scene *sc, stress_kind kind, double seconds, const hc_monitor *monitor)
{
  shrinker s = {kind, seconds, monitor, HC_OK};
  drop_contacts(&s, sc);
  fewer_harmonics(&s, sc);
  round_numbers(&s, sc);
  return s.status;
}
