/* test_structures.c - the commands on structures, and what they say of single contacts and responses. */
#include <stdbool.h>

#include "tests/program.h"

#define CHAIN "cases/structures/chain3.yaml "
#define CASE2 "cases/paper/case2.yaml "
#define PLANE "cases/structures/plane.yaml "
#define SPACE "cases/structures/space.yaml "

static int count(const char *fragment)
{
  int n = 0;
  for (const char *at = out; (at = strstr(at, fragment)) != NULL; ++at) ++n;
  return n;
}

/* ---- frf ------------------------------------------------------------------------------------------- */

static void one_response_is_kept(CHECK_STATE)
{
  expect("frf " CHAIN "--at 1.2 --format csv -q", 0, "omega,branch,response,amplitude,");
  assert_int_equal(count("\n1.2,"), 3);
  expect("frf " CHAIN "--at 1.2 --format csv -q --response 3", 0, "\n1.2,0,3,");
  assert_int_equal(count("\n1.2,"), 1);
  expect("frf " CHAIN "--at 1.2 --format csv -q --response 2-1 --set 'response=[1, {2: 1, 1: -1}]'", 0,
         "\n1.2,0,-1+2,");
  assert_int_equal(count("\n1.2,"), 1);
  expect("frf " CASE2 "--at 5 --format csv -q --response x", 0, "\n5,0,");
  expect("frf " CHAIN "--at 1.2 --response 4 2>&1", 64,
         "hbmcheck frf: --response: the case has no `4`; expected one of 1, 2, 3\n");
  expect("frf " CASE2 "--at 5 --response y 2>&1", 64, "--response: the case has no `y`; expected x\n");
}

/* Number `column`, from 0, of the first line of `out` after `table` that begins with `start`. */
static double cell(const char *table, const char *start, int column)
{
  const char *line = strstr(out, table);
  assert_non_null(line);
  line = strstr(line, start);
  assert_non_null(line);
  for (++line; column > 0; --column) line = strchr(line, ',') + 1;
  return strtod(line, NULL);
}

/* A contact with two tangents is two in the model, one in every table: normal forces add up, the limit is either's.
 * Under the square law, y still but for x's rounding, its work is the one tangent's: the case without tangent_2. */
static void pairs_are_one_row(CHECK_STATE)
{
  char line[1024];
  static const char *const at[] = {"frf %s --at 11.5 --contacts --format csv -q",
                                   "transient %s --at 11.5 --contacts --format csv -q",
                                   "compare %s --at 11.5 --contacts --format csv -q --set hbm.harmonics=15"};
  static const int work[] = {9, 7, 9}; /* its column */
  for (int k = 0; k < 3; ++k) {
    double single[2];
    for (int two = 0; two < 2; ++two) {
      snprintf(line, sizeof line, at[k],
               two ? "cases/structures/plane.yaml --set contacts[0].limit=square --set forcing[1].amplitude=1e-9"
                   : "cases/structures/plane.yaml --set forcing[1].amplitude=1e-9 --set 'contacts=[{name: rub, "
                     "tangential_stiffness: 60, friction: 0.5, preload: 4, tangent: x}]'");
      expect(line, 0, "\n11.5,");
      const char *rows = strstr(out, "slip_distance") ? "slip_distance" : "contact_verdict";
      assert_non_null(strstr(out, rows));
      const char *second = strstr(strstr(out, rows), "\n11.5,");
      assert_null(strstr(second + 1, "\n11.5,")); /* one row */
      single[two] = cell(rows, "\n11.5,", work[k]);
      assert_true(single[two] > 0.1);
    }
    CHECK_NEAR(single[1], single[0], 1e-6 * single[0], "work by %s", at[k]);
  }
  expect("modes cases/structures/plane.yaml --set contacts[0].limit=square --format csv -q", 0, "\n0,rub,closed,4,2\n");
  expect("modes cases/structures/space.yaml --set contacts[0].limit=square --format csv -q", 0,
         "\n0,foot,closed,1.6000000000000001,0.8");
}

