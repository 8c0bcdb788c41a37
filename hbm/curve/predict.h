/* predict.h - error estimate of an HBM solution from the equations of harmonic balance alone, made before any
 * comparison with time integration.
 *
 * The solution X of H harmonics is padded with zeros and improved by Newton on finer equations: n = 2H harmonics, 14 at
 * least, or as many more as reach the highest natural frequency, contacts stuck (to 100, or to 1500 unknowns), exact
 * forces (which take away aliasing with the truncation), harmonic 0 kept (leaving it out is an error of the model of
 * the motion, too). The distance d of the two motions lacks the error of the n harmonics themselves. Errors fall like
 * H^-3 (docs/theory.md, 3), so
 *
 *     error(H) = d / |1 - (H/n)^3|          8/7 d, also where n > 2H
 *
 * The mean counts in the waveform error also where a slider never slips and the mean depends on the history: only the
 * transient shows whether it does, and counting it errs on the large side.
 *
 * Nothing finer is affordable above HBM_MAX_HARMONICS/2 harmonics: there n = H/2; error d/7, with sampled forces d. */
#pragma once

#include "hbm/solver/hbm_solver.h"
#include "hbm/stability/multipliers.h"
#include "model/periodic_motion.h"

/* The error of the solution X[n_coef] at omega, H = hbm_n_harmonics. It is at least the rounding error; where Newton
 * does not converge, at least its longest step; INFINITY where the finer equations have no solution next to X, as
 * beyond one of their folds: X is then an artefact of the truncation. X need not solve the equations: errors of the
 * solve count too. The first call for a number of harmonics allocates, later ones do not. Unless HC_OK, all of *out is
 * NaN: errors of the contact force, HC_SINGULAR, HC_NOT_FINITE, HC_NO_MEMORY. */
hc_status hbm_predict(hbm_solver *s, double omega, const double *X, motion_error *out);

/* The same for response r, counted from 0, of the solution of the last hbm_predict, which returned HC_OK: nothing is
 * solved again. HC_BAD_INPUT: there is no such response. */
hc_status hbm_predict_response(hbm_solver *s, double omega, const double *X, int r, motion_error *out);

/* The multipliers of X at omega as of hbm_stability_at, and bounds of the largest modulus (out->low, high). Reference
 * is the solution next to X with twice the harmonics, 14 at least: each modulus is taken to err towards the reference's
 * by their difference times the factor above, or times 2 if that is more and H harmonics do not reach the contacts' own
 * frequency. Without such a solution the bounds are 0 and INFINITY.
 *
 * The reference costs as much as one or several points of a curve. It is not computed where the contacts' stiffness is
 * constant over the period (multipliers exact); where the upper half of X's harmonics is too small to move a multiplier
 * across 1; where the lower half reaches the contacts' own frequency and alone has the largest multiplier on the same
 * side of 1. For a row of a curve (is_row: rows are asked about in their order) also where
 * hbm_stability_error_is_costly, and where the contacts do the same as in the last row examined, up to 8 rows before
 * and on the same side of 1, whose error was at most a quarter of this row's distance from 1. Then low = high, or the
 * bounds by the lower half. Errors of hbm_stability_at. */
hc_status hbm_stability_with_error(hbm_solver *s, double omega, const double *X, bool is_row, hbm_stability *out);

/* True if the equations of that reference have more than 600 unknowns. */
bool hbm_stability_error_is_costly(const hbm_solver *s);

/* The multipliers of that reference; their difference from X's, times *factor, is the error of X's. Errors of
 * hbm_stability_at and of the contact force, HC_SINGULAR; HC_NOT_CONVERGED: there is none next to X. */
hc_status hbm_finer_stability(hbm_solver *s, double omega, const double *X, hbm_stability *finer, double *factor);

/* The solution X at omega after the structure's receptance H has changed by dH = error e^(i theta) H, the error that a
 * reduction states: q = H (p - F(q)), so that with R = S q + F - p, S = H^-1,
 *     dq = dH (p - F) - H F' dq,    (S + F') dq = error e^(i theta) S q.
 * moved[2][n_coef] is X + dq for theta = 0 and pi/2; for any theta dq is the combination of these two by cos theta and
 * sin theta, so no quantity changes by more than the root of the sum of their squares. Errors of the contact force,
 * HC_SINGULAR. */
hc_status hbm_predict_reduction(hbm_solver *s, double omega, const double *X, double error, double *moved);
