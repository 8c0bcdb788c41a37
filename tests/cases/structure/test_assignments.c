/* test_assignments.c - --set on the parts of a structure. */
#include "tests/cases/structure/structure_text.h"

#define LISTS                                                                                                          \
  "forcing: [{dof: tip, amplitude: 1}]\n"                                                                              \
  "contacts: [{name: joint, tangential_stiffness: 200, friction: 1, preload: 5, tangent: root}, "                      \
  "{normal_stiffness: 4, gap: 2, normal: tip}]\n"

/* Setting it is writing it in the file. */
static void is_as_if(const char *set, const char *from, const char *to)
{
  static const char text[] = TWO_NAMED LISTS;
  char other[1024];
  const char *at = strstr(text, from);
  assert_non_null(at);
  snprintf(other, sizeof other, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
  model *a = model_of(text, set), *b = model_of(other, NULL);
  same_models(a, b);
  model_free(a);
  model_free(b);
}

static void every_part_can_be_set(CHECK_STATE)
{
  is_as_if("structure.damping.modal=0.02", "modal: 0.01", "modal: 0.02");
  is_as_if("structure.damping.modal=[0.02, 0.03]", "modal: 0.01", "modal: [0.02, 0.03]");
  is_as_if("structure.damping.rayleigh=[0.5, 1e-3]", "modal: 0.01", "rayleigh: [0.5, 1e-3]");
  is_as_if("structure.damping.rayleigh[0]=0.5", "modal: 0.01", "rayleigh: [0.5, 0]");
  is_as_if("structure.damping.rayleigh[1]=1e-3", "modal: 0.01", "rayleigh: [0, 1e-3]");
  is_as_if("structure.damping={rayleigh: [0.5, 1e-3]}", "modal: 0.01", "rayleigh: [0.5, 1e-3]");
  is_as_if("structure.damping=[3, 4]", "{modal: 0.01}", "[3, 4]");
  is_as_if("structure.mass=[3, 4]", "[1, 0.02]", "[3, 4]");
  is_as_if("structure.stiffness=[[3, 1], [1, 4]]", "[[680, -40], [-40, 40]]", "[[3, 1], [1, 4]]");
  is_as_if("forcing[0].amplitude=3", "amplitude: 1", "amplitude: 3");
  is_as_if("forcing[0].phase_deg=30", "amplitude: 1", "amplitude: 1, phase_deg: 30");
  is_as_if("forcing[0].harmonic=3", "amplitude: 1", "amplitude: 1, harmonic: 3");
  is_as_if("forcing[0].dof=root", "dof: tip", "dof: root");
  is_as_if("forcing[0].direction={tip: 1, root: -2}", "dof: tip", "direction: {tip: 1, root: -2}");
  is_as_if("forcing=[]", "[{dof: tip, amplitude: 1}]", "[]");
  is_as_if("forcing[1]={dof: root, amplitude: 7}", "amplitude: 1}", "amplitude: 1}, {dof: root, amplitude: 7}");
  is_as_if("contacts[0].friction=0.2", "friction: 1", "friction: 0.2");
  is_as_if("contacts[joint].friction=0.2", "friction: 1", "friction: 0.2");
  is_as_if("contacts[joint].tangent={tip: 1, root: -1}", "tangent: root", "tangent: {tip: 1, root: -1}");
  is_as_if("contacts[1].preload=3", "gap: 2", "preload: 3");
  is_as_if("contacts[1].gap=-3", "gap: 2", "gap: -3");
  is_as_if("contacts[2]={normal_stiffness: 1, normal: root}", "normal: tip}",
           "normal: tip}, {normal_stiffness: 1, normal: root}");
  is_as_if("contacts[joint]={normal_stiffness: 1, normal: root}",
           "{name: joint, tangential_stiffness: 200, friction: 1, preload: 5, tangent: root}",
           "{normal_stiffness: 1, normal: root}");
  is_as_if("response=[root]", LISTS, LISTS "response: [root]\n");
  is_as_if("structure.names=[root, tip]", LISTS, LISTS); /* what has been read stays where it was */
}

/* One number of Rayleigh damping leaves the other where there was such damping, also if it came before in the list. */
static void one_number_of_rayleigh_damping_leaves_the_other(CHECK_STATE)
{
  static const char *const set[] = {"structure.damping.rayleigh=[0.5, 1e-3]", "structure.damping.rayleigh[0]=0.25",
                                    "structure.damping.modal=0.1", "structure.damping.rayleigh[1]=1e-2"};
  static const double expected[][2] = {{0.5, 1e-3}, {0.25, 1e-3}, {0, 0}, {0, 1e-2}};
  for (int n = 1; n <= 4; ++n) {
    case_error err;
    CHECK_FILLED(scene, sc, case_parse("f", TWO_NAMED, strlen(TWO_NAMED), n, set, &sc, &err));
    const scene_structure *s = sc.structure;
    assert_int_equal(s->how, n == 3 ? STRUCTURE_DAMPING_MODAL : STRUCTURE_DAMPING_RAYLEIGH);
    if (n != 3) assert_true(s->rayleigh[0] == expected[n - 1][0] && s->rayleigh[1] == expected[n - 1][1]);
    case_clear(&sc);
  }
}

static void named_by_the_assignment(const mistake *m)
{
  char start[4096];
  snprintf(start, sizeof start, "--set %s: ", m->text);
  refused(TWO_NAMED LISTS, m->text, start, m->message);
}

static void mistakes_name_the_assignment(CHECK_STATE)
{
  each_mistake("structure assignments", 27, named_by_the_assignment);
  refused(SMALLEST, "structure.damping.modal=1", "--set structure.damping.modal=1: ",
          "`structure.damping.modal` is a structure's, and the case has an oscillator");
  refused(SMALLEST, "response=[1]", "--set response=[1]: ", "`response` is a structure's");
  refused(SMALLEST "contacts: [" CONTACT_1 "]\n", "contacts[0].limit=circle",
          "--set contacts[0].limit=circle: ", "is a structure's");
  refused(SMALLEST, "forcing[0].amplitude=1", "--set forcing[0].amplitude=1: ", "unknown field");
}

static void a_preload_needs_a_stiffness_that_can_hold_it(CHECK_STATE)
{
  static const char text[] = TWO_NAMED "contacts: [{normal_stiffness: 1e-10, preload: 1, normal: tip}]\n";
  model_free(model_of(text, NULL));
  refused(text, "contacts[0].preload=1e300", "--set contacts[0].preload=1e300: ", "preload/normal_stiffness too large");
}

static void a_copy_is_changed_without_its_original(CHECK_STATE)
{
  scene sc;
  accepted(TWO_NAMED LISTS, NULL, &sc);
  scene_structure *copy = structure_copy(sc.structure);
  assert_non_null(copy);
  copy->mass.v[0] = copy->contacts[0].tangent[0] = copy->loads[0].direction[1] = 7;
  copy->names[0][0] = 'x';
  assert_true(sc.structure->mass.v[0] == 1 && sc.structure->contacts[0].tangent[0] == 0);
  assert_true(sc.structure->loads[0].direction[1] == 0);
  assert_string_equal(sc.structure->names[0], "tip");
  structure_free(copy);
  case_clear(&sc);
}

CHECK_TESTS("structure.assignments", 60, every_part_can_be_set, one_number_of_rayleigh_damping_leaves_the_other,
            mistakes_name_the_assignment, a_preload_needs_a_stiffness_that_can_hold_it,
            a_copy_is_changed_without_its_original)