/* What is not compared is said to be. */
static void comparisons_say_what_they_leave_out(CHECK_STATE)
{
  const char *const at_24 = "compare cases/structures/jenkins2.yaml --at 24.5 ";
  char line[256];
  snprintf(line, sizeof line, "%s--set 'response=[tip, {tip: 1e-12}]'", at_24);
  expect(line, 0, "1 row not compared: that response moves less than 1e-9 of the largest");
  expect(at_24, 0, "2 match");
  assert_int_equal(count("not compared"), 0);
}

/* --response keeps one; verdict and tables are of it (7 harmonics do for the third, not the first). All predicted. */
static void one_response_is_compared(CHECK_STATE)
{
  const char *const at = "compare " CHAIN "--at 1.4 --set hbm.harmonics=7 --set gate.amplitude=2e-3 --format csv -q ";
  char line[512];
  expect(at, 1, "omega,branch,response,verdict,");
  assert_int_equal(count("\n1.3999999999999999,0,"), 3);
  assert_int_equal(count(",differs,"), 1);
  snprintf(line, sizeof line, "%s--response 3 --tables --harmonics 3 --samples 32", at);
  expect(line, 0, "\n1.3999999999999999,0,3,match,");
  assert_int_equal(count("\n1.3999999999999999,0,"), 1);
  assert_int_equal(count("# by the response 3\n"), 1);
  assert_int_equal(count("\n3,sampled,32,"), 1);
  snprintf(line, sizeof line, "%s--response 4 2>&1", at);
  expect(line, 64, "--response: the case has no `4`; expected one of 1, 2, 3\n");
  expect("transient " CHAIN "--at 1.4 --response 2 --format csv -q --set transient.regularisation=1e-3", 0,
         "\n1.3999999999999999,2,settled,");
  assert_int_equal(count("\n1.3999999999999999,"), 1);
}

/* Both sides of each contact; the work of ground, 1 on its path of 1, is what `transient` says. */
static void contacts_are_compared(CHECK_STATE)
{
  expect("transient " CHAIN "--at 1.25 --contacts --format csv -q", 0,
         "omega,start,contact,name,regime,normal_min,normal_max,traction_max,slip_distance,work\n"
         "1.25,hbm branch 0,0,ground,slip,1,1,1,");
  const double work = cell("# Contacts", "\n1.25,hbm branch 0,0,ground", 9);
  expect("compare " CHAIN "--at 1.25 --contacts --format csv -q", 1, "\n\n# Contacts\n# work: dissipated in a period");
  assert_true(cell("\nomega,branch,contact,name,verdict,", "\n1.25,0,0,ground,differs,differs,slip,slip,", 9) == work);
  assert_int_equal(count("# DIFFERS at omega = 1.25, branch 0: contact ground: work "), 1);
  expect("compare " CASE2 "--at 7 --contacts --format csv -q", 0, "\nomega,branch,contact,verdict,contact_verdict,");
}

/* A damper out of reach of its contacts that no load presses on: by name, and what to do. */
static void what_nothing_holds_is_named(CHECK_STATE)
{
  const char *const words = "nothing holds the motion {damper_";
  expect("frf cases/structures/wedge_F2.yaml -q --set contacts[0].gap=-1 --set contacts[1].gap=-1 "
         "--set forcing[0].amplitude=0 2>&1",
         3, words);
  expect("frf cases/structures/wedge_F2.yaml -q --set contacts=[] 2>&1", 2, words);
}

/* By name, and what to do. */
static void what_has_no_mass_is_named(CHECK_STATE)
{
  const char *const words = "{root: 1} has none: condense it statically onto the others, or give it a small one";
  expect("transient cases/structures/jenkins2.yaml --at 24 --set structure.mass=[1,0] 2>&1", 2, words);
  expect("compare cases/structures/jenkins2.yaml --at 24 --set structure.mass=[1,0] 2>&1", 2, words);
  expect("transient cases/structures/jenkins2.yaml --at 24 --set 'structure.mass=[[1,1],[1,1]]' 2>&1", 2,
         "; {tip: 1, root: -1} has none");
}

