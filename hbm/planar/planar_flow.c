/* planar_flow.c - see planar_flow.h. Unknown are the accelerations x'' and y' at the points of a step, [n + slipping]
 * of each: x', x and y follow by one or two integrations with the collocation's weights. */
#include "hbm/planar/planar_flow.h"

#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

enum { N = COLLOCATION_POINTS };

/* A slipping planar contact at one point of a step. */
typedef struct weighted_state {
  planar_state is;
  double weight; /* factor that scales its equation: 1/(R + s h) [1/length] */
} weighted_state;

struct planar_flow {
  const model *m;
  int n, n_states;
  collocation c;
  double twice[N][N];   /* square of the collocation's a: from accelerations to positions */
  double *K, *C;        /* [n][n] by columns: K_j of the interval; C of the model */
  double *K_at, *C_at;  /* [N][n][n] the same at the points of a step, with the derivatives of smooth laws */
  planar_bends *bends;  /* callback for smooth contacts; NULL: none */
  const void *orbit;    /* argument of bends */
  double *matrix;       /* [N (n + planar)]^2 by columns: collocation equations of a step */
  int *pivot;           /* [N (n + planar)] */
  double *right;        /* [n_states][N (n + planar)] for each column of phi the right side, then the accelerations */
  double *now;          /* [2 n + n_contacts] current column of phi */
  weighted_state *at;   /* [planar][N] */
  double *along, *perp; /* [planar][N][n] t.e and t.e_perp */
  workspace memory;     /* of all of these */
};

hc_status planar_flow_new(const model *m, planar_flow **out)
{
  const size_t n = (size_t)m->n, planar = (size_t)m->n_contacts / 2 + 1, unknowns = N * (n + planar);
  planar_flow *f = calloc(1, sizeof *f);
  *out = NULL;
  if (!f) return HC_NO_MEMORY;
  f->m = m;
  f->n = m->n;
  f->n_states = 2 * m->n + m->n_contacts;
  f->K = workspace_array(&f->memory, 2 * (N + 1) * n * n, sizeof *f->K);
  f->matrix = workspace_array(&f->memory, unknowns * unknowns, sizeof *f->matrix);
  f->pivot = workspace_array(&f->memory, unknowns, sizeof *f->pivot);
  f->right = workspace_array(&f->memory, (size_t)f->n_states * unknowns, sizeof *f->right);
  f->now = workspace_array(&f->memory, (size_t)f->n_states, sizeof *f->now);
  f->at = workspace_array(&f->memory, planar * N, sizeof *f->at);
  f->along = workspace_array(&f->memory, planar * N * n, sizeof *f->along);
  f->perp = workspace_array(&f->memory, planar * N * n, sizeof *f->perp);
  collocation_fill(&f->c);
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j)
      for (int k = 0; k < N; ++k) f->twice[i][j] += f->c.a[i][k] * f->c.a[k][j];
  if (!f->memory.failed) {
    f->C = f->K + n * n, f->K_at = f->C + n * n, f->C_at = f->K_at + N * n * n;
    memcpy(f->C, m->damping, n * n * sizeof *f->C);
    *out = f;
    return HC_OK;
  }
  planar_flow_free(f);
  return HC_NO_MEMORY;
}

void planar_flow_free(planar_flow *f)
{
  if (!f) return;
  workspace_free(&f->memory);
  free(f);
}

void planar_flow_bend(planar_flow *f, planar_bends *bends, const void *self) { f->bends = bends, f->orbit = self; }

/* ---- a step ------------------------------------------------------------------------------------------ */

/* Shift, 0 or 2 pi, of the angle th of the period into the interval. */
static double shift_to(const planar_interval *p, double th) { return th >= p->from && th < p->to ? 0 : TWO_PI; }

/* The panel that covers th. */
static const planar_panel *panel_at(const planar_slipping *s, double th)
{
  const planar_panel *p = s->cycle->slip.panel + s->interval->panel, *last = p + s->interval->n_panels - 1;
  while (p < last && th >= p->to) ++p;
  return p;
}

double planar_slipping_step(int n_slipping, const planar_slipping *slipping, double th, double to, double width)
{
  const double rounding = 1e-13;
  double end = th + width < to ? th + width : to;
  for (int k = 0; k < n_slipping; ++k) {
    const double shift = shift_to(slipping[k].interval, 0.5 * (th + end));
    const planar_panel *p = panel_at(&slipping[k], th + shift + rounding);
    if (p->to - shift > th + rounding && p->to - shift < end) end = p->to - shift;
  }
  return end;
}

