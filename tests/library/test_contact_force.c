/* test_contact_force.c - the forces of one contact under a motion that is given, through the C API. */
#include "tests/library/case2.h"

enum { H = 9, LENGTH = 2 * H + 1 };

/* Stuck all period, T = kt u and N = N0 + kn v: of case 2's contact that is closed, kt = 100, kn = 1000. */
static void stuck_it_is_linear(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("contacts[0].gap=5", "contacts[0].friction=10");
  double u[LENGTH] = {0, 0.25, 0, 0, 0.125}, v[LENGTH] = {0.5, 0, 1}, T[LENGTH], N[LENGTH];
  for (int samples = 0; samples <= 64; samples += 64) {
    assert_int_equal(hbmcheck_contact_force(c, 0, H, u, NULL, v, samples, T, NULL, N), HBMCHECK_OK);
    for (int i = 0; i < LENGTH; ++i) { /* sums of at most 64 numbers of 5000 and 25 at most */
      CHECK_LE(fabs(T[i] - 100 * u[i]), 64 * 25 * 0x1p-52, "T[%d] = %g", i, T[i]);
      CHECK_LE(fabs(N[i] - (i == 0 ? 5000 : 0) - 1000 * v[i]), 64 * 6500 * 0x1p-52, "N[%d] = %g", i, N[i]);
    }
  }
  hbmcheck_case_free(c);
}

/* N0 = kn gap, u = A cos th: a Jenkins element, loss 4 mu N0 (A - x_c), x_c = mu N0/kt, pi A times the drop of b1. */
static void a_slider_loses_the_closed_form(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("contacts[0].gap=0.01", "contacts[0].friction=0.5");
  const double A = 0.2, f = 5, x_c = f / 100;
  const double u[LENGTH] = {0, A};
  double T[LENGTH], N[LENGTH];
  assert_int_equal(hbmcheck_contact_force(c, 0, H, u, NULL, NULL, 0, T, NULL, N), HBMCHECK_OK);
  CHECK_LE(fabs(T[2] + 4 * f * (A - x_c) / (PI * A)), 1e-13 * f, "b1 = %.17g", T[2]);
  CHECK_LE(fabs(N[0] - 10), 1e-14, "N0 = %.17g", N[0]);
  hbmcheck_case_free(c);
}

/* In space, moved along a line: T and T2 share its forces as u and u2 do under the law of the circle. */
static void two_tangents_share_a_line(CHECK_STATE)
{
  char name[32];
  const double a = 0.6, b = 0.8, A = 0.2;
  const double along[LENGTH] = {0, A}, u[LENGTH] = {0, a * A}, u2[LENGTH] = {0, b * A};
  double T[LENGTH], T2[LENGTH], N[LENGTH], line[LENGTH], none[LENGTH];
  CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(SOURCE_DIR "/cases/structures/space.yaml", 0, NULL, NULL, 0, &c));
  assert_int_equal(hbmcheck_case_contacts(c), 1);
  assert_int_equal(hbmcheck_case_contact_tangents(c, 0), 2);
  assert_int_equal(hbmcheck_case_contact_name(c, 0, name, sizeof name), HBMCHECK_OK);
  assert_string_equal(name, "foot");
  assert_int_equal(hbmcheck_contact_force(c, 0, H, along, NULL, NULL, 0, line, none, N), HBMCHECK_OK);
  CHECK_LE(fabs(N[0] - 80 * 0.02), 1e-14, "N0 = %.17g", N[0]); /* kn gap of the whole contact, not of a half */
  assert_int_equal(hbmcheck_contact_force(c, 0, H, u, u2, NULL, 0, T, T2, N), HBMCHECK_OK);
  for (int i = 0; i < LENGTH; ++i) { /* both are exact to rounding of mu N = 0.8, followed through a period */
    CHECK_LE(fabs(none[i]), 1e-12, "T2[%d] = %g", i, none[i]);
    CHECK_LE(fabs(T[i] - a * line[i]), 1e-12, "T[%d] = %g", i, T[i]);
    CHECK_LE(fabs(T2[i] - b * line[i]), 1e-12, "T2[%d] = %g", i, T2[i]);
  }
  CHECK_LE(0.1, -line[2], "slips: b1 = %g", line[2]);
  hbmcheck_case_free(c);
}