/* Two masses, a spring of 1 between and one behind: omega^2 = (3 -+ sqrt 5)/2. No contact takes the transient out. */
static void what_has_no_damping_is_named(CHECK_STATE)
{
  const char *const words = "no damping acts on the mode at omega = 0.6180339887";
  expect("transient cases/structures/stop2.yaml -q --at 0.7 --set 'structure.damping=[[0,0],[0,0]]' "
         "--set transient.start=rest 2>&1",
         3, words);
  expect("compare cases/structures/stop2.yaml -q --at 0.7 --set 'structure.damping=[[0,0],[0,0]]' "
         "--set transient.start=rest 2>&1",
         3, words);
}

/* The stop touches DOF 3 alone, N = 1 (x3 - 0.25); the sliders have mu N = 1, so their work is their path. */
static void every_contact_of_every_solution_has_a_row(CHECK_STATE)
{
  expect("frf " CHAIN "--at 1.25 --contacts --format csv -q", 0,
         "\n\n# Contacts\n"
         "omega,branch,contact,name,regime,normal_min,normal_max,traction_max,slip_distance,work\n"
         "1.25,0,0,ground,slip,1,1,1,");
  assert_int_equal(3 * count(",stop,separation,0,"), count("\n1.25,") - 3 * count(",stop,"));
  const double touching = cell("# Response", "\n1.25,0,3,", 4) - 0.25;
  CHECK_NEAR(cell("# Contacts", "\n1.25,0,2,stop", 6), touching, 1e-15, "N of the stop");
  const double path = cell("# Contacts", "\n1.25,0,0,ground", 8);
  assert_true(path > 0 && path == cell("# Contacts", "\n1.25,0,0,ground", 9));
  expect("frf " CASE2 "--at 8 --contacts --format csv -q", 0, "\nomega,branch,contact,regime,normal_min,");
  expect("frf " CHAIN "--at 1.25 --contacts --set hbm.force=sampled", 0, "contacts by the exact law along the motion");
  expect("frf " CASE2 "--contacts --format json -q --set sweep.omega=19,20", 0, "\"Contacts\": [");
}

/* ---- contact --------------------------------------------------------------------------------------- */

/* ground: kt = 20, mu N = 1; under u = 0.1 cos it slips by 0.2 in all: work = 0.2 = -pi A b1, but for rounding. */
static void a_jenkins_element_has_its_closed_form(CHECK_STATE)
{
  expect("contact " CHAIN "--contact ground --motion-u 0,0.1,0 --samples 64 --format csv", 0,
         "force,harmonic,cos,sin,cos_64,sin_64\ntangential,0,");
  CHECK_NEAR(cell("force", "\ntangential,1,", 3), -0.2 / (PI * 0.1), 1e-15, "b1");
  CHECK_NEAR(cell("force", "\ntangential,1,", 5), -0.2 / (PI * 0.1), 2e-3, "b1 by 64 samples: of the order 1/64^2");
  assert_true(cell("force", "\nnormal,0,", 2) == 1 && cell("force", "\nnormal,1,", 2) == 0);
  expect("contact " CHAIN "--contact 0 --motion-u 0,0.1,0", 0, "slip path 0.2, work 0.2 in a period");
}

/* T = 20 (u - w) with w = 0.005; from w = 0.03 the slider is dragged to 0.01, where T is -1 at least. */
static void the_slider_starts_where_it_is_told(CHECK_STATE)
{
  expect("contact " CHAIN "--contact ground --motion-u 0,0.04,0 --slider 0.005 --format csv", 0, "force,");
  CHECK_NEAR(cell("force", "\ntangential,0,", 2), -0.1, 1e-15, "mean of T");
  expect("contact " CHAIN "--contact ground --motion-u 0,0.04,0 --slider 0.03 --format csv", 0, "force,");
  CHECK_NEAR(cell("force", "\ntangential,0,", 2), -0.2, 1e-15, "mean of T");
  CHECK_NEAR(cell("force", "\ntangential,1,", 2), 0.8, 1e-15, "T");
}

