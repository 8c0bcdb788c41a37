/* causes.h - what may be wrong with a curve: one bit each, its word in csv and json, its meaning, its remedy. */
#pragma once

#include <stdbool.h>

/* clang-format off */
#define VERIFY_CAUSE_LIST(X) \
  /* the equations */ \
  X(CAUSE_NO_STATIC, "no_static_harmonic", "harmonic 0 is missing", "keep harmonic 0") \
  X(CAUSE_ODD_ONLY, "odd_harmonics_only", "even harmonics are missing", "keep even harmonics, 0 included") \
  X(CAUSE_HARMONICS, "too_few_harmonics", "too few harmonics", "keep more harmonics") \
  X(CAUSE_SAMPLES, "too_few_samples", "too few samples", "take more samples per period, or exact forces") \
  X(CAUSE_SLIDER, "slider_restart", "the slider restarts on a sample after a separation", \
    "restart it at the interpolated instant of touch") \
  X(CAUSE_SINGLE_PASS, "single_pass", "the slider is followed over one period only", \
    "follow it over two periods, and keep the second") \
  X(CAUSE_SLIDER_ZEROED, "slider_zeroed", "the slider is put to zero by a separation", \
    "while separated the slider is where the contact is: w = u") \
  X(CAUSE_SLIDER_KEPT, "slider_kept", "the slider is kept over a separation", \
    "while separated the slider is where the contact is: w = u") \
  X(CAUSE_FRICTION_SIGN, "friction_sign", "a friction force has the other sign", \
    "T acts along the tangent as its motion u grows: + t T on the left of the equations") \
  X(CAUSE_SLIDER_MEAN, "slider_mean", "the friction force lacks the slider's mean", \
    "harmonic 0 of T = kt (u - w) is kt times that of u - w: keep it") \
  X(CAUSE_NO_SEPARATION, "no_separation", "the contacts do not separate", "N = max(kn (v + gap), 0)") \
  X(CAUSE_CONSTANT_N, "constant_normal_force", "the normal force does not change with the motion", \
    "the limit of friction is mu N with N = max(kn (v + gap), 0)") \
  X(CAUSE_PRELOAD_ADDED, "preload_not_subtracted", "the preload acts on the mass", \
    "x is measured from the static equilibrium: the mass feels N - N0") \
  X(CAUSE_CONTACT_FACTOR, "contact_force_factor", "the contact force is off by a factor", \
    "is its Fourier sum divided by N/2, and by N for harmonic 0?") \
  X(CAUSE_MEAN_FACTOR, "mean_factor", "harmonic 0 of the contact force is off by a factor", \
    "divide its Fourier sum by N, those of the other harmonics by N/2") \
  X(CAUSE_NO_CONTACT, "no_contact", "the contacts are missing", \
    "is the gap's sign right, and the contact force in the equations?") \
  X(CAUSE_STUCK, "always_stuck", "the contacts neither slip nor separate", \
    "is the contact force nonlinear in the equations?") \
  /* the case's numbers */ \
  X(CAUSE_FORCE, "wrong_force", "the forcing has another amplitude", "compare the forcing with the case's") \
  X(CAUSE_MASS, "wrong_mass", "the mass is another", "compare the mass with the case's") \
  X(CAUSE_DAMPING, "wrong_damping", "the damping is another", "compare the damping with the case's") \
  X(CAUSE_DAMPING_KIND, "damping_kind", "the damping is of another kind", \
    "compare the damping matrix: modal, proportional to M or to K, hysteretic") \
  X(CAUSE_STIFFNESS, "wrong_stiffness", "the stiffness is another", "compare the stiffness with the case's") \
  X(CAUSE_KT, "wrong_tangential_stiffness", "the tangential stiffness is another", "compare it with the case's") \
  X(CAUSE_KN, "wrong_normal_stiffness", "the normal stiffness is another", "compare it with the case's") \
  X(CAUSE_FRICTION, "wrong_friction", "the friction coefficient is another", "compare it with the case's") \
  X(CAUSE_GAP, "wrong_gap", "the gap is another", "compare the gap with the case's") \
  X(CAUSE_COEFFICIENT, "wrong_coefficient", "a coefficient of a polynomial is another", \
    "compare its coefficients with the case's, and their signs") \
  X(CAUSE_POWER, "wrong_power", "a polynomial has other powers", \
    "the force of {p: k} is k d^p: powers of the force, not of its potential") \
  X(CAUSE_EPSILON, "wrong_epsilon", "epsilon of tanh friction is another", \
    "it is the velocity that smooths: mu N tanh(u'/epsilon)") \
  X(CAUSE_GAP_SIGN, "gap_sign", "the gap has the other sign", "here gap > 0 is a preload, gap < 0 a clearance") \
  X(CAUSE_ANGLE, "wrong_angle", "the angle of the contact is another", "compare it with the case's") \
  X(CAUSE_ANGLE_COMPLEMENT, "angle_complement", "the angle is counted from the other axis", \
    "here it is the one between the motion and the contact's tangent") \
  X(CAUSE_ANGLE_UNIT, "angle_unit", "degrees and radians are mixed up", "give the angle in degrees") \
  X(CAUSE_EXCHANGED, "stiffnesses_exchanged", "kt and kn are exchanged", "exchange them") \
  X(CAUSE_NO_FRICTION, "no_friction", "there is no friction", "give the friction coefficient") \
  X(CAUSE_NO_KT, "no_tangential_stiffness", "there is no tangential force", "give the tangential stiffness") \
  X(CAUSE_SQUARE_LIMIT, "square_limit", "friction is limited in each of two directions by itself (limit: square)", \
    "the case limits the vector, |(T_1, T_2)| <= mu N: limit: circle") \
  X(CAUSE_CIRCLE_LIMIT, "circle_limit", "friction in two directions is limited as a vector (limit: circle)", \
    "the case limits each direction by itself: limit: square") \
  X(CAUSE_TANGENT_MISSING, "tangent_missing", "friction acts in one of two directions only", \
    "give both tangential directions") \
  X(CAUSE_LOAD_DOF, "load_dof", "the force acts on another degree of freedom", "compare the forcing's direction") \
  X(CAUSE_NO_STATIC_LOAD, "no_static_load", "the static loads are missing or of another size", \
    "give the loads of harmonic 0") \
  X(CAUSE_PHASE_SIGN, "phase_sign", "the phases of the loads have the other sign", \
    "here a load is amplitude cos(k omega t + phase)") \
  X(CAUSE_TRANSPOSED, "transposed", "a matrix is transposed", "is it written by rows or by columns?") \
  X(CAUSE_ONE_SIDE, "one_side_turned", "one side of a contact has the other sign", \
    "compare the contact's tangent and normal with the case's") \
  X(CAUSE_ONE_LOAD, "one_load", "one of several loads is another", "compare the loads one by one, and their phases") \
  X(CAUSE_CONTACTS_EXCHANGED, "contacts_exchanged", "the stiffnesses of two contacts are exchanged", \
    "compare the order of the contacts with the case's") \
  X(CAUSE_LUMPED_MASS, "lumped_mass", "the mass matrix is lumped", "give the consistent mass matrix") \
  X(CAUSE_DOFS_EXCHANGED, "dofs_exchanged", "two degrees of freedom are exchanged", \
    "compare the numbering in matrices, loads and contacts") \
  /* the columns */ \
  X(CAUSE_RESPONSE, "other_response", "the values are those of another response", "name the right one: --response") \
  X(CAUSE_RELATIVE, "relative_response", "the values are those of a motion relative to another", \
    "give the motion itself, or --response both of them: {a: 1, b: -1}") \
  X(CAUSE_FREQUENCY, "frequency_unit", "rad per time and cycles per time are mixed up", \
    "name the column omega or frequency as it is") \
  X(CAUSE_TWICE, "peak_to_peak", "the values are twice as large, as from peak to peak", "halve them") \
  X(CAUSE_HALF, "half_amplitude", "the values are half as large, as of one-sided coefficients", "double them") \
  X(CAUSE_RMS, "rms", "the values are root mean squares", "name the column rms") \
  X(CAUSE_RMS_ALTERNATING, "rms_without_mean", "the values are root mean squares without the mean", \
    "give amplitudes, or root mean squares with the mean and name the column rms") \
  X(CAUSE_RMS_NLVIB, "norm_over_root_2", "the values are norms of all harmonics divided by the root of 2", \
    "name the column norm_over_root_2") \
  X(CAUSE_NORM, "norm", "the values are norms of all harmonics", "name the column norm") \
  X(CAUSE_SUM, "sum_of_moduli", "the values are sums of the harmonics' moduli", \
    "harmonics do not peak at one time: evaluate x(t) and give (max - min)/2") \
  X(CAUSE_COSINE, "cosine_only", "the values are |a1|", "give |a1 + i b1|") \
  X(CAUSE_SINE, "sine_only", "the values are |b1|", "give |a1 + i b1|") \
  X(CAUSE_VELOCITY, "velocity", "the values are velocities", "name the column velocity") \
  X(CAUSE_ACCELERATION, "acceleration", "the values are accelerations", "name the column acceleration") \
  X(CAUSE_DECIBEL, "decibel", "the values are in dB", "name the column dB, or dB_ and its quantity") \
  X(CAUSE_LENGTH, "length_unit", "the values are in another unit of length", "give them in the case's unit") \
  X(CAUSE_QUANTITY, "other_quantity", "the values are another quantity", "name the column by what it holds") \
  X(CAUSE_VALUE_SCALE, "value_scale", "all values are off by one factor", "give them in the case's units") \
  X(CAUSE_OMEGA_SCALE, "omega_scale", "all frequencies are off by one factor", "give them in the case's units") \
  X(CAUSE_OMEGA_OFFSET, "frequency_offset", "all frequencies are a little off", "calibrate the frequency axis") \
  /* the points: one of these stands alone */ \
  X(CAUSE_OUTLIER, "outlier", "few points are far off and the others are right", "look at these points alone") \
  X(CAUSE_NOISE, "noise", "the points scatter around the truth", \
    "measured, or computed? Say how much a measured curve scatters: --noise") \
  X(CAUSE_NOT_CONVERGED, "not_converged", "points lie anywhere, as where Newton ended before it converged", \
    "check the residuals of these points") \
  X(CAUSE_INTERPOLATED, "interpolated", "points lie on chords of the curve, between others", \
    "give the points that were computed, without those between") \
  X(CAUSE_UNSTABLE, "unstable_branch", "the points run along an unstable branch", \
    "no motion stays there: follow a stable one where there is one") \
  X(CAUSE_OTHER_BRANCH, "other_branch", "the points hop to another stable branch and back", \
    "start each point from its neighbour's solution")
