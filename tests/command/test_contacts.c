/* test_contacts.c - the tables of contacts and the forces of one contact agree with what other commands print. */
#include "tests/program.h"

#define CHAIN "cases/structures/chain3.yaml "
#define CASE2 "cases/paper/case2.yaml "
#define SPACE "cases/structures/space.yaml "

static int count(const char *fragment)
{
  int n = 0;
  for (const char *at = out; (at = strstr(at, fragment)) != NULL; ++at) ++n;
  return n;
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

/* Both sides of each contact; the work of ground, 1 on its path of 1, is what `transient` says. */
static void contacts_are_compared(CHECK_STATE)
{
  expect("transient " CHAIN "--at 1.25 --contacts --format csv -q", 0,
         "name,regime,normal_min,normal_max,traction_max,slip_distance,work\n1.25,hbm branch 0,0,ground,slip,");
  for (int c = 5; c <= 7; ++c) CHECK_NEAR(cell("# Contacts", "\n1.25,hbm branch 0,0,ground", c), 1, 1e-15, "of 1");
  const double work = cell("# Contacts", "\n1.25,hbm branch 0,0,ground", 9);
  expect("compare " CHAIN "--at 1.25 --contacts --format csv -q", 1, "\n\n# Contacts\n# work: dissipated in a period");
  assert_true(cell("\nomega,branch,contact,name,verdict,", "\n1.25,0,0,ground,differs,differs,slip,slip,", 9) == work);
  assert_int_equal(count("# DIFFERS at omega = 1.25, branch 0: contact ground: work "), 1);
  expect("compare " CASE2 "--at 7 --contacts --format csv -q", 0, "\nomega,branch,contact,verdict,contact_verdict,");
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

CHECK_TESTS("command.contacts", 60, pairs_are_one_row, contacts_are_compared, every_contact_of_every_solution_has_a_row,
            a_collinear_motion_is_that_of_one_tangent, one_contact_of_an_oscillator_adds_up)