/* kt = 60, mu N = 2, R = 1/30. Round a circle of radius a = 0.1 > R it slips all the time, and T lags: mu N R/a of it
 * along u, mu N sqrt(1 - R^2/a^2) along u'. The slider goes round one of radius sqrt(a^2 - R^2). Between samples u goes
 * along chords, up to a h^2/8 beside the circle, h = 2 pi/64: T is off by less than kt times that (0.7 of it). */
static void a_circular_motion_has_its_closed_form(CHECK_STATE)
{
  const double along = 2. / 3, across = 2 * sqrt(8. / 9);
  expect("contact " PLANE "--contact rub --motion-u 0,0.1,0 --motion-u2 0,0,0.1 --samples 64 --format csv", 0,
         "force,harmonic,cos,sin,cos_64,sin_64\ntangential,0,");
  for (int set = 0; set < 2; ++set) {
    const double near = set ? 60 * 0.1 * (2 * PI / 64) * (2 * PI / 64) / 8 : 4e-15;
    CHECK_NEAR(cell("force", "\ntangential,1,", 2 + 2 * set), along, near, "T_1 along");
    CHECK_NEAR(cell("force", "\ntangential,1,", 3 + 2 * set), -across, near, "T_1 across");
    CHECK_NEAR(cell("force", "\ntangential_2,1,", 2 + 2 * set), across, near, "T_2 across");
    CHECK_NEAR(cell("force", "\ntangential_2,1,", 3 + 2 * set), along, near, "T_2 along");
  }
  assert_true(cell("force", "\nnormal,0,", 2) == 4 && cell("force", "\nnormal,1,", 2) == 0);
  expect("contact " PLANE "--contact rub --motion-u 0,0.1,0 --motion-u2 0,0,0.1", 0,
         "|T| at most 2, slip path 0.592384392, work 1.18476878 in a period"); /* 0.2 pi sqrt(8/9) and twice that */
}

/* u = (0.6, 0.8) s: T = (0.6, 0.8) of the contact with one tangent under s, exact and sampled; it slips and lifts off.
 * Rounding of forces up to 80 (0.07 + 0.02). */
static void a_collinear_motion_is_that_of_one_tangent(CHECK_STATE)
{
  static const char *const forces[] = {"\ntangential,%d,", "\ntangential_2,%d,", "\nnormal,%d,"};
  enum { HARMONICS = 4, CELLS = 4 };
  double one[3][HARMONICS][CELLS], rows[3][HARMONICS][CELLS];
  for (int pair = 0; pair < 2; ++pair) {
    char start[32];
    expect(pair ? "contact " SPACE "--contact foot --motion-u 0,0.03,0.012 --motion-u2 0,0.04,0.016 "
                  "--motion-v 0,0.01,0.06 --samples 64 --format csv --set hbm.harmonics=3"
                : "contact " SPACE "--set 'contacts=[{name: foot, tangential_stiffness: 60, normal_stiffness: 80, "
                  "friction: 0.5, gap: 0.02, tangent: x, normal: z}]' --motion-u 0,0.05,0.02 "
                  "--motion-v 0,0.01,0.06 --samples 64 --format csv --set hbm.harmonics=3",
           0, "force,harmonic,");
    for (int d = 0; d < 3; ++d)
      for (int h = 0; h < HARMONICS; ++h)
        for (int k = 0; k < CELLS && (pair || d != 1); ++k) {
          snprintf(start, sizeof start, forces[d], h);
          (pair ? rows : one)[d][h][k] = cell("force", start, 2 + k);
        }
  }
  for (int h = 0; h < HARMONICS; ++h)
    for (int k = 0; k < CELLS; ++k) {
      CHECK_NEAR(rows[0][h][k], 0.6 * one[0][h][k], 1e-13, "T_1");
      CHECK_NEAR(rows[1][h][k], 0.8 * one[0][h][k], 1e-13, "T_2");
      CHECK_NEAR(rows[2][h][k], one[2][h][k], 1e-13, "N");
    }
}

