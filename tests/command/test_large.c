/* test_large.c - a structure of 96 degrees of freedom and 24 contacts (bladed_disk.yaml), through all of it:
 * monodromy matrices of 192 columns, BDF steps of 216 states; a reduced mesh of 84 coordinates and 12 node pairs. */
#include "tests/shell.h"

static char out[1 << 20];

/* Number `column`, from 0, of the first line of `out` that begins with `start`. */
static double cell(const char *start, int column)
{
  const char *line = strstr(out, start);
  assert_non_null(line);
  for (++line; column > 0; --column) line = strchr(line, ',') + 1;
  return strtod(line, NULL);
}

static void run(const char *args, int code, const char *fragment)
{
  char line[2048];
  snprintf(line, sizeof line,
           "%s %s cases/structures/bladed_disk.yaml --format csv -q --at 985 --set sweep.omega=984,986",
           HBMCHECK_COMMAND, args);
  shell_check(line, shell_read(line, out, sizeof out), out, code, fragment);
}

/* With 5 harmonics the disk's resonance misses the gate, and by what harmonic balance predicts of them: its prediction,
 * by Newton on more harmonics, has an error of the next order, a tenth. Two sides that know nothing of each other. The
 * regularised law errs by the second order of 1e-4 where contacts slip and never open. */
static void a_bladed_disk_is_compared(CHECK_STATE)
{
  run("compare", 1, "\n985,0,3,differs,");
  const double regularised = cell("\n985,0,3,", 5), error = cell("\n985,0,3,", 6);
  CHECK_NEAR(error, cell("\n985,0,3,", 11), 0.1 * error, "predicted from truncation");
  CHECK_NEAR(cell("\n985,0,1,", 6), cell("\n985,0,1,", 11), 0.1 * cell("\n985,0,1,", 6), "of the rim");
  run("transient --set transient.law=exact --set transient.method=closed_form", 0, "\n985,3,settled,");
  CHECK_NEAR(regularised, cell("\n985,3,", 3), 1e-7 * regularised, "regularised against exact");
}

/* What the command prints is in `out` afterwards. */
static void run_plates(const char *args, const char *fragment)
{
  char line[2048];
  snprintf(line, sizeof line, "%s %s cases/structures/plates.yaml --format csv -q", HBMCHECK_COMMAND, args);
  shell_check(line, shell_read(line, out, sizeof out), out, 0, fragment);
}

/* First frequency [Hz] of a steel cantilever as thick as the plates: 1.8751^2 / (2 pi L^2) sqrt(EI / (rho A)). */
static double cantilever(double length)
{
  const double young = 2.1e11, density = 7850, thickness = 0.005, root = 1.8751040687119611;
  return root * root / (2 * PI * length * length) * sqrt(young * thickness * thickness / (12 * density));
}

/* Contacts open, the two lowest modes are the first bending of each plate, between those of a beam, free to strain
 * across, and of an infinitely wide plate, E / (1 - nu^2) with nu = 0.3. Shear and rotary inertia lower a hinged beam's
 * frequency by (pi r / L)^2 (1 + E / (kappa G)) / 2 = 1.7 (h / L)^2 (r^2 = h^2 / 12, kappa = 5/6), a cantilever's, of
 * longer wave, by less: 0.35 % at most. */
static void plates_bend_as_cantilevers(CHECK_STATE)
{
  const double upper = cantilever(0.20), lower = cantilever(0.11), wide = 1 / sqrt(1 - 0.3 * 0.3);
  run_plates("modes", "frequency_open");
  CHECK_LE((1 - 1.7 * 0.000625) * upper, cell("\n1,", 2), "upper plate");
  CHECK_LE(cell("\n1,", 2), wide * upper, "upper plate");
  CHECK_LE((1 - 1.7 * 0.00207) * lower, cell("\n2,", 2), "lower plate");
  CHECK_LE(cell("\n2,", 2), wide * lower, "lower plate");
}

/* Pairs in the state `regime` at the k-th of the frequencies of 12 rows each. */
static int pairs_that(const char *regime, int k)
{
  const char *line = strstr(out, "# Contacts");
  int n = 0;
  assert_non_null(line);
  line = strchr(line, '\n') + 1;
  for (int row = -1; row < 12 * (k + 1); ++row) {
    const char *end = strchr(line, '\n'), *found = strstr(line, regime);
    assert_non_null(end);
    if (row >= 12 * k && found && found < end) ++n;
    line = end + 1;
  }
  return n;
}

/* At the frequencies at which the case compares. */
static void plates_stick_slip_and_lift_off(CHECK_STATE)
{
  static const int sticking[] = {6, 0, 0}, slipping[] = {6, 9, 11}, lifting[] = {0, 3, 1};
  run_plates("frf --at 135,138,140 --contacts", "# Contacts");
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(pairs_that(",stick,", k), sticking[k]);
    assert_int_equal(pairs_that(",slip,", k), slipping[k]);
    assert_int_equal(pairs_that(",separation,", k), lifting[k]);
  }
}

CHECK_TESTS("command.large", 600, a_bladed_disk_is_compared, plates_bend_as_cantilevers, plates_stick_slip_and_lift_off)
