/* scenes.c - see scenes.h.
 *
 * kn, kt 1e0..1e8; mu 0..3; angle 0..90 degrees; gap -10..10; F0 1e-6..1e6; damping ratio 0..0.5; mass 1e-3..1e3;
 * stiffness 1e0..1e6; 1 to 4 contacts; H 1..50; N 16..2^14; harmonic 0 kept or not; both kinds of force, both laws.
 * Ends of ranges where something special happens (mu = 0, 0 and 90 degrees, gap = 0, no damping) are points of
 * measure zero and would never be drawn: each gets a twentieth of its range. A force drawn from twelve decades
 * mostly moves the mass either far less than the gap or far more: for two scenes in three it is drawn such that the
 * gap is just reached. The frequency lies near the free resonance, near that of the stuck mass, or between; not so
 * low that the stuck mass makes more than MOST_OSCILLATIONS in a period, which only costs time. In a sixth of the
 * scenes a cubic spring holds the mass, and hardly a linear one; in one of 24 it moves between two equal stops. */
#include "compare/stress/scenes.h"

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_rng.h>
#include <string.h>

#include "model/casefile/fields.h"
#include "numerics/random.h"

enum {
  MASS,
  STIFFNESS,
  DAMPING,
  FORCE_WAY,
  FORCE,
  PLACE,
  BESIDE,
  CONTACTS,
  HARMONICS,
  SAMPLES,
  KEEP_MEAN,
  LAW,
  SAMPLED,
  CONTACT
};
enum { KN, KT, MU, ANGLE, GAP, PER_CONTACT };
enum { MOST_CONTACTS = 4, MOST_OSCILLATIONS = 500 };
_Static_assert(STRESS_DIMENSIONS == CONTACT + MOST_CONTACTS * PER_CONTACT, "of the sequence");

static const double special = 0.05; /* part of a range's draws that go to its special point */

struct stress_scenes {
  unsigned long seed;
  double shift[STRESS_DIMENSIONS]; /* added modulo 1 to every point (Cranley and Patterson): what the seed decides */
  gsl_qrng *sobol;
  long next; /* index of the point that sobol gives next */
};

hc_status stress_scenes_new(unsigned long seed, stress_scenes **out)
{
  *out = NULL;
  stress_scenes *s = calloc(1, sizeof *s);
  gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
  if (s && random && (s->sobol = gsl_qrng_alloc(gsl_qrng_sobol, STRESS_DIMENSIONS))) {
    gsl_rng_set(random, seed);
    for (int d = 0; d < STRESS_DIMENSIONS; ++d) s->shift[d] = gsl_rng_uniform(random);
    s->seed = seed;
    *out = s;
  } else free(s);
  if (random) gsl_rng_free(random);
  return *out ? HC_OK : HC_NO_MEMORY;
}

void stress_scenes_free(stress_scenes *s)
{
  if (!s) return;
  gsl_qrng_free(s->sobol);
  free(s);
}

unsigned long stress_scenes_seed(const stress_scenes *s) { return s->seed; }

void stress_scenes_point(stress_scenes *s, long index, double p[STRESS_DIMENSIONS])
{
  if (index < s->next) {
    gsl_qrng_init(s->sobol);
    s->next = 0;
  }
  for (; s->next <= index; ++s->next) gsl_qrng_get(s->sobol, p);
  for (int d = 0; d < STRESS_DIMENSIONS; ++d) {
    p[d] += s->shift[d];
    p[d] -= floor(p[d]);
  }
}

static double geometric(double u, double from, double to) { return from * pow(to / from, u); }

/* One scene in so many is of a kind. Keys leave the scenes that tests name, drawn before there was the kind, what they
 * were. */
static bool is_of_kind(const stress_scenes *s, long index, uint64_t key_of_kind, double part, uint64_t *random)
{
  uint64_t key = (((uint64_t)s->seed << 32) + (uint64_t)index) ^ key_of_kind << 48;
  *random = random_bits(&key);
  return random_unit(random) < part;
}

bool stress_scenes_cubic(const stress_scenes *s, long index, uint64_t *random)
{
  return is_of_kind(s, index, 0x1a7, 1.0 / 6, random);
}

bool stress_scenes_facing(const stress_scenes *s, long index, uint64_t *random)
{
  return is_of_kind(s, index, 0x1224, 1.0 / 24, random);
}

bool stress_scenes_circles(const stress_scenes *s, long index, uint64_t *random)
{
  return is_of_kind(s, index, 0x393, 1.0 / 10, random);
}

double stress_scenes_weak(uint64_t *random)
{
  return random_unit(random) < 1.0 / 3 ? 1e-9 : geometric(random_unit(random), 1e-6, 1e-3);
}

/* u beyond the part of the special point, mapped to 0..1 again. */
static double beyond(double u) { return (u - special) / (1 - special); }

static double angle(double u)
{
  if (u < special) return 0;
  if (u > 1 - special) return 90;
  return 90 * (u - special) / (1 - 2 * special);
}

static scene_contact contact_at(const double *p)
{
  scene_contact c;
  field_contact_defaults(&c);
  c.law.kn = geometric(p[KN], 1, 1e8);
  c.law.kt = geometric(p[KT], 1, 1e8);
  c.law.mu = p[MU] < special ? 0 : 3 * beyond(p[MU]);
  c.law.gap = p[GAP] < special ? 0 : -10 + 20 * beyond(p[GAP]);
  c.angle_deg = angle(p[ANGLE]);
  return c;
}

