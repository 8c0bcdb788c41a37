/* test_scenes.c - scenes cover every range and its special points; the same numbers give the same scene. */
#include <float.h>

#include "compare/stress/scenes.h"
#include "model/casefile/case_file.h"
#include "tests/check.h"
#include "tests/oscillator.h"

enum { MANY = 4000 };

static stress_scenes *sequence(unsigned long seed)
{
  CHECK_MADE(stress_scenes, s, stress_scenes_new(seed, &s));
  return s;
}

/* What was drawn of one quantity. */
typedef struct range {
  const char *name;
  double low, high, least, most;
} range;
enum { KN, KT, MU, ANGLE, GAP, FORCE, MASS, STIFFNESS, RATIO, HARMONICS, SAMPLES, N_RANGES };

static void take(range *r, double x)
{
  CHECK_LE(r->low, x, "%s", r->name);
  CHECK_LE(x, r->high, "%s", r->name);
  r->least = fmin(r->least, x);
  r->most = fmax(r->most, x);
}

/* 4000 points reach within a hundredth of each end: a Sobol sequence fills every hundredth some 40 times. */
static void check_reach(const range *r, bool geometric)
{
  double low = geometric ? log(r->low) : r->low, high = geometric ? log(r->high) : r->high;
  double least = geometric ? log(r->least) : r->least, most = geometric ? log(r->most) : r->most;
  CHECK_LE(least, low + 0.01 * (high - low), "%s reaches down", r->name);
  /* whole numbers: their last one is 2 % of the range */
  CHECK_LE(high - 0.02 * (high - low), most, "%s reaches up", r->name);
}

static void the_whole_of_every_range_is_drawn(CHECK_STATE)
{
  range r[N_RANGES] = {{"kn", 1, 1e8, 0, 0},      {"kt", 1, 1e8, 0, 0},        {"mu", 0, 3, 0, 0},
                       {"angle", 0, 90, 0, 0},    {"gap", -10, 10, 0, 0},      {"F0", 1e-6, 1e6, 0, 0},
                       {"mass", 1e-3, 1e3, 0, 0}, {"stiffness", 1, 1e6, 0, 0}, {"ratio", 0, 0.5, 0, 0},
                       {"H", 1, 50, 0, 0},        {"N", 16, 16384, 0, 0}};
  for (int i = 0; i < N_RANGES; ++i) r[i].least = INFINITY, r[i].most = -INFINITY;
  stress_scenes *s = sequence(1);
  int contacts[5] = {0}, mean[2] = {0}, zero_mu = 0, angle_0 = 0, angle_90 = 0, zero_gap = 0, undamped = 0, cubics = 0,
      facing = 0;
  for (long i = 0; i < MANY; ++i) {
    CHECK_FILLED(scene, sc, stress_scenes_at(s, i, &sc));
    scene_kept(sc);
    ++contacts[sc.structure->n_contacts];
    ++mean[sc.hbm.keep_mean];
    double ratio = *sc.structure->damping.v / (2 * sqrt(*sc.structure->mass.v * *sc.structure->stiffness.v));
    undamped += *sc.structure->damping.v == 0;
    const bool cubic = sc.structure->contacts[sc.structure->n_contacts - 1].given.kind ==
                       CONTACT_POLYNOMIAL; /* in the place of the stiffness */
    cubics += cubic;
    take(&r[MASS], *sc.structure->mass.v), take(&r[FORCE], sc.structure->loads->amplitude);
    if (!cubic) take(&r[STIFFNESS], *sc.structure->stiffness.v), take(&r[RATIO], ratio * (1 - 4 * DBL_EPSILON));
    take(&r[HARMONICS], sc.hbm.harmonics), take(&r[SAMPLES], sc.hbm.samples);
    const bool faces = sc.structure->contacts[0].given.kind == SCENE_LAW_TABLE;
    facing += faces;
    for (int j = 0; j < sc.structure->n_contacts - cubic && !faces; ++j) {
      const scene_contact *c = &sc.structure->contacts[j].given;
      take(&r[KN], c->law.kn), take(&r[KT], c->law.kt), take(&r[MU], c->law.mu), take(&r[ANGLE], c->angle_deg),
          take(&r[GAP], c->law.gap);
      zero_mu += c->law.mu == 0, zero_gap += c->law.gap == 0, angle_0 += c->angle_deg == 0,
          angle_90 += c->angle_deg == 90;
    }
  }
  stress_scenes_free(s);
  for (int i = 0; i < N_RANGES; ++i)
    check_reach(&r[i], i == KN || i == KT || i == FORCE || i == MASS || i == STIFFNESS);
  for (int n = 1; n <= 4; ++n) CHECK_LE(MANY / 5, contacts[n], "%d contacts", n);
  CHECK_LE(MANY / 10, mean[0], "without harmonic 0");
  /* a twentieth of 10000 contacts, of 4000 scenes; half of that must be there */
  CHECK_LE(250, fmin(fmin(zero_mu, zero_gap), fmin(angle_0, angle_90)), "special points");
  CHECK_LE(100, undamped, "undamped");
  CHECK_LE(MANY / 8, cubics, "cubic springs");
  CHECK_LE(MANY / 48, facing, "equal stops"); /* half of one in 24 */
}

/* In any order; another seed is another scene. */
static void a_scene_comes_again_from_seed_and_index(CHECK_STATE)
{
  stress_scenes *a = sequence(7), *b = sequence(7), *c = sequence(8);
  scene first, again, other;
  for (long i = 0; i < 50; ++i) assert_int_equal(stress_scenes_at(a, i, &first), HC_OK), scene_kept(first);
  assert_int_equal(stress_scenes_at(b, 80, &again), HC_OK), scene_kept(again);
  assert_int_equal(stress_scenes_at(b, 49, &again), HC_OK), scene_kept(again);
  assert_true(scene_equals(&first, &again));
  assert_int_equal(stress_scenes_at(c, 49, &other), HC_OK), scene_kept(other);
  assert_true(*other.structure->mass.v != *first.structure->mass.v &&
              other.structure->contacts[0].given.law.kn != first.structure->contacts[0].given.law.kn);
  assert_int_equal(stress_scenes_at(a, -1, &first), HC_BAD_INPUT);
  stress_scenes_free(a), stress_scenes_free(b), stress_scenes_free(c);
}

/* Every scene is one that a case file may say. */
static void every_scene_is_a_case_file(CHECK_STATE)
{
  stress_scenes *s = sequence(3);
  for (long i = 0; i < 200; ++i) {
    scene sc, back;
    char text[8192] = "";
    case_error err;
    assert_int_equal(stress_scenes_at(s, i, &sc), HC_OK);
    FILE *to = fmemopen(text, sizeof text, "w");
    assert_non_null(to);
    assert_int_equal(case_echo(&sc, to), HC_OK);
    fclose(to);
    if (case_parse("scene", text, strlen(text), 0, NULL, &back, &err) != HC_OK)
      fail_msg("scene %ld: %s", i, err.message);
    assert_true(scene_equals(&sc, &back));
    case_clear(&sc), case_clear(&back);
  }
  stress_scenes_free(s);
}

CHECK_TESTS("stress.scenes", 60, the_whole_of_every_range_is_drawn, a_scene_comes_again_from_seed_and_index,
            every_scene_is_a_case_file)
