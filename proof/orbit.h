/* orbit.h - the theorem's objects. Between two events the letters are fixed and Z' = A Z, with the state
 *     Z = (x, v, 1, cos k omega t, sin k omega t of every harmonic, w of every slider that sticks)
 * Unknowns y: x, v, t of every event, [n_events][2 n + 1]; of a section x and v only. Segment i runs from event i to
 * event i + 1; the last ends at event 0, `multiple` periods later. */
#pragma once

#include "proof/certificate.h"

/* Where and why a proof ended. */
typedef struct failure {
  char reason[320];     /* empty: it did not */
  int segment, contact; /* -1: none */
  double from, to;      /* of time; NaN: none */
} failure;
bool refute(failure *f, int segment, int contact, const char *format, ...); /* keeps the first; returns false */

/* A contact in balls. */
typedef struct contact_balls {
  arb_ptr t, n; /* [coordinates]                                                           */
  arb_ptr kt, mu, kn, gap, load, rest;
  bool parallel; /* t = ratio n: tangential and normal motions are proportional             */
  arb_ptr ratio;
} contact_balls;

/* A segment's law and flow. In Z: x at 0, v at n, 1 at 2 n, then cos and sin of harmonics, then sliders that stick. */
typedef struct orbit_segment {
  const char *letters;        /* [contacts] */
  int size;                   /* of Z                                                     */
  int slider[LIMIT_CONTACTS]; /* column of w, -1: it does not stick                */
  int began[LIMIT_CONTACTS];  /* event at which its stick began, -1: it always did */
  char from[LIMIT_CONTACTS];  /* the letter before that                            */
  int place[LIMIT_CONTACTS];  /* of w in the monodromy's state x, v, w; -1: it is not there, or does not depend on x */
  int state;                  /* size of that                                      */
  arb_mat_struct *a;          /* [size][size]                                             */
  int *first, *length;        /* [size] the part of each row that is not 0                */
  slong *weight;              /* [size] norm of Z: max |Z_i| / 2^weight_i                 */
  mag_ptr norm;               /* of A in it                                               */
  arb_ptr span, step;         /* exact: about the segment's duration; span / 2^levels     */
  int levels;
  arb_mat_struct *power; /* [levels + 1] exp(A step 2^b)                             */
  arb_ptr start;         /* [size] Z at its start, for all y in the box              */
} orbit_segment;

/* dF/dy, by rows. */
typedef struct jacobian {
  int *row;       /* [unknowns + 1] where each begins */
  int n, *column; /* [n] */
  arb_ptr value;  /* [n] */
  int room;
} jacobian;

typedef struct orbit {
  pool pool; /* of all arrays */
  const certificate *c;
  slong precision;
  int n, m, contacts, unknowns;
  int harmonics, harmonic[LIMIT_HARMONICS + 1]; /* in Z: number of each                                  */
  int load_column[LIMIT_HARMONICS];             /* in Z: of the certificate's loads, the cosine's; 1's of harmonic 0 */
  int first_harmonic;                           /* the column of cos omega t in Z                        */
  arb_mat_struct *inverse_mass;
  arb_ptr omega, duration; /* of all segments together          */
  contact_balls *friction; /* [contacts]                        */
  orbit_segment *segments; /* [m]                               */
  arb_ptr centre, box;     /* [m][2 n + 1] y0; y                */
  arb_ptr scale;           /* [2 n + 1]                         */
  arb_ptr scratch;         /* [4 size], of whoever is at work    */
  int largest;             /* Z of the segments                 */
  int reach;               /* substeps have |A| step <= 2^reach */
  int degree;              /* of a substep's Taylor series, at most */
} orbit;

/* ---- model.c ---- */
/* NULL: the model is none (singular mass) or the sequence is refused, as `f` says. */
orbit *orbit_new(const certificate *c, failure *f);
void orbit_free(orbit *o);
/* Every segment's Z at its start, for all y in the box. */
void orbit_starts(orbit *o);
static inline arb_ptr orbit_event(const orbit *o, int i)
{
  return o->box + (size_t)(i % o->m) * (2 * (size_t)o->n + 1);
}
void orbit_time(const orbit *o, int event, arb_t t); /* event m: of event 0, one round later */
static inline char orbit_letter(const orbit *o, int i, int contact)
{
  return o->c->letters[(size_t)((i + o->m) % o->m) * (size_t)o->contacts + (size_t)contact];
}
/* The contact whose guard stands in F for event i; -1 for a section. */
int orbit_guarded(const orbit *o, int i);
typedef enum guard { GUARD_TOUCH, GUARD_SLIP, GUARD_STICK } guard;
guard guard_of(char before, char after);
static inline int sign_of(char letter) { return letter == '+' ? 1 : letter == '-' ? -1 : 0; }
/* w of a contact whose stick begins, linear in x: [n] and its constant. From O: t.x; from slip s: t.x - s mu N/kt. */
void slider_line(const orbit *o, int contact, char before, arb_ptr line);
/* Functions of Z that are linear, as rows [size]. */
void row_gap(const orbit *o, const orbit_segment *s, int contact, int sign,
             arb_ptr row); /* sign (n.x + gap)            */
