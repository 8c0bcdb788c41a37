/* main.c - a program outside the project, C and C++ at once: case 2 traced, integrated and compared through the
 * installed library. usage: consumer case2.yaml. Prints what it found beside what it should be; exit 1 if anything
 * is off. */
#include <hbmcheck/hbmcheck.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int wrong;

/* |found - expected| <= tol; NaN is wrong. */
static void near(const char *what, double found, double expected, double tol)
{
  bool ok = fabs(found - expected) <= tol;
  printf("%s %s: %.12g, expected %.12g within %.1g\n", ok ? "ok   " : "WRONG", what, found, expected, tol);
  wrong += !ok;
}

static void done(const char *what, hc_status st)
{
  if (st == HC_OK) return;
  printf("WRONG %s: %s\n", what, hc_status_text(st));
  exit(1);
}

/* Amplitude without contact, |F0/(K - M w^2 + i C w)|. */
static double linear_amplitude(const scene *sc, double w)
{
  return sc->force / hypot(sc->stiffness - sc->mass * w * w, sc->damping * w);
}

/* x where the contact closes: x sin(45 deg) = -gap. */
static double touch(const scene *sc) { return -sc->contacts[0].law.gap * sqrt(2); }

/* Where the linear amplitude first reaches that: the smaller root z = w^2 of (K - M z)^2 + C^2 z = (F0/touch)^2. */
static double grazing(const scene *sc)
{
  double m = sc->mass, k = sc->stiffness, b = k / m - sc->damping * sc->damping / (2 * m * m),
         f = sc->force / touch(sc);
  return sqrt(b - sqrt(b * b - (k * k - f * f) / (m * m)));
}

/* The contact change is located to 1e-9 of omega (hbm.h); the amplitude there moves by at most d(amplitude)/d(omega)
 * < 5 times that. The solution at omega = 7: tests/reference/hbm_exact.csv, good to 1e-9, the equations solved to
 * 1e-10 of the forces, of which the stuck stiffness makes some ten times the displacement's share: 1e-8. */
static void trace(const scene *sc)
{
  hbm_solver *s;
  hbm_curve curve = {0}, at = {0};
  hbm_special special;
  hbm_measures m;
  int n = 0;
  compare_setup setup;
  done("scene_setup", scene_setup(sc, &setup));
  done("hbm_solver_new", hbm_solver_new(setup.model, &setup.hbm, &s));
  scene_setup_clear(&setup);
  done("hbm_trace", hbm_trace(s, sc->omega_from, sc->omega_to, NULL, &curve));
  done("hbm_specials", hbm_specials(s, &curve, 1, &special, &n));
  near("specials, at least one", n >= 1, 1, 0);
  near("omega of grazing", special.omega, grazing(sc), 1e-9 * grazing(sc));
  near("amplitude of grazing", special.amplitude, touch(sc), 5e-9 * touch(sc));
  done("hbm_curve_at", hbm_curve_at(s, &curve, 7, &at));
  near("solutions at omega = 7", at.n, 1, 0);
  done("hbm_measure", hbm_measure(s, at.X, &m));
  near("amplitude at omega = 7", m.amplitude, 9.99130459182, 1e-8 * 9.99);
  near("mean at omega = 7", m.mean, -2.29888373479, 1e-8 * 9.99);
  hbm_curve_free(&at);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
}

/* At omega = 5 the contact stays open: the closed form holds, and the answer is transient.tolerance from the orbit. */
static void march(const scene *sc)
{
  timeint *ti;
  timeint_result r;
  compare_setup setup;
  done("scene_setup", scene_setup(sc, &setup));
  done("timeint_new", timeint_new(setup.model, &setup.transient, &ti));
  scene_setup_clear(&setup);
  timeint_state y = timeint_rest(ti);
  done("timeint_steady", timeint_steady(ti, 5, &y, NULL, &r));
  near("transient at omega = 5", r.amplitude, linear_amplitude(sc, 5), 10 * sc->transient.tolerance * r.amplitude);
  timeint_free(ti);
}

/* The two sides agree at these, inside the gate of the file. */
static void compare(scene sc)
{
  comparison c;
  sc.compare.omega.n = 2;
  sc.compare.omega.v[0] = 5;
  sc.compare.omega.v[1] = 7;
  compare_setup setup;
  done("scene_setup", scene_setup(&sc, &setup));
  done("comparison_run", comparison_run(&setup, NULL, &c));
  scene_setup_clear(&setup);
  near("rows", c.n_rows, 2, 0);
  near("rows that match", c.count[VERDICT_MATCH], 2, 0);
  near("exit code", comparison_exit_code(&c), 0, 0);
  comparison_clear(&c);
}

int main(int argc, char **argv)
{
  scene sc;
  case_error err;
  alarm(600); /* a hang is a failure */
  if (argc != 2) return 64;
  if (case_read(argv[1], 0, NULL, &sc, &err) != HC_OK) {
    puts(err.message);
    return 1;
  }
  near("one version", strcmp(hbmcheck_version(), HBMCHECK_VERSION), 0, 0);
  trace(&sc);
  march(&sc);
  compare(sc);
  return wrong ? 1 : 0;
}
