/* predict.h - how far off an HBM solution is, by its own reckoning: from the equations of harmonic balance alone,
 * before anything else is known. What time integration finds may then be held against it.
 *
 * The solution X of H harmonics is padded with zeros and improved by Newton on finer equations: n = 2H harmonics, 14 at
 * least, or as many more as reach the highest natural frequency, contacts stuck (to 100, or to 1500 unknowns), exact
 * forces (which take away aliasing with the truncation), harmonic 0 kept (leaving it out is an error of the model of
 * the motion, too). The distance d of the two motions misses what n harmonics leave out. Errors fall like H^-3
 * (docs/theory.md, 3), so
 *
 *     error(H) = d / |1 - (H/n)^3|          8/7 d, also where n > 2H
 *
 * The mean stays in the waveform also where a slider never slips, so that the mean depends on the history: whether it
 * is open shows in the transient only, and leaving it in errs on the large side.
 *
 * Nothing finer is affordable above HBM_MAX_HARMONICS/2 harmonics: there n = H/2; error d/7, with sampled forces d. */
#pragma once

#include "hbm/solver/hbm_solver.h"
#include "hbm/stability/multipliers.h"
#include "model/periodic_motion.h"

/* The error of the solution X[n_coef] at omega, H = hbm_n_harmonics. Never less than rounding leaves; where Newton
 * does not converge, never less than its longest step; INFINITY where the finer equations have no solution next to
 * X, as beyond a fold of theirs: the solution is one of few harmonics, not of the oscillator. What was computed
 * wrong shows as well: X need not solve the equations. The first call for a number of harmonics allocates, later
 * ones do not. Unless HC_OK, all of *out is NaN: errors of the contact force, HC_SINGULAR, HC_NOT_FINITE,
 * HC_NO_MEMORY. */
hc_status hbm_predict(hbm_solver *s, double omega, const double *X, motion_error *out);

/* The same of response r, counted from 0, of the solution that hbm_predict was last asked about, with HC_OK: nothing is
 * solved again. HC_BAD_INPUT: there is no such response. */
hc_status hbm_predict_response(hbm_solver *s, double omega, const double *X, int r, motion_error *out);

/* The multipliers of X at omega as of hbm_stability_at, and between what the largest one's modulus is (out->low, high).
 * Each modulus is off, towards that of the solution next to X with twice the harmonics, 14 at least, by that distance
 * times the same factor as above; by twice the distance where H harmonics do not reach the contacts' own frequency.
 * Where there is no such solution nothing is known: 0 and INFINITY.
 *
 * That solution costs as much as a point of a curve or several, and is asked only where it would tell: not where
 * nothing changes over the period, so that the multipliers are exact; nor where X has too little in the upper half of
 * its harmonics; nor where its lower half reaches the contacts' own frequency and alone has all multipliers on the same
 * side of 1. Of a row (is_row: asked about after the rows before it, along one curve) neither where contacts do the
 * same as in a row up to 8 before, on the same side of 1, whose error was at most a quarter of what this one is from 1;
 * nor where hbm_stability_error_is_costly. Then low = high, or what the lower half says. Errors of hbm_stability_at. */
hc_status hbm_stability_with_error(hbm_solver *s, double omega, const double *X, bool is_row, hbm_stability *out);

/* Do those equations have more than 600 unknowns? */
bool hbm_stability_error_is_costly(const hbm_solver *s);

/* The multipliers of that solution; what they differ by from X's, times *factor, is the error of X's. Errors of
 * hbm_stability_at and of the contact force, HC_SINGULAR; HC_NOT_CONVERGED: there is none next to X. */
hc_status hbm_finer_stability(hbm_solver *s, double omega, const double *X, hbm_stability *finer, double *factor);

/* Where the solution X at omega moves if the structure's receptance H is off by dH = error e^(i theta) H, as by a
 * reduction that states this error: q = H (p - F(q)), so that with R = S q + F - p, S = H^-1,
 *     dq = dH (p - F) - H F' dq,    (S + F') dq = error e^(i theta) S q.
 * moved[2][n_coef] is X + dq for theta = 0 and pi/2; of the dq between the two, which add up with cos theta and sin
 * theta, the largest change of anything is at most the root of the sum of the squares of both. Errors of the contact
 * force, HC_SINGULAR. */
hc_status hbm_predict_reduction(hbm_solver *s, double omega, const double *X, double error, double *moved);
