/* period_map.h - F^k, k periods of the load as a map of the state, its derivative Phi (the monodromy matrix), and the
 * step from a state towards a fixed point:
 *
 *     step = (I - Phi)^-1 (z - F^k(z))
 *
 * in the unit of length ti->length, at the integrator's present tolerance. F^k is integrated once at each point.
 *
 * A free slider: one that sticks all period is at a fixed point of F wherever it is, and its row of Phi is that of the
 * identity. So does one that travels less than MEASURE_RESTS in a period: a contact that shakes down comes to rest on
 * the edge of slip, where F has one derivative on either side, and the rounding of an orbit already found would choose
 * between them. That of slip nearly has a multiplier 1, and its step leads away. In I - Phi a free slider's equation
 * is: stay.
 *
 * Phi comes from the variational equations along the periods themselves. A large structure borrows it: from the map of
 * the same structure in closed form with its fastest modes slowed (mass_scaling.h), the lender, nearly its own at a
 * tenth of the cost. The lender keeps the last one it found. Slowed modes have units of their own (modal_base.h); only
 * this file converts. */
#pragma once

#include "timeint/steady/timeint_private.h"

typedef struct period_map period_map;

/* What periods come with; a better one also answers a request for less. None of a map that borrows its matrix. */
typedef enum period_matrix { PERIODS_ALONE, PERIODS_COARSE_MATRIX, PERIODS_MATRIX } period_matrix;

/* A monodromy matrix that is lent, and what it is of. */
typedef struct kept_matrix {
  int k;          /* periods; 0: there is none */
  double omega;   /* [rad/time] */
  double length;  /* [length] unit of length of `at` */
  double fastest; /* [rad/time] of the lender's modes then */
  long events;    /* changes of contact states in these periods */
  double *at;     /* [n] the state they began at, in the lender's units */
  double *phi;    /* [n][n] by columns, in the lender's units */
} kept_matrix;

struct period_map {          /* from period_map_new, to period_map_free; others write only what is said to be theirs */
  timeint *ti;               /* whose periods these are */
  int n;                     /* states */
  int k;                     /* periods of a point, of period_map_begin */
  const hc_monitor *monitor; /* of period_map_begin */
  period_map *lender;        /* of period_map_borrow_from, else NULL */
  kept_matrix kept;          /* for those that borrow from this one */

  bool known;           /* z, f, travel, events are of one run of periods; else z is where the search began */
  double *z, *f;        /* [n] the point last asked for, and F^k of it */
  double *phi;          /* [n][n] by columns, Phi there, if it came with them or has been borrowed */
  double *travel;       /* [n] of each slider: its largest distance, in a period, from where that period began */
  period_matrix matrix; /* what these periods came with, in phi */
  long events;          /* changes of contact states in them; exact law only */
  bool measures;        /* the searcher's: it expects the next point on an orbit, whose period is measured as well */

  double *before;         /* [n] ti->y when the search began */
  bool begun;             /* first is valid */
  double *first;          /* [n] F^k(before) */
  double *iterate, *step; /* [n] the searcher's: its present point; the step there */

  double *factors, *vector;     /* [n][n] of I - Phi; [n] scratch of one function */
  int *pivot;                   /* [n] of factors */
  double *one_period, *product; /* [n][n] monodromy matrix of one period out of k; a copy of what it multiplies */
  workspace memory;             /* of all the arrays above */
};

/* HC_NO_MEMORY: *out is NULL. */
hc_status period_map_new(timeint *ti, period_map **out);
void period_map_free(period_map *map); /* NULL is allowed */

/* The matrices of this map, and of `lender` itself, are those that `lender` keeps; of a handle of the same model, which
 * lives as long. */
void period_map_borrow_from(period_map *map, period_map *lender);

/* True if this map's matrices are borrowed: a lender's are, from itself. */
bool period_map_borrows(const period_map *map);

/* True if there are coarse matrices. The periods of such a map take a tenth of the time without one: a matrix serves
 * on as long as steps with it contract. */
bool period_map_has_coarse(const period_map *map);

/* A search for a fixed point of k periods from ti->y on: nothing is known of it. */
void period_map_begin(period_map *map, int k, const hc_monitor *monitor);

/* The search did not begin with periods of its own but with those of the lender, whose search began next to ti->y. */
void period_map_began_with(period_map *map, const period_map *lender);

/* F^k at z[n], and with it at least that matrix, if it does not borrow. HC_NOT_SETTLED after max_periods;
 * HC_INTERRUPTED; what integration answers. */
hc_status period_map_at(period_map *map, const double *z, period_matrix matrix);

/* Of a map that borrows: phi becomes Phi at map->z to some 1e-4 of a state's size; nothing to do for others. Errors of
 * integration; HC_NO_MEMORY. */
hc_status period_map_find_matrix(period_map *map);

/* The same, but phi is the lender's last matrix of these periods wherever that was, or, if `anew` or there is none, at
 * map->z. */
hc_status period_map_borrow(period_map *map, bool anew);
bool period_map_can_borrow(const period_map *map); /* true if there is one */

/* phi, by another handle of the same model along the k periods from map->z on, as good as Newton needs it. */
hc_status period_map_matrix_by(period_map *map, period_map *other);

/* True if state i is a free slider; by phi alone where F^k is not known. */
bool period_map_is_free(const period_map *map, int i);

/* jac[n][n] = I - Phi. */
void period_map_jacobian(const period_map *map, double *jac);

/* The same factored, for what follows. HC_SINGULAR. */
hc_status period_map_factor(period_map *map);

/* map->step = (I - Phi)^-1 (from - to); its length [L]. */
double period_map_step(period_map *map, const double *from, const double *to);

/* [L] How far F^k(z) may be off by what integration scatters. */
double period_map_scatter(const period_map *map);

/* *out [L]: no fixed point can be found to better than this, scatter |(I - Phi)^-1|, Frobenius norm. HC_SINGULAR where
 * that leaves no digit of it: it is as any other along a motion that nothing holds. */
hc_status period_map_attainable(period_map *map, double *out);
