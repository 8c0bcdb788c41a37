/* in_modes.c - multipliers of a large structure, all intervals in its modes (monodromy.h).
 *
 * Most states decay to rounding within the first part of the period. After each part phi, its rows scaled to roots of
 * energies, is factored to rounding as phi = basis carry, and only the columns of the basis are integrated further.
 * With phi of the basis at the end, the map of the period is phi carry, and carry phi, smaller, has the same
 * multipliers but for 0.
 *
 * In a large structure less than a hundredth of the states outlasts a part of the period. Their space is found by
 * integrating as many random columns. The period then begins behind that part, with a basis of it, and its map is
 * that of the basis's coordinates: cyclic products have the same multipliers but for 0. */
#include <stdlib.h>
#include <string.h>

#include "hbm/stability/modal_flow.h"
#include "hbm/stability/monodromy.h"
#include "hbm/stability/variation.h"
#include "numerics/base/constants.h"
#include "numerics/dense.h"

enum {
  PARTS = 16,        /* of a period */
  FIRST = 3,         /* of these: the first part, that few columns outlast */
  MANY_STATES = 400, /* random columns that survivors are looked for with, at first */
  SPARE = 16         /* columns that must be lost, to be sure that none was missed */
};
static const double LOST = 1e-13; /* of the largest column: rounding */

typedef struct in_modes {
  variation v; /* of modal_flow_model */
  modal_flow *modal;
  bool from_all;    /* no survivors are looked for */
  double *weighted; /* [n_states][n_states] phi by columns, rows as roots of energies; compress makes a basis of it */
  double *size, *squares; /* [n_states] of the basis's columns; the squares of those yet to be made orthogonal */
  int *place;             /* [n_states] which column of phi each of `weighted` is */
  double *factor;         /* [n_states][n_states] by rows: columns of phi in the basis */
  int carried;            /* columns of carry: those the period began with */
  double *carry,
      *next;       /* [n_states][n_states] by rows: these columns in those of phi, which are fewer; the next ones */
  double *closing; /* [n_states][n_states] by rows: those of phi at the period's end in those it began with */
  double *map;     /* [columns][columns] carry closing */
} in_modes;

static void in_modes_free(void *self)
{
  in_modes *w = self;
  if (!w) return;
  modal_flow_free(w->modal);
  variation_free(&w->v);
  free(w);
}

static hc_status in_modes_make(const model *m, void **self, variation **v)
{
  in_modes *w = *self = calloc(1, sizeof *w);
  if (!w) return HC_NO_MEMORY;
  *v = &w->v;
  hc_status st = modal_flow_new(m, &w->modal);
  if (st == HC_OK) st = variation_make(&w->v, modal_flow_model(w->modal), PARTS);
  if (st != HC_OK) return st;
  const size_t states = (size_t)w->v.n_states;
  workspace *memory = &w->v.memory;
  double **const matrices[] = {&w->weighted, &w->factor, &w->carry, &w->next, &w->closing, &w->map};
  for (size_t i = 0; i < sizeof matrices / sizeof *matrices; ++i)
    *matrices[i] = workspace_doubles(memory, states * states);
  w->size = workspace_doubles(memory, states);
  w->squares = workspace_doubles(memory, states);
  w->place = workspace_array(memory, states, sizeof *w->place);
  return memory->failed ? HC_NO_MEMORY : HC_OK;
}

static hc_status in_modes_make_from_all(const model *m, void **self, variation **v)
{
  const hc_status st = in_modes_make(m, self, v);
  if (*self) ((in_modes *)*self)->from_all = true;
  return st;
}

/* ---- columns ------------------------------------------------------------------------------------------- */

/* Root of the energy of state i by what it is: lengths by their mode's frequency, sliders by kt. 0 where the state does
 * not count on the current interval. */
static double weight_of_state(const variation *v, int i)
{
  const int j = i - 2 * v->n;
  if (i < v->n) return fmax(v->omega, sqrt(fmax(0, v->m->stiffness[(size_t)i * (size_t)(v->n + 1)])));
  if (j < 0) return 1;
  const double root = sqrt(v->m->contacts[j].law.kt);
  if (variation_sticks(v, j)) return root > 0 ? 1 / root : 0;
  return variation_slips(v, j) ? root : 0;
}

