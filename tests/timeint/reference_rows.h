/* reference_rows.h - tests/reference/transient_exact.csv: the steady state of the printed equation at single
 * frequencies, swept up and down from the ends of the sweep. Closed form in each contact phase, transitions to
 * rounding; computed by a program independent of this one; good to about 1e-9. Rows of one case and direction follow
 * each other in the order of the sweep. */
#pragma once

#include "tests/check.h"

typedef struct steady_reference {
  char name[16], sweep[8]; /* "c2"; "up", "down" */
  double omega, amplitude, max, min, harmonic_1, mean;
  int events; /* transitions a period */
} steady_reference;

enum { N_STEADY_REFERENCES = 134 };
static steady_reference steady_references[N_STEADY_REFERENCES];

/* For a program's setup. */
static int read_steady_references(CHECK_STATE)
{
  char line[512];
  int n = 0;
  FILE *f = fopen(SOURCE_DIR "/tests/reference/transient_exact.csv", "r");
  if (!f || !fgets(line, sizeof line, f)) return -1;
  for (; n < N_STEADY_REFERENCES && fgets(line, sizeof line, f); ++n) {
    steady_reference *r = &steady_references[n];
    if (sscanf(line, "%15[^,],%7[^,],%lf,%lf,%lf,%lf,%lf,%lf,%d", r->name, r->sweep, &r->omega, &r->amplitude, &r->max,
               &r->min, &r->harmonic_1, &r->mean, &r->events) != 9)
      return -1;
  }
  const int whole = n == N_STEADY_REFERENCES && !fgets(line, sizeof line, f);
  fclose(f);
  return whole ? 0 : -1;
}