planar_state planar_slipping_at(const collocation *c, const planar_slipping *s, double th, double middle, double omega)
{
  const double shift = shift_to(s->interval, middle);
  const planar_panel *panel = panel_at(s, middle + shift);
  const double phi = planar_panel_angle(c, panel, th + shift);
  const planar_point p = planar_motion_at(s->cycle->m, th + shift);
  planar_state a = {.e = {cos(phi), sin(phi)}, .R = fmax(0, p.R)};
  a.turning = omega * planar_slip_slope(s->cycle->m, &p, phi);
  a.speed = omega * fmax(0, planar_slip_speed(&p, phi));
  return a;
}

/* Derivatives of smooth contact j; false if it is not smooth, or separated. */
static bool bends(const planar_flow *f, const contact_interval *const *interval, int j, double th, double omega,
                  contact_slopes *out)
{
  const bool touches = interval[j] || contact_never_opens(&f->m->contacts[j].law);
  return touches && f->bends(f->orbit, j, th, omega, out);
}

/* K and C at the points of a step. */
static void fill_slopes(planar_flow *f, const contact_interval *const *interval, double from, double to, double omega)
{
  const size_t square = (size_t)f->n * (size_t)f->n;
  for (size_t i = 0; i < N; ++i) {
    double *K = f->K_at + i * square, *C = f->C_at + i * square;
    memcpy(K, f->K, square * sizeof *K);
    memcpy(C, f->C, square * sizeof *C);
    for (int j = 0; j < f->m->n_contacts && f->bends; ++j) {
      const model_contact *c = &f->m->contacts[j];
      contact_slopes at;
      if (!bends(f, interval, j, from + (to - from) * f->c.x[i], omega, &at)) continue;
      add_outer(f->n, at.n_v, c->normal, c->normal, K);
      add_outer(f->n, at.t_v, c->tangent, c->normal, K);
      add_outer(f->n, at.t_du, c->tangent, c->tangent, C);
    }
  }
}

static void fill_states(planar_flow *f, int n_slipping, const planar_slipping *slipping, double from, double to,
                        double omega)
{
  const size_t n = (size_t)f->n;
  const double middle = 0.5 * (from + to), h = (to - from) / omega;
  for (int k = 0; k < n_slipping; ++k) {
    const planar_slipping *s = &slipping[k];
    const double *t[2] = {f->m->contacts[s->contact].tangent, f->m->contacts[s->contact + 1].tangent};
    for (int i = 0; i < N; ++i) {
      const planar_state a = planar_slipping_at(&f->c, s, from + (to - from) * f->c.x[i], middle, omega);
      f->at[k * N + i] = (weighted_state){a, 1 / (a.R + a.speed * h)};
      double *along = f->along + (size_t)(k * N + i) * n, *perp = f->perp + (size_t)(k * N + i) * n;
      for (size_t q = 0; q < n; ++q) {
        along[q] = t[0][q] * a.e[0] + t[1][q] * a.e[1];
        perp[q] = t[1][q] * a.e[0] - t[0][q] * a.e[1];
      }
    }
  }
}

/* dR/dv of a slipping contact. */
static double radius_by_v(const planar_flow *f, const planar_slipping *s)
{
  const contact *law = &f->m->contacts[s->contact].law;
  return law->mu * law->kn / law->kt;
}

/* Block (i, j) of the matrix: coefficients of the accelerations at point j in the structure's equations at point i. */
static void fill_motion_block(planar_flow *f, int n_slipping, const planar_slipping *slipping, double h, int i, int j)
{
  const size_t n = (size_t)f->n, of_point = n + (size_t)n_slipping, ld = N * of_point;
  const double once = h * f->c.a[i][j], twice = h * h * f->twice[i][j];
  const double *K = f->K_at + (size_t)i * n * n, *C = f->C_at + (size_t)i * n * n;
  double *block = f->matrix + (size_t)j * of_point * ld + (size_t)i * of_point;
  for (size_t q = 0; q < n; ++q)
    for (size_t r = 0; r < n; ++r)
      block[q * ld + r] = (i == j) * f->m->mass[q * n + r] + once * C[q * n + r] + twice * K[q * n + r];
  for (int k = 0; k < n_slipping; ++k) {
    const model_contact *c = &f->m->contacts[slipping[k].contact];
    const double *along = f->along + (size_t)(k * N + i) * n, *perp = f->perp + (size_t)(k * N + i) * n,
                 by_v = c->law.kt * radius_by_v(f, &slipping[k]);
    for (size_t q = 0; q < n; ++q)
      for (size_t r = 0; r < n && by_v * c->normal[q] != 0; ++r)
        block[q * ld + r] += twice * by_v * along[r] * c->normal[q];
    for (size_t r = 0; r < n; ++r) block[(n + (size_t)k) * ld + r] = once * c->law.kt * perp[r];
  }
}

