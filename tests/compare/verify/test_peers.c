/* test_peers.c - curves that NLvib and tmdsimpy computed (cases/README.md), in their own quantities: right ones
 * match at every point, folds included, and what is wrong with the others is named. */
#include "tests/shell.h"

#define CASE2     "cases/verify/case2.yaml"
#define CLEARANCE "cases/verify/unilateral.yaml"
#define PRELOADED "cases/verify/unilateral.yaml --set 'contacts[0].gap=0.5'"

#define CHAIN3         "cases/structures/chain3.yaml"
#define TANGENT_NORMAL "cases/structures/tangent_normal_F100.yaml"

#define SPACE  "cases/structures/space.yaml --set contacts[0].gap=0.1 --set sweep.omega=[11,15.2]"
#define SQUARE SPACE " --set contacts[0].limit=square"

typedef struct peer {
  const char *scene, *file, *quantity;
  int code;
  const char *said;
} peer;

static void judged(int n, const peer *p)
{
  static char out[262144];
  for (int i = 0; i < n; ++i) {
    char line[1024];
    snprintf(line, sizeof line, "%s verify %s -q --format csv --against cases/verify/%s --quantity %s",
             HBMCHECK_COMMAND, p[i].scene, p[i].file, p[i].quantity);
    const int code = shell_read(line, out, sizeof out);
    shell_check(line, code, out, p[i].code, p[i].said);
  }
}
#define JUDGED(list) judged(sizeof list / sizeof *list, list)

static void right_curves_match(CHECK_STATE)
{
  static const peer list[] = {
      {CASE2, "nlvib_case2.csv", "norm_over_root_2", 0, "# cause: none"},
      {CASE2, "nlvib_case2.csv", "harmonic_1", 0, "# cause: none"},
      {CASE2, "tmdsimpy_case2.csv", "norm", 0, "# cause: none"},
      {CASE2, "tmdsimpy_case2.csv", "harmonic_1", 0, "# cause: none"},
      {CLEARANCE, "nlvib_clearance.csv", "norm_over_root_2", 0, "# cause: none"},
      {CLEARANCE, "tmdsimpy_clearance.csv", "norm", 0, "# cause: none"},
      {CLEARANCE, "tmdsimpy_clearance.csv", "harmonic_1", 0, "# cause: none"},
      {PRELOADED, "nlvib_preloaded.csv", "norm_over_root_2", 0, "# cause: none"},
      {PRELOADED, "tmdsimpy_preloaded.csv", "norm", 0, "# cause: none"},
  };
  JUDGED(list);
}

static void wrong_curves_are_named(CHECK_STATE)
{
  static const peer list[] = {
      {CASE2, "nlvib_case2_n32.csv", "norm_over_root_2", 1, "# cause: too_few_samples\n"},
      {CASE2, "nlvib_case2_n32.csv", "norm_over_root_2", 1, "H = 10, N = 32; "},
      {CASE2, "nlvib_case2_n32.csv", "harmonic_1", 1, "# cause: too_few_samples\n"},
      /* the right curve under another name */
      {CASE2, "nlvib_case2.csv --columns omega=1,value=2", "rms", 1, "# cause: norm_over_root_2\n"},
  };
  JUDGED(list);
}

static void wandered_curves_are_judged(CHECK_STATE)
{
  static const peer list[] = {
      {CASE2, "tmdsimpy_case2_wandered.csv", "norm", 1, "# 67 points at omega <= 0 left out"},
      {CASE2, "tmdsimpy_case2_wandered.csv", "norm", 1, "H = 5, N = 128; "},
      {CASE2, "tmdsimpy_case2_wandered.csv", "norm", 1, "# cause: too_few_harmonics+too_few_samples\n"},
      {CLEARANCE, "nlvib_wandered.csv", "norm_over_root_2", 0, "# the curve reverses 155 times: its program wandered"},
      {CLEARANCE, "nlvib_wandered.csv", "norm_over_root_2", 0, "# cause: none"},
  };
  JUDGED(list);
}

/* H = 7 is too few for chain3, and said to be 7; NLvib's RMS is named where it is called one. tmdsimpy's contact with a
 * varying normal force, as it should be and with 16 samples. */
static void structures_are_judged(CHECK_STATE)
{
  static const peer list[] = {
      {CHAIN3, "nlvib_chain3.csv --columns omega=1,rms@3=7", "rms", 1,
       "too few harmonics, and the values are norms of all harmonics divided by the root of 2 (H = 7; "},
      {TANGENT_NORMAL, "tmdsimpy_tangent_normal.csv --columns omega=1,amplitude@along=2,amplitude@across=4",
       "amplitude", 0, "# cause: none"},
      {TANGENT_NORMAL, "tmdsimpy_tangent_normal.csv --columns omega=1,rms@across=5", "rms", 1,
       "# cause: norm_over_root_2\n"},
      {TANGENT_NORMAL, "tmdsimpy_tangent_normal_n16.csv --columns omega=1,amplitude@along=2", "amplitude", 1,
       "suspected cause: too few samples (H = 7, N = 16; "},
  };
  JUDGED(list);
}

/* tmdsimpy's element limits each of two tangential forces by itself; a radial return limits the vector. That is of
 * first order where slip turns: at N = 1024 it is off by 1.4e-3 here, hence the wider gate. */
static void laws_of_two_tangents_are_told_apart(CHECK_STATE)
{
  static const peer list[] = {
      {SQUARE, "tmdsimpy_space.csv --columns omega=1,amplitude@x=2,amplitude@y=3,amplitude@z=4", "amplitude", 0,
       "# cause: none"},
      {SQUARE, "radial_space.csv --columns omega=1,amplitude@y=3", "amplitude", 1,
       "suspected cause: friction in two directions is limited as a vector (limit: circle) (limit: circle, H = "},
      {SQUARE, "radial_space.csv --columns omega=1,amplitude@y=3", "amplitude", 1, "# cause: circle_limit\n"},
      {SPACE " --set gate.amplitude=2e-3",
       "radial_space.csv --columns omega=1,amplitude@x=2,amplitude@y=3,amplitude@z=4", "amplitude", 0, "# cause: none"},
      {SPACE, "tmdsimpy_space.csv --columns omega=1,amplitude@y=3", "amplitude", 1,
       "suspected cause: friction is limited in each of two directions by itself (limit: square) (limit: square, H = "},
      {SPACE, "tmdsimpy_space.csv --columns omega=1,amplitude@y=3", "amplitude", 1, "# cause: square_limit\n"},
  };
  JUDGED(list);
}

CHECK_TESTS("verify.peers", 300, right_curves_match, wrong_curves_are_named, wandered_curves_are_judged,
            structures_are_judged, laws_of_two_tangents_are_told_apart)
