/* orbit.h - the theorem's objects. Between two events the letters are fixed and Z' = A Z, with the state
 *     Z = (x, v, 1, cos k omega t, sin k omega t of every harmonic, w of every slider that sticks)
 * Unknowns y: x, v, t of every event, [n_events][2 n + 1]; for a section x and v only. Segment i runs from event i to
 * event i + 1; the last ends at event 0, `multiple` periods later. */
#pragma once

#include "proof/certificate.h"

/* Reason and place of a failed proof. */
typedef struct failure {
  char reason[320];     /* empty: no failure */
  int segment, contact; /* -1: none */
  double from, to;      /* interval of time; NaN: none */
} failure;
bool refute(failure *f, int segment, int contact, const char *format, ...); /* stores the first failure; false */

/* A contact in balls. */
typedef struct contact_balls {
  arb_ptr t, n; /* [coordinates] */
  arb_ptr kt, mu, kn, gap, load, rest;
  bool parallel; /* t = ratio n: tangential and normal motions are proportional */
  arb_ptr ratio;
} contact_balls;

/* A segment's law and flow. Order of Z: x at 0, v at n, 1 at 2 n, then cos and sin of harmonics, then sliders that
 * stick. */
typedef struct orbit_segment {
  const char *letters;        /* [contacts] */
  int size;                   /* length of Z */
  int slider[LIMIT_CONTACTS]; /* index of w in Z, -1: it does not stick */
  int began[LIMIT_CONTACTS];  /* event at which stick began, -1: sticks all period */
  char from[LIMIT_CONTACTS];  /* letter before that event */
  int place[LIMIT_CONTACTS];  /* index of w in the monodromy's state x, v, w; -1: not in the state, or w is independent
                                 of it */
  int state;                  /* size of that state */
  arb_mat_struct *a;          /* [size][size] */
  int *first, *length;        /* [size] nonzero range of each row of A */
  slong *weight;              /* [size] norm of Z: max |Z_i| / 2^weight_i */
  mag_ptr norm;               /* norm of A in it */
  arb_ptr span, step;         /* exact numbers: approximate duration of the segment; span / 2^levels */
  int levels;
  arb_mat_struct *power; /* [levels + 1] exp(A step 2^b) */
  arb_ptr start;         /* [size] Z at the start, for all y in the box */
} orbit_segment;

/* dF/dy, by rows. */
typedef struct jacobian {
  int *row;       /* [unknowns + 1] index of each row's first entry */
  int n, *column; /* [n] */
  arb_ptr value;  /* [n] */
  int room;
} jacobian;

typedef struct orbit {
  pool pool; /* of all arrays */
  const certificate *c;
  slong precision;
  int n, m, contacts, unknowns;
  int harmonics, harmonic[LIMIT_HARMONICS + 1]; /* number of harmonics in Z; harmonic numbers */
  int load_column[LIMIT_HARMONICS];             /* index in Z of each load's cosine, or of 1 for harmonic 0 */
  int first_harmonic;                           /* index of cos omega t in Z */
  arb_mat_struct *inverse_mass;
  arb_ptr omega, duration; /* total duration of all segments */
  contact_balls *friction; /* [contacts] */
  orbit_segment *segments; /* [m] */
  arb_ptr centre, box;     /* [m][2 n + 1] y0; the box of y */
  arb_ptr scale;           /* [2 n + 1] */
  arb_ptr scratch;         /* [4 size] work, for one function at a time */
  int largest;             /* largest size of Z */
  int reach;               /* log2 of the bound of |A| step */
  int degree;              /* largest degree of a substep's Taylor series */
} orbit;

/* ---- model.c ---- */
/* NULL: singular mass, or a sequence that is not covered; reason in *f. */
orbit *orbit_new(const certificate *c, failure *f);
void orbit_free(orbit *o);
/* Sets every segment's Z at its start, for all y in the box. */
void orbit_starts(orbit *o);
static inline arb_ptr orbit_event(const orbit *o, int i)
{
  return o->box + (size_t)(i % o->m) * (2 * (size_t)o->n + 1);
}
void orbit_time(const orbit *o, int event, arb_t t); /* event m: event 0 of the next period */
static inline char orbit_letter(const orbit *o, int i, int contact)
{
  return o->c->letters[(size_t)((i + o->m) % o->m) * (size_t)o->contacts + (size_t)contact];
}
/* The contact whose guard is the equation of event i in F; -1 for a section. */
int orbit_guarded(const orbit *o, int i);
typedef enum guard { GUARD_TOUCH, GUARD_SLIP, GUARD_STICK } guard;
guard guard_of(char before, char after);
static inline int sign_of(char letter) { return letter == '+' ? 1 : letter == '-' ? -1 : 0; }
/* w of a contact at the beginning of stick, as a row on x: line[n], then a constant. From O: t.x; from slip s: t.x - s
 * mu N/kt. */
