/* planar_series.c - see planar_series.h. Proof: tests/timeint/test_circle.c. */
#include "timeint/closed_form/planar_series.h"

#include <float.h>
#include <string.h>

#include "numerics/wide_vectors.h"

void planar_series_begin(planar_series *s, int j, const contact_track t[2], const double *u, const double *v)
{
  s->contact = j;
  s->fresh = t->fresh;
  s->u[0] = u;
  s->u[1] = u + TRACK_TERMS;
  s->v = v;
  s->e[0][0] = t[0].along;
  s->e[1][0] = t[1].along;
}

/* Contributions of coefficients before e_k and q_{k-1}, computed in one pass. */
typedef struct sums {
  double across, held; /* to (U'.e_perp)_m and (mu N q)_m, m = k if fresh, else k - 1 */
  double turned[2];    /* to (q e)_{k-1} */
  double pull[2];      /* to (mu N e)_k */
} sums;

static sums sums_before(const planar_series *s, int k)
{
  const int later = s->fresh;
  const double *e0 = s->e[0], *e1 = s->e[1], *r0 = s->rate[0] + later, *r1 = s->rate[1] + later;
  sums sum = {0};
  for (int i = 0, j = k - 1; i < k; ++i, --j) {
    const double q = s->turn[i], limit = s->limit[i + 1]; /* q_{k-1}: 0 as yet */
    sum.across += e0[i] * r1[j] - e1[i] * r0[j];
    sum.held += q * s->limit[j + later];
    sum.turned[0] += q * e0[j];
    sum.turned[1] += q * e1[j];
    sum.pull[0] += limit * e0[j];
    sum.pull[1] += limit * e1[j];
  }
  return sum;
}

/* q_{k-1} and e_k. */
static void turn(planar_series *s, double kt, int k, const sums *before)
{
  double q;
  if (s->fresh) { /* U'.e_perp has e_k in it, and so q_{k-1} */
    const double size = s->rate[0][0] * s->e[0][0] + s->rate[1][0] * s->e[1][0];
    const double slide = s->rate[0][0] * before->turned[0] + s->rate[1][0] * before->turned[1];
    q = (kt * (before->across - slide / k) - before->held) / (s->limit[1] + kt * size / k);
  } else q = (kt * before->across - before->held) / s->limit[0];
  s->turn[k - 1] = q;
  s->e[0][k] = -(before->turned[1] + q * s->e[1][0]) / k;
  s->e[1][k] = (before->turned[0] + q * s->e[0][0]) / k;
}

void planar_series_next(planar_series *s, const scaled_contact *c, int k, double pull[2])
{
  const law_regularised *law = &c->law;
  const double friction = law->mu * law->kn;
  s->limit[k] = friction * s->v[k];
  if (k == 0) s->limit[0] = s->fresh ? 0 : contact_track_limit(c, s->v[0]);
  for (int a = 0; a < 2; ++a) s->rate[a][k] = k + 1 < TRACK_TERMS ? (k + 1) * s->u[a][k + 1] : 0;
  if (k > 0) s->turn[k - 1] = 0;
  const sums before = sums_before(s, k);
  if (k > 0 && s->fresh && k + 1 == TRACK_TERMS) s->e[0][k] = s->e[1][k] = 0;
  else if (k > 0) turn(s, law->kt, k, &before);
  for (int a = 0; a < 2; ++a) pull[a] = before.pull[a] + s->limit[0] * s->e[a][k];
}

double planar_series_reach(const planar_series *s)
{
  double tau = INFINITY;
  for (int k = TRACK_ORDER - 2; k < TRACK_ORDER; ++k) {
    const double term = hypot(s->e[0][k], s->e[1][k]);
    if (isnan(term)) return 0;
    if (term > 0) tau = fmin(tau, pow(0.25 * DBL_EPSILON / term, 1.0 / k));
  }
  return tau;
}

void planar_series_direction(const planar_series *s, double tau, double e[2])
{
  for (int a = 0; a < 2; ++a) {
    e[a] = 0;
    for (int k = TRACK_TERMS; k-- > 0;) e[a] = e[a] * tau + s->e[a][k];
  }
  const double size = hypot(e[0], e[1]);
  e[0] /= size, e[1] /= size;
}

void planar_series_guard(const planar_series *s, const scaled_contact *c, double *g)
{
  for (int k = 0; k < TRACK_ORDER; ++k) {
    double slide = 0;
    for (int i = 0; i <= k; ++i) slide += s->e[0][i] * s->rate[0][k - i] + s->e[1][i] * s->rate[1][k - i];
    g[k] = c->law.kt * slide - (k + 1) * s->limit[k + 1];
  }
  g[TRACK_ORDER] = 0;
}

