/* compliance.h - the dynamic stiffness of a large structure in its coordinates q, without contacts, from its modes:
 *
 *     S = G^-1,   G = B Z^-1 B^T,   p = S g,   g = B Z^-1 (load),   q = B x
 *     response r = G_r S q + (g_r - G_r p)                        (G_r, g_r: with the row of r in place of B)
 *
 * Z^-1 is a sum over modes where C is diagonal in them, as modal and Rayleigh damping are, and else over
 * the eigenvectors of the first-order form, found once. Either way a harmonic costs O(n dim^2) at most. Not for s = 0,
 * where a structure that is free to move has no Z^-1. */
#pragma once

#include <complex.h>

#include "model/model.h"

typedef struct compliance compliance;

/* For m in the coordinates q = B x, B[dim][n] by rows. *out is NULL with HC_OK if the sum is not available or not
 * reliable: K not symmetric, a mode without damping, or eigenvectors of the first-order form too ill conditioned.
 * HC_NO_MEMORY. */
hc_status compliance_new(const model *m, int dim, const double *B, compliance **out);
void compliance_free(compliance *c); /* NULL is allowed */

/* S[dim][dim] by columns and g[n_loads][2][dim] (of cosine and sine) at frequency w [rad/time] of a harmonic, with
 * additional damping d M. reach: largest w to be expected, for which the series is prepared. HC_NOT_FINITE: G too close
 * to singular at w (a resonance), or d != 0 with the sum over poles. */
hc_status compliance_at(compliance *c, double w, double reach, double d, double complex *S, double complex *g);

/* dG[dim][dim] and, behind it, dg[n_loads][2][dim] for a change of s = i w by ds and of d by dd; valid until the next
 * call. dS = -S dG S. HC_NOT_FINITE as above. */
hc_status compliance_change(compliance *c, double w, double reach, double d, double complex ds, double complex dd,
                            const double complex **dG);

/* G_r[dim] and g_r[n_loads][2] of response r. */
hc_status compliance_of_response(compliance *c, double w, double reach, double d, int r, double complex *G_r,
                                 double complex *g_r);
