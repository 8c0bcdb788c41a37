/* quantity.h - what a column of a response curve may hold, by name and by formula.
 *
 *     x(t) = X0 + sum_k a_k cos(k omega t) + b_k sin(k omega t)         X[2H+1] = X0, a1, b1, a2, b2, ...
 *
 * Everything is of a motion truncated after H harmonics: a program that keeps H of them reports these of its own
 * solution. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* code, name, does it depend on where a slider rests that never slips?, formula. Those after ACCELERATION_HARMONIC
 * cannot be asked for: they are readings that the search tries. */
#define VERIFY_KIND_LIST(X)                                                                                            \
  X(KIND_AMPLITUDE, "amplitude", false, "(max - min)/2")                                                               \
  X(KIND_DOUBLE_AMPLITUDE, "double_amplitude", false, "max - min")                                                     \
  X(KIND_PEAK, "peak", true, "max |x|")                                                                                \
  X(KIND_MAX, "max", true, "max x")                                                                                    \
  X(KIND_MIN, "min", true, "min x")                                                                                    \
  X(KIND_MEAN, "mean", true, "X0")                                                                                     \
  X(KIND_RMS, "rms", true, "sqrt(X0^2 + sum (a_k^2 + b_k^2)/2)")                                                       \
  X(KIND_NORM, "norm", true, "sqrt(X0^2 + sum (a_k^2 + b_k^2))")                                                       \
  X(KIND_RMS_NLVIB, "norm_over_root_2", true, "sqrt((X0^2 + sum (a_k^2 + b_k^2))/2)")                                  \
  X(KIND_VELOCITY, "velocity", false, "(max x' - min x')/2")                                                           \
  X(KIND_ACCELERATION, "acceleration", false, "(max x'' - min x'')/2")                                                 \
  X(KIND_HARMONIC, "harmonic_", false, "|a_K + i b_K|")                                                                \
  X(KIND_VELOCITY_HARMONIC, "velocity_harmonic_", false, "K omega |a_K + i b_K|")                                      \
  X(KIND_ACCELERATION_HARMONIC, "acceleration_harmonic_", false, "K^2 omega^2 |a_K + i b_K|")                          \
  X(KIND_RMS_ALTERNATING, "rms without mean", false, "sqrt(sum (a_k^2 + b_k^2)/2)")                                    \
  X(KIND_NORM_ALTERNATING, "norm without mean", false, "sqrt(sum (a_k^2 + b_k^2))")                                    \
  X(KIND_SUM_OF_MODULI, "sum of moduli", false, "sum |a_k + i b_k|")                                                   \
  X(KIND_SUM_WITH_MEAN, "sum of moduli with mean", true, "|X0| + sum |a_k + i b_k|")                                   \
  X(KIND_COSINE, "|a1|", false, "|a_1|")                                                                               \
  X(KIND_SINE, "|b1|", false, "|b_1|")                                                                                 \
  X(KIND_PEAK_OF_HARMONIC, "mean and harmonic 1", true, "|X0| + |a_1 + i b_1|")
#define VERIFY_KIND_CODE(code, name, free, formula) code,
typedef enum verify_kind { VERIFY_KIND_LIST(VERIFY_KIND_CODE) VERIFY_KINDS } verify_kind;
#undef VERIFY_KIND_CODE

enum { VERIFY_QUANTITY_TEXT = 48, VERIFY_MOST_HARMONIC = 200 };

typedef struct verify_quantity {
  verify_kind kind;
  int harmonic; /* K, of the three kinds that end in one */
  bool decibel; /* 20 log10 of it, reference 1 */
} verify_quantity;

/* "amplitude", "dB", "harmonic_3", "dB_velocity", ...; "dB" is that of the amplitude. False: no such name. */
bool verify_quantity_read(const char *text, size_t length, verify_quantity *out);

/* Its name into text[VERIFY_QUANTITY_TEXT], which is returned. */
const char *verify_quantity_name(const verify_quantity *q, char text[VERIFY_QUANTITY_TEXT]);

bool verify_quantity_same(const verify_quantity *a, const verify_quantity *b);

/* Names for messages, "amplitude, harmonic_K, ...". */
extern const char verify_quantity_names[];

/* May it be negative? A number in dB may, and max, min and mean. */
bool verify_quantity_signed(const verify_quantity *q);
/* Why it cannot be verified of a structure's response; NULL: it can. A constant string. */
const char *verify_quantity_refused_of_structure(const verify_quantity *q);
/* Does it depend on where a slider rests that never slips? */
bool verify_quantity_of_mean(const verify_quantity *q);

/* A periodic motion, as quantities are taken of it. */
typedef struct verify_motion {
  double omega;    /* [rad/time] */
  double max, min; /* [length] */
  double rates[2]; /* [length/time], [length/time^2] (max - min)/2 of x' and x''; 0: not looked for yet */
  int n_harm;
  const double *X; /* [2 n_harm + 1] [length] */
} verify_motion;

/* The motion with the series X, which it points to from then on; its extrema are looked for. */
verify_motion verify_motion_of(double omega, int n_harm, const double *X);

/* The quantity of that motion, not in dB. */
double verify_quantity_of(const verify_quantity *q, const verify_motion *m);

/* m->rates, for those who ask for many quantities of one motion: their extrema are costly. */
void verify_motion_find_rates(verify_motion *m);

/* What a difference of that quantity is measured by, > 0: the amplitude of x, x' or x''. Of double_amplitude, norm and
 * sums: of themselves. */
double verify_quantity_scale(const verify_quantity *q, const verify_motion *m);

/* From the column's number to the quantity, and back: the same but in dB. */
double verify_quantity_from_column(const verify_quantity *q, double number);
double verify_quantity_to_column(const verify_quantity *q, double value);
