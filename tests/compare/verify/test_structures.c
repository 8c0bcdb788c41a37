/* test_structures.c - hbmcheck verify on structures: curves of several responses, and mistakes that one degree of
 * freedom cannot have. The curves are our own harmonic balance's, of the same structure with one thing changed; what is
 * tested is that the mistake is told from all others that are tried. Runs the built hbmcheck in a folder of its own. */
#include "tests/folder.h"
#include "tests/shell.h"

static char out[262144];

static int shell(const char *format, ...) __attribute__((format(printf, 1, 2)));
static int shell(const char *format, ...)
{
  char line[4096];
  va_list args;
  va_start(args, format);
  vsnprintf(line, sizeof line, format, args);
  va_end(args);
  return shell_read(line, out, sizeof out);
}

#define HAVE(fragment)                                                                                                 \
  if (!strstr(out, fragment)) fail_msg("no '%s' in:\n%s", fragment, out)

/* Three masses with a gyroscopic C, loads of two phases and a static one, a slider between two of them and a stop. */
static const char masses[] = "mass: [1, 0.7, 1.5]", matrix_C[] = "[[0.3, 0.25, 0], [-0.25, 0.2, 0.1], [0, -0.1, 0.2]]",
                  matrix_K[] = "[[30, -8, 0], [-8, 25, -6], [0, -6, 40]]", phase[] = "phase_deg: 60",
                  fixed[] = "amplitude: 2, harmonic: 0", tangent[] = "tangent: {a: 1, b: -1}",
                  normal[] = "normal: {c: 1}", load[] = "dof: b", friction[] = "friction: 0.5";

/* The case, with `now` in the place of `was` where that is not NULL. */
static void put_case(const char *name, const char *was, const char *now)
{
  char text[2048];
  snprintf(text, sizeof text,
           "structure:\n  %s\n  damping: %s\n  stiffness: %s\n  names: [a, b, c]\n"
           "forcing:\n  - {dof: a, amplitude: 10}\n  - {%s, amplitude: 4, %s}\n  - {dof: c, %s}\n"
           "contacts:\n  - {tangential_stiffness: 12, %s, preload: 3, %s}\n"
           "  - {normal_stiffness: 50, gap: -0.4, %s}\n"
           "response: [a, b]\nsweep: {omega: [3, 9]}\nhbm: {harmonics: 5}\n",
           masses, matrix_C, matrix_K, load, phase, fixed, friction, tangent, normal);
  FILE *to = folder_open(name, "w");
  const char *at = was ? strstr(text, was) : NULL;
  if (was) assert_non_null(at);
  if (at) fprintf(to, "%.*s%s%s", (int)(at - text), text, now, at + strlen(was));
  else fputs(text, to);
  assert_int_equal(fclose(to), 0);
}

/* The curve of theirs.yaml as frf writes it, into theirs.csv. */
static void make_curve(const char *options)
{
  if (shell("$H frf $D/theirs.yaml -q --format csv --set hbm.harmonics=20 %s -o $D/theirs.csv", options) != 0)
    fail_msg("frf: %s", out);
}

/* verify of that file ends with this code, and says that. */
static void judged(const char *options, int code, const char *fragment)
{
  const int found = shell("$H verify $D/ours.yaml -q --format csv --against $D/theirs.csv %s 2>&1", options);
  shell_check(options, found, out, code, fragment);
}

/* Two responses in one file, by its column `response` and as columns of their own. */
static void every_response_is_judged(CHECK_STATE)
{
  put_case("ours.yaml", NULL, NULL);
  put_case("theirs.yaml", NULL, NULL);
  make_curve("");
  judged("--columns omega=omega,rms=rms --response b --response a", 0,
         "omega,value,nearest,branch,response,stable,error,verdict,line\n");
  HAVE("# response b\n# truth: H = 20");
  HAVE(",a,yes,");
  HAVE(",b,yes,");
  assert_null(strstr(out, "differs"));
  judged("--columns omega=omega,harmonic_1@a=harmonic_1,amplitude@b=amplitude --format json", 0,
         "\"response\": \"b\", \"cause\": \"none\"");
  judged("--columns omega=omega,amplitude@b=harmonic_1,harmonic_1@a=harmonic_1", 1, "+other_quantity");
  HAVE("# cause: none");
  judged("--columns omega=omega,rms@d=rms", 64, "has no `d`; expected one of a, b");
  judged("--columns omega=omega,rms@a=rms --response b", 64, "give one of them");
  judged("--columns omega=omega,rms@a=rms,rms@b=rms --plot x.svg", 64, "--plot draws one response");
  judged("--columns omega=omega,acceleration@a=rms", 2, "acceleration_harmonic_1");
  make_curve("--response a");
  judged("--columns omega=omega,rms=rms --response b", 2, "0 points in the file of response b, expected at least 3");
  shell("cut -d, -f1,4 $D/theirs.csv > $D/plain.csv && mv $D/plain.csv $D/theirs.csv");
  judged("--response a --response b", 64, "no column `response`");
}

