/* circle_columns.c - see circle_columns.h. Proof: tests/timeint/test_circle.c. */
#include "timeint/circle_columns.h"

#include <stdlib.h>
#include <string.h>

hc_status circle_columns_make(circle_columns *c, int columns)
{
  const size_t width = (size_t)columns, series = TRACK_TERMS * width;
  double **const arrays[] = {&c->u[0], &c->u[1], &c->v, &c->angle, &c->turned[0], &c->turned[1]};
  const size_t n_arrays = sizeof arrays / sizeof *arrays;
  *c = (circle_columns){.columns = columns};
  if (!(c->numbers = calloc(n_arrays * series + 2 * width, sizeof *c->numbers))) return HC_NO_MEMORY;
  for (size_t i = 0; i < n_arrays; ++i) *arrays[i] = c->numbers + i * series;
  c->pull[0] = c->numbers + n_arrays * series;
  c->pull[1] = c->pull[0] + width;
  return HC_OK;
}

void circle_columns_free(circle_columns *c) { free(c->numbers); }

void circle_columns_begin(circle_columns *c, const circle_series *s, const scaled_contact *law, double h)
{
  double power = 1;
  c->fresh = s->fresh;
  c->h = h;
  c->kt = law->law.kt;
  c->friction = law->law.mu * law->law.kn;
  for (int k = 0; k < TRACK_TERMS; ++k, power *= h) {
    c->limit[k] = s->limit[k] * power;
    c->turn[k] = k < TRACK_ORDER ? s->turn[k] * power : 0;
    c->slide[k] = 0;
    for (int a = 0; a < 2; ++a) {
      c->e[a][k] = s->e[a][k] * power;
      c->rate[a][k] = s->rate[a][k] * power;
      for (int i = 0; i <= k; ++i) c->slide[k] += s->e[a][i] * s->rate[a][k - i] * power;
    }
  }
}

static double *term(double *series, const circle_columns *c, int k) { return series + (size_t)k * (size_t)c->columns; }

static void add(int width, double by, const double *restrict x, double *restrict sum)
{
  for (int q = 0; q < width; ++q) sum[q] += by * x[q];
}

/* sum += kt (dU'.e_perp)_k */
static void add_across(const circle_columns *c, int width, int k, double *sum)
{
  for (int i = 0; i <= k; ++i) {
    const double by = c->kt * (i + 1) / c->h;
    add(width, -by * c->e[1][k - i], term(c->u[0], c, i + 1), sum);
    add(width, by * c->e[0][k - i], term(c->u[1], c, i + 1), sum);
  }
}

/* sum -= (q d(mu N))_k + kt (U'.e dphi)_k with dphi up to `known`. */
static void subtract_rest(const circle_columns *c, int width, int k, int known, double *sum)
{
  for (int i = 0; i <= k; ++i) add(width, -c->turn[k - i] * c->friction, term(c->v, c, i), sum);
  for (int i = 0; i <= known; ++i) add(width, -c->kt * c->slide[k - i], term(c->angle, c, i), sum);
}

/* sum -= (mu N dphi')_k without its `without` first terms of mu N. */
static void subtract_turn(const circle_columns *c, int width, int k, int without, double *sum)
{
  for (int i = without; i <= k; ++i) add(width, -c->limit[i] * (k - i + 1) / c->h, term(c->angle, c, k - i + 1), sum);
}

/* dphi_k */
static void find_angle(circle_columns *c, int width, int k)
{
  double *angle = term(c->angle, c, k);
  if (k == 0 && !c->fresh) return;
  memset(angle, 0, (size_t)width * sizeof *angle);
  const int order = c->fresh ? k : k - 1; /* of the equation that tells it */
  const double by = c->fresh ? (k > 0 ? k * c->limit[1] / c->h : 0) + c->kt * c->slide[0] : k * c->limit[0] / c->h;
  add_across(c, width, order, angle);
  subtract_rest(c, width, order, k - 1, angle);
  subtract_turn(c, width, order, c->fresh ? 2 : 1, angle);
  for (int q = 0; q < width; ++q) angle[q] /= by;
}

void circle_columns_term(circle_columns *c, int width, int k)
{
  find_angle(c, width, k);
  for (int a = 0; a < 2; ++a) {
    double *turned = term(c->turned[a], c, k), *pull = c->pull[a];
    const double *other = c->e[1 - a], sign = a == 0 ? -1 : 1;
    memset(turned, 0, (size_t)width * sizeof *turned);
    memset(pull, 0, (size_t)width * sizeof *pull);
    for (int i = 0; i <= k; ++i) add(width, sign * other[k - i], term(c->angle, c, i), turned);
    for (int i = 0; i <= k; ++i) {
      add(width, c->friction * c->e[a][k - i], term(c->v, c, i), pull);
      add(width, c->limit[k - i], term(c->turned[a], c, i), pull);
    }
  }
}

void circle_columns_end(const circle_columns *c, int width, int k, double *angle)
{
  memset(angle, 0, (size_t)width * sizeof *angle);
  for (int i = 0; i <= k; ++i) add(width, 1, term(c->angle, c, i), angle);
}