/* Right sides at every point for the column in f->now, into to[N][n + n_slipping]. */
static void fill_right(const planar_flow *f, const contact_interval *const *interval, int n_slipping,
                       const planar_slipping *slipping, double h, double *to)
{
  const int n = f->n;
  const model *m = f->m;
  const double *x = f->now, *v = x + n, *state = v + n;
  for (int i = 0; i < N; ++i) {
    double *right = to + (size_t)i * (size_t)(n + n_slipping);
    const double t = h * f->c.x[i], *K = f->K_at + (size_t)(i * n * n), *C = f->C_at + (size_t)(i * n * n);
    for (int r = 0; r < n; ++r) right[r] = 0;
    for (int q = 0; q < n; ++q)
      for (int r = 0; r < n; ++r) {
        const size_t at = (size_t)q * (size_t)n + (size_t)r;
        right[r] -= C[at] * v[q] + K[at] * (x[q] + t * v[q]);
      }
    for (int j = 0; j < m->n_contacts; ++j)
      for (int r = 0; r < n && contact_interval_holds(&m->contacts[j].law, interval[j]); ++r)
        right[r] += m->contacts[j].tangent[r] * state[j];
    for (int k = 0; k < n_slipping; ++k) {
      const model_contact *c = &m->contacts[slipping[k].contact];
      const double weight = f->at[k * N + i].weight;
      const planar_state *a = &f->at[k * N + i].is;
      const double *along = f->along + (size_t)((k * N + i) * n), *perp = f->perp + (size_t)((k * N + i) * n);
      const double dR =
          radius_by_v(f, &slipping[k]) * (dot_product(n, c->normal, x) + t * dot_product(n, c->normal, v));
      const double y = state[slipping[k].contact];
      for (int r = 0; r < n; ++r) right[r] -= c->law.kt * (along[r] * dR + perp[r] * y);
      right[n + k] = weight * (a->R * (dot_product(n, perp, v) - a->turning * dR) - a->speed * y);
    }
  }
}

static void load_column(planar_flow *f, const double *phi, size_t q)
{
  for (size_t i = 0; i < (size_t)f->n_states; ++i) f->now[i] = phi[i * (size_t)f->n_states + q];
}

static hc_status advance_step(planar_flow *f, const contact_interval *const *interval, int n_slipping,
                              const planar_slipping *slipping, double from, double to, double omega, int columns,
                              double *phi)
{
  const size_t states = (size_t)f->n_states;
  const int unknowns = N * (f->n + n_slipping);
  const double h = (to - from) / omega;
  fill_states(f, n_slipping, slipping, from, to, omega);
  fill_slopes(f, interval, from, to, omega);
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      fill_motion_block(f, n_slipping, slipping, h, i, j);
      /* The rows of the slip equations in that block. */
      const size_t n = (size_t)f->n, of_point = n + (size_t)n_slipping, ld = N * of_point;
      const double once = h * f->c.a[i][j], twice = h * h * f->twice[i][j];
      for (int k = 0; k < n_slipping; ++k) {
        const double weight = f->at[k * N + i].weight;
        const planar_state *a = &f->at[k * N + i].is;
        const double *perp = f->perp + (size_t)(k * N + i) * n, *normal = f->m->contacts[slipping[k].contact].normal;
        const double by_v = a->turning * radius_by_v(f, &slipping[k]);
        double *row = f->matrix + (size_t)j * of_point * ld + (size_t)i * of_point + n + (size_t)k;
        for (size_t q = 0; q < n; ++q) row[q * ld] = weight * a->R * (twice * by_v * normal[q] - once * perp[q]);
        for (int l = 0; l < n_slipping; ++l) row[(n + (size_t)l) * ld] = 0;
        row[(n + (size_t)k) * ld] = weight * ((i == j) * a->R + once * a->speed);
      }
    }
  if (dense_factor(unknowns, f->matrix, f->pivot) != HC_OK) return HC_SINGULAR;
  for (size_t q = 0; q < (size_t)columns; ++q) {
    load_column(f, phi, q);
    fill_right(f, interval, n_slipping, slipping, h, f->right + q * (size_t)unknowns);
  }
  dense_solve(unknowns, f->matrix, f->pivot, columns, f->right);
  for (size_t q = 0; q < (size_t)columns; ++q) {
    load_column(f, phi, q);
    /* The column in f->now at the end of the step, from its accelerations. */
    const double *acceleration = f->right + q * (size_t)unknowns;
    const int n = f->n, of_point = n + n_slipping;
    double *x = f->now, *v = x + n, *state = v + n;
    for (int r = 0; r < n; ++r) {
      double once = 0, twice = 0;
      for (int j = 0; j < N; ++j) {
        once += f->c.a[N - 1][j] * acceleration[j * of_point + r];
        twice += f->twice[N - 1][j] * acceleration[j * of_point + r];
      }
      x[r] += h * v[r] + h * h * twice;
      v[r] += h * once;
    }
    for (int k = 0; k < n_slipping; ++k)
      for (int j = 0; j < N; ++j)
        state[slipping[k].contact] += h * f->c.a[N - 1][j] * acceleration[j * of_point + n + k];
    for (size_t i = 0; i < states; ++i) phi[i * states + q] = f->now[i];
  }
  return isfinite(phi[0]) ? HC_OK : HC_NOT_FINITE;
}

