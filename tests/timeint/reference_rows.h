/* reference_rows.h - tests/reference/transient_exact.csv: the steady state of the printed equation at single
 * frequencies, swept up and down from the ends of the sweep. Closed form in each contact phase, transitions to
 * rounding; computed by a program independent of this one; good to about 1e-9. Rows of one case and direction follow
 * each other in the order of the sweep. */
#pragma once

#include "tests/reference_table.h"
#include "tests/timeint/scenes.h"

typedef struct steady_reference {
  char name[16], sweep[8]; /* "c2"; "up", "down" */
  double omega, amplitude, max, min, harmonic_1, mean;
  int events; /* transitions a period */
} steady_reference;

enum { N_STEADY_REFERENCES = 134 };
static steady_reference steady_references[N_STEADY_REFERENCES];

static inline bool parse_steady_reference(const char *line, void *row)
{
  steady_reference *r = row;
  return sscanf(line, "%15[^,],%7[^,],%lf,%lf,%lf,%lf,%lf,%lf,%d", r->name, r->sweep, &r->omega, &r->amplitude, &r->max,
                &r->min, &r->harmonic_1, &r->mean, &r->events) == 9;
}

/* For a program's setup. */
static int read_steady_references(CHECK_STATE)
{
  const int n = read_reference(
      "transient_exact.csv", "case,sweep,omega,amplitude,max,min,harmonic_1,mean,events_per_period,period_closure",
      parse_steady_reference, N_STEADY_REFERENCES, sizeof *steady_references, steady_references);
  return n == N_STEADY_REFERENCES ? 0 : -1;
}

/* Half a unit of the last digit printed: the table has 12 significant ones, or fewer where the rest are 0. */
static inline double half_a_digit(double x) { return x != 0 ? 0.5 * pow(10, floor(log10(fabs(x))) - 11) : 0; }

/* The rows of a case in one direction, from the sweep's end `from`: amplitude, first harmonic and mean to half a digit
 * and `off` of the amplitude, `linear_off` where there is no transition. The mean where it is unique: it is not where a
 * slider never slips (free_sliders), and then both programs' histories differ. The worst, of what it may be. */
static inline double follow_rows(const scene *sc, const char *name, const char *sweep, double from, double off,
                                 double linear_off)
{
  timeint_result r;
  int rows = 0;
  double worst = 0;
  const bool exact = sc->transient.law == TRANSIENT_LAW_EXACT,
             closed = sc->transient.method == TRANSIENT_METHOD_CLOSED_FORM;
  CHECK_MADE(timeint, ti, scene_timeint(sc, &ti));
  scene_state y = {.x = 0};
  for (int i = 0; i < N_STEADY_REFERENCES; ++i) {
    const steady_reference *want = &steady_references[i];
    if (strcmp(want->name, name) || strcmp(want->sweep, sweep)) continue;
    if (reference_is_behind_chaos(name, !strcmp(sweep, "down"), want->omega)) y = reference_behind_chaos;
    else assert_int_equal(timeint_sweep(ti, from, want->omega, y.all, NULL), HC_OK);
    assert_int_equal(timeint_steady(ti, from = want->omega, y.all, NULL, &r), HC_OK);
    const double ours = (want->events == 0 ? linear_off : off) * want->amplitude;
    const double got[] = {r.amplitude, r.harmonic_1, r.mean}, table[] = {want->amplitude, want->harmonic_1, want->mean};
    for (int k = 0; k < (exact && r.free_sliders == 0 ? 3 : 2); ++k) {
      const double bound = half_a_digit(table[k]) + ours;
      worst = fmax(worst, fabs(got[k] - table[k]) / bound);
      CHECK_NEAR(got[k], table[k], bound, "%s %s at %g: amplitude, harmonic_1, mean [%d]", name, sweep, want->omega, k);
    }
    /* 3: touch, separation, and a slip of no length where traction and limit vanish together (reference/README.md) */
    if (closed) assert_int_equal(r.switches, want->events == 3 ? 2 : want->events);
    if (exact) assert_true((r.switches > 0) == (want->events > 0));
    else assert_true((r.regime > CONTACT_STUCK) == (want->events > 0));
    if (closed) assert_true(r.closed_form_periods == 0 && r.cvode_flag == 0);
    assert_int_equal(r.period_multiple, 1);
    CHECK_LE(r.multiplier, 1, "%s %s is stable at %g", name, sweep, want->omega);
    ++rows;
  }
  timeint_free(ti);
  CHECK_LE(4, rows, "%s %s", name, sweep);
  return worst;
}

/* The same both ways. */
static inline double follow_reference(const char *name, scene sc, double off, double linear_off)
{
  const reference_scene *of = reference_scene_named(name);
  const bool blade = of->stiffness > 1000;
  const double up = follow_rows(&sc, name, "up", blade ? 600 : 3, off, linear_off);
  return fmax(up, follow_rows(&sc, name, "down", blade ? 1100 : of->omega_to, off, linear_off));
}