/* A cubic spring as stiff as the linear one at the motion x, and next to nothing of that one: in the place of the last
 * contact, or beside the only one. false: out of memory. */
static bool weaken(uint64_t *random, double x, scene_structure *s)
{
  if (s->n_contacts == 1 && !structure_add_contact(s)) return false;
  scene_contact *c = &s->contacts[s->n_contacts - 1].given;
  field_contact_defaults(c);
  c->kind = CONTACT_POLYNOMIAL;
  c->law = (contact){0};
  c->law.power[3 - CONTACT_LEAST_POWER] = *s->stiffness.v / (x * x);
  *s->stiffness.v *= stress_scenes_weak(random);
  return true;
}

/* In the place of all contacts two stops as stiff as the first, at its gap on either side. */
static void face(scene_structure *s)
{
  scene_contact *c = &s->contacts[0].given;
  const double gap = fmax(fabs(c->law.gap), 1e-3), stop = gap + 1, force = c->law.kn;
  const double points[4][2] = {{-stop, -force}, {-gap, 0}, {gap, 0}, {stop, force}};
  field_contact_defaults(c);
  c->law = (contact){0};
  c->kind = SCENE_LAW_TABLE;
  c->n_points = 4;
  memcpy(c->points, points, sizeof points);
  while (s->n_contacts > 1) structure_drop_contact(s, s->n_contacts - 1);
}

/* [force/length] without contacts. */
static double dynamic_stiffness(const scene_structure *s, double omega)
{
  return hypot(*s->stiffness.v - *s->mass.v * omega * omega, *s->damping.v * omega);
}

/* The force that moves the mass without contacts by about the first gap, or from all of the range. */
static double force_at(const double *p, const scene_structure *s, double omega)
{
  if (p[FORCE_WAY] < 1.0 / 3) return geometric(p[FORCE], 1e-6, 1e6);
  double reach = fmax(fabs(s->contacts[0].given.law.gap), 1e-3) * geometric(p[FORCE], 0.2, 50);
  double f = reach * dynamic_stiffness(s, omega);
  return fmin(fmax(f, 1e-6), 1e6);
}

static double frequency(const double *p, const scene *sc)
{
  const double mass = *sc->structure->mass.v;
  double low = sqrt(*sc->structure->stiffness.v / mass), high = sqrt(scene_max_stiffness(sc) / mass);
  double between = fmin(fmax(1.5 * p[PLACE] - 0.25, 0), 1); /* a sixth of all at either end */
  double omega = low * pow(high / low, between) * geometric(p[BESIDE], 0.4, 2.5);
  return fmax(omega, high / MOST_OSCILLATIONS);
}

hc_status stress_scenes_at(stress_scenes *s, long index, scene *out)
{
  double p[STRESS_DIMENSIONS];
  if (index < 0) return HC_BAD_INPUT;
  stress_scenes_point(s, index, p);
  scene sc;
  field_defaults(&sc);
  snprintf(sc.title, sizeof sc.title, "Stress scene %ld of seed %lu", index, s->seed);
  const double mass = geometric(p[MASS], 1e-3, 1e3), stiffness = geometric(p[STIFFNESS], 1, 1e6);
  double ratio = p[DAMPING] < special ? 0 : geometric(beyond(p[DAMPING]), 1e-5, 0.5);
  scene_structure *t = sc.structure = structure_new_oscillator(mass, 2 * ratio * sqrt(mass * stiffness), stiffness, 0);
  const int n_contacts = 1 + (int)(MOST_CONTACTS * p[CONTACTS]);
  bool failed = !t;
  for (int j = 0; j < n_contacts && !failed; ++j) {
    structure_contact *c = structure_add_contact(t);
    failed = !c;
    if (c) c->given = contact_at(p + CONTACT + j * PER_CONTACT);
  }
  if (failed) return structure_free(t), HC_NO_MEMORY;
  double omega = frequency(p, &sc);
  t->loads->amplitude = force_at(p, t, omega);
  uint64_t random;
  const bool cubic = stress_scenes_cubic(s, index, &random);
  if (cubic && !weaken(&random, t->loads->amplitude / dynamic_stiffness(t, omega), t))
    return structure_free(t), HC_NO_MEMORY;
  if (!cubic && stress_scenes_facing(s, index, &random)) face(t);
  sc.compare.omega = (number_list){1, {omega}};
  sc.hbm.harmonics = (int)geometric(p[HARMONICS], 1, 50.999);
  sc.hbm.samples = (int)geometric(p[SAMPLES], 16, 16384.999);
  if (sc.hbm.samples < 2 * sc.hbm.harmonics + 1) sc.hbm.samples = 2 * sc.hbm.harmonics + 1;
  sc.hbm.keep_mean = p[KEEP_MEAN] < 0.8;
  sc.hbm.force = p[SAMPLED] < 0.3 ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT;
  /* between the two ends a sampled curve may have thousands of false turning points, which only cost time */
  const double reach = sc.hbm.force == HBM_FORCE_SAMPLED ? 0.02 : 0.2;
  sc.omega_from = (1 - reach) * omega;
  sc.omega_to = (1 + reach) * omega;
  sc.transient.law = p[LAW] < 0.5 ? TRANSIENT_LAW_REGULARISED : TRANSIENT_LAW_EXACT;
  sc.transient.max_periods = 300; /* a motion that has not settled by then is no check of anything */
  *out = sc;
  return HC_OK;
}
