/* test_model.c - from the case file of a structure to its model. */
#include "tests/cases/structure/structure_text.h"

static void matrices_are_by_columns(CHECK_STATE)
{
  model *m = model_of("structure:\n  mass: [[2, 0.5], [0.5, 1]]\n  stiffness: [[1, 2], [3, 4]]\n"
                      "  damping: [[5, 6], [7, 8]]\n" SWEEP,
                      NULL);
  const double mass[] = {2, 0.5, 0.5, 1}, stiffness[] = {1, 3, 2, 4}, damping[] = {5, 7, 6, 8};
  assert_memory_equal(m->mass, mass, sizeof mass);
  assert_memory_equal(m->stiffness, stiffness, sizeof stiffness);
  assert_memory_equal(m->damping, damping, sizeof damping);
  assert_int_equal(m->n_loads, 0);
  assert_int_equal(m->n_contacts, 0);
  assert_true(m->n_responses == 1 && m->responses[0] == 1 && m->responses[1] == 0); /* no force: the first DOF */
  model_free(m);
}

/* Halves that rounding made unequal become equal, half way; beyond 1e-10 of the diagonal they are meant. */
static void what_is_symmetric_but_for_rounding_is_symmetric(CHECK_STATE)
{
  for (int meant = 0; meant < 2; ++meant) {
    char text[256];
    snprintf(
        text, sizeof text,
        "structure:\n  mass: [[2, 0], [0, 1]]\n  stiffness: [[4, %s], [-1, 4]]\n  damping: [[1, 0], [0, 1]]\n" SWEEP,
        meant ? "-1.0000000005" : "-1.0000000002");
    model *m = model_of(text, NULL);
    const double half = meant ? 0 : 1e-10;
    assert_true(m->stiffness[0] == 4 && m->stiffness[3] == 4);
    CHECK_NEAR(m->stiffness[1], -1 - half, 1e-15, "below the diagonal");
    assert_int_equal(m->stiffness[1] == m->stiffness[2], !meant);
    model_free(m);
  }
}

/* One degree of freedom in every way it can be written. */
static void one_degree_of_freedom_is_the_oscillator_to_the_bit(CHECK_STATE)
{
  static const char *const contacts[][2] = {
  /* as an oscillator has it, as a structure can say it */
#define RUBS "tangential_stiffness: 100.7, friction: 0.3"
#define BOTH RUBS ", normal_stiffness: 1000.3"
      {BOTH ", gap: -0.7, angle_deg: 45", ""},
      {BOTH ", gap: -0.7, angle_deg: 0", ""},
      {BOTH ", gap: -0.7, angle_deg: 90", ""},
      {BOTH ", preload: 0.7, angle_deg: -30", ""},
      {RUBS ", preload: 0.7", RUBS ", preload: 0.7, tangent: 1"},
      {RUBS ", preload: 0.7, angle_deg: 0", ""},
      {"normal_stiffness: 3, gap: -0.7, angle_deg: -90", "normal_stiffness: 3, gap: -0.7, normal: {1: -1}"},
      {"normal_stiffness: 4, gap: 0.5, angle_deg: 90", "normal_stiffness: 4, preload: 2, normal: 1"}};
  for (size_t i = 0; i < sizeof contacts / sizeof *contacts; ++i) {
    char old[512], new[512];
    const char *given = contacts[i][0];
    snprintf(old, sizeof old,
             "oscillator: {mass: 1.1, damping: 0.4, stiffness: 40.3}\nforcing: {amplitude: 100.9}\n" SWEEP
             "contacts: [{%s}]\n",
             given);
    model *a = model_of(old, NULL), *b;
    static const char *const matrices[] = {"mass: [[1.1]], damping: [[0.4]], stiffness: [[40.3]]",
                                           "mass: [1.1], damping: [0.4], stiffness: [40.3]",
                                           "mass: 1.1, damping: 0.4, stiffness: 40.3"};
    static const char *const loads[] = {"{amplitude: 100.9}", "[{dof: 1, amplitude: 100.9}]", "[{amplitude: 100.9}]",
                                        "[{direction: {1: 1}, amplitude: 100.9, phase_deg: 0, harmonic: 1}]"};
    for (size_t k = 0; k < 12; ++k) {
      snprintf(new, sizeof new, "structure: {%s}\nforcing: %s\n" SWEEP "contacts: [{%s}]\n", matrices[k % 3],
               loads[k / 3], k % 2 && *contacts[i][1] ? contacts[i][1] : given);
      b = model_of(new, NULL);
      same_models(a, b);
      assert_true(model_is_oscillator(b));
      model_free(b);
    }
    model_free(a);
  }
}

