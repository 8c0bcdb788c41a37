/* survey_starts.h - where the motions of a survey begin: points of a low-discrepancy sequence (Sobol's, GSL; beyond its
 * 40 dimensions random numbers), shifted by numbers that the seed draws, as states (x, v, w) about rest:
 *
 *     x = x_rest + sum_i r_i a_i phi_i xi_i       v = sum_i r_i a_i max(omega, omega_i) phi_i eta_i
 *     w = u + zeta min(mu N/kt, a few motions)    xi, eta, zeta in [-1, 1); zeta under the law of the circle in a disc
 *
 * phi_i are modes, at most MOST_MODES (survey_starts.c), the fastest ones. a_i [length] is the largest amplitude of the
 * mode in the linear response and in the motions seen so far (survey_starts_see): directions of any size have starts of
 * theirs. r_i is 1 for half of the starts and 0.1 for a fifth; for the others spread evenly in its logarithm up to 4 or
 * to the largest amplitude that the loads can keep up: in a periodic motion the damping of the mode takes at most what
 * its load gives, c_i v_rms <= p_rms. Normal springs hold no more energy than the motion has. Start 0 is rest. */
#pragma once

#include "model/model.h"

typedef struct survey_starts survey_starts;

/* n starts at omega; rest: the state of timeint_rest (copied). Errors of model_modes; HC_NO_MEMORY: *out is NULL. */
hc_status survey_starts_new(const model *m, double omega, const double *rest, int n, unsigned seed,
                            survey_starts **out);
void survey_starts_free(survey_starts *s);

/* The sizes become at least those of a periodic motion through that state. */
void survey_starts_see(survey_starts *s, const double *state);

/* state[2 n + n_contacts] of start i; may be called from several threads. */
void survey_starts_draw(const survey_starts *s, int i, double *state);