hc_status planar_flow_advance(planar_flow *f, const contact_interval *const *interval, int n_slipping,
                              const planar_slipping *slipping, double from, double to, double omega, int columns,
                              double *phi)
{
  const double turns_a_step = f->bends ? 2 : 3; /* [rad] of the highest frequency per step; less with varying
                                                   stiffness */
  const model *m = f->m;
  memcpy(f->K, m->stiffness, (size_t)f->n * (size_t)f->n * sizeof *f->K);
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    if (!interval[j]) continue;
    add_outer(f->n, c->law.kn, c->normal, c->normal, f->K);
    add_outer(f->n, contact_interval_stiffness(&c->law, interval[j]), c->tangent,
              contact_slip_sign(interval[j]->state) ? c->normal : c->tangent, f->K);
  }
  for (int k = 0; k < n_slipping; ++k) { /* kn of both halves */
    const model_contact *c = &m->contacts[slipping[k].contact];
    add_outer(f->n, 2 * c->law.kn, c->normal, c->normal, f->K);
  }
  /* [1/time^2] Estimated bound of the squared frequencies of K_j and M: the largest row sum of |K| over the row's
   * diagonal dominance in M, but at least a tenth of its diagonal. */
  double most = 0;
  for (int i = 0; i < f->n; ++i) {
    double k = 0, mass = 2 * f->m->mass[(size_t)i * (size_t)(f->n + 1)];
    for (int j = 0; j < f->n; ++j) {
      k += fabs(f->K[(size_t)j * (size_t)f->n + (size_t)i]);
      mass -= fabs(f->m->mass[(size_t)j * (size_t)f->n + (size_t)i]);
    }
    const double least = 0.1 * f->m->mass[(size_t)i * (size_t)(f->n + 1)];
    most = fmax(most, k / fmax(mass, least));
  }
  for (int k = 0; k < f->m->n_contacts; ++k) { /* kt of planar contacts is not in K */
    const model_contact *c = &f->m->contacts[k];
    for (int i = 0; i < f->n; ++i)
      most = fmax(most, 2 * c->law.kt * fabs(c->tangent[i]) / f->m->mass[(size_t)i * (size_t)(f->n + 1)]);
  }
  hc_status st = HC_OK;
  for (double at = from; at < to && st == HC_OK;) {
    double width = turns_a_step * omega / sqrt(most);
    for (int look = 0; look < 5 && f->bends; ++look) { /* stiffnesses at five places of the step */
      const double there = at + 0.25 * look * width;
      double stiffest = most;
      for (int j = 0; j < m->n_contacts; ++j) {
        contact_slopes slopes;
        if (!bends(f, interval, j, there, omega, &slopes)) continue;
        for (int i = 0; i < f->n; ++i)
          stiffest += fabs(slopes.n_v) * m->contacts[j].normal[i] * m->contacts[j].normal[i] /
                      m->mass[(size_t)i * (size_t)(f->n + 1)];
        width = fmin(fmin(width, slopes.step), turns_a_step * omega / sqrt(stiffest));
      }
    }
    const double end = planar_slipping_step(n_slipping, slipping, at, to, width);
    st = advance_step(f, interval, n_slipping, slipping, at, end, omega, columns, phi);
    at = end;
  }
  return st;
}