/* M r A omega^2 behind the other loads; -M r a of an acceleration; of all nodes that move in x, or of DOFs. */
static void a_moving_base_is_the_last_load(CHECK_STATE)
{
  static const char text[] =
      "structure: {mass: [[2, 1, 0.5], [1, 3, 0.25], [0.5, 0.25, 4]], stiffness: [3, 4, 5], damping: {modal: 0.1},\n"
      "  nodes: [[1, 17, x], [2, 17, z], [3, 18, x]]}\n"
      "forcing: [{dof: 2, amplitude: 9, harmonic: 2}]\nbase: {direction: x, amplitude: 0.5}\n" SWEEP;
  static const struct {
    const char *set;
    bool inertial;
    double cosine[3];
  } as[] = {{NULL, true, {1.25, 0.625, 2.25}},
            {"base.acceleration=4", false, {-10, -5, -18}},
            {"base.direction={1: 1, 2: 2}", true, {2, 3.5, 0.5}},
            {"base.amplitude=0", true, {0, 0, 0}}};
  for (size_t k = 0; k < sizeof as / sizeof *as; ++k) {
    model *m = model_of(text, as[k].set);
    assert_int_equal(m->n_loads, 2);
    assert_int_equal(m->loads[0].harmonic, 2);
    assert_int_equal(m->loads[1].harmonic, 1);
    assert_int_equal(m->loads[1].inertial, as[k].inertial);
    for (int i = 0; i < 3; ++i) {
      CHECK_NEAR(m->loads[1].cosine[i], as[k].cosine[i], 0, "%zu: cosine %d", k, i);
      CHECK_NEAR(m->loads[1].sine[i], 0, 0, "%zu: sine %d", k, i);
    }
    model_free(m);
  }
  model *alone = model_of("structure: {mass: 2, stiffness: 3, damping: 0.1}\nbase: {amplitude: 3}\n" SWEEP, NULL);
  assert_true(alone->n_loads == 1 && *alone->loads->cosine == 6 && !model_is_oscillator(alone));
  model_free(alone);
}

static void contacts_have_directions_and_laws(CHECK_STATE)
{
  model *m = model_of(TWO "contacts:\n"
                          "  - {tangential_stiffness: 200, normal_stiffness: 300, friction: 0.3, gap: 0.1,\n"
                          "     tangent: {1: 1, 2: -1}, normal: {2: 1}}\n"
                          "  - {tangential_stiffness: 20, friction: 1, preload: 5, tangent: 1}\n"
                          "  - {normal_stiffness: 30, gap: -0.25, normal: {1: 1}}\n"
                          "  - {normal_stiffness: 4, preload: 3, normal: {1: 0.5, 2: 2}}\n",
                      NULL);
  const double tangents[4][2] = {{1, -1}, {1, 0}, {0, 0}, {0, 0}}, normals[4][2] = {{0, 1}, {0, 0}, {1, 0}, {0.5, 2}};
  const contact laws[] = {{.kt = 200, .kn = 300, .mu = 0.3, .gap = 0.1},
                          {.kt = 20, .mu = 1, .load = 5},
                          {.kn = 30, .gap = -0.25},
                          {.kn = 4, .gap = 0.75}};
  assert_int_equal(m->n_contacts, 4);
  for (int j = 0; j < 4; ++j) {
    assert_memory_equal(m->contacts[j].tangent, tangents[j], sizeof tangents[j]);
    assert_memory_equal(m->contacts[j].normal, normals[j], sizeof normals[j]);
    assert_memory_equal(&m->contacts[j].law, &laws[j], sizeof laws[j]);
  }
  model_free(m);
}