/* Under the square law each direction is a Jenkins element of its own: A = 0.1 loses 4 mu N (A - R) = pi A |b|. */
static void a_square_has_two_jenkins_elements(CHECK_STATE)
{
  const double b = 4 * 2 * (0.1 - 1. / 30) / (PI * 0.1);
  expect("contact " PLANE "--contact rub --motion-u 0,0.1,0 --motion-u2 0,0,0.1 --set contacts[0].limit=square "
         "--format csv",
         0, "force,harmonic,");
  CHECK_NEAR(cell("force", "\ntangential,1,", 3), -b, 4e-15, "T_1");
  CHECK_NEAR(cell("force", "\ntangential_2,1,", 2), b, 4e-15, "T_2");
  assert_true(cell("force", "\nnormal,0,", 2) == 4);
  /* N = 80 max(v + gap, 0) of both halves: v = -0.01, constant, is half of gap */
  expect("contact " SPACE "--contact foot --motion-u 0,0.01,0 --motion-v -0.01 --set contacts[0].limit=square "
         "--samples 64 --format csv",
         0, "force,harmonic,");
  CHECK_NEAR(cell("force", "\nnormal,0,", 2), 0.8, 1e-15, "N");
  CHECK_NEAR(cell("force", "\nnormal,0,", 4), 0.8, 1e-15, "N, sampled");
}

/* T = 60 (u - w) where it sticks. */
static void a_slider_of_two_tangents_starts_where_it_is_told(CHECK_STATE)
{
  static const char *const limits[] = {"circle", "square"};
  for (int i = 0; i < 2; ++i) {
    char args[256];
    snprintf(args, sizeof args,
             "contact " PLANE "--contact rub --motion-u 0,0.01,0 --slider 0.005,-0.01 --set contacts[0].limit=%s "
             "--format csv",
             limits[i]);
    expect(args, 0, "force,");
    CHECK_NEAR(cell("force", "\ntangential,0,", 2), -0.3, 1e-15, "mean of T_1");
    CHECK_NEAR(cell("force", "\ntangential,1,", 2), 0.6, 1e-15, "T_1");
    CHECK_NEAR(cell("force", "\ntangential_2,0,", 2), 0.6, 1e-15, "mean of T_2");
  }
}

/* N = max(cos - 0.25, 0), closed for |th| < p: its mean is (sin p - p/4)/pi. */
static void a_stop_has_a_normal_force_alone(CHECK_STATE)
{
  const double p = acos(0.25);
  expect("contact " CHAIN "--contact stop --motion-v 0,1,0 --format csv", 0, "force,");
  CHECK_NEAR(cell("force", "\nnormal,0,", 2), (sin(p) - p / 4) / PI, 1e-15, "mean of N");
  expect("contact " CHAIN "--contact stop --motion-u 0,1,0 2>&1", 64, "contact stop has no tangent;");
  expect("contact " CHAIN "--contact ground --motion-v 0,1,0 2>&1", 64,
         "contact ground has no normal; expected no --mo");
}

