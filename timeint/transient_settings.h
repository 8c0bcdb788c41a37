/* transient_settings.h - how a steady state is found by time integration. Plain data: copy it freely. Names, defaults,
 * ranges and meanings of the fields are those of `transient` in a case file (model/casefile/fields.c). */
#pragma once

#include <stdbool.h>

/* The ends of their ranges that advice must know. */
#define TRANSIENT_LEAST_TOLERANCE      1e-13
#define TRANSIENT_MOST_REGULARISATION  1e-1
#define TRANSIENT_USUAL_REGULARISATION 1e-4
enum { TRANSIENT_MOST_PERIODS = 10000000 };

typedef enum transient_law { TRANSIENT_LAW_REGULARISED, TRANSIENT_LAW_EXACT } transient_law;
typedef enum transient_method { TRANSIENT_METHOD_CVODE, TRANSIENT_METHOD_CLOSED_FORM } transient_method;
typedef enum transient_steady {
  TRANSIENT_STEADY_AUTO,
  TRANSIENT_STEADY_MARCH,
  TRANSIENT_STEADY_SHOOTING
} transient_steady;
typedef enum transient_start {
  TRANSIENT_START_HBM,
  TRANSIENT_START_REST,
  TRANSIENT_START_UP,
  TRANSIENT_START_DOWN
} transient_start;

typedef struct transient_settings {
  transient_law law;
  transient_method method; /* closed form: exact law only */
  bool scout;              /* orbits are looked for in closed form, and confirmed by `method` */
  double regularisation;   /* [1] */
  transient_steady steady;
  transient_start start;
  double tolerance; /* [1] relative distance to the periodic orbit */
  int max_periods;
  double regularisation_error; /* [1] of an amplitude, relative: where it is larger the regularisation is halved; 0: it
                                  stays as it is. No field of a case: a tenth of gate.amplitude */
} transient_settings;
