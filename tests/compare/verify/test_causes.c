/* test_causes.c - curves spoiled in one known way each: the cause is named, by its word, and a good curve is not
 * blamed for anything.
 *
 * The curves are made here by our own harmonic balance, on two scenes: case 2, whose contact strikes and sticks, and
 * one under preload that slides and lifts off. What is tested is that the mistake is told from all others that are
 * tried. */
#include "tests/compare/verify/curves.h"
#include "tests/scene_runs.h"

static const char case2[] = "cases/paper/case2.yaml", preloaded[] = "cases/paper/fig09_gap_p1.yaml";

typedef struct prepared {
  const char *name, *scene, *cause;
  double low, high;
  int n;
  spoiling how;
} prepared;

/* The report of one prepared curve, its cause checked. */
static verify_report named(const prepared *p)
{
  const scene sc = curve_scene(p->scene);
  verify_data d = curve_make(&sc, &p->how, p->low, p->high, p->n);
  char words[VERIFY_TEXT];
  CHECK_FILLED(verify_report, r, scene_verify_run(&sc, &d, NULL, &r));
  if (strcmp(verify_cause_words(r.causes, words), p->cause)) {
    char text[VERIFY_TEXT];
    print_error("%s (%s), expected %s: %s\n", p->name, p->scene, p->cause, verify_sentence(&r, text));
    for (int i = 0; i < r.n_hypotheses && i < 5; ++i) {
      const verify_hypothesis *h = &r.hypotheses[i];
      print_error("  %s: %.3g (score %.3g; H %d N %d restart %d)\n", verify_cause_words(h->causes, text), h->distance,
                  h->score, h->equations.harmonics, h->equations.samples, h->equations.restart);
    }
    fail();
  }
  assert_int_equal(verify_exit_code(&r), strcmp(p->cause, "none") ? 1 : 0);
  for (int i = 0; i < r.n_hypotheses; ++i) { /* the truth as it stands is none */
    const verify_equations *e = &r.hypotheses[i].equations;
    const bool few_alone = r.hypotheses[i].causes == VERIFY_BIT(CAUSE_HARMONICS);
    assert_false(few_alone && e->harmonics == r.harmonics);
  }
  verify_data_clear(&d);
  return r;
}

static void name_all(int n, const prepared *p)
{
  for (int i = 0; i < n; ++i) {
    verify_report r = named(&p[i]);
    verify_clear(&r);
  }
}
#define NAME_ALL(list) name_all(sizeof list / sizeof *list, list)

/* Frequencies where something happens at the contact, mostly. */
#define ON_CASE2     case2, .low = 4, .high = 14, .n = 41
#define ON_PRELOADED preloaded, .low = 15, .high = 29, .n = 41

static void equations_solved_wrongly(CHECK_STATE)
{
  static const prepared list[] = {
      {"no static", ON_CASE2, .cause = "no_static_harmonic", .how = {.no_static = true}},
      {"no static", ON_PRELOADED, .cause = "no_static_harmonic", .how = {.no_static = true}},
      {"H = 1", ON_CASE2, .cause = "too_few_harmonics", .how = {.harmonics = 1}},
      {"H = 2", ON_CASE2, .cause = "too_few_harmonics", .how = {.harmonics = 2}},
      {"H = 3", ON_CASE2, .cause = "too_few_harmonics",
       .how = {.harmonics = 3, .meant = KIND_HARMONIC, .said = KIND_HARMONIC}},
      {"H = 1", ON_PRELOADED, .cause = "too_few_harmonics", .how = {.harmonics = 1}},
      {"linear", ON_CASE2, .cause = "no_contact", .how = {.no_contact = true}},
      {"linear", ON_PRELOADED, .cause = "no_contact", .how = {.no_contact = true}},
  };
  NAME_ALL(list);
}