/* clang-format on */
#define VERIFY_CAUSE_NUMBER(code, word, meaning, remedy) code,
enum { VERIFY_CAUSE_LIST(VERIFY_CAUSE_NUMBER) VERIFY_CAUSES, CAUSE_NONE = VERIFY_CAUSES };
#undef VERIFY_CAUSE_NUMBER

/* Bits; one of the points stands alone, as the complement of its number: no equations have nearly all causes. More bits
 * than uint64_t has: of gcc and clang on every machine of 64 bits. */
__extension__ typedef unsigned __int128 verify_causes;
enum { VERIFY_MOST_BITS = 128 };
#define VERIFY_BIT(cause)                                                                                              \
  ((cause) < CAUSE_OUTLIER ? (verify_causes)1 << ((cause) % VERIFY_MOST_BITS) : ~(verify_causes)((cause)-CAUSE_OUTLIER))
static inline bool verify_has(verify_causes causes, int cause)
{
  const bool of_points = cause >= CAUSE_OUTLIER || causes > VERIFY_BIT(VERIFY_CAUSES);
  return of_points ? causes == VERIFY_BIT(cause) : (causes & VERIFY_BIT(cause)) != 0;
}

const char *verify_cause_meaning(int cause);
const char *verify_cause_remedy(int cause);

/* The words of all bits, joined by '+', "none" for none: in text[VERIFY_TEXT], which is returned. */
enum { VERIFY_TEXT = 1024 };
const char *verify_cause_words(verify_causes causes, char text[VERIFY_TEXT]);

/* How many there are. */
int verify_cause_count(verify_causes causes);