static void loads_of_a_harmonic_are_summed(CHECK_STATE)
{
  model *m = model_of(TWO "forcing:\n"
                          "  - {dof: 1, amplitude: 3, phase_deg: 90, harmonic: 2}\n"
                          "  - {dof: 2, amplitude: -10, harmonic: 0}\n"
                          "  - {direction: {1: 2, 2: -0.5}, amplitude: 4, harmonic: 2}\n"
                          "  - {dof: 2, amplitude: 5, phase_deg: -450}\n"
                          "  - {dof: 1, amplitude: 2, phase_deg: 30, harmonic: 7}\n"
                          "hbm: {harmonics: 7}\n",
                      NULL);
  const double cosines[4][2] = {{0, -10}, {0, 0}, {8, -2}, {2 * cos(PI / 6), 0}};
  const double sines[4][2] = {{0, 0}, {0, 5}, {-3, 0}, {-2 * sin(PI / 6), 0}};
  const int harmonics[] = {0, 1, 2, 7};
  assert_int_equal(m->n_loads, 4);
  for (int i = 0; i < 4; ++i) {
    assert_int_equal(m->loads[i].harmonic, harmonics[i]);
    for (int k = 0; k < 2; ++k) {
      CHECK_LE(fabs(m->loads[i].cosine[k] - cosines[i][k]), i == 3 ? 4e-16 : 0, "cosine %d %d", i, k);
      CHECK_LE(fabs(m->loads[i].sine[k] - sines[i][k]), i == 3 ? 4e-16 : 0, "sine %d %d", i, k);
    }
  }
  assert_true(m->responses[0] == 1 && m->responses[1] == 0); /* of the first load that moves: dof 1 */
  model_free(m);
}

static void quarters_of_a_turn_are_exact(CHECK_STATE)
{
  double c, s;
  for (int k = -9; k <= 9; ++k) {
    static const double cosines[] = {1, 0, -1, 0}, sines[] = {0, 1, 0, -1};
    structure_cosine_sine(90.0 * k, &c, &s);
    assert_true(c == cosines[(k + 12) % 4] && s == sines[(k + 12) % 4]);
  }
  for (double a = -720; a < 720; a += 7.3) {
    structure_cosine_sine(a, &c, &s);
    /* a pi/180 rounds to 3 eps of up to 12.6, and cos and sin change by as much */
    CHECK_LE(fabs(c - cos(a * (PI / 180))), 1e-14, "cos %g", a);
    CHECK_LE(fabs(s - sin(a * (PI / 180))), 1e-14, "sin %g", a);
  }
}

static void degrees_of_freedom_go_by_name_number_or_node(CHECK_STATE)
{
  static const char nodes[] = "dof,node,direction\n\n 1 , 17, y\r\nroot,18,x\n";
  const own_file f = write_file("nodes.csv", nodes, sizeof nodes - 1);
  char text[1024];
  const char *tail = "response: [tip, {node: 18, direction: x}, {tip: 1, 2: -1}]\n";
  const char *loads = "forcing: [{node: 17, direction: y, amplitude: 3}]\n";
  snprintf(text, sizeof text,
           "%s%sstructure:\n  names: [tip, root]\n  nodes: %s\n  damping: [0, 0]\n  stiffness: [1, 1]\n"
           "  mass: [1, 1]\n" SWEEP,
           tail, loads, f.path);
  model *a = model_of(text, NULL);
  const double responses[] = {1, 0, 0, 1, 1, -1};
  assert_int_equal(a->n_responses, 3);
  assert_memory_equal(a->responses, responses, sizeof responses);
  assert_true(a->n_loads == 1 && a->loads[0].cosine[0] == 3 && a->loads[0].cosine[1] == 0);
  snprintf(text, sizeof text,
           "structure:\n  names: [tip, root]\n  nodes: [[tip, 17, y], [2, 18, x]]\n  damping: [0, 0]\n"
           "  stiffness: [1, 1]\n  mass: [1, 1]\n" SWEEP "%s%s",
           tail, loads);
  model *b = model_of(text, NULL);
  same_models(a, b);
  model_free(a);
  model_free(b);
  remove_file(&f);
}