/* On x act T cos 45 + (N - N0) sin 45 of the one contact; N0 = 0 with a clearance, 200 with a preload. */
static void one_contact_of_an_oscillator_adds_up(CHECK_STATE)
{
  const char *const set[] = {"", "--set 'contacts[0].gap=0.2' "};
  const double preload[] = {0, 200};
  for (int i = 0; i < 2; ++i) {
    char args[256];
    snprintf(args, sizeof args, "contact " CASE2 "--motion 0,8,0 %s--format csv", set[i]);
    expect(args, 0, "\nharmonic,cos,sin\n");
    const double sum = cell("harmonic", "\n1,", 1), mean = cell("harmonic", "\n0,", 1);
    snprintf(args, sizeof args, "contact " CASE2 "--contact 0 --motion 0,8,0 %s--format csv", set[i]);
    expect(args, 0, "\nforce,harmonic,cos,sin\n");
    const double both = cell("force", "\ntangential,1,", 2) + cell("force", "\nnormal,1,", 2);
    const double means = cell("force", "\ntangential,0,", 2) + cell("force", "\nnormal,0,", 2) - preload[i];
    CHECK_NEAR(both * sqrt(0.5), sum, 1e-15 * 5000, "cosine"); /* of forces up to 1000 (8 + 0.2)/sqrt(2) */
    CHECK_NEAR(means * sqrt(0.5), mean, 1e-15 * 5000, "mean");
  }
}

static void a_motion_that_fits_no_contact_is_refused(CHECK_STATE)
{
  expect("contact " CHAIN "--motion 0,1,0 2>&1", 64, "the case has 3 degrees of freedom; expected --contact NAME");
  expect("contact " CHAIN "--motion-u 0,1,0 2>&1", 64, "of which contact? expected --contact NAME");
  expect("contact " CHAIN "--contact 3 --motion-u 0,1,0 2>&1", 64, "no `3`; expected one of ground, between, stop");
  expect("contact " CHAIN "--contact ground 2>&1", 64, "no motion given: --motion-u");
  expect("contact " CHAIN "--contact ground --motion 0,1,0 2>&1", 64, "--motion is for one degree of freedom");
  expect("contact " CHAIN "--contact ground --motion-u 0,1 2>&1", 64, "--motion-u has 2 coefficients");
  expect("contact " CHAIN "--contact ground --motion-u 0,1,0 --slider x 2>&1", 64, "--slider: 'x' is not");
  expect("contact " CASE2 "--motion 0,1,0 --motion-u 0,1,0 2>&1", 64, "--motion is of x, and u and v follow from it");
  expect("contact " CHAIN "--contact ground --motion-u2 0,1,0 2>&1", 64, "contact ground has no second tangent;");
  expect("contact " PLANE "--contact rub --motion-v 0,1,0 2>&1", 64,
         "contact rub has no normal; expected no --motion-v");
  expect("contact " PLANE "--motion-u2 0,1 2>&1", 64, "--motion-u2 has 2 coefficients");
  expect("contact " PLANE "--motion-u 0,1,0 --slider 1 2>&1", 64, "--slider: '1' is not two finite numbers W1,W2");
  expect("contact " PLANE "--motion-u 0,1,0 --slider 1,nan 2>&1", 64, "'1,nan' is not two finite numbers W1,W2");
}

/* ---- study and describe ---------------------------------------------------------------------------- */

/* Two scenes, three responses each; what is drawn and summed up is of the first. */
static void a_study_keeps_every_response(CHECK_STATE)
{
  char line[1024];
  snprintf(line, sizeof line,
           "printf 'study: s\\nbase: %s/" CHAIN
           "\\nrun: frf\\nset: {compare.omega: [1.25]}\\nvary:\\n  - contacts[between]."
           "friction: [1, 2]\\n' | %s study /dev/stdin --results :memory: --export csv -q",
           SOURCE_DIR, HBMCHECK_COMMAND);
  const int code = shell_read(line, out, sizeof out);
  shell_check(line, code, out, 0, ",omega,branch,response,amplitude,");
  assert_int_equal(count(",1.25,0,1,"), 2);
  assert_int_equal(count(",1.25,0,3,"), 2);
}