void slider_line(const orbit *o, int contact, char before, arb_ptr line);
/* Linear functions of Z, as rows [size]. */
void row_gap(const orbit *o, const orbit_segment *s, int contact, int sign, arb_ptr row); /* sign (n.x + gap) */
void row_limit(const orbit *o, const orbit_segment *s, int contact, int sign,
               arb_ptr row); /* mu N - sign kt (t.x - w) */
void row_slip(const orbit *o, const orbit_segment *s, int contact, int sign, arb_ptr row); /* sign kt t.v - mu kn n.v */
/* ---- flow.c ---- */
/* The exponentials of all segments; false: too many substeps. */
bool flow_prepare(orbit *o, failure *f);
void flow_duration(const orbit *o, int i, arb_t tau); /* duration of segment i, for the box */
void flow_apply(const orbit *o, const orbit_segment *s, arb_srcptr z, arb_ptr derivative); /* A z */
/* Z at the end of segment i and, if not NULL, the columns [size] of exp(A tau) for x, v and w; false: box too wide. */
bool flow_end(const orbit *o, int i, arb_ptr end, arb_ptr columns);

/* Iterates over the substeps of a segment: of length `step`, the last one up to the longest possible duration. */
typedef struct walk {
  pool pool;
  const orbit *o;
  const orbit_segment *s;
  long steps, k; /* number of substeps; index of the current one */
  arb_ptr at;    /* [levels + 1][size] Z at the last substep whose index ends in b bits of 0 */
  arb_ptr width; /* exact length of the current substep */
  arb_ptr end;   /* end of the segment on the substep, in widths: 1, on the last one a ball up to 1 */
  int degree;
  arb_ptr series; /* [degree + 1][size] Z(t_k + s width) = sum of series_j s^j + rest, 0 <= s <= 1 */
  mag_ptr rest;   /* norm of the rest */
  arb_ptr factor; /* [degree] width / (j + 1) */
} walk;
void walk_start(walk *w, const orbit *o, int i);
bool walk_next(walk *w); /* false: no more substeps */
void walk_end(walk *w);
/* Taylor coefficients [degree + 1] of row.Z on the substep, and a bound of its rest. */
void walk_polynomial(const walk *w, arb_srcptr row, arb_ptr polynomial, mag_t rest);

/* Bernstein coefficients [degree + 1] on [0, 1] of a polynomial of degree `full` plus a rest: terms above `degree`, and
 * the rest, are added to the radii. */
void bernstein(arb_ptr b, arb_srcptr polynomial, int full, int degree, const mag_t rest, slong precision);
void bernstein_halve(arb_srcptr b, arb_ptr left, arb_ptr right, int degree, slong precision);
typedef enum known_sign { SIDE_BOTH, SIDE_POSITIVE, SIDE_NEGATIVE } known_sign; /* SIDE_BOTH: unknown */
known_sign bernstein_side(arb_srcptr b, int degree);

/* ---- existence.c ---- */
typedef struct krawczyk {
  pool pool;
  orbit *o;
  jacobian derivative;
  arb_ptr value;   /* [unknowns] F(y0) */
  double *inverse; /* [unknowns][unknowns] B */
  double *middle;  /* [derivative.n] midpoints of dF/dy at y0 */
  mag_ptr defect;  /* [unknowns] sum over c of |I - B middle| scale */
  mag_ptr shift;   /* [unknowns] |B F(y0)| */
  mag_ptr image;   /* [unknowns] bound of |y - y0| for the zero, after existence_holds() */
} krawczyk;
/* Computes F and dF/dy at the centre, and sets B to `inverse` (may be k->inverse), or, if NULL, to a new inverse. *k
 * must be {0} before the first call. */
bool existence_prepare(krawczyk *k, orbit *o, const double *inverse, failure *f);
void existence_measure(krawczyk *k); /* defect and shift, for existence_holds() */
/* True if F has exactly one zero in the box y0 +- radius scale, which becomes o->box. *ratio: must be below 1 for
 * that. */
bool existence_holds(krawczyk *k, const arb_t radius, double *ratio);
void existence_free(krawczyk *k);
bool shooting_equations(orbit *o, arb_ptr f, jacobian *derivative); /* for the box; either may be NULL */
void box_set(orbit *o, mag_srcptr radius);                          /* centre +- radius [unknowns]; NULL: 0 */

/* ---- around/guesses.c: the proof is valid for any result of these ---- */
void guess_weights(const orbit *o, orbit_segment *s); /* sets s->weight */
bool guess_inverse(krawczyk *k);                      /* k->inverse from k->middle; false: singular */

/* ---- signs.c, multipliers.c, quantities.c ---- */
typedef struct quantities {
  arb_t value[CLAIMS];
  bool known, multiplier_known;
  stability stability;
} quantities;
bool sequence_check(const orbit *o, failure *f);
/* The monodromy matrix of the state (x, v, then sliders that stick), starting at the event with the smallest state;
 * returns its size. */
int monodromy(const orbit *o, arb_mat_t product, failure *f);
void multipliers(const orbit *o, quantities *q, failure *f);
bool response_quantities(const orbit *o, quantities *q, failure *f);
