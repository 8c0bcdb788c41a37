/* acceleration.h - the acceleration of a motion that is a solution, from the equation of motion; private to
 * compare/verify/. The series of x'' would need some 1000 harmonics for three digits, as its coefficients decay like
 * 1/k^2; x and x' need far fewer. */
#ifndef HC_VERIFY_ACCELERATION_H
#define HC_VERIFY_ACCELERATION_H

#include "compare/verify/curve_file/quantity.h"
#include "model/model.h"

/* Sliders that acceleration_amplitude works with: doubles, of a model. */
size_t acceleration_room(const model *m);

/* (max x'' - min x'')/2 [length/time^2] of the motion's series X, with
 *     M x'' = F0 cos(th) - C x' - K x - sum_j [ t_j T_j + n_j (N_j - N0_j) ],      th = omega t
 * on 4096 samples of the third period from the sliders room[n_contacts] at th = 0, and around the largest and the
 * smallest of them to 1e-8 of a sample. A slider restarts at the interpolated instant of touch. room[] is
 * overwritten. */
double acceleration_amplitude(const model *m, const verify_motion *motion, double *room);

#endif