static void forces_sampled_too_coarsely(CHECK_STATE)
{
  static const prepared list[] = {
      {"N = 32", ON_CASE2, .cause = "too_few_samples", .how = {.samples = 32}},
      {"N = 16", ON_PRELOADED, .cause = "too_few_samples", .how = {.samples = 16}},
      {"N = 64", ON_CASE2, .cause = "too_few_samples", .how = {.samples = 64, .noise = 1e-6}},
      {"N = 32, no static", ON_CASE2, .cause = "no_static_harmonic+too_few_samples",
       .how = {.samples = 32, .no_static = true}},
      {"N = 64, no static, slider on a sample", ON_CASE2, .cause = "no_static_harmonic+too_few_samples+slider_restart",
       .how = {.samples = 64, .no_static = true, .slider_on_sample = true}},
      {"N = 32, slider on a sample", ON_CASE2, .cause = "too_few_samples+slider_restart",
       .how = {.samples = 32, .slider_on_sample = true}},
      {"N = 128, slider on a sample", ON_CASE2, .cause = "too_few_samples+slider_restart",
       .how = {.samples = 128, .slider_on_sample = true}},
      {"H = 1, N = 32, no static", ON_CASE2, .cause = "no_static_harmonic+too_few_harmonics+too_few_samples",
       .how = {.harmonics = 1, .samples = 32, .no_static = true}},
  };
  NAME_ALL(list);
}

static void columns_misread(CHECK_STATE)
{
  static const prepared list[] = {
      {"Hz", ON_CASE2, .cause = "frequency_unit", .how = {.omega_factor = 1 / (2 * PI)}},
      {"rad/s times 2 pi", ON_CASE2, .cause = "frequency_unit", .how = {.omega_factor = 2 * PI}},
      {"Hz", ON_PRELOADED, .cause = "frequency_unit", .how = {.omega_factor = 1 / (2 * PI)}},
      {"peak to peak", ON_CASE2, .cause = "peak_to_peak", .how = {.value_factor = 2}},
      {"peak to peak", ON_PRELOADED, .cause = "peak_to_peak", .how = {.value_factor = 2}},
      {"one-sided", ON_CASE2, .cause = "half_amplitude",
       .how = {.value_factor = 0.5, .said = KIND_HARMONIC, .meant = KIND_HARMONIC}},
      {"rms", ON_CASE2, .cause = "rms", .how = {.value_factor = 0.70710678118654752}},
      {"mm for m", ON_CASE2, .cause = "length_unit", .how = {.value_factor = 1e3}},
      {"m for mm", ON_PRELOADED, .cause = "length_unit", .how = {.value_factor = 1e-3}},
      {"harmonic 1 as amplitude", ON_CASE2, .cause = "other_quantity",
       .how = {.said = KIND_AMPLITUDE, .meant = KIND_HARMONIC}},
      {"peak as amplitude", ON_CASE2, .cause = "other_quantity", .how = {.said = KIND_AMPLITUDE, .meant = KIND_PEAK}},
      {"divided by F0", ON_PRELOADED, .cause = "value_scale", .how = {.value_factor = 0.01}},
      {"7 % too high", ON_CASE2, .cause = "value_scale", .how = {.harmonics = 20, .value_factor = 1.07}},
      {"divided by w0", ON_PRELOADED, .cause = "omega_scale", .how = {.omega_factor = 0.15811388}},
      {"0.1 % off", ON_CASE2, .cause = "frequency_offset", .how = {.omega_factor = 1.001}},
      {"norm", ON_CASE2, .cause = "norm", .how = {.meant = KIND_NORM}},
      {"norm/sqrt(2)", ON_CASE2, .cause = "norm_over_root_2", .how = {.meant = KIND_RMS_NLVIB}},
      {"|b1|", ON_PRELOADED, .cause = "sine_only", .how = {.said = KIND_HARMONIC, .meant = KIND_SINE}},
      {"acceleration", ON_PRELOADED, .cause = "acceleration", .how = {.meant = KIND_ACCELERATION}},
      {"no static, in mm", ON_CASE2, .cause = "no_static_harmonic+length_unit",
       .how = {.no_static = true, .value_factor = 1e3}},
  };
  NAME_ALL(list);
}

static void twice_the_damping(scene *sc) { *sc->structure->damping.v *= 2; }
static void some_more_mass(scene *sc) { *sc->structure->mass.v *= 1.13; }
static void some_more_damping(scene *sc) { *sc->structure->damping.v *= 1.4; }
static void other_sign(scene *sc) { sc->structure->contacts[0].given.law.gap *= -1; }
static void exchanged(scene *sc)
{
  const double kt = sc->structure->contacts[0].given.law.kt;
  sc->structure->contacts[0].given.law.kt = sc->structure->contacts[0].given.law.kn;
  sc->structure->contacts[0].given.law.kn = kt;
}
static void without_friction(scene *sc) { sc->structure->contacts[0].given.law.mu = 0; }
static void twice_the_contact(scene *sc)
{
  sc->structure->contacts[0].given.law.kn *= 2, sc->structure->contacts[0].given.law.kt *= 2;
}

