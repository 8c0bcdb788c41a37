/* band.h - all steady states that differ from an HBM solution by where its free sliders rest (hbm/solver/rests.h): the
 * least and the largest amplitude of each response among them.
 *
 * They are the members of the family at this omega that can be reached from the solution by moving the rests. A member
 * is followed along one rest at a time, from limit to limit; other sliders are dragged along where they cannot stay.
 * Where another contact ceases to slip there is one rest more, and both ways along that are followed, too. The largest
 * and the least amplitude may lie between limits: there the rate by the rest changes its sign.
 *     exact      everywhere on these lines at most one slider was free, or no contact changed its state, and then
 *                amplitudes do not depend on rests: all members on them were seen
 *     at least   more sliders are free: beside the lines the amplitude is climbed and descended along its gradient
 *                from the best members; or a line could not be followed to its end, or an end not be confirmed
 * Nothing is searched, and the width is 0, where a part of the structure (model/parts.h) has one contact alone, or none
 * whose normal force or gap a mean moves: of two motions of a linear structure on sliders of constant N the difference
 * obeys d/dt [dv M dv + dx K dx + sum dT^2/kt]/2 <= -dv C dv, so that two periodic ones differ by a constant. */
#pragma once

#include "compare/compare_settings.h"
#include "hbm/hbm.h"
#include "timeint/steady/steady.h"

typedef enum band_kind { BAND_NOT_ASKED, BAND_NONE /* there is no free slider */, BAND_EXACT, BAND_AT_LEAST } band_kind;
const char *band_kind_name(band_kind kind); /* "none", "exact", "at least"; "" if it was not asked */

/* One response's. */
typedef struct band {
  band_kind kind;
  double low, high; /* [length] the least and the largest amplitude; NaN: not known */
  bool confirmed;   /* both are those of the exact law's orbits, with these rests; else harmonic balance's own */
} band;

/* [1] (high - low)/(high + low); NaN where there is none. */
double band_width(const band *b);

/* [1] By how much the amplitude is off at most, relative, where the slider rests elsewhere; NaN without a band. */
double band_from_history(const band *b, double amplitude);

/* Workspace for the bands of one model; one a thread. */
typedef struct band_search band_search;

/* s: the solver of the solutions to come; exact: the exact law's time integration, by which the ends are confirmed and
 * located; NULL: those of harmonic balance. Both must outlive it. HC_NO_MEMORY. */
hc_status band_search_new(const model *m, hbm_solver *s, timeint *exact, band_search **out);
void band_search_free(band_search *b); /* NULL is allowed */

/* out[responses]: of the solution X at omega. HC_OK, also where members could not be followed: `at least`.
 * HC_NO_MEMORY, HC_INTERRUPTED. The solver's sliders begin at 0 again afterwards. */
hc_status band_find(band_search *b, double omega, const double *X, const hc_monitor *monitor, band *out);

/* Systems that Newton was put to in all searches. */
long band_solves(const band_search *b);