static void contacts_have_names(CHECK_STATE)
{
  hbmcheck_case *c = CASE2(NULL);
  char name[32] = "before";
  assert_int_equal(hbmcheck_case_contacts(NULL), 0);
  assert_int_equal(hbmcheck_case_contacts(c), 1);
  assert_int_equal(hbmcheck_case_contact_tangents(c, 0), 1);
  assert_int_equal(hbmcheck_case_contact_tangents(c, 1), 0);
  assert_int_equal(hbmcheck_case_contact_tangents(c, -1), 0);
  assert_int_equal(hbmcheck_case_contact_tangents(NULL, 0), 0);
  assert_int_equal(hbmcheck_case_contact_name(c, 1, name, sizeof name), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_case_contact_name(c, -1, name, sizeof name), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_case_contact_name(c, 0, NULL, 4), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_case_contact_name(NULL, 0, name, sizeof name), HBMCHECK_BAD_INPUT);
  assert_string_equal(name, "before");
  assert_int_equal(hbmcheck_case_contact_name(c, 0, name, sizeof name), HBMCHECK_OK);
  assert_string_equal(name, "0"); /* it has none */
  hbmcheck_case_free(c);
}

/* Every call below is BAD_INPUT and leaves T, T2 and N alone. */
static void motions_that_are_none(CHECK_STATE)
{
  hbmcheck_case *c = CASE2(NULL), *chain;
  assert_int_equal(hbmcheck_case_read(SOURCE_DIR "/cases/structures/chain3.yaml", 0, NULL, NULL, 0, &chain),
                   HBMCHECK_OK);
  const double u[LENGTH] = {0, 1}, nan[LENGTH] = {0, 1, NAN}, infinite[LENGTH] = {INFINITY};
  double T[LENGTH] = {7}, T2[LENGTH] = {8}, N[LENGTH] = {9};
  const struct {
    const hbmcheck_case *c;
    int j, harmonics;
    const double *u, *u2, *v;
    int samples;
    double *T, *T2, *N;
  } bad[] = {
      {NULL, 0, H, u, NULL, u, 0, T, NULL, N},     {c, 1, H, u, NULL, u, 0, T, NULL, N},
      {c, -1, H, u, NULL, u, 0, T, NULL, N},       {c, 0, 0, u, NULL, u, 0, T, NULL, N},
      {c, 0, 201, u, NULL, u, 0, T, NULL, N},      {c, 0, H, nan, NULL, u, 0, T, NULL, N},
      {c, 0, H, u, NULL, infinite, 0, T, NULL, N}, {c, 0, H, u, u, u, 0, T, T2, N},
      {c, 0, H, u, NULL, u, 0, T, T2, N},          {c, 0, H, u, u, u, 0, T, NULL, N},
      {c, 0, H, u, NULL, u, -1, T, NULL, N},       {c, 0, H, u, NULL, u, 2 * H, T, NULL, N},
      {c, 0, H, u, NULL, u, 0, NULL, NULL, N},     {c, 0, H, u, NULL, u, 0, T, NULL, NULL},
      {chain, 0, H, u, NULL, u, 0, T, NULL, N},    /* no normal */
      {chain, 2, H, u, NULL, NULL, 0, T, NULL, N}, /* no tangent */
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i)
    if (hbmcheck_contact_force(bad[i].c, bad[i].j, bad[i].harmonics, bad[i].u, bad[i].u2, bad[i].v, bad[i].samples,
                               bad[i].T, bad[i].T2, bad[i].N) != HBMCHECK_BAD_INPUT)
      fail_msg("call %zu is not refused", i);
  assert_true(T[0] == 7 && T2[0] == 8 && N[0] == 9);
  assert_int_equal(hbmcheck_contact_force(chain, 2, H, NULL, NULL, u, 0, T, NULL, N), HBMCHECK_OK);
  hbmcheck_case_free(chain);
  hbmcheck_case_free(c);
}

CHECK_TESTS("library.contact_force", 300, stuck_it_is_linear, a_slider_loses_the_closed_form, two_tangents_share_a_line,
            contacts_have_names, motions_that_are_none)