/* Nothing touches with -gap: what the curve tells is that the contacts are missing. */
static void numbers_of_another_model(CHECK_STATE)
{
  static const prepared list[] = {
      {"2 C", ON_CASE2, .cause = "wrong_damping", .how = {.change = twice_the_damping}},
      {"1.13 M", ON_CASE2, .cause = "wrong_mass", .how = {.change = some_more_mass}},
      {"1.4 C", ON_CASE2, .cause = "wrong_damping", .how = {.change = some_more_damping}},
      {"-gap", ON_PRELOADED, .cause = "no_contact", .how = {.change = other_sign}},
      {"kt for kn", ON_CASE2, .cause = "stiffnesses_exchanged", .how = {.change = exchanged}},
      {"mu = 0", ON_CASE2, .cause = "no_friction+no_tangential_stiffness", .how = {.change = without_friction}},
      {"2 contact force", ON_CASE2, .cause = "contact_force_factor", .how = {.change = twice_the_contact}},
      {"odd harmonics", ON_CASE2, .cause = "odd_harmonics_only", .how = {.odd_only = true}},
      {"-T", ON_CASE2, .cause = "friction_sign", .how = {.turned = true}},
      {"-T", ON_PRELOADED, .cause = "friction_sign", .how = {.turned = true}},
      {"one pass", ON_CASE2, .cause = "single_pass", .how = {.samples = 512, .slider = &verify_once}},
  };
  NAME_ALL(list);
}

/* Case 2 has an upper, an unstable and a lower solution from 7.337 to 9.209. */
static void branches_mistaken(CHECK_STATE)
{
  static const prepared unstable = {"unstable", ON_CASE2, .cause = "unstable_branch", .how = {.branch = -1}},
                        hops = {"hops", ON_CASE2, .cause = "other_branch", .how = {.branch = 2}};
  verify_report r = named(&unstable);
  assert_int_equal(r.count[VERDICT_DIFFERS], 0);
  verify_clear(&r);
  r = named(&hops);
  assert_true(r.count[VERDICT_OTHER_BRANCH] > 0 && r.count[VERDICT_DIFFERS] == 0);
  verify_clear(&r);
}

static void seven_percent_more_mass(scene *sc) { *sc->structure->mass.v *= 1.07; }

/* Nearly undamped, a larger mass and another unit of frequency give the same curve: neither is named, both are told. */
static void equals_are_a_guess(CHECK_STATE)
{
  const scene sc = curve_scene(preloaded);
  const spoiling how = {.harmonics = 20, .change = seven_percent_more_mass};
  verify_data d = curve_make(&sc, &how, 15, 29, 41);
  char text[VERIFY_TEXT];
  CHECK_FILLED(verify_report, r, scene_verify_run(&sc, &d, NULL, &r));
  assert_int_equal(r.causes, 0);
  assert_int_equal(r.nearest_guess, VERIFY_BIT(CAUSE_MASS) | VERIFY_BIT(CAUSE_OMEGA_SCALE));
  assert_non_null(strstr(verify_sentence(&r, text), "more than one cause fits: "));
  verify_clear(&r);
  verify_data_clear(&d);
}

static void nothing_wrong(CHECK_STATE)
{
  static const prepared list[] = {
      {"good", ON_CASE2, .cause = "none", .how = {.harmonics = 20, .noise = 1e-5}},
      {"good, all branches", ON_CASE2, .cause = "none", .how = {.harmonics = 20, .noise = 1e-5, .branch = 1}},
      {"good peak", ON_CASE2, .cause = "none", .how = {.harmonics = 20, .said = KIND_PEAK, .meant = KIND_PEAK}},
      {"good", ON_PRELOADED, .cause = "none", .how = {.harmonics = 20, .noise = 1e-5}},
      {"good enough samples", ON_CASE2, .cause = "none", .how = {.harmonics = 20, .samples = 4096}},
  };
  NAME_ALL(list);
}