/* A structure with one thing changed, and what that is called. */
static void mistakes_of_structures_are_named(CHECK_STATE)
{
  static const struct mistake {
    const char *was, *now, *words, *cause;
  } all[] = {
      {matrix_C, "[[0.3, -0.25, 0], [0.25, 0.2, -0.1], [0, 0.1, 0.2]]", "C transposed", "# cause: transposed\n"},
      {phase, "phase_deg: -60", "phases of the loads times -1", "# cause: phase_sign\n"},
      {fixed, "amplitude: 1e-9, harmonic: 0", "static loads times 0", "# cause: no_static_load\n"},
      {tangent, "tangent: {a: 1, b: 1}", "one side turned", "# cause: one_side_turned\n"},
      {"tangent: {a: 1, b: -1}}\n  - {normal_stiffness: 50, gap: -0.4, normal: {c: 1}}",
       "tangent: {a: 1, c: -1}}\n  - {normal_stiffness: 50, gap: -0.4, normal: {b: 1}}",
       "the contacts exchanged in DOFs 2 and 3", "# cause: dofs_exchanged\n"},
      {"mass: [1, 0.7, 1.5]\n  "
       "damping: [[0.3, 0.25, 0], [-0.25, 0.2, 0.1], [0, -0.1, 0.2]]\n  stiffness: [[30, -8, 0], "
       "[-8, 25, -6], [0, -6, 40]]",
       "mass: [0.7, 1, 1.5]\n  "
       "damping: [[0.2, -0.25, 0.1], [0.25, 0.3, 0], [-0.1, 0, 0.2]]\n  stiffness: [[25, -8, -6], "
       "[-8, 30, 0], [-6, 0, 40]]",
       "M, C and K exchanged in DOFs 1 and 2", "# cause: dofs_exchanged\n"},
      {friction, "friction: 1", "(mu times 2,", "# cause: wrong_friction\n"},
      {friction, "friction: 0.05", "(mu times 0.1,", "# cause: wrong_friction\n"},
      {"normal_stiffness: 50, gap: -0.4", "normal_stiffness: 100, gap: -0.4", "kn times 2",
       "# cause: wrong_normal_stiffness\n"},
  };
  put_case("ours.yaml", NULL, NULL);
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    put_case("theirs.yaml", all[i].was, all[i].now);
    make_curve("");
    judged("--columns omega=omega,harmonic_1@b=harmonic_1", 1, all[i].cause);
    HAVE(all[i].words);
  }
}

/* Loads, contacts and masses of which one alone, or the order, is another: `was` is `ours` here, and `theirs` there. Of
 * two moving loads either may be the one that is turned: half a period later the other is. */
