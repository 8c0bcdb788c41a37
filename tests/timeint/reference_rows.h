/* reference_rows.h - tests/reference/transient_exact.csv: the steady state of the printed equation at single
 * frequencies, swept up and down from the ends of the sweep. Closed form in each contact phase, transitions to
 * rounding; computed by a program independent of this one; good to about 1e-9. Rows of one case and direction follow
 * each other in the order of the sweep. */
#pragma once

#include "tests/check.h"

typedef struct reference_row {
  char name[16], sweep[8]; /* "c2"; "up", "down" */
  double omega, amplitude, max, min, harmonic_1, mean;
  int events; /* transitions a period */
} reference_row;

enum { N_REFERENCE_ROWS = 134 };
static reference_row reference_rows[N_REFERENCE_ROWS];

/* For a program's setup. */
static int read_reference_rows(CHECK_STATE)
{
  char line[512];
  int n = 0;
  FILE *f = fopen(SOURCE_DIR "/tests/reference/transient_exact.csv", "r");
  if (!f || !fgets(line, sizeof line, f)) return -1;
  for (; n < N_REFERENCE_ROWS && fgets(line, sizeof line, f); ++n) {
    reference_row *r = &reference_rows[n];
    if (sscanf(line, "%15[^,],%7[^,],%lf,%lf,%lf,%lf,%lf,%lf,%d", r->name, r->sweep, &r->omega, &r->amplitude, &r->max,
               &r->min, &r->harmonic_1, &r->mean, &r->events) != 9)
      return -1;
  }
  const int whole = n == N_REFERENCE_ROWS && !fgets(line, sizeof line, f);
  fclose(f);
  return whole ? 0 : -1;
}