static void files_of_matrices_lie_beside_the_case(CHECK_STATE)
{
  static const char mtx[] = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 680\n2 1 -40\n2 2 40\n";
  const own_file f = write_file("k.mtx", mtx, sizeof mtx - 1);
  static const char text[] =
      "structure: {mass: [1, 0.02], stiffness: k.mtx, damping: [[0.1, -0.05], [-0.05, 0.05]]}\n" SWEEP;
  char name[128];
  scene sc;
  case_error err;
  snprintf(name, sizeof name, "%s/case.yaml", f.folder);
  if (case_parse(name, text, strlen(text), 0, NULL, &sc, &err) != HC_OK) fail_msg("%s", err.message);
  model *a, *b = model_of(TWO, NULL);
  assert_int_equal(scene_model(&sc, &a), HC_OK);
  same_models(a, b);
  model_free(a);
  model_free(b);
  case_clear(&sc);
  remove_file(&f);
}

/* Phi^T C Phi must be diag(2 z omega): held against M, K and an independent closed form for n = 2. */
static void modal_damping_damps_every_mode_as_asked(CHECK_STATE)
{
  static const char text[] =
      "structure:\n  mass: [2, 2]\n  stiffness: [[30, -10], [-10, 30]]\n  damping: {modal: %s}\n" SWEEP;
  static const char *const values[] = {"0.02", "[0.02, 0.02]", "[0.01, 0.03]"};
  for (int k = 0; k < 3; ++k) {
    char full[512];
    snprintf(full, sizeof full, text, values[k]);
    model *m = model_of(full, NULL);
    /* modes (1, 1) and (1, -1): omega^2 = 10 and 20; along them C has 2 z omega M */
    const double z1 = k == 2 ? 0.01 : 0.02, z2 = k == 2 ? 0.03 : 0.02;
    const double along_1 = m->damping[0] + m->damping[1], along_2 = m->damping[0] - m->damping[1];
    CHECK_LE(fabs(along_1 - 2 * z1 * sqrt(10) * 2), 1e-14, "%s", values[k]); /* some roundings of 0.25 */
    CHECK_LE(fabs(along_2 - 2 * z2 * sqrt(20) * 2), 1e-14, "%s", values[k]);
    assert_true(fabs(m->damping[1] - m->damping[2]) < 1e-15 && fabs(m->damping[0] - m->damping[3]) < 1e-14);
    model_free(m);
  }
  model *m = model_of("structure:\n  mass: [2, 4]\n  stiffness: [[30, -10], [-10, 30]]\n"
                      "  damping: {rayleigh: [0.5, 0.25]}\n" SWEEP,
                      NULL);
  const double rayleigh[] = {8.5, -2.5, -2.5, 9.5};
  assert_memory_equal(m->damping, rayleigh, sizeof rayleigh);
  model_free(m);
}

