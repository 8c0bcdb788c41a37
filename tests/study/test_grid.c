/* test_grid.c - the grid of a study: lists, ranges and fields that go together, against values worked out by hand. */
#include "tests/study/study_text.h"

static scene scene_of(const study *s, long id)
{
  case_error err = {{0}};
  CHECK_FILLED(scene, sc, study_scene(s, id, &sc, &err));
  return scene_kept(sc);
}

/* 2 x 3 x 2: the last axis is the fastest, so id = 6 i + 2 j + k. */
static void the_last_axis_is_the_fastest(CHECK_STATE)
{
  study *s = good_study(
      "study: t\n" CONTACT_CASE
      "set: {hbm.harmonics: 7}\nvary:\n  - hbm.samples: [32, 128]\n  - contacts[0].gap: {from: -1, to: 1, count: 3}\n"
      "  - {forcing.amplitude: [1, 10], hbm.static: [true, false]}\n");
  assert_int_equal(s->n_scenes, 12);
  for (long id = 0; id < 12; ++id) {
    scene sc = scene_of(s, id);
    int i = (int)(id / 6), j = (int)(id / 2 % 3), k = (int)(id % 2);
    assert_int_equal(sc.hbm.samples, i ? 128 : 32);
    CHECK_NEAR(sc.structure->contacts[0].given.law.gap, j - 1.0, 0, "scene %ld", id);
    CHECK_NEAR(sc.structure->loads->amplitude, k ? 10.0 : 1.0, 0, "scene %ld", id);
    assert_int_equal(sc.hbm.keep_mean, !k);
    assert_int_equal(sc.hbm.harmonics, 7);
    assert_int_equal(study_index(s, id, 1), j);
  }
  study_free(s);
}

/* Ends are included as written; linear steps of halves are exact in binary; decades of a log range are exact. */
static void ranges_hit_what_one_expects(CHECK_STATE)
{
  study *s = good_study(
      "study: t\n" CONTACT_CASE "vary:\n  - contacts[0].gap: {from: -5, to: 3, count: 17}\n"
      "  - contacts[0].normal_stiffness: {from: 1e2, to: 1e5, count: 7, scale: log}\n  - oscillator.damping: {from: "
      "0.1, to: 0.7, count: 3}\n");
  for (int i = 0; i < 17; ++i)
    CHECK_NEAR(scene_of(s, i * 21L).structure->contacts[0].given.law.gap, -5 + 0.5 * i, 0, "value %d", i);
  for (int i = 0; i < 7; i += 2)
    CHECK_NEAR(scene_of(s, i * 3L).structure->contacts[0].given.law.kn,
               i == 0   ? 1e2
               : i == 2 ? 1e3
               : i == 4 ? 1e4
                        : 1e5,
               0, "value %d", i);
  /* between decades pow(10, x)'s argument errs by half an ulp of 5: ln(10) 4.5e-16, and half an ulp of its own */
  for (int i = 1; i < 7; i += 2)
    CHECK_NEAR(scene_of(s, i * 3L).structure->contacts[0].given.law.kn / (sqrt(10) * pow(10, 2 + i / 2)), 1, 2e-15,
               "value %d", i);
  CHECK_NEAR(*scene_of(s, 0).structure->damping.v, 0.1, 0, "first");
  CHECK_NEAR(*scene_of(s, 2).structure->damping.v, 0.7, 0, "last");
  study_free(s);
}

/* An integer forgives what a log range rounds: 32 * 2^k. */
static void integers_by_powers_of_two(CHECK_STATE)
{
  study *s = good_study("study: t\n" CASE "vary:\n  - {hbm.samples: {from: 32, to: 4096, count: 8, scale: log}}\n");
  for (int i = 0; i < 8; ++i) assert_int_equal(scene_of(s, i).hbm.samples, 32 << i);
  study_free(s);
}

