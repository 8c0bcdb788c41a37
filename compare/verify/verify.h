/* verify.h - a response curve of another program compared with ours, and the likely cause of what differs. The header
 * of this folder.
 *
 *     truth       the solutions of harmonic balance with exact forces and many harmonics at the file's omegas, compared
 *                 at some of them with the exact law's periodic orbits (the referee of comparison.h)
 *     verdict     per point, against the nearest of those solutions: match, differs, unstable, other_branch,
 *                 solver_failed; what the points tell by themselves: outliers, noise, the wrong branch
 *     hypotheses  our own harmonic balance with usual mistakes in it, and usual misreadings of the columns: the one
 *                 that the points lie on names the cause
 *
 * What is not connected to the branch that begins at the sweep's first omega is not seen. Nothing is printed. */
#pragma once

#include "compare/verify/truth/report.h"

/* Judges the points of data[n], of one program's curves of the same case: their responses' causes are one, or it is
 * none. HC_INTERRUPTED, HC_NO_MEMORY, or why there is no truth; rows found until then are kept. verify_clear of each
 * in any case. */
hc_status verify_run(const compare_setup *setup, int n, const verify_data *data, const verify_effort *effort,
                     const hc_monitor *monitor, verify_report *out);
void verify_clear(verify_report *r);

/* The cause in a sentence, or that there is none: in text[VERIFY_TEXT], which is returned. */
const char *verify_sentence(const verify_report *r, char text[VERIFY_TEXT]);

/* The causes' words for scripts: "none" where every point is right, "unknown" where no cause is sure. In
 * text[VERIFY_TEXT], which is returned. */
const char *verify_word(const verify_report *r, char text[VERIFY_TEXT]);

/* 0 every point lies on a solution and on the right one; 1 not; 3 some could not be judged. */
int verify_exit_code(const verify_report *r);