/* A free damper on a blade is held by contacts alone; with its tangential springs gone it slides away. */
static void what_contacts_hold_is_held(CHECK_STATE)
{
  static const char text[] =
      "structure:\n  mass: [1, 0.05]\n  stiffness: [1000, 0]\n  damping: [0.3, 0.2]\n" SWEEP
      "contacts: [{tangential_stiffness: 400, friction: 0.3, preload: 3, tangent: {1: 1, 2: -1}}]\n";
  model_free(model_of(text, NULL));
  refused(text, "contacts[0].friction=0", "--set contacts[0].friction=0: ", "nothing holds the motion {2: 1}");
  refused(text, "contacts[0].preload=0", "--set contacts[0].preload=0: ", "nothing holds the motion {2: 1}");
  refused(text, "contacts=[]",
          "--set contacts=[]: ", "nothing holds the motion {2: 1}: neither structure.stiffness nor a contact");
  refused("structure: {names: [a, b, c], mass: [1, 1, 1], damping: [0, 0, 0], "
          "stiffness: [[1, -1, 0], [-1, 2, -1], [0, -1, 1]]}\n" SWEEP,
          NULL, "f:1:12: ", "nothing holds the motion {a: 1, b: 1, c: 1}");
  refused("structure: {mass: [1, 1], damping: [0, 0], stiffness: [0, 0]}\n" SWEEP, NULL,
          "f:1:12: ", "nothing holds the motion");
  /* stiff and soft together is not free: a spread of 1e12 is that of a fine mesh */
  model_free(model_of("structure: {mass: [1, 1, 1], damping: [0, 0, 0], stiffness: [1e12, 1, 1e6]}\n" SWEEP, NULL));
  model_free(model_of(
      "structure: {mass: [1, 1e-9, 1], damping: [0, 0, 0], stiffness: [[1e20, 1, 0], [1, 1, 0], [0, 0, 1e-9]]}\n" SWEEP,
      NULL)); /* walls and units */
}

/* The angle says where a contact of one degree of freedom acts, which has no vectors then. */
static void what_a_contact_at_an_angle_holds_is_held(CHECK_STATE)
{
  static const char text[] = "structure: {mass: [1], damping: [0.1], stiffness: [0]}\n" SWEEP
                             "contacts:\n  - {tangential_stiffness: 10, normal_stiffness: 10, friction: 0.5, gap: 0.3, "
                             "angle_deg: 30}\n";
  model_free(model_of(text, NULL));
  model_free(model_of(text, "contacts[0].tangential_stiffness=0")); /* the normal spring alone */
  refused(text, "contacts[0].normal_stiffness=0", "", "nothing holds the motion {1: 1}");
}

/* A curved spring holds, though K and its stiffness at rest are singular, however stiff K is; one that only pushes
 * away, or acts along another motion, does not. */
static void what_a_polynomial_holds_is_held(CHECK_STATE)
{
  static const char text[] = "structure:\n  mass: [1, 0.05]\n  stiffness: [1e12, 0]\n  damping: [0.3, 0.2]\n" SWEEP
                             "contacts: [{law: polynomial, direction: {1: 1, 2: -1}, coefficients: {3: 500}}]\n";
  model_free(model_of(text, NULL));
  model_free(model_of(text, "contacts[0].coefficients.3=1e-9"));
  model_free(model_of(text, "contacts[0].coefficients={2: -500}"));
  model_free(model_of(text, "structure.stiffness=[1e-12, 0]"));
  refused(text, "contacts[0].coefficients.3=-500",
          "--set contacts[0].coefficients.3=-500: ", "nothing holds the motion {2: 1}");
  refused(text, "contacts[0].direction=1", "--set contacts[0].direction=1: ", "nothing holds the motion {2: 1}");
}

/* At rest, where a mean is to be found, it has to push back from both sides. */
static void at_rest_polynomials_hold_from_both_sides(CHECK_STATE)
{
  static const char *const powers[] = {"{3: 500}", "{3: -1, 5: 1}", "{2: 500}", "{3: 500, 4: 1}", "{3: 1, 5: -1}"};
  for (int i = 0; i < 5; ++i) {
    char text[400];
    scene sc;
    double x[2];
    bool is_free;
    snprintf(text, sizeof text,
             "structure: {mass: [1, 1], stiffness: [1, 0], damping: [1, 1]}\n" SWEEP
             "contacts: [{law: polynomial, direction: {2: 1}, coefficients: %s}]\n",
             powers[i]);
    accepted(text, NULL, &sc);
    assert_int_equal(structure_free_motion(sc.structure, true, x, &is_free), HC_OK);
    assert_int_equal(is_free, i >= 2);
    case_clear(&sc);
  }
}