/* What nobody tried is not explained away: values too high by more and more, up to 40 % at the last omega. */
static void no_cause_is_made_up(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  const spoiling how = {.harmonics = 20, .warp = 0.4};
  verify_data d = curve_make(&sc, &how, 4, 14, 41);
  char text[VERIFY_TEXT];
  CHECK_FILLED(verify_report, r, scene_verify_run(&sc, &d, NULL, &r));
  assert_int_equal(r.causes, 0);
  assert_int_equal(verify_exit_code(&r), 1);
  assert_non_null(strstr(verify_sentence(&r, text), "no hypothesis fits better than"));
  verify_clear(&r);
  verify_data_clear(&d);
}

/* The error column is |value - truth|/amplitude: noise of 1e-3 is 1e-3, less what a tenth of the gate in omega
 * explains: the contact is apart here, so that amplitude = F0/(M omega^2 - K) nearly, whose logarithmic slope is
 * -2 omega^2/(omega^2 - K/M), K/M = 40. The truth's own error is in checked_error. */
static void errors_are_what_was_put_in(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  const spoiling how = {.harmonics = 40, .noise = 1e-3};
  verify_data d = curve_make(&sc, &how, 10, 14, 9);
  CHECK_FILLED(verify_report, r, scene_verify_run(&sc, &d, NULL, &r));
  assert_int_equal(r.n_rows, 9);
  CHECK_LE(r.checked_error, 1e-4, "a tenth of the gate");
  for (int i = 0; i < r.n_rows; ++i) {
    const double square = r.rows[i].omega * r.rows[i].omega, slope = 2 * square / (square - 40);
    CHECK_NEAR(r.rows[i].error, 1e-3, r.checked_error + 0.1 * r.gate * slope + 1e-6, "omega = %g", r.rows[i].omega);
  }
  verify_clear(&r);
  verify_data_clear(&d);
}

/* Stopped at any moment: the rows that are there are the first of a run to the end, as that judges them before its
 * search for causes, and some stop comes among them. */
static void stopping_keeps_rows(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  const spoiling how = {.samples = 32};
  verify_data d = curve_make(&sc, &how, 4, 14, 11);
  int among = 0, before = 0;
  CHECK_FILLED(verify_report, whole, scene_verify_run(&sc, &d, NULL, &whole));
  assert_int_equal(whole.n_rows, d.n);
  for (int ticks = 1, end = 0; !end && ticks < 400; ticks += 1 + ticks / 8) {
    int left = ticks;
    const hc_monitor monitor = {check_stop, &left};
    verify_report r;
    end = scene_verify_run(&sc, &d, &monitor, &r) == HC_OK;
    assert_true(end || r.status == HC_INTERRUPTED);
    if (!end) assert_int_equal(left, 0); /* nobody asks again after a stop */
    assert_true(r.n_rows >= before && r.n_rows <= whole.n_rows);
    before = r.n_rows;
    among += r.n_rows > 0 && r.n_rows < whole.n_rows;
    for (int i = 0; i < r.n_rows; ++i) {
      const verify_row *kept = &r.rows[i], *full = &whole.rows[i];
      assert_true(kept->omega == full->omega && kept->nearest == full->nearest && kept->branch == full->branch);
      assert_int_equal(kept->verdict, full->verdict);
    }
    verify_clear(&r);
  }
  assert_true(among > 0);
  verify_clear(&whole);
  verify_data_clear(&d);
}

/* Three points that differ are the fewest that a cause is looked for. */
static void three_points_are_enough(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  const spoiling how = {.harmonics = 20, .value_factor = 2};
  verify_data d = curve_make(&sc, &how, 6.5, 8.5, 3);
  for (int n = 3; n >= 2; --n) {
    d.n = n;
    CHECK_FILLED(verify_report, r, scene_verify_run(&sc, &d, NULL, &r));
    assert_int_equal(r.count[VERDICT_DIFFERS], n);
    assert_int_equal(r.n_hypotheses > 0, n == 3);
    verify_clear(&r);
  }
  verify_data_clear(&d);
}

CHECK_TESTS("verify.causes", 600, nothing_wrong, equations_solved_wrongly, forces_sampled_too_coarsely,
            numbers_of_another_model, columns_misread, branches_mistaken, equals_are_a_guess, no_cause_is_made_up,
            errors_are_what_was_put_in, stopping_keeps_rows, three_points_are_enough)