static void lists_and_rivals_can_vary(CHECK_STATE)
{
  study *s = good_study(
      "study: t\n" CASE
      "vary:\n  - {sweep.frequency: [[1, 2], [2, 1]]}\n  - {compare.omega: [[5], [6, 7]], title: [a, 'b, \"c\"']}\n");
  scene sc = scene_of(s, 3);
  CHECK_NEAR(sc.omega_from, 4 * PI, 4e-15, "2 cycles");
  assert_int_equal(sc.compare.omega.n, 2);
  assert_string_equal(sc.title, "b, \"c\"");
  study_free(s);
}

/* Fields that do not go together are a matter of the scene, told with their place. */
static void a_scene_may_be_impossible(CHECK_STATE)
{
  study *s = good_study("study: t\n" CASE
                        "set: {hbm.force: sampled}\nvary:\n  - {hbm.samples: [32, 8]}\n  - {hbm.harmonics: [3, 4]}\n");
  scene sc;
  case_error err = {{0}};
  for (long id = 0; id < 3; ++id) scene_of(s, id);
  assert_int_equal(study_scene(s, 3, &sc, &err), HC_BAD_INPUT);
  assert_non_null(strstr(err.message, ":5:24: 8 samples cannot tell 4 harmonics apart, expected hbm.samples >= 9"));
  study_free(s);
}

/* The fingerprint is of what is computed, not of spelling, titles and claims. */
static void the_fingerprint_is_of_what_is_computed(CHECK_STATE)
{
  enum { SAME = 3 }; /* of these as many */
  static const char *const all[] = {
      "study: t\n" CASE "vary: [{oscillator.mass: [1, 2, 3]}]\n",
      "study: other\n" CASE "vary: [{oscillator.mass: [1.0, 2e0, 3]}]\nclaims: [{says: a, holds: SELECT 1}]\n",
      "study: t\n" CASE
      "run: compare\nset: {hbm.harmonics: 5}\nvary: [{oscillator.mass: {from: 1, to: 3, count: 3}}]\n",
      "study: t\n" CASE "vary: [{oscillator.mass: [1, 2]}]\n",
      "study: t\n" CASE "vary: [{oscillator.mass: [1, 3, 2]}]\n",
      "study: t\n" CASE "vary: [{oscillator.damping: [1, 2, 3]}]\n",
      "study: t\n" CASE "run: frf\nvary: [{oscillator.mass: [1, 2, 3]}]\n",
      "study: t\n" CASE "set: {hbm.harmonics: 6}\nvary: [{oscillator.mass: [1, 2, 3]}]\n",
  };
  study *first = good_study(all[0]);
  for (size_t i = 1; i < sizeof all / sizeof *all; ++i) {
    study *s = good_study(all[i]);
    assert_int_equal(s->fingerprint == first->fingerprint, i < SAME);
    study_free(s);
  }
  study_free(first);
}

static void the_largest_study(CHECK_STATE)
{
  study *s = good_study(
      "study: t\n" CASE
      "vary:\n  - {oscillator.mass: {from: 1, to: 2, count: 1000}}\n  - {oscillator.damping: {from: 1, to: 2, count: "
      "1000}}\n");
  assert_int_equal(s->n_scenes, 1000000);
  CHECK_NEAR(*scene_of(s, 999999).structure->damping.v, 2, 0, "last");
  CHECK_NEAR(*scene_of(s, 999000).structure->mass.v, 2, 0, "last");
  CHECK_NEAR(*scene_of(s, 999000).structure->damping.v, 1, 0, "first");
  study_free(s);
}

#define STRUCTURE_CASE                                                                                                 \
  "case:\n  structure: {mass: [1, 2], stiffness: [3, 4], damping: {modal: 0.01}, names: [tip, root]}\n"                \
  "  forcing: [{dof: tip, amplitude: 1}]\n  sweep: {omega: [3, 9]}\n"                                                  \
  "  contacts: [{name: joint, tangential_stiffness: 10, friction: 0.3, preload: 1, tangent: root}]\n"