static void one_of_several_is_named(CHECK_STATE)
{
#define SLIDERS(kt, other)                                                                                             \
  "stiffness: " #kt ", friction: 0.5, preload: 3, tangent: {a: 1, b: -1}}\n"                                           \
  "  - {tangential_stiffness: " #other ", friction: 1, preload: 2, tangent: {b: 1}}\n"
  static const char first[] = "stiffness: 12, friction: 0.5, preload: 3, tangent: {a: 1, b: -1}}\n",
                    consistent[] = "mass: [[0.8, 0.2, 0], [0.2, 0.4, 0.1], [0, 0.1, 1.4]]", at_a[] = "amplitude: 10";
  static const struct one {
    const char *was, *ours, *theirs, *words, *cause;
  } all[] = {
      {masses, consistent, masses, "(M as the sums of its rows, H = ", "# cause: lumped_mass\n"},
      {at_a, at_a, "amplitude: 5", "(the load of harmonic 1 at DOF 1 times 0.5, ", "# cause: one_load\n"},
      {phase, phase, "phase_deg: 240", "(the other sign of the load of harmonic 1 at DOF ", "# cause: one_load\n"},
      {first, SLIDERS(12, 30), SLIDERS(30, 12), "(kt and kn exchanged between contacts 0 and 1, ",
       "# cause: contacts_exchanged\n"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    put_case("ours.yaml", all[i].was, all[i].ours);
    put_case("theirs.yaml", all[i].was, all[i].theirs);
    make_curve("");
    judged("--columns omega=omega,harmonic_1@b=harmonic_1", 1, all[i].cause);
    HAVE(all[i].words);
  }
}

/* The motion of a less that of c under the name of a, and b as it is. */
static void a_relative_motion_is_named(CHECK_STATE)
{
  put_case("ours.yaml", NULL, NULL);
  put_case("theirs.yaml", "response: [a, b]", "response: [{a: 1, c: -1}, b]");
  make_curve("");
  shell("sed -i 's/,a-c,/,a,/' $D/theirs.csv");
  judged("--columns omega=omega,amplitude=amplitude --response a --response b", 1, "# cause: relative_response\n");
  HAVE("the motion relative to DOF 3, ");
  HAVE("# cause: none");
}

/* The motion of c under the name of a; c is no response of the case. */
static void another_degree_of_freedom_is_named(CHECK_STATE)
{
  put_case("ours.yaml", NULL, NULL);
  put_case("theirs.yaml", "response: [a, b]", "response: [c]");
  make_curve("");
  shell("sed -i 's/,c,/,a,/' $D/theirs.csv");
  judged("--columns omega=omega,amplitude@a=amplitude", 1,
         "# suspected cause: the values are those of another response (the motion of DOF 3, ");
}

#define JENKINS "$H verify cases/structures/jenkins2.yaml -q --against "

/* All of the force at one degree of freedom: the load of jenkins2 at its root. */
static void a_load_elsewhere_is_named(CHECK_STATE)
{
  assert_int_equal(shell("$H frf cases/structures/jenkins2.yaml -q --format csv --response tip --set "
                         "'forcing[0].dof=root' --set hbm.harmonics=20 -o $D/load.csv"),
                   0);
  assert_int_equal(shell(JENKINS "$D/load.csv --columns omega=omega,harmonic_1=harmonic_1 2>&1"), 1);
  HAVE("cause: load_dof\n");
  HAVE("the force at DOF 2, ");
}

/* A mass on a rough plane, rubbing along one of its directions only. Along the first its curve of x is that of the
 * square law, too, which knows nothing of y, so that both are guessed; y, and all along the second, tell. */
static void a_missing_tangent_is_named(CHECK_STATE)
{
  static const struct missing {
    const char *tangents, *response, *cause, *words;
  } all[] = {
      {"tangent: y,", "x", "# cause: tangent_missing\n", "(tangent_2 alone, H = 20;"},
      {"tangent: x,", "y", "# cause: tangent_missing\n", "(no tangent_2, H = 20;"},
      {"tangent: x,", "x", "# cause: unknown\n", "friction acts in one of two directions only"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    shell("sed 's/tangent: x, tangent_2: y,/%s/' cases/structures/space.yaml > $D/theirs.yaml", all[i].tangents);
    make_curve("");
    assert_int_equal(shell("$H verify cases/structures/space.yaml -q --against $D/theirs.csv --columns "
                           "omega=omega,amplitude=amplitude --response %s 2>&1",
                           all[i].response),
                     1);
    HAVE(all[i].cause + 2);
    HAVE(all[i].words);
  }
  HAVE("limit: square");
}

/* Where the slider of jenkins2 sticks all period, a value that is off may be right with the slider elsewhere: said. */
static void what_history_decides_is_said(CHECK_STATE)
{
  assert_int_equal(shell("$H frf cases/structures/jenkins2.yaml -q --format csv --response tip --set hbm.harmonics=20 "
                         "| awk -F, -v OFS=, '/^2/ {$4 *= 1.01 + 0.3*($1 - 25)} {print}' > $D/off.csv"),
                   0);
  assert_int_equal(shell(JENKINS "$D/off.csv --columns omega=omega,amplitude=amplitude 2>&1"), 1);
  HAVE(" points that differ are where a slider never slips: where it rests is a matter of history");
}

CHECK_TESTS_WITH("verify.structures", 600, folder_make, folder_remove, every_response_is_judged,
                 mistakes_of_structures_are_named, one_of_several_is_named, a_relative_motion_is_named,
                 another_degree_of_freedom_is_named, a_load_elsewhere_is_named, a_missing_tangent_is_named,
                 what_history_decides_is_said)