/* ---- variations ---------------------------------------------------------------------------------------- */

void planar_columns_make(planar_columns *c, int columns, workspace *memory)
{
  double **const series[] = {&c->u[0], &c->u[1], &c->v, &c->angle},
                 **const rows[] = {&c->pull[0], &c->pull[1], &c->sum};
  *c = (planar_columns){.columns = columns};
  for (size_t i = 0; i < 4; ++i) *series[i] = workspace_doubles(memory, TRACK_TERMS * (size_t)columns);
  for (size_t i = 0; i < 3; ++i) *rows[i] = workspace_doubles(memory, (size_t)columns);
}

void planar_columns_begin(planar_columns *c, const planar_series *s, const scaled_contact *law, double h)
{
  double power = 1;
  c->fresh = s->fresh;
  c->h = h;
  c->kt = law->law.kt;
  c->friction = law->law.mu * law->law.kn;
  for (int k = 0; k < TRACK_TERMS; ++k, power *= h) {
    c->limit[k] = s->limit[k] * power;
    c->turn[k] = k < TRACK_ORDER ? s->turn[k] * power : 0;
    c->slide[k] = c->across[0][k] = c->across[1][k] = 0;
    for (int a = 0; a < 2; ++a) {
      c->e[a][k] = s->e[a][k] * power;
      for (int i = 0; i <= k; ++i) {
        c->slide[k] += s->e[a][i] * s->rate[a][k - i] * power;
        c->across[1 - a][k] += (a == 0 ? 1 : -1) * s->e[a][i] * s->limit[k - i] * power;
      }
    }
  }
}

static double *term(double *series, const planar_columns *c, int k) { return series + (size_t)k * (size_t)c->columns; }

/* sum += by_x x + by_y y */
WIDE_VECTORS static void add(int width, double by_x, const double *restrict x, double by_y, const double *restrict y,
                             double *restrict sum)
{
  for (int q = 0; q < width; ++q) sum[q] += by_x * x[q] + by_y * y[q];
}

/* dphi_k */
static void find_angle(planar_columns *c, int width, int k)
{
  double *angle = term(c->angle, c, k);
  if (k == 0 && !c->fresh) return;
  const int order = c->fresh ? k : k - 1; /* order of the equation that determines dphi_k */
  const double by = c->fresh ? (k > 0 ? k * c->limit[1] / c->h : 0) + c->kt * c->slide[0] : k * c->limit[0] / c->h;
  double *sum = c->sum;
  memset(sum, 0, (size_t)width * sizeof *sum);
  /* sum += kt (dU'.e_perp)_k */
  for (int i = 0; i <= order; ++i) {
    const double factor = c->kt * (i + 1) / c->h;
    add(width, -factor * c->e[1][order - i], term(c->u[0], c, i + 1), factor * c->e[0][order - i],
        term(c->u[1], c, i + 1), sum);
  }
  /* sum -= (q d(mu N))_k + (kt U'.e dphi + mu N dphi')_k with dphi up to `known`. */
  const int known = k - 1;
  for (int i = 0; i <= order; ++i) {
    const double *of_angle = term(i <= known ? c->angle : c->v, c, i);
    const double factor =
        i <= known ? -c->kt * c->slide[order - i] - (i > 0 ? c->limit[order + 1 - i] * i / c->h : 0) : 0;
    add(width, -c->turn[order - i] * c->friction, term(c->v, c, i), factor, of_angle, sum);
  }
  for (int q = 0; q < width; ++q) angle[q] = sum[q] / by;
}

void planar_columns_term(planar_columns *c, int width, int k)
{
  find_angle(c, width, k);
  for (int a = 0; a < 2; ++a) {
    double *pull = c->pull[a];
    memset(pull, 0, (size_t)width * sizeof *pull);
    for (int i = 0; i <= k; ++i)
      add(width, c->friction * c->e[a][k - i], term(c->v, c, i), c->across[a][k - i], term(c->angle, c, i), pull);
  }
}

void planar_columns_end(const planar_columns *c, int width, int k, double *angle)
{
  memset(angle, 0, (size_t)width * sizeof *angle);
  for (int i = 0; i <= k; ++i)
    for (int q = 0; q < width; ++q) angle[q] += term(c->angle, c, i)[q];
}