/* In the model a contact with two tangents is two, with half the normal stiffness and twice the friction each. */
static void two_tangents_are_two_contacts_of_the_model(CHECK_STATE)
{
  scene sc;
  accepted(TWO "contacts:\n"
               "  - {normal_stiffness: 3, normal: 2}\n"
               "  - {tangential_stiffness: 200, normal_stiffness: 300, friction: 0.3, gap: 0.1,\n"
               "     tangent: 1, tangent_2: {1: 1, 2: -1}, normal: {2: 1}}\n"
               "  - {tangential_stiffness: 20, friction: 1, preload: 5, tangent: 1, tangent_2: 2, limit: square}\n",
           NULL, &sc);
  CHECK_MADE(model, m, scene_model(&sc, &m));
  assert_int_equal(m->n_contacts, 5);
  assert_int_equal(scene_model_contact(&sc, 1), 1);
  assert_int_equal(scene_model_contact(&sc, 2), 3);
  assert_int_equal(scene_model_contact(&sc, 3), 5);
  assert_true(m->contacts[0].pair == CONTACT_ALONE && m->contacts[0].law.kn == 3);
  for (int d = 0; d < 2; ++d) {
    const model_contact *circle = &m->contacts[1 + d], *square = &m->contacts[3 + d];
    assert_true(circle->pair == (d ? CONTACT_SECOND : CONTACT_FIRST) && circle->circle);
    assert_true(square->pair == (d ? CONTACT_SECOND : CONTACT_FIRST) && !square->circle);
    assert_true(circle->law.kt == 200 && circle->law.kn == 150 && circle->law.mu == 0.6 && circle->law.gap == 0.1);
    assert_true(square->law.kt == 20 && square->law.kn == 0 && square->law.mu == 2 && square->law.load == 2.5);
    assert_true(circle->normal[0] == 0 && circle->normal[1] == 1);
  }
  assert_true(m->contacts[1].tangent[0] == 1 && m->contacts[1].tangent[1] == 0);
  assert_true(m->contacts[2].tangent[0] == 1 && m->contacts[2].tangent[1] == -1);
  assert_true(model_has_circle(m));
  model_free(m);
  case_clear(&sc);
}

static void names_of_responses(CHECK_STATE)
{
  scene sc;
  char text[64];
  accepted(TWO_NAMED "response: [tip, {root: -1, tip: 1}, {tip: 0.5, 2: 2}, {2: -1}]\n", NULL, &sc);
  static const char *const names[] = {"tip", "tip-root", "0.5*tip+2*root", "-root"};
  for (int i = 0; i < 4; ++i)
    assert_string_equal(structure_direction_name(sc.structure, sc.structure->responses[i].direction, text, sizeof text),
                        names[i]);
  assert_string_equal(structure_direction_name(sc.structure, sc.structure->responses[2].direction, text, 10),
                      "0.5*ti...");
  case_clear(&sc);
}

CHECK_TESTS("structure.model", 60, matrices_are_by_columns, what_is_symmetric_but_for_rounding_is_symmetric,
            one_degree_of_freedom_is_the_oscillator_to_the_bit, a_moving_base_is_the_last_load,
            contacts_have_directions_and_laws, loads_of_a_harmonic_are_summed, quarters_of_a_turn_are_exact,
            degrees_of_freedom_go_by_name_number_or_node, files_of_matrices_lie_beside_the_case,
            modal_damping_damps_every_mode_as_asked, what_contacts_hold_is_held,
            what_a_contact_at_an_angle_holds_is_held, what_a_polynomial_holds_is_held,
            at_rest_polynomials_hold_from_both_sides, two_tangents_are_two_contacts_of_the_model, names_of_responses)