void row_limit(const orbit *o, const orbit_segment *s, int contact, int sign,
               arb_ptr row); /* mu N - sign kt (t.x - w)    */
void row_slip(const orbit *o, const orbit_segment *s, int contact, int sign,
              arb_ptr row); /* sign kt t.v - mu kn n.v     */
/* ---- flow.c ---- */
/* The exponentials of all segments; false: too many substeps. */
bool flow_prepare(orbit *o, failure *f);
void flow_duration(const orbit *o, int i, arb_t tau); /* of segment i, in the box */
void flow_apply(const orbit *o, const orbit_segment *s, arb_srcptr z, arb_ptr derivative); /* A z */
/* Z at the end of segment i, and, if not NULL, the columns [size] of exp(A tau) that belong to x, v and w. */
bool flow_end(const orbit *o, int i, arb_ptr end, arb_ptr columns);

/* The substeps of a segment, one after the other: lengths `step`, the last as long as the segment may last at most. */
typedef struct walk {
  pool pool;
  const orbit *o;
  const orbit_segment *s;
  long steps, k; /* of steps; the one that was walked last                                          */
  arb_ptr at;    /* [levels + 1][size] Z at the last substep whose number ends in so many bits of 0 */
  arb_ptr width; /* exact                                                                           */
  arb_ptr end;   /* where the segment ends, in widths: 1, or a ball below 1 on the last             */
  int degree;
  arb_ptr series; /* [degree + 1][size] Z(t_k + s width) = sum of series_j s^j + rest, 0 <= s <= 1    */
  mag_ptr rest;   /* in the norm                                                                     */
  arb_ptr factor; /* [degree] width / (j + 1)                                                        */
} walk;
void walk_start(walk *w, const orbit *o, int i);
bool walk_next(walk *w); /* false: there is none left */
void walk_end(walk *w);
/* Taylor coefficients [degree + 1] of row.Z on the substep, and a bound of the rest of it. */
void walk_polynomial(const walk *w, arb_srcptr row, arb_ptr polynomial, mag_t rest);

/* Bernstein coefficients [degree + 1] on [0, 1] of a polynomial of `full` degree and a rest: what is above the degree,
 * and the rest, become radius. */
void bernstein(arb_ptr b, arb_srcptr polynomial, int full, int degree, const mag_t rest, slong precision);
void bernstein_halve(arb_srcptr b, arb_ptr left, arb_ptr right, int degree, slong precision);
typedef enum known_sign { SIDE_BOTH, SIDE_POSITIVE, SIDE_NEGATIVE } known_sign; /* SIDE_BOTH: not known */
known_sign bernstein_side(arb_srcptr b, int degree);

/* ---- existence.c ---- */
typedef struct krawczyk {
  pool pool;
  orbit *o;
  jacobian derivative;
  arb_ptr value;   /* [unknowns] F(y0)                             */
  double *inverse; /* [unknowns][unknowns] B                       */
  double *middle;  /* [derivative.n] a matrix near dF/dy at y0     */
  mag_ptr defect;  /* [unknowns] sum over c of |I - B middle| scale */
  mag_ptr shift;   /* [unknowns] |B F(y0)|                         */
  mag_ptr image;   /* [unknowns] |y - y0| <= image after existence_holds() */
} krawczyk;
/* F, dF/dy and B at the centre: `inverse`, which may be the one it has, or where that is NULL a new one; *k is {0} at
 * first. */
bool existence_prepare(krawczyk *k, orbit *o, const double *inverse, failure *f);
void existence_measure(krawczyk *k); /* what existence_holds() needs of them */
/* Has F exactly one zero in the box y0 +- radius scale? *ratio: what must be below 1. It stays the box. */
bool existence_holds(krawczyk *k, const arb_t radius, double *ratio);
void existence_free(krawczyk *k);
bool shooting_equations(orbit *o, arb_ptr f, jacobian *derivative); /* in the box; either may be NULL */
void box_set(orbit *o, mag_srcptr radius);                          /* centre +- radius [unknowns]; NULL: 0 */

/* ---- around/guesses.c: nothing is assumed of what these choose ---- */
void guess_weights(const orbit *o, orbit_segment *s); /* s->weight: x as the stiffness balances, v, loads */
bool guess_inverse(krawczyk *k);                      /* k->inverse, of k->middle; false: it is singular    */

/* ---- signs.c, multipliers.c, quantities.c ---- */
typedef struct quantities {
  arb_t value[CLAIMS];
  bool known, multiplier_known;
  stability stability;
} quantities;
bool sequence_check(const orbit *o, failure *f);
/* The monodromy matrix of the state after event *start (x, v, then sliders that stick); its size. */
int monodromy(const orbit *o, arb_mat_t product, failure *f);
void multipliers(const orbit *o, quantities *q, failure *f);
bool response_quantities(const orbit *o, quantities *q, failure *f);