/* Both sides, and time integration alone, of two frictions; --response is a filter of the export. */
static void a_study_runs_time_integration_of_structures(CHECK_STATE)
{
  static const struct run {
    const char *kind, *header, *row;
  } runs[] = {{"compare", ",omega,branch,response,verdict,hbm_amplitude,", ",25.800000000000001,0,%s,match,"},
              {"transient", ",omega,response,verdict,amplitude,", ",25.800000000000001,%s,settled,"}};
  for (int i = 0; i < 4; ++i) {
    const struct run *r = &runs[i / 2];
    const bool one = i % 2;
    char line[1024], row[64];
    snprintf(line, sizeof line,
             "printf 'study: s\\nbase: %s/cases/structures/jenkins2.yaml\\nrun: %s\\nset: {compare.omega: [25.8], "
             "hbm.harmonics: 9}\\nvary:\\n  - contacts[0].friction: [0.5, 1]\\n' | %s study /dev/stdin --results "
             ":memory: --export csv -q %s",
             SOURCE_DIR, r->kind, HBMCHECK_COMMAND, one ? "--response root" : "");
    const int code = shell_read(line, out, sizeof out);
    shell_check(line, code, out, 0, r->header);
    for (int tip = 0; tip < 2; ++tip) {
      snprintf(row, sizeof row, r->row, tip ? "tip" : "root");
      assert_int_equal(count(row), one && tip ? 0 : 2);
    }
  }
  expect("study cases/studies/recontact.yaml --results :memory: --response tip 2>&1", 64,
         "has one degree of freedom, expected a structure");
}

static void a_structure_says_what_it_resolved_to(CHECK_STATE)
{
  expect("describe --case " CHAIN "--format csv", 0,
         "\nstructure.mass,\"3 x 3, diagonal\",force time^2/length,file,6,9,");
  const char *const words[] = {"\nstructure.damping,rayleigh,force",
                               "\nstructure.damping.rayleigh,\"[0, 0.02]\",",
                               "\nstructure.damping.modal,,1,,,,",
                               "\nforcing[0].direction,2,",
                               "\nforcing[0].amplitude,1,force,file,10,5,",
                               "\ncontacts[0].name,ground,",
                               "\ncontacts[1].tangent,-1+2,1,file,",
                               "\ncontacts[1].normal,,1,,,,",
                               "\ncontacts[1].normal_stiffness,,force/length,,,,",
                               "\ncontacts[2].gap,-0.25,length,",
                               "\ncontacts[2].tangential_stiffness,,",
                               "\nresponse,\"1, 2, 3\",",
                               "\nhbm.harmonics,5,1,default,",
                               "\ndegrees_of_freedom,3,1,",
                               "\nomega_open,0.7653668647301"}; /* 2 sin(pi/8), of a chain of 3 */
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i) assert_non_null(strstr(out, words[i]));
  assert_null(strstr(out, "oscillator."));
  assert_null(strstr(out, "\nforcing.amplitude"));
  expect("describe --case cases/structures/beam16.yaml --format csv", 0,
         "structure.stiffness,16 x 16 of cases/structures/");
  expect("describe contacts --case " CHAIN "--set 'contacts[between].friction=3' --format csv", 0,
         "\ncontacts[1].friction,3,1,--set,");
  assert_null(strstr(out, "structure.mass"));
}

CHECK_TESTS("command.structures", 60, pairs_are_one_row, one_response_is_kept, what_nothing_holds_is_named,
            what_has_no_mass_is_named, what_has_no_damping_is_named, comparisons_say_what_they_leave_out,
            one_response_is_compared, contacts_are_compared, every_contact_of_every_solution_has_a_row,
            a_jenkins_element_has_its_closed_form, the_slider_starts_where_it_is_told,
            a_circular_motion_has_its_closed_form, a_collinear_motion_is_that_of_one_tangent,
            a_square_has_two_jenkins_elements, a_slider_of_two_tangents_starts_where_it_is_told,
            a_stop_has_a_normal_force_alone, one_contact_of_an_oscillator_adds_up,
            a_motion_that_fits_no_contact_is_refused, a_study_keeps_every_response,
            a_study_runs_time_integration_of_structures, a_structure_says_what_it_resolved_to)