/* Every scene has a structure of its own; the base keeps what it had. */
static void structures_vary_too(CHECK_STATE)
{
  study *s = good_study("study: t\nrun: frf\n" STRUCTURE_CASE "set: {\"contacts[joint].preload\": 7}\n"
                        "vary:\n  - structure.damping.modal: [0.02, 0.03]\n  - {\"contacts[joint].friction\": [0, 1], "
                        "\"forcing[0].amplitude\": [5, 6]}\n");
  assert_int_equal(s->n_scenes, 4);
  for (long id = 0; id < 4; ++id) {
    scene sc = scene_of(s, id);
    const scene_structure *own = sc.structure;
    assert_true(own != s->base.structure);
    CHECK_NEAR(own->modal, id / 2 ? 0.03 : 0.02, 0, "scene %ld", id);
    CHECK_NEAR(own->damping.v[3], 2 * own->modal * sqrt(4.0 / 2) * 2, 1e-15, "scene %ld", id);
    CHECK_NEAR(own->contacts[0].given.law.mu, (double)(id % 2), 0, "scene %ld", id);
    CHECK_NEAR(own->contacts[0].given.preload, 7, 0, "scene %ld", id);
    CHECK_NEAR(own->loads[0].amplitude, 5.0 + (double)(id % 2), 0, "scene %ld", id);
    case_clear(&sc);
  }
  CHECK_NEAR(s->base.structure->modal, 0.01, 0, "base");
  CHECK_NEAR(s->base.structure->contacts[0].given.law.mu, 0.3, 0, "base");
  study_free(s);
}

static void one_number_of_rayleigh_damping_varies(CHECK_STATE)
{
  study *s = good_study("study: t\nrun: frf\n" STRUCTURE_CASE
                        "vary:\n  - structure.damping.rayleigh[0]: {from: 1, to: 3, count: 3}\n"
                        "  - structure.damping.rayleigh[1]: [0.5, 0.25]\n");
  assert_int_equal(s->n_scenes, 6);
  for (long id = 0; id < 6; ++id) {
    scene sc = scene_of(s, id);
    const double alpha = 1 + (double)(id / 2), beta = id % 2 ? 0.25 : 0.5;
    CHECK_NEAR(sc.structure->damping.v[0], alpha * 1 + beta * 3, 0, "scene %ld", id); /* M = 1, 2; K = 3, 4: exact */
    CHECK_NEAR(sc.structure->damping.v[3], alpha * 2 + beta * 4, 0, "scene %ld", id);
    case_clear(&sc);
  }
  study_free(s);
}

static void parts_of_structures_do_not_vary(CHECK_STATE)
{
  case_error err;
  assert_null(
      study_from_text("study: t\nrun: frf\n" STRUCTURE_CASE "vary: [{structure.mass: [1, 2]}]\n", 0, NULL, &err));
  assert_non_null(strstr(err.message, "`structure.mass` cannot vary"));
  assert_null(
      study_from_text("study: t\nrun: frf\n" STRUCTURE_CASE "vary: [{forcing.amplitude: [1, 2]}]\n", 0, NULL, &err));
  assert_non_null(strstr(err.message, "is an oscillator's, and the case has a structure"));
  assert_null(study_from_text("study: t\nrun: frf\n" STRUCTURE_CASE "vary: [{\"contacts[1].friction\": [1]}]\n", 0,
                              NULL, &err));
  assert_non_null(strstr(err.message, "the case has 1 contacts, expected an index 0..0"));
}

CHECK_TESTS_WITH("study.grid", 60, folder_make, folder_remove, the_last_axis_is_the_fastest,
                 ranges_hit_what_one_expects, integers_by_powers_of_two, lists_and_rivals_can_vary,
                 a_scene_may_be_impossible, the_fingerprint_is_of_what_is_computed, the_largest_study,
                 structures_vary_too, one_number_of_rayleigh_damping_varies, parts_of_structures_do_not_vary)
