/* certificate.h - a certificate in memory: exact rational numbers and letters. README.md has the format. */
#pragma once

#include "proof/ball.h"
#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

/* Limits of a certificate; LIMIT_BYTES bounds the memory for reading it. */
enum {
  LIMIT_BYTES = 1 << 23,
  LIMIT_COORDINATES = 64,
  LIMIT_CONTACTS = 64,
  LIMIT_HARMONICS = 16,
  LIMIT_HARMONIC = 1000,
  LIMIT_MULTIPLE = 1000,
  LIMIT_UNKNOWNS = 2048, /* events times (2 coordinates + 1) */
  LIMIT_PRECISION = 1024,
  LIMIT_DIGITS = 120,
  LIMIT_EXPONENT = 400
};

enum { CONTACT_NUMBERS = 6 };

/* M x'' + C x' + K x + sum [ t T + n (N - N0) ] = sum [ p_k cos(k omega t) + q_k sin(k omega t) ], u = t.x, v = n.x:
 *     N = max(kn (v + gap), 0), N0 = max(kn gap, 0), or N = N0 = preload;  T = kt (u - w), |T| <= mu N */
typedef struct contact_given {
  bool tangential;                         /* with friction: letters O S + -; else O N */
  bool normal;                             /* with a normal direction; else N = `load`, a constant */
  bool angled;                             /* t = cos(angle) d, n = sin(angle) d: `t` and `n` are d, rational */
  fmpq *t, *n;                             /* [coordinates] in one array, followed by CONTACT_NUMBERS numbers */
  fmpq *angle, *kt, *mu, *kn, *gap, *load; /* [1]; angle in degrees; 0 if not given */
} contact_given;

typedef enum claim {
  CLAIM_MAX,
  CLAIM_MIN,
  CLAIM_AMPLITUDE,
  CLAIM_MEAN,
  CLAIM_A1,
  CLAIM_B1,
  CLAIM_HARMONIC_1,
  CLAIM_MULTIPLIER,
  CLAIMS
} claim;
extern const char *const claim_names[CLAIMS];

typedef enum stability { STABILITY_UNKNOWN, STABILITY_STABLE, STABILITY_UNSTABLE, STABILITY_UNPROVEN } stability;
extern const char *const stability_names[]; /* indexed by the enum; NULL for unknown */

typedef struct certificate {
  int n, n_contacts, n_harmonics, n_events;
  int multiple, precision;
  bool section;                     /* no transition: the only event is a section at fixed time */
  fmpq *mass, *damping, *stiffness; /* [n][n] */
  int harmonic[LIMIT_HARMONICS];    /* >= 0 */
  fmpq *cosine, *sine;              /* [n_harmonics][n] */
  contact_given contacts[LIMIT_CONTACTS];
  fmpq *omega, *response, *rest;    /* [1], [n], [n_contacts] */
  fmpq *scales[3];                  /* [1] each: of x, v, t */
  fmpq *time;                       /* [n_events] */
  fmpq *state;                      /* [n_events][2 n] x, v */
  char *letters;                    /* [n_events][n_contacts] after each event */
  fmpq *radius, *uniqueness_radius; /* [1] */
  bool claimed[CLAIMS];
  fmpq *claims; /* [CLAIMS][2] */
  stability stability;
  int n_vectors;
  fmpq *vectors; /* [n_vectors][n_vectors][2] */
  pool pool;     /* memory of all arrays */
} certificate;

/* Reads a certificate; a candidate has no claims and no vectors. NULL: wrong, why[size] tells the reason. */
certificate *certificate_read(const json_t *json, bool candidate, char *why, size_t size);
void certificate_free(certificate *c);

/* The decimal text[length] as a rational; false: not a decimal, or beyond LIMIT_DIGITS or LIMIT_EXPONENT. */
bool decimal_read(const char *text, size_t length, fmpq_t value);
