/* test_echo.c - an echoed structure reads back to the same bits, whatever its files were. */

#include "tests/cases/structure/structure_text.h"

/* The models, the names and the text itself: what a second echo writes. */
static void check_round_trip(const scene *sc)
{
  scene back;
  case_error err;
  char *text = echoed(sc, HC_OK), *again;
  if (case_parse("other", text, strlen(text), 0, NULL, &back, &err) != HC_OK)
    fail_msg("%s\n%.2000s", err.message, text);
  again = echoed(&back, HC_OK);
  assert_string_equal(text, again);
  CHECK_MADE(model, a, scene_model(sc, &a));
  CHECK_MADE(model, b, scene_model(&back, &b));
  same_models(a, b);
  assert_int_equal(sc->structure->n_nodes, back.structure->n_nodes);
  for (int i = 0; sc->structure->names && i < sc->structure->n; ++i)
    assert_string_equal(sc->structure->names[i], back.structure->names[i]);
  for (int j = 0; j < sc->structure->n_contacts; ++j)
    assert_memory_equal(&sc->structure->contacts[j].given, &back.structure->contacts[j].given, sizeof(scene_contact));
  case_clear(&back);
  model_free(a);
  model_free(b);
  free(text);
  free(again);
}

static void every_form_comes_back(CHECK_STATE)
{
  static const char *const texts[] = {
      TWO,
      TWO_NAMED,
      "structure: {mass: 1.1, stiffness: 40, damping: 0.4}\nforcing: {amplitude: 100}\n" SWEEP
      "contacts: [{tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.3, angle_deg: 0, gap: -5}]\n",
      "structure: {mass: [1, 1], stiffness: [3, 4], damping: {modal: [0.1, 0.2]}, nodes: [[1, 17, x], [2, -3, z]]}\n"
      "forcing: [{node: 17, direction: x, amplitude: -0.1, phase_deg: 1e-3}, {dof: 2, amplitude: 1}]\n" SWEEP
      "response: [2, {1: 0.1, 2: -3}]\n",
      "structure: {mass: [1, 1, 1], stiffness: [3, 4, 5], damping: {modal: 0.1}, nodes: [[1, 17, x], [2, 17, z], "
      "[3, 18, x]]}\nbase: {direction: x, amplitude: 0.1}\nforcing: [{dof: 2, amplitude: 9, harmonic: 0}]\n" SWEEP,
      TWO_NAMED "base: {direction: {tip: 1, root: 0.5}, acceleration: 0.1}\n",
      TWO_NAMED "contacts:\n  - {name: \"a\\\"\", tangential_stiffness: 200, friction: 1, preload: 5, tangent: root}\n"
                "  - {normal_stiffness: 3, preload: 0.1, normal: tip}\n"
                "  - {normal_stiffness: 3, gap: -0.1, normal: {tip: 0.1, root: 3}}\n"
                "  - {tangential_stiffness: 2, friction: 0.1, normal_stiffness: 3, normal: tip, tangent: root}\n",
      TWO "contacts:\n  - {tangential_stiffness: 2, friction: 0.1, preload: 3, tangent: 1, tangent_2: {1: 0.1, 2: 1}}\n"
          "  - {tangential_stiffness: 2, friction: 0.1, normal_stiffness: 3, normal: 1, tangent: 1, tangent_2: 2,\n"
          "     limit: square}\n",
      "structure:\n  mass: [1, 1]\n  stiffness: [3, 4]\n  damping: {rayleigh: [-0.1, 1e-300]}\n"
      "  names: [\"a: b\", \"#\\\\ \\u20ac\"]\n" SWEEP,
  };
  for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
    scene sc;
    accepted(texts[i], NULL, &sc);
    check_round_trip(&sc);
    case_clear(&sc);
  }
}

/* Random numbers, all bits of them, in matrices that are positive definite by their diagonals. */
static void random_structures_come_back_bit_for_bit(CHECK_STATE)
{
  uint64_t s = 3;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = random_int(&s, 1, 9);
    scene sc;
    accepted("structure: {mass: 1, stiffness: 1, damping: 0}\n" SWEEP, NULL, &sc);
    scene_structure *own = sc.structure;
    structure_matrix *m[] = {&own->mass, &own->stiffness, &own->damping};
    own->n = n;
    for (int k = 0; k < 3; ++k) {
      m[k]->v = realloc(m[k]->v, (size_t)(n * n) * sizeof(double));
      for (int i = 0; i < n * n; ++i) m[k]->v[i] = k == 0 && trial % 2 ? 0 : random_unit(&s) - 0.5;
      for (int i = 0; i < n; ++i) m[k]->v[i + n * i] = n + random_unit(&s);
      for (int i = 0; i < n * n && k == 0; ++i) m[k]->v[i] = m[k]->v[i % n * n + i / n];
    }
    for (int j = random_int(&s, 0, 20); j > 0; --j) {
      structure_contact *c = structure_add_contact(own);
      c->given.law = (contact){.kt = random_unit(&s), .kn = random_unit(&s), .mu = random_unit(&s)};
      *(random_bits(&s) % 2 ? &c->given.preload : &c->given.law.gap) = random_unit(&s);
      for (int i = 0; i < n; ++i) c->tangent[i] = random_unit(&s) - 0.5, c->normal[i] = random_unit(&s);
      if (j % 2 == 0) snprintf(c->given.name, sizeof c->given.name, "c%d", j);
    }
    for (int j = random_int(&s, 0, 5); j > 0; --j) {
      structure_load *load = structure_add_load(own);
      load->amplitude = random_unit(&s) - 0.5;
      load->harmonic = random_int(&s, 0, 3);
      load->phase_deg = load->harmonic ? 1000 * random_unit(&s) : 0;
      load->direction[random_int(&s, 0, n - 1)] = random_unit(&s) + 1e-3;
    }
    check_round_trip(&sc);
    case_clear(&sc);
  }
}

static void check_a_structure(const scene *sc)
{
  assert_non_null(sc->structure);
  if (sc->structure->n <= 300) check_round_trip(sc); /* of more rows it is larger than a case file may be */
}

static void the_cases_of_structures_are_all_readable(CHECK_STATE)
{
  assert_true(each_case_of(SOURCE_DIR "/cases/structures", check_a_structure) >= 20);
}

CHECK_TESTS("structure.echo", 60, every_form_comes_back, the_cases_of_structures_are_all_readable,
            random_structures_come_back_bit_for_bit)
