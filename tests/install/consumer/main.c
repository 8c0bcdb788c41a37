/* main.c - a program outside the project, C and C++ at once: case 2 traced, integrated and compared through the
 * installed library. usage: consumer case2.yaml. Prints what it found beside what it should be; exit 1 if anything
 * is off. */
#include <hbmcheck.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What case2.yaml says. */
static const double mass = 1, damping = 0.4, stiffness = 40, force = 100, gap = -5;
static const double tolerance = 1e-9; /* transient.tolerance, as main() sets it */

static int wrong;

/* |found - expected| <= tol; NaN is wrong. */
static void near(const char *what, double found, double expected, double tol)
{
  int ok = fabs(found - expected) <= tol;
  printf("%s %s: %.12g, expected %.12g within %.1g\n", ok ? "ok   " : "WRONG", what, found, expected, tol);
  wrong += !ok;
}

static void done(const char *what, hbmcheck_status st)
{
  if (st == HBMCHECK_OK) return;
  printf("WRONG %s: %s\n", what, hbmcheck_status_text(st));
  exit(1);
}

/* Amplitude without contact, |F0/(K - M w^2 + i C w)|. */
static double linear_amplitude(double w) { return force / hypot(stiffness - mass * w * w, damping * w); }

/* x where the contact closes: x sin(45 deg) = -gap. */
static double touch(void) { return -gap * sqrt(2); }

/* Where the linear amplitude first reaches that: the smaller root z = w^2 of (K - M z)^2 + C^2 z = (F0/touch)^2. */
static double grazing(void)
{
  double m = mass, k = stiffness, b = k / m - damping * damping / (2 * m * m), f = force / touch();
  return sqrt(b - sqrt(b * b - (k * k - f * f) / (m * m)));
}

/* The contact change is located to 1e-9 of omega (hbmcheck.h); the amplitude there moves by at most
 * d(amplitude)/d(omega) < 5 times that. The solution at omega = 7: tests/reference/hbm_exact.csv, good to 1e-9, the
 * equations solved to 1e-10 of the forces, of which the stuck stiffness makes some ten times the displacement's share:
 * 1e-8. Its mean is X[0] itself, its first harmonic hypot(X[1], X[2]) but for rounding. */
static void trace(const hbmcheck_case *c)
{
  hbmcheck_curve *curve;
  hbmcheck_solutions *at;
  hbmcheck_solution s;
  hbmcheck_special special;
  double X[3];
  int n = 0;
  done("hbmcheck_curve_trace", hbmcheck_curve_trace(c, NULL, &curve));
  done("hbmcheck_curve_specials", hbmcheck_curve_specials(curve, 1, &special, &n));
  near("specials, at least one", n >= 1, 1, 0);
  near("omega of grazing", special.omega, grazing(), 1e-9 * grazing());
  near("amplitude of grazing", special.amplitude, touch(), 5e-9 * touch());
  done("hbmcheck_curve_at", hbmcheck_curve_at(curve, 7, &at));
  near("solutions at omega = 7", hbmcheck_solutions_count(at), 1, 0);
  done("hbmcheck_solutions_get", hbmcheck_solutions_get(at, 0, &s));
  near("amplitude at omega = 7", s.amplitude, 9.99130459182, 1e-8 * 9.99);
  near("mean at omega = 7", s.mean, -2.29888373479, 1e-8 * 9.99);
  done("hbmcheck_solutions_coefficients", hbmcheck_solutions_coefficients(at, 0, 3, X, &n));
  near("coefficients of H = 10", n, 21, 0);
  near("the mean is X[0]", X[0], s.mean, 0);
  near("the first harmonic is X[1], X[2]", hypot(X[1], X[2]), s.harmonic_1, 1e-15 * 9.99);
  hbmcheck_solutions_free(at);
  hbmcheck_curve_free(curve);
}

/* At omega = 5 the contact stays open: the closed form holds, and the answer is transient.tolerance from the orbit. */
static void march(const hbmcheck_case *c)
{
  const double at = 5;
  hbmcheck_transient *t;
  hbmcheck_steady s;
  done("hbmcheck_transient_run", hbmcheck_transient_run(c, 1, &at, NULL, &t));
  done("hbmcheck_transient_get", hbmcheck_transient_get(t, 0, &s));
  near("transient at omega = 5", s.amplitude, linear_amplitude(5), 10 * tolerance * s.amplitude);
  hbmcheck_transient_free(t);
}

/* The two sides agree at these, inside the gate of the file. */
static void compare(const hbmcheck_case *c)
{
  const double at[] = {5, 7};
  hbmcheck_comparison *both;
  hbmcheck_gate gate;
  done("hbmcheck_comparison_run", hbmcheck_comparison_run(c, 2, at, NULL, &both));
  near("rows", hbmcheck_comparison_count(both), 2, 0);
  for (int k = 0; k < hbmcheck_comparison_count(both); ++k) {
    hbmcheck_row row;
    done("hbmcheck_comparison_get", hbmcheck_comparison_get(both, k, &row));
    near("a row matches", strcmp(hbmcheck_verdict_name(row.verdict), "match"), 0, 0);
  }
  near("exit code", hbmcheck_comparison_exit_code(both), 0, 0);
  done("hbmcheck_comparison_gate", hbmcheck_comparison_gate(both, &gate));
  near("gate: failed", gate.failed, 0, 0);
  near("gate: exit code", gate.exit_code, 0, 0);
  hbmcheck_comparison_free(both);
}

int main(int argc, char **argv)
{
  const char *const set[] = {"transient.tolerance=1e-9"};
  char message[512];
  hbmcheck_case *c;
  alarm(600); /* a hang is a failure */
  if (argc != 2) return 64;
  if (hbmcheck_case_read(argv[1], 1, set, message, sizeof message, &c) != HBMCHECK_OK) {
    puts(message);
    return 1;
  }
  near("one version", strcmp(hbmcheck_version(), HBMCHECK_VERSION), 0, 0);
  trace(c);
  march(c);
  compare(c);
  hbmcheck_case_free(c);
  return wrong ? 1 : 0;
}
