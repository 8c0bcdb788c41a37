/* test_contact_force.c - the forces of one contact under a motion that is given, through the C API. */
#include "tests/library/case2.h"

enum { H = 9, LENGTH = 2 * H + 1 };

/* Coefficients a0, a1, b1, ... of that force: tangential, tangential_2, normal. */
static void read_force(const hbmcheck_result *r, const char *force, double F[LENGTH])
{
  const hbmcheck_table *t = hbmcheck_result_table(r, 0);
  for (int i = 0; i < LENGTH; ++i) F[i] = NAN;
  for (int i = 0; i < hbmcheck_table_rows(t); ++i) {
    const int h = (int)hbmcheck_table_number(t, i, "harmonic");
    if (strcmp(hbmcheck_table_text(t, i, "force"), force) != 0 || h > H) continue;
    F[h ? 2 * h - 1 : 0] = hbmcheck_table_number(t, i, "cos");
    if (h) F[2 * h] = hbmcheck_table_number(t, i, "sin");
  }
}

#define FORCE(c, out, ...) assert_int_equal(RUN(c, "contact", NULL, out, "--contact=0", __VA_ARGS__), HBMCHECK_OK)

/* Stuck all period, T = kt u and N = N0 + kn v: of case 2's contact that is closed, kt = 100, kn = 1000. */
static void stuck_it_is_linear(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("contacts[0].gap=5", "contacts[0].friction=10", "hbm.harmonics=9");
  const double u[LENGTH] = {0, 0.25, 0, 0, 0.125}, v[LENGTH] = {0.5, 0, 1};
  double T[LENGTH], N[LENGTH];
  const char *const how[] = {"--set=hbm.force=exact", "--set=hbm.force=sampled"};
  for (int k = 0; k < 2; ++k) {
    hbmcheck_result *r;
    FORCE(c, &r, "--motion-u=0,0.25,0,0,0.125", "--motion-v=0.5,0,1", how[k], "--set=hbm.samples=64");
    read_force(r, "tangential", T);
    read_force(r, "normal", N);
    for (int i = 0; i < LENGTH; ++i) { /* sums of at most 64 numbers of 5000 and 25 at most */
      CHECK_LE(fabs(T[i] - 100 * u[i]), 64 * 25 * 0x1p-52, "T[%d] = %g", i, T[i]);
      CHECK_LE(fabs(N[i] - (i == 0 ? 5000 : 0) - 1000 * v[i]), 64 * 6500 * 0x1p-52, "N[%d] = %g", i, N[i]);
    }
    hbmcheck_result_free(r);
  }
  hbmcheck_case_free(c);
}

/* N0 = kn gap, u = A cos th: a Jenkins element, loss 4 mu N0 (A - x_c), x_c = mu N0/kt, pi A times the drop of b1. */
static void a_slider_loses_the_closed_form(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("contacts[0].gap=0.01", "contacts[0].friction=0.5");
  const double A = 0.2, f = 5, x_c = f / 100;
  double T[LENGTH], N[LENGTH];
  hbmcheck_result *r;
  FORCE(c, &r, "--motion-u=0,0.2,0");
  read_force(r, "tangential", T);
  read_force(r, "normal", N);
  CHECK_LE(fabs(T[2] + 4 * f * (A - x_c) / (PI * A)), 1e-13 * f, "b1 = %.17g", T[2]);
  CHECK_LE(fabs(N[0] - 10), 1e-14, "N0 = %.17g", N[0]);
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
}

/* In space, moved along a line: T and T2 share its forces as u and u2 do under the law of the circle. */
static void two_tangents_share_a_line(CHECK_STATE)
{
  const double a = 0.6, b = 0.8;
  double T[LENGTH], T2[LENGTH], N[LENGTH], line[LENGTH], none[LENGTH];
  hbmcheck_result *r;
  CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(SOURCE_DIR "/cases/structures/space.yaml", 0, NULL, NULL, 0, &c));
  FORCE(c, &r, "--set=hbm.harmonics=9", "--motion-u=0,0.2,0");
  read_force(r, "tangential", line);
  read_force(r, "tangential_2", none);
  read_force(r, "normal", N);
  hbmcheck_result_free(r);
  CHECK_LE(fabs(N[0] - 80 * 0.02), 1e-14, "N0 = %.17g", N[0]); /* kn gap of the whole contact, not of a half */
  FORCE(c, &r, "--set=hbm.harmonics=9", "--motion-u=0,0.12,0", "--motion-u2=0,0.16,0");
  read_force(r, "tangential", T);
  read_force(r, "tangential_2", T2);
  hbmcheck_result_free(r);
  for (int i = 0; i < LENGTH; ++i) { /* both are exact to rounding of mu N = 0.8, followed through a period */
    CHECK_LE(fabs(none[i]), 1e-12, "T2[%d] = %g", i, none[i]);
    CHECK_LE(fabs(T[i] - a * line[i]), 1e-12, "T[%d] = %g", i, T[i]);
    CHECK_LE(fabs(T2[i] - b * line[i]), 1e-12, "T2[%d] = %g", i, T2[i]);
  }
  CHECK_LE(0.1, -line[2], "slips: b1 = %g", line[2]);
  hbmcheck_case_free(c);
}

/* Each is refused in words. */
static void motions_that_are_none(CHECK_STATE)
{
  CHECK_MADE(hbmcheck_case, chain,
             hbmcheck_case_read(SOURCE_DIR "/cases/structures/chain3.yaml", 0, NULL, NULL, 0, &chain));
  const char *const bad[][2] = {{"--contact=ground", "--motion-v=0,1,0"},   /* no normal */
                                {"--contact=stop", "--motion-u=0,1,0"},     /* no tangent */
                                {"--contact=ground", "--motion-u2=0,1,0"},  /* one tangent */
                                {"--contact=ground", "--motion-u=0,1"},     /* an even number */
                                {"--contact=ground", "--motion-u=0,nan,0"}, /* no number */
                                {"--contact=3", "--motion-u=0,1,0"},        /* none */
                                {"--contact=ground", "--samples=8"}};       /* no motion */
  hbmcheck_result *r;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
    if (RUN(chain, "contact", NULL, &r, bad[i][0], bad[i][1]) != HBMCHECK_BAD_INPUT)
      fail_msg("call %zu is not refused", i);
    assert_non_null(hbmcheck_result_remark(r, 0));
    assert_null(hbmcheck_result_table(r, 0));
    hbmcheck_result_free(r);
  }
  hbmcheck_case_free(chain);
}

CHECK_TESTS("library.contact_force", 300, stuck_it_is_linear, a_slider_loses_the_closed_form, two_tangents_share_a_line,
            motions_that_are_none)
