/* test_verdicts.c - every scene of cases/adversarial through the command: verdicts and exit codes; why each must be so
 * stands in the case file. Motions: test_contacts.c, test_curves.c. */
#include "tests/program.h"

/* The third column, `verdict`, of the rows of a csv, one letter each: m match, u unstable, o other_branch, ... */
static void letters(char *csv, char *found, size_t size)
{
  size_t n = 0;
  for (char *line = strtok(csv, "\n"); line; line = strtok(NULL, "\n")) {
    char word[32];
    double omega;
    int branch;
    if (sscanf(line, "%lf,%d,%31[a-z_0-9]", &omega, &branch, word) == 3 ||
        sscanf(line, "%lf,,%31[a-z_0-9]", &omega, word) == 2)
      if (n + 1 < size) found[n++] = word[0];
  }
  found[n] = 0;
}

typedef struct verdicts {
  const char *scene, *options;
  int code;
  const char *letters;
} verdicts;

static void check_verdicts(int n, const verdicts *v)
{
  for (int i = 0; i < n; ++i) {
    char args[512], got[64];
    snprintf(args, sizeof args, "compare cases/adversarial/%s.yaml --format csv -q %s 2>&1", v[i].scene, v[i].options);
    const int code = run(args);
    letters(out, got, sizeof got);
    if (code == v[i].code && !strcmp(got, v[i].letters)) continue;
    print_error("hbmcheck %s\nexit %d, verdicts '%s', expected %d, '%s'\n", args, code, got, v[i].code, v[i].letters);
    fail();
  }
}

#define CHECK_VERDICTS(list) check_verdicts((int)(sizeof list / sizeof *list), list)

static void contacts(CHECK_STATE)
{
  static const verdicts list[] = {
      {"grazing", "", 0, "mmum"},
      {"amplitude_is_gap", "", 0, "m"},
      {"cone_edge", "", 0, "mmmum"},
      {"vanishing_together", "", 0, "mmmumm"},
      {"angle_0", "", 0, "mmmm"},
      {"angle_90", "", 0, "mmmm"},
      {"no_friction", "", 0, "mmmumm"},
      {"huge_friction", "", 0, "mmmumm"},
      {"huge_friction", "--set 'contacts[0].friction=1e6'", 0, "mmmumm"},
      {"gap_0", "", 0, "mmmmm"},
      {"two_at_once", "", 0, "mmmm"},
      {"sixteen", "--at 5,9,13,22", 0, "mmmm"},
      {"friction_only", "", 0, "mmmm"},
      {"soft", "", 0, "mmm"},
      /* refused, and said so, rather than hung */
      {"huge_friction", "--at 5,6 --set 'contacts[0].friction=1e308'", 3, "ss"},
  };
  CHECK_VERDICTS(list);
}

/* 20 harmonics cannot draw a wall: what is in contact differs, or is unstable by the referee; what is not is exact. */
static void curves(CHECK_STATE)
{
  static const verdicts list[] = {
      {"hard", "", 1, "mddumm"},
      {"overdamped", "", 0, "mmmm"},
      {"downwards", "", 0, "mmumm"},
      {"no_force", "", 0, "mm"},
      {"zeta_1e-6", "", 0, "mmm"},
      {"zeta_1e-6_contact", "--at 0.95,1,1.05", 0, "mmm"},
      {"two_hundred_harmonics", "--at 9", 0, "mum"},
      /* leaves a saddle that forgets 1e-6 a period: 300 do not do, and it is said */
      {"zeta_1e-6_contact", "--at 1.0005 --set transient.max_periods=300", 3, "mnm"},
  };
  CHECK_VERDICTS(list);
}

/* The orbit of 7.37 is on the curve from 3 to 30, as a transient swept down says. A curve that cannot turn round says
 * where it stopped and agrees to nothing. A sweep too narrow for the fold sees one branch, and does not disagree. */
static void a_branch_is_not_hidden(CHECK_STATE)
{
  static const verdicts list[] = {
      {"isolated", "", 0, "mum"},
      {"isolated", "--set transient.start=down", 0, "oum"},
      {"isolated", "--set transient.start=up", 0, "muo"},
      {"isolated", "--set hbm.continuation=natural", 3, "m"},
      {"isolated", "--set hbm.continuation=natural --set transient.start=down", 1, "o"},
      {"isolated", "--set sweep.omega=15,17", 0, "m"},
      {"isolated", "--set sweep.omega=15,30", 0, "mum"},
  };
  CHECK_VERDICTS(list);
  expect("gate cases/adversarial/isolated.yaml -q --set transient.start=down 2>&1", 0, "13 passed");
  expect("gate cases/adversarial/isolated.yaml -q --set transient.start=down --set hbm.continuation=natural 2>&1", 1,
         "fail");
  expect("frf cases/adversarial/isolated.yaml --at 16 -q --format csv 2>&1", 0, "16,2,7.3659");
  expect("frf cases/adversarial/isolated.yaml --at 16 -q --set hbm.continuation=natural 2>&1", 3, "stopped at omega");
}

/* The HBM solution at 5.3 is good, and unstable: nothing runs there. */
static void chaos_is_not_agreed_with(CHECK_STATE)
{
  static const verdicts list[] = {{"chaotic", "--at 5.3,6", 1, "am"}};
  CHECK_VERDICTS(list);
  expect("frf cases/adversarial/chaotic.yaml --at 5.3 -q --format csv 2>&1", 0, ",no,");
}

static void refusals(CHECK_STATE)
{
  expect("compare cases/adversarial/one_point.yaml 2>&1", 2, "one_point.yaml:6:16: the sweep ends where it starts");
  expect("frf cases/adversarial/one_point.yaml 2>&1", 2, "--at");
  expect("compare cases/adversarial/fewest_samples.yaml -q --at 6,6.5 2>&1", 1, "aliasing");
  expect("compare cases/adversarial/fewest_samples.yaml --set hbm.samples=10 2>&1", 2, "hbm.samples >= 11");
  expect("compare cases/adversarial/two_hundred_harmonics.yaml --set hbm.harmonics=201 2>&1", 2, "200");
}

CHECK_TESTS("adversarial.verdicts", 900, contacts, curves, a_branch_is_not_hidden, chaos_is_not_agreed_with, refusals)
