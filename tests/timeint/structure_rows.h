/* structure_rows.h - tests/reference/structures_transient.csv: steady states of structures by an independent program,
 * from rest at each frequency, or the state carried on through those that are listed: what all members of a family of
 * motions have in common of a sweep, all of a start from rest. */
#pragma once

#include "tests/closed_form.h"
#include "tests/hbm/structure_cases.h"
#include "tests/reference_table.h"
#include "timeint/steady/steady.h"
#include "timeint/steady/sweep.h"

typedef struct structure_row {
  char name[24], start[8]; /* "rest", "up", "down" */
  double omega;
  int response;
  double amplitude, harmonic_1, mean; /* NAN: the family's members differ */
  int free_sliders, multiple;
} structure_row;

enum { N_STRUCTURE_ROWS = 134 };
static structure_row structure_rows[N_STRUCTURE_ROWS];

static inline bool parse_structure_row(const char *line, void *row)
{
  structure_row *r = row;
  return sscanf(line, "%23[^,],%7[^,],%lf,%d,%lf,%lf,%lf,%d,%d", r->name, r->start, &r->omega, &r->response,
                &r->amplitude, &r->harmonic_1, &r->mean, &r->free_sliders, &r->multiple) == 9;
}

/* For a program's setup. */
static int read_structure_rows(CHECK_STATE)
{
  const int n = read_reference("structures_transient.csv",
                               "case,start,omega,response,amplitude,harmonic_1,mean,free_sliders,period_multiple",
                               parse_structure_row, N_STRUCTURE_ROWS, sizeof *structure_rows, structure_rows);
  return n == N_STRUCTURE_ROWS ? 0 : -1;
}

/* The rows of a case with that start, or only those without free sliders; tolerance relative to the largest response at
 * the frequency. How many. */
static inline int check_structure_rows(const model *m, const char *name, transient_start start, bool all,
                                       transient_settings how, double tolerance)
{
  enum { STATES = 16 };
  static const char *const starts[] = {
      [TRANSIENT_START_REST] = "rest", [TRANSIENT_START_UP] = "up", [TRANSIENT_START_DOWN] = "down"};
  double omega = NAN, largest = 0, state[STATES], swept[STATES] = {0};
  timeint_result r;
  int checked = 0;
  how.start = start;
  CHECK_MADE(timeint, ti, timeint_new(m, &how, &ti));
  for (int i = 0; i < N_STRUCTURE_ROWS; ++i) {
    const structure_row *row = &structure_rows[i];
    if (strcmp(row->name, name) || strcmp(row->start, starts[start]) || (row->free_sliders && !all)) continue;
    if (row->omega != omega) {
      if (start != TRANSIENT_START_REST)
        assert_int_equal(timeint_sweep(ti, checked ? omega : row->omega, row->omega, swept, NULL), HC_OK);
      omega = row->omega, largest = 0;
      memcpy(state, swept, sizeof state);
      assert_int_equal(timeint_steady(ti, omega, state, NULL, &r), HC_OK);
      for (int k = 0; k < N_STRUCTURE_ROWS; ++k)
        if (!strcmp(structure_rows[k].name, name) && structure_rows[k].omega == omega)
          largest = fmax(largest, structure_rows[k].amplitude);
    }
    const double off = tolerance * largest;
    assert_int_equal(timeint_response(ti, row->response, &r), HC_OK);
    assert_int_equal(r.free_sliders, row->free_sliders);
    assert_int_equal(r.period_multiple, row->multiple);
    CHECK_NEAR(r.amplitude, row->amplitude, off, "%s %s at %g, %d", name, row->start, omega, row->response);
    CHECK_NEAR(r.harmonic_1, row->harmonic_1, off, "%s %s at %g, %d", name, row->start, omega, row->response);
    if (!isnan(row->mean)) CHECK_NEAR(r.mean, row->mean, off, "%s %s at %g: mean", name, row->start, omega);
    ++checked;
  }
  timeint_free(ti);
  return checked;
}

/* All three ways against the rows without free sliders of a case from rest, so many. They are good to 1e-11: an orbit
 * is closed to 1e-10 of its size at most; CVODE's tolerance is a thousandth of transient.tolerance, and periods scatter
 * by some hundred times that; the regularised law's error is of the first order in 1e-4, in units of the motion. */
static inline void check_structure_rows_all_ways(const model *m, const char *name, int rows)
{
  static const double tolerance[] = {1e-10, 1e-8, 1e-4};
  for (int way = 0; way < 3; ++way) {
    transient_settings how = CLOSED_FORM(way < 2 ? 1e-10 : 1e-8, 20000);
    if (way > 0) how.method = TRANSIENT_METHOD_CVODE;
    if (way > 1) how.law = TRANSIENT_LAW_REGULARISED, how.scout = true;
    assert_int_equal(check_structure_rows(m, name, TRANSIENT_START_REST, false, how, tolerance[way]), rows);
  }
}