/* columns[v->columns][states] = phi times the weights of its states. */
static void weigh_columns(const variation *v, double *columns)
{
  const size_t states = (size_t)v->n_states;
  for (size_t i = 0; i < states; ++i) {
    const double weight = weight_of_state(v, (int)i);
    for (size_t q = 0; q < (size_t)v->columns; ++q) columns[q * states + i] = weight * v->phi[i * states + q];
  }
}

/* The period begins with the columns of phi. */
static void carry_nothing(in_modes *w)
{
  const size_t states = (size_t)w->v.n_states;
  w->carried = w->v.columns;
  memset(w->carry, 0, states * states * sizeof *w->carry);
  for (size_t q = 0; q < (size_t)w->carried; ++q) w->carry[q * states + q] = 1;
}

/* For long vectors: four sums, which do not wait for each other. */
static double long_product(size_t n, const double *a, const double *b)
{
  double sum[4] = {0};
  size_t i = 0;
  for (; i + 4 <= n; i += 4)
    for (size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
  for (; i < n; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static void swap_columns(size_t n, double *A, int a, int b)
{
  for (size_t i = 0; i < n && a != b; ++i) {
    const double kept = A[(size_t)a * n + i];
    A[(size_t)a * n + i] = A[(size_t)b * n + i];
    A[(size_t)b * n + i] = kept;
  }
}

/* phi = basis factor by Gram and Schmidt, the largest column first, each as long as what it is of phi, so that in later
 * parts, too, LOST is of the largest; phi becomes the basis, carry = factor carry. The basis need not be orthogonal to
 * rounding: only the product counts. */
static void compress(in_modes *w)
{
  variation *v = &w->v;
  const size_t states = (size_t)v->n_states;
  double *Q = w->weighted, *R = w->factor, *squares = w->squares, first = 0;
  int rank = 0;
  memset(R, 0, states * states * sizeof *R);
  for (int q = 0; q < v->columns; ++q) w->place[q] = q;
  weigh_columns(v, Q);
  for (int q = 0; q < v->columns; ++q)
    squares[q] = long_product(states, Q + (size_t)q * states, Q + (size_t)q * states);
  for (; rank < v->columns; ++rank) {
    int pivot = rank;
    for (int q = rank + 1; q < v->columns; ++q)
      if (squares[q] > squares[pivot]) pivot = q;
    const double size = sqrt(squares[pivot]);
    if (rank == 0) first = size;
    if (!(size > LOST * first)) break;
    swap_columns(states, Q, rank, pivot);
    const int moved = w->place[rank];
    w->place[rank] = w->place[pivot], w->place[pivot] = moved, squares[pivot] = squares[rank];
    double *now = Q + (size_t)rank * states, *row = R + (size_t)rank * states;
    for (size_t i = 0; i < states; ++i) now[i] /= size;
    row[w->place[rank]] = 1, w->size[rank] = size;
    for (int q = rank + 1; q < v->columns; ++q) {
      double *restrict other = Q + (size_t)q * states;
      const double share = long_product(states, now, other);
      for (size_t i = 0; i < states; ++i) other[i] -= share * now[i];
      squares[q] = long_product(states, other, other);
      row[w->place[q]] = share / size;
    }
  }
  for (size_t i = 0; i < states; ++i) {
    const double weight = weight_of_state(v, (int)i);
    for (size_t q = 0; q < (size_t)rank; ++q)
      v->phi[i * states + q] = weight > 0 ? w->size[q] * Q[q * states + i] / weight : 0;
  }
  dense_add_product(w->carried, rank, v->columns, 1, w->carry, v->n_states, R, v->n_states, 0, w->next, v->n_states);
  double *before = w->carry;
  w->carry = w->next, w->next = before;
  v->columns = rank;
}

/* phi over intervals first..end-1. */
static hc_status follow_intervals(in_modes *w, int first, int end, bool compressed)
{
  variation *v = &w->v;
  int every = v->n_intervals > PARTS ? v->n_intervals / PARTS : 1, next = first + every;
  hc_status st = HC_OK;
  for (int i = first; i < end && st == HC_OK; ++i) {
    if (variation_is_empty(v, i)) continue;
    variation_start(v, i);
    st = modal_flow_advance(w->modal, v->interval, v->n_slipping, v->slipping, v->boundary[i], variation_end(v, i),
                            v->omega, v->columns, v->phi);
    if (st != HC_OK || !compressed || i + 1 < next) continue;
    const int before = v->columns;
    compress(w);
    if (2 * v->columns > before && before == w->carried) every *= 2; /* hardly anything is lost so soon */
    next += every;
  }
  return st;
}

/* ---- a period from all states ------------------------------------------------------------------------------- */

/* All active states as columns. */
static void begin_with_active(in_modes *w)
{
  variation *v = &w->v;
  const size_t states = (size_t)v->n_states;
  v->columns = v->n_active;
  memset(v->phi, 0, states * states * sizeof *v->phi);
  for (size_t q = 0; q < (size_t)v->n_active; ++q) {
    const size_t state = (size_t)v->active[q];
    v->phi[state * states + q] = 1 / weight_of_state(v, (int)state);
  }
  carry_nothing(w);
}

static hc_status follow_all(in_modes *w)
{
  variation *v = &w->v;
  const size_t states = (size_t)v->n_states;
  variation_enter(v, v->n_intervals - 1);
  begin_with_active(w);
  const hc_status st = follow_intervals(w, 0, v->n_intervals, true);
  for (size_t a = 0; a < (size_t)v->n_active && st == HC_OK; ++a) {
    const double weight = weight_of_state(v, v->active[a]);
    for (size_t q = 0; q < (size_t)v->columns; ++q)
      w->closing[a * states + q] = weight * v->phi[(size_t)v->active[a] * states + q];
  }
  return st;
}

/* ---- a period from the survivors of its first part ------------------------------------------------------------ */

/* The first intervals, as long as FIRST of PARTS. */
static int first_part(const variation *v)
{
  int end = 0;
  while (end < v->n_intervals - 1 && v->boundary[end] - v->boundary[0] < 0.99 * TWO_PI * FIRST / PARTS) ++end;
  return end;
}

/* phi = a basis of what is behind interval end - 1; false where it takes all states. */
static hc_status find_survivors(in_modes *w, int end, bool *found)
{
  variation *v = &w->v;
  const size_t states = (size_t)v->n_states;
  unsigned long long random = 1;
  hc_status st = HC_OK;
  *found = false;
  w->carried = 0;
  for (int columns = MANY_STATES; st == HC_OK && !*found && columns < v->n_active / 2; columns *= 2) {
    variation_enter(v, v->n_intervals - 1);
    memset(v->phi, 0, states * states * sizeof *v->phi);
    for (int a = 0; a < v->n_active; ++a)
      for (int q = 0; q < columns; ++q) {
        random = random * 6364136223846793005ULL + 1442695040888963407ULL;
        v->phi[(size_t)v->active[a] * states + (size_t)q] =
            ((double)(random >> 11) * 0x1p-52 - 1) / weight_of_state(v, v->active[a]);
      }
    v->columns = columns;
    st = follow_intervals(w, 0, end, false);
    if (st == HC_OK) compress(w);
    *found = st == HC_OK && v->columns + SPARE <= columns;
  }
  for (size_t i = 0; i < states && *found; ++i)
    for (size_t q = 0; q < (size_t)v->columns; ++q) v->phi[i * states + q] /= w->size[q];
  return st;
}

/* w->closing[rank][columns] by rows: coordinates of phi, after the first part once more, in basis[rank][states]. */
static hc_status close_period(in_modes *w, int end, int rank, const double *basis)
{
  variation *v = &w->v;
  const size_t states = (size_t)v->n_states, square = (size_t)rank * (size_t)rank;
  workspace own = {0};
  double *turned = workspace_doubles(&own, (size_t)rank * states), *gram = workspace_doubles(&own, square),
         *C = workspace_doubles(&own, square);
  bool *active = workspace_array(&own, states, sizeof *active);
  int *pivot = workspace_array(&own, (size_t)rank, sizeof *pivot);
  hc_status st = own.failed ? HC_NO_MEMORY : HC_OK;
  for (int a = 0; a < v->n_active && st == HC_OK; ++a) active[v->active[a]] = true;
  for (size_t i = 0; i < states && st == HC_OK; ++i)
    if (!active[i]) memset(v->phi + i * states, 0, states * sizeof *v->phi);
  if (st == HC_OK) st = follow_intervals(w, 0, end, false);
  if (st == HC_OK) {
    weigh_columns(v, w->weighted);
    dense_transpose((int)states, rank, basis, turned);
    dense_multiply(rank, rank, (int)states, turned, basis, gram);
    dense_multiply(rank, v->columns, (int)states, turned, w->weighted, C);
    st = dense_factor(rank, gram, pivot);
  }
  if (st == HC_OK) {
    dense_solve(rank, gram, pivot, v->columns, C);
    for (size_t a = 0; a < (size_t)rank; ++a)
      for (size_t q = 0; q < (size_t)v->columns; ++q) w->closing[a * states + q] = C[q * (size_t)rank + a];
  }
  workspace_free(&own);
  return st;
}

/* From phi, a basis of what is behind the first part, which ends with interval end - 1. */
static hc_status follow_survivors(in_modes *w, int end)
{
  variation *v = &w->v;
  const int rank = v->columns;
  double *basis = malloc(((size_t)rank * (size_t)v->n_states + 1) * sizeof *basis);
  if (!basis) return HC_NO_MEMORY;
  carry_nothing(w);
  weigh_columns(v, basis);
  hc_status st = follow_intervals(w, end, v->n_intervals, true);
  if (st == HC_OK) st = close_period(w, end, rank, basis);
  free(basis);
  return st;
}

/* ---- multipliers ------------------------------------------------------------------------------------------ */

/* Step widths for this orbit, from omega and the number of its changes of contact states; they are then made to hold
 * for the states in the middle of each part of the period. */
static hc_status choose_widths(in_modes *w)
{
  variation *v = &w->v;
  hc_status st = HC_OK;
  int changes = 0;
  for (int i = 0; i < v->n_intervals; ++i) changes += !variation_is_empty(v, i);
  modal_flow_begin(w->modal, v->omega, changes - PARTS);
  for (int part = 0, i = 0; part < PARTS && st == HC_OK; ++part) {
    const double th = TWO_PI * (part + 0.5) / PARTS;
    while (!(variation_end(v, i) > th)) ++i;
    variation_enter(v, i);
    st = modal_flow_check(w->modal, v->interval, v->n_slipping, v->slipping, th);
  }
  return st == HC_OK && modal_flow_operations(w->modal) > MONODROMY_MOST_OPERATIONS ? HC_NOT_CONVERGED : st;
}

/* exp(s T) of the roots s of the structure as its contacts hold it on the current interval. */
static hc_status multipliers_of_roots(const in_modes *w, int *count, double complex *lambda)
{
  const hc_status st = modal_flow_roots(w->modal, w->v.interval, lambda);
  *count = 2 * w->v.n;
  for (int i = 0; i < *count && st == HC_OK; ++i) lambda[i] = cexp(lambda[i] * (TWO_PI / w->v.omega));
  return st;
}

static hc_status in_modes_find(void *self, int *count, double complex *lambda)
{
  in_modes *w = self;
  variation *v = &w->v;
  hc_status st = choose_widths(w);
  if (st != HC_OK) return st;
  const bool by_roots = modal_flow_operations_of_roots(w->modal) < modal_flow_operations(w->modal);
  if (by_roots && !w->from_all && variation_never_changes(v)) return multipliers_of_roots(w, count, lambda);
  const int end = first_part(v);
  bool few = false;
  variation_find_states(v, v->n_intervals - 1);
  if (end > 0 && !w->from_all) st = find_survivors(w, end, &few);
  if (st == HC_OK) st = few ? follow_survivors(w, end) : follow_all(w);
  if (st != HC_OK) return st;
  *count = v->columns;
  dense_add_product(*count, *count, w->carried, 1, w->closing, v->n_states, w->carry, v->n_states, 0, w->map, *count);
  return dense_eigen(*count, w->map, lambda, NULL, NULL);
}

const multiplier_method multipliers_in_modes = {in_modes_make, in_modes_free, in_modes_find},
                        multipliers_from_all_states = {in_modes_make_from_all, in_modes_free, in_modes_find};
