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

/* What the command finds, with at most one option. */
static hbmcheck_result *run(const hbmcheck_case *c, const char *command, const char *option)
{
  hbmcheck_result *r;
  hbmcheck_status st = hbmcheck_run(c, command, option != NULL, &option, NULL, &r);
  if (st == HBMCHECK_OK) return r;
  printf("WRONG %s: %s\n", command, hbmcheck_status_text(st));
  exit(1);
}

static const hbmcheck_table *titled(const hbmcheck_result *r, const char *title)
{
  const hbmcheck_table *t;
  int i = 0;
  while ((t = hbmcheck_result_table(r, i)) != NULL && strcmp(hbmcheck_table_title(t), title) != 0) ++i;
  return t;
}

/* Amplitude without contact, |F0/(K - M w^2 + i C w)|. */
static double linear_amplitude(double w) { return force / hypot(stiffness - mass * w * w, damping * w); }

/* Where the contact closes: x sin(45 deg) = -gap. */
static double touch(void) { return -gap * sqrt(2); }

/* Where the linear amplitude first reaches that: the smaller root z = w^2 of (K - M z)^2 + C^2 z = (F0/touch)^2. */
static double grazing(void)
{
  double m = mass, k = stiffness, b = k / m - damping * damping / (2 * m * m), f = force / touch();
  return sqrt(b - sqrt(b * b - (k * k - f * f) / (m * m)));
}

/* The contact change is located to 1e-9 of omega; the amplitude there moves by at most
 * d(amplitude)/d(omega) < 5 times that. The solution at omega = 7: tests/reference/hbm_exact.csv, good to 1e-9, the
 * equations solved to 1e-10 of the forces, of which the stuck stiffness makes some ten times the displacement's share:
 * 1e-8. Its mean is X[0] itself, its first harmonic hypot(X[1], X[2]) but for rounding. */
static void trace(const hbmcheck_case *c)
{
  double X[3];
  hbmcheck_result *curve = run(c, "frf", NULL), *at = run(c, "frf", "--at=7");
  const hbmcheck_table *special = titled(curve, "Special points"), *s = hbmcheck_result_table(at, 0);
  near("specials, at least one", hbmcheck_table_rows(special) >= 1, 1, 0);
  near("omega of grazing", hbmcheck_table_number(special, 0, "omega"), grazing(), 1e-9 * grazing());
  near("amplitude of grazing", hbmcheck_table_number(special, 0, "amplitude"), touch(), 5e-9 * touch());
  near("solutions at omega = 7", hbmcheck_table_rows(s), 1, 0);
  near("amplitude at omega = 7", hbmcheck_table_number(s, 0, "amplitude"), 9.99130459182, 1e-8 * 9.99);
  near("mean at omega = 7", hbmcheck_table_number(s, 0, "mean"), -2.29888373479, 1e-8 * 9.99);
  near("coefficients of H = 10", hbmcheck_table_numbers(s, 0, "coefficients", 3, X), 21, 0);
  near("the mean is X[0]", X[0], hbmcheck_table_number(s, 0, "mean"), 0);
  near("the first harmonic is X[1], X[2]", hypot(X[1], X[2]), hbmcheck_table_number(s, 0, "harmonic_1"), 1e-15 * 9.99);
  hbmcheck_result_free(curve);
  hbmcheck_result_free(at);
}

/* At omega = 5 the contact stays open: the closed form holds, and the answer is transient.tolerance from the orbit. */
static void march(const hbmcheck_case *c)
{
  hbmcheck_result *t = run(c, "transient", "--at=5");
  double amplitude = hbmcheck_table_number(hbmcheck_result_table(t, 0), 0, "amplitude");
  near("transient at omega = 5", amplitude, linear_amplitude(5), 10 * tolerance * amplitude);
  hbmcheck_result_free(t);
}

/* The two sides agree at these, inside the gate of the file. */
static void compare(const hbmcheck_case *c)
{
  hbmcheck_result *both = run(c, "compare", "--at=5,7");
  const hbmcheck_table *rows = hbmcheck_result_table(both, 0), *gate = titled(both, "Gate");
  int k;
  near("rows", hbmcheck_table_rows(rows), 2, 0);
  for (k = 0; k < hbmcheck_table_rows(rows); ++k)
    near("a row matches", strcmp(hbmcheck_table_text(rows, k, "verdict"), "match"), 0, 0);
  near("exit code", hbmcheck_result_exit_code(both), 0, 0);
  near("gate: failed", hbmcheck_table_number(gate, 0, "failed"), 0, 0);
  near("gate: exit code", hbmcheck_table_number(gate, 0, "exit_code"), 0, 0);
  hbmcheck_result_free(both);
}

/* What a column is; and modes, by the library's other dependencies. */
static void describe(const hbmcheck_case *c)
{
  hbmcheck_column column;
  hbmcheck_result *modes = run(c, "modes", NULL);
  column.size = sizeof column;
  near("a first column", hbmcheck_table_column(hbmcheck_result_table(modes, 0), 0, &column), HBMCHECK_OK, 0);
  near("it counts modes", strcmp(column.name, "mode"), 0, 0);
  near("undamped frequency", hbmcheck_table_number(hbmcheck_result_table(modes, 0), 0, "omega_open"),
       sqrt(stiffness / mass), 1e-14);
  hbmcheck_result_free(modes);
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
  describe(c);
  hbmcheck_case_free(c);
  return wrong ? 1 : 0;
}
