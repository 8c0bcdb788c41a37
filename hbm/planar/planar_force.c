/* planar_force.c - see planar_force.h. Forces are computed as lengths, u - w and R e, and multiplied by kt at the end.
 *
 * Derivatives of the slider's position are rows: d w (two rows) while it sticks, d phi while it slips; columns are the
 * derivatives by X, and two by w0 = w(0). On the closed orbit w(2 pi) = w0, d w0 = (1 - A)^-1 B dX with A, B the
 * derivatives of the pass; the last two columns are then eliminated. */
#include "hbm/planar/planar_force.h"

#include <string.h>

#include "hbm/contact/exact_force.h"
#include "hbm/contact/force_jacobian.h"
#include "hbm/contact/interval_series.h"
#include "numerics/base/constants.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/rotate.h"
#include "numerics/wide_vectors.h"

enum { N = COLLOCATION_POINTS };

struct planar_force {
  int n_harm, n_dof, n_coef, n_size; /* n_size = n_dof n_coef */
  int n_col;                         /* n_size + 2 */
  contact law;                       /* of both halves together */
  exact_force *normal;               /* gives N - N0 and the intervals of contact; NULL if N is constant */
  double *F_normal, *jac_normal;     /* [n_coef], [n_coef]^2 */
  double start[2];                   /* [length] where the slider was asked to begin: u is counted from there */
  double *X;                         /* [n_size] so counted, of the last evaluation, to which `motion` points */
  planar_motion motion;
  double *table; /* of series_grid_table_fill */
  planar_point grid[PLANAR_GRID];
  collocation rule;
  planar_contact *contact; /* [cap] */
  planar_cycle cycle;
  contact_interval *intervals;         /* [cycle.cap] the cycle's intervals in the form of contact_evaluator.h */
  double *indicator, *symbol, *weight; /* [4H+1] Fourier series of an interval's indicator; of all stick intervals;
                                          [2H+1] interval_series_weights */
  double *F;                           /* [2][n_coef] [length] harmonics of T/kt */
  double *by;                          /* [2][n_coef][n_col] its derivatives */
  double *dw[2], *dphi;                /* [n_col] */
  double *node;                        /* [3][N][n_col] d phi at the points of a panel; weighted d(R e) there (2) */
  double *matrix;                      /* [n_coef]^2 dT/du of stick, over kt */
  double *base, *rate;                 /* [N][n_coef] 1, cos, sin at the points, and their derivatives */
  double *test;                        /* [n_coef][N] test functions of the integrals: 1/2, cos, sin */
  workspace memory;                    /* of all of these */
};

/* ---- rows of derivatives [n_col]: by the columns of X and by w0 ---------------------------------------- */

/* 1, cos, sin .. of h th; and their derivatives by th. [n_coef] */
static void fill_base(int n_harm, double th, double *base, double *rate)
{
  const double c = cos(th), s = sin(th);
  double ch = 1, sh = 0;
  base[0] = 1, rate[0] = 0;
  for (int h = 1; h <= n_harm; ++h) {
    series_turn(c, s, &ch, &sh);
    base[2 * h - 1] = ch, base[2 * h] = sh;
    rate[2 * h - 1] = -h * sh, rate[2 * h] = h * ch;
  }
}

/* to += derivatives by X of a u_1 + b u_2 + c v at the angle of `base` (with `rate`: of their derivatives by th). */
static void add_motion(const planar_force *f, const double *base, double a, double b, double c, double *to)
{
  const int L = f->n_coef;
  for (int i = 0; i < L; ++i) to[i] += a * base[i];
  for (int i = 0; i < L; ++i) to[L + i] += b * base[i];
  for (int i = 0; i < L && f->n_dof == 3; ++i) to[2 * L + i] += c * base[i];
}

static void clear_row(const planar_force *f, double *row) { memset(row, 0, (size_t)f->n_col * sizeof *row); }

/* Slip begins: d phi = e_perp.(du - dw)/length, u - w having this length and the direction phi. */
static void begin_slip(planar_force *f, const double *base, double phi, double length)
{
  const double a = -sin(phi) / length, b = cos(phi) / length;
  for (int i = 0; i < f->n_col; ++i) f->dphi[i] = -a * f->dw[0][i] - b * f->dw[1][i];
  add_motion(f, base, a, b, 0, f->dphi);
}

/* From slip in direction phi into rest: d w = du - dR e - R e_perp d phi. */
static void come_to_rest(planar_force *f, const double *base, double phi, double R)
{
  const double cosine = cos(phi), sine = sin(phi), per_v = f->motion.per_v;
  for (int i = 0; i < f->n_col; ++i) {
    f->dw[0][i] = R * sine * f->dphi[i];
    f->dw[1][i] = -R * cosine * f->dphi[i];
  }
  add_motion(f, base, 1, 0, -per_v * cosine, f->dw[0]);
  add_motion(f, base, 0, 1, -per_v * sine, f->dw[1]);
}

/* Contact begins at an angle that changes by -dR/R'. */
static void begin_contact(planar_force *f, const planar_interval *p, const planar_point *at, const double *base,
                          const double *rate)
{
  const double per_v = f->motion.per_v;
  if (p->state == CONTACT_STICK) {
    const double moved = at->dR > 0 ? -per_v / at->dR : 0;
    clear_row(f, f->dw[0]);
    clear_row(f, f->dw[1]);
    add_motion(f, base, 1, 0, moved * at->du[0], f->dw[0]);
    add_motion(f, base, 0, 1, moved * at->du[1], f->dw[1]);
    return;
  }
  const double phi = f->cycle.slip.panel[p->panel].phi0, speed = hypot(at->du[0], at->du[1]);
  clear_row(f, f->dphi);
  add_motion(f, rate, -sin(phi) / speed, cos(phi) / speed, 0, f->dphi);
  add_motion(f, base, 0, 0, -planar_slip_slope(&f->motion, at, phi) * per_v / speed, f->dphi);
}

/* From w0 at th = 0, with derivatives in dw, to the slider moved into the circle. */
static void begin_period(planar_force *f, const planar_interval *p, const planar_point *at, const double *base)
{
  const double t1 = at->u[0] - f->cycle.start[0], t2 = at->u[1] - f->cycle.start[1], length = hypot(t1, t2),
               phi = atan2(t2, t1);
  const bool slips = p->state != CONTACT_STICK;
  if (!slips && !(length > at->R)) return;
  begin_slip(f, base, phi, length);
  if (!slips) come_to_rest(f, base, phi, at->R);
}

/* Carries the derivatives into interval i, in dw or dphi; sets base and rate at its start. */
static void begin_interval(planar_force *f, int i, double *base, double *rate)
{
  const planar_cycle *c = &f->cycle;
  const planar_interval *p = &c->interval[i], *before = p - 1;
  const planar_point at = planar_motion_at(&f->motion, p->from);
  fill_base(f->n_harm, p->from, base, rate);
  if (p->begin == PLANAR_TOUCHES) begin_contact(f, p, &at, base, rate);
  else if (p->begin == PLANAR_STARTS) begin_period(f, p, &at, base);
  else if (p->state == before->state) return; /* stick continues; the slider changed by rounding only */
  else if (p->state == CONTACT_STICK)
    come_to_rest(f, base, c->slip.panel[before->panel + before->n_panels - 1].phi[N - 1], at.R);
  else begin_slip(f, base, c->slip.panel[p->panel].phi0, at.R);
}

/* ---- a panel of slip ------------------------------------------------------------------------------- */

typedef struct slip_points {
  double weight[N]; /* width a[last][i]/pi: weights of the Fourier integrals */
  double cosine[N], sine[N], R[N], pull[N];
} slip_points;

/* 1, cos, sin .. and their rates at the points of a panel, [N][n_coef]. */
static void fill_bases(planar_force *f, const planar_panel *p)
{
  const size_t L = (size_t)f->n_coef;
  const double width = p->to - p->from, middle = p->from + 0.5 * width;
  double x[N], c[N], s[N], ch[N], sh[N];
  for (int i = 0; i < N; ++i) x[i] = width * (f->rule.x[i] - 0.5);
  rotate(N, cos(middle), sin(middle), x, c, s);
  for (size_t i = 0; i < N; ++i) ch[i] = 1, sh[i] = 0, f->base[i * L] = 1, f->rate[i * L] = 0;
  for (size_t h = 1; h <= (size_t)f->n_harm; ++h) {
    for (int i = 0; i < N; ++i) series_turn(c[i], s[i], &ch[i], &sh[i]);
    for (size_t i = 0; i < N; ++i) {
      double *base = f->base + i * L + 2 * h, *rate = f->rate + i * L + 2 * h;
      base[-1] = ch[i], base[0] = sh[i];
      rate[-1] = -(double)h * sh[i], rate[0] = (double)h * ch[i];
    }
  }
}

/* Loops over whole rows have constant length, which is faster. */
static inline void subtract_row(double factor, const double *restrict row, double *restrict from)
{
  for (int j = 0; j < 2 * N; ++j) from[j] -= factor * row[j];
}

/* B := A^-1 B, [A | B] being the two in one: the matrix of planar_slip.c, which needs no exchange of rows. */
WIDE_VECTORS static void solve_columns(double A[N][2 * N])
{
  for (int k = 0; k < N; ++k) {
    const double inverse = 1 / A[k][k];
    for (int j = 0; j < 2 * N; ++j) A[k][j] *= inverse;
    for (int i = 0; i < N; ++i)
      if (i != k) subtract_row(A[i][k], A[k], A[i]);
  }
}

/* d phi at the points: (R + h a pull) d slope = du'.e_perp - slope dR - pull d phi0, d phi = d phi0 + h a d slope. With
 * Q = h a (R + h pull a)^-1 it is (1 - Q pull) d phi0 + Q (du'.e_perp - slope dR). */
static void follow_angle(planar_force *f, const planar_panel *p, const slip_points *q)
{
  const int L = f->n_coef;
  const double h = p->to - p->from, per_v = f->motion.per_v;
  double A[N][2 * N]; /* both transposed */
  for (int j = 0; j < N; ++j) {
    for (int i = 0; i < N; ++i) A[j][i] = h * q->pull[i] * f->rule.by_point[j][i];
    for (int i = 0; i < N; ++i) A[j][N + i] = h * f->rule.by_point[j][i];
    A[j][j] += q->R[j];
  }
  solve_columns(A);
  double by_du[2][N][N], by_dv[N][N];
  for (int i = 0; i < N; ++i) {
    double *to = f->node + (size_t)i * (size_t)f->n_col, kept = 1;
    for (int j = 0; j < N; ++j) {
      const double Q = A[j][N + i];
      kept -= Q * q->pull[j];
      by_du[0][i][j] = -Q * q->sine[j];
      by_du[1][i][j] = Q * q->cosine[j];
      by_dv[i][j] = -Q * p->slope[j] * per_v;
    }
    for (int k = 0; k < f->n_col; ++k) to[k] = kept * f->dphi[k];
  }
  for (int d = 0; d < 2; ++d) dense_add_product(L, N, N, 1, f->rate, L, by_du[d][0], N, 1, f->node + d * L, f->n_col);
  if (f->n_dof == 3) dense_add_product(L, N, N, 1, f->base, L, by_dv[0], N, 1, f->node + 2 * L, f->n_col);
  memcpy(f->dphi, f->node + (size_t)(N - 1) * (size_t)f->n_col, (size_t)f->n_col * sizeof *f->dphi);
}

/* d(R e) = R e_perp d phi + e dR at a point, times its weight. */
static void fill_change(const planar_force *f, const slip_points *q, int i, double *restrict first,
                        double *restrict second)
{
  const size_t L = (size_t)f->n_coef;
  const double *restrict dphi = f->node + (size_t)i * (size_t)f->n_col, *base = f->base + (size_t)i * (size_t)f->n_coef;
  const double R = q->weight[i] * q->R[i], e = q->weight[i] * f->motion.per_v, c = q->cosine[i], s = q->sine[i];
  for (int k = 0; k < f->n_col; ++k) first[k] = -R * s * dphi[k], second[k] = R * c * dphi[k];
  for (size_t k = 0; f->motion.v && k < L; ++k)
    first[2 * L + k] += e * c * base[k], second[2 * L + k] += e * s * base[k];
}

/* F += a panel's integrals of R e times 1/2, cos, sin .. of h th, over pi. derive: by += their derivatives, with dphi
 * at the panel's beginning, which becomes that at its end. */
static void add_panel(planar_force *f, const planar_panel *p, bool derive)
{
  const int L = f->n_coef;
  slip_points q;
  const double width = p->to - p->from;
  planar_panel_directions(p, q.cosine, q.sine);
  for (int i = 0; i < N; ++i) {
    q.weight[i] = width * f->rule.a[N - 1][i] / PI;
    q.R[i] = p->R[i];
    q.pull[i] = p->du[0][i] * q.cosine[i] + p->du[1][i] * q.sine[i];
  }
  fill_bases(f, p);
  for (int i = 0; i < N; ++i) {
    const double *base = f->base + (size_t)i * (size_t)f->n_coef;
    const double T[2] = {q.weight[i] * q.R[i] * q.cosine[i], q.weight[i] * q.R[i] * q.sine[i]};
    for (int d = 0; d < 2; ++d) {
      f->F[d * L] += 0.5 * T[d];
      for (int row = 1; row < L; ++row) f->F[d * L + row] += T[d] * base[row];
    }
  }
  if (!derive) return;
  follow_angle(f, p, &q);
  /* by += integrals of d(R e) with the test functions. */
  const size_t n = (size_t)f->n_col;
  double *change[2] = {f->node + N * n, f->node + 2 * N * n};
  for (int i = 0; i < N; ++i) fill_change(f, &q, i, change[0] + (size_t)i * n, change[1] + (size_t)i * n);
  dense_transpose(L, N, f->base, f->test);
  for (int i = 0; i < N; ++i) f->test[i] = 0.5;
  for (int d = 0; d < 2; ++d)
    dense_add_product(f->n_col, L, N, 1, change[d], f->n_col, f->test, N, 1, f->by + (size_t)(d * L) * n, f->n_col);
}

/* ---- made and freed ---------------------------------------------------------------------------------- */

static hc_status make_workspace(planar_force *f)
{
  const size_t L = (size_t)f->n_coef, col = (size_t)f->n_col, symbol = (size_t)force_jacobian_symbol_length(f->n_harm);
  planar_cycle *c = &f->cycle;
  c->cap = 16 * f->n_harm + 16;
  c->slip.cap = 64 * f->n_harm + 256;
  c->interval = workspace_array(&f->memory, (size_t)c->cap, sizeof *c->interval);
  c->slip.panel = workspace_array(&f->memory, (size_t)c->slip.cap, sizeof *c->slip.panel);
  f->contact = workspace_array(&f->memory, (size_t)c->cap, sizeof *f->contact);
  f->intervals = workspace_array(&f->memory, (size_t)c->cap, sizeof *f->intervals);
  f->indicator = workspace_doubles(&f->memory, symbol), f->symbol = workspace_doubles(&f->memory, symbol),
  f->weight = workspace_doubles(&f->memory, 2 * (size_t)f->n_harm + 1);
  f->X = workspace_doubles(&f->memory, (size_t)f->n_size), f->F = workspace_doubles(&f->memory, 2 * L),
  f->by = workspace_doubles(&f->memory, 2 * L * col);
  f->dw[0] = workspace_doubles(&f->memory, col), f->dw[1] = workspace_doubles(&f->memory, col),
  f->dphi = workspace_doubles(&f->memory, col);
  f->matrix = workspace_doubles(&f->memory, L * L),
  f->table = workspace_doubles(&f->memory, (size_t)series_grid_table_length(f->n_harm));
  f->node = workspace_doubles(&f->memory, 3 * N * col), f->base = workspace_doubles(&f->memory, N * L),
  f->rate = workspace_doubles(&f->memory, N * L), f->test = workspace_doubles(&f->memory, N * L);
  f->F_normal = workspace_doubles(&f->memory, L), f->jac_normal = workspace_doubles(&f->memory, L * L);
  if (f->memory.failed || f->n_dof == 2) return f->memory.failed ? HC_NO_MEMORY : HC_OK;
  const moving_contact across = {.law = {.kn = f->law.kn, .gap = f->law.gap}, .cv = {1}};
  return exact_force_new(f->n_harm, 1, 1, &across, &f->normal);
}

/* The law of both halves together. n_dof = 2: N is constant, its value at v = 0. */
static contact whole_law(const contact *half, int n_dof)
{
  contact law = {half->kt, 2 * half->kn, half->mu / 2, half->gap, 2 * half->load};
  if (n_dof == 2) law.load = contact_normal(&law, 0), law.kn = law.gap = 0;
  return law;
}

hc_status planar_force_new(int n_harm, int n_dof, const contact *law, planar_force **out)
{
  *out = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || !contact_has_friction(law)) return HC_BAD_INPUT;
  if (n_dof != 2 && n_dof != 3) return HC_BAD_INPUT;
  planar_force *f = calloc(1, sizeof *f);
  if (!f) return HC_NO_MEMORY;
  f->n_harm = n_harm, f->n_dof = n_dof, f->law = whole_law(law, n_dof);
  f->n_coef = series_length(n_harm);
  f->n_size = n_dof * f->n_coef;
  f->n_col = f->n_size + 2;
  hc_status st = make_workspace(f);
  if (st != HC_OK) {
    planar_force_free(f);
    return st;
  }
  interval_series_weights(2 * n_harm, f->weight);
  collocation_fill(&f->rule);
  series_grid_table_fill(n_harm, f->table);
  *out = f;
  return HC_OK;
}

void planar_force_free(planar_force *f)
{
  if (!f) return;
  exact_force_free(f->normal);
  workspace_free(&f->memory);
  free(f);
}

/* ---- the orbit --------------------------------------------------------------------------------------- */

/* The normal force, and the intervals of contact. */
static hc_status find_contacts(planar_force *f, const double *X)
{
  planar_cycle *c = &f->cycle;
  f->contact[0] = (planar_contact){0, TWO_PI};
  c->n_contacts = 1;
  c->always = true;
  c->contact = f->contact;
  if (!f->normal) {
    c->n_contacts = f->law.load > 0;
    return HC_OK;
  }
  const hc_status st = exact_force_eval(f->normal, X + 2 * (size_t)f->n_coef, f->F_normal, f->jac_normal, NULL);
  const contact_interval *p = exact_force_intervals(f->normal, 0, &c->n_contacts);
  for (int i = 0; i < c->n_contacts && st == HC_OK; ++i) f->contact[i] = (planar_contact){p[i].from, p[i].to};
  c->always = c->n_contacts == 1 && p->from <= 0 && p->to >= TWO_PI;
  return st;
}

static hc_status find_orbit(planar_force *f, const double *X)
{
  planar_cycle *c = &f->cycle;
  const double *v = f->normal ? X + 2 * (size_t)f->n_coef : NULL;
  hc_status st = find_contacts(f, X);
  f->motion = planar_motion_make(&f->law, f->n_harm, X, X + f->n_coef, v);
  if (!isfinite(f->motion.of_u[3] * f->motion.of_u[3] + f->motion.of_R[3] * f->motion.of_R[3])) st = HC_NOT_FINITE;
  c->m = c->slip.m = &f->motion;
  c->slip.c = &f->rule;
  c->slip.width = 0;
  c->grid = f->grid;
  c->n = 0;
  if (st != HC_OK || c->n_contacts == 0) return st;
  planar_motion_grid(&f->motion, f->table, f->grid);
  return planar_cycle_find(c);
}

/* ---- stick ------------------------------------------------------------------------------------------- */

/* Adds u - w on the interval: its indicator to the symbol (u), and the constant w to F; derive: dw to by. */
static void add_stick(planar_force *f, const planar_interval *p, bool derive)
{
  const int L = f->n_coef;
  interval_series_fill(2 * f->n_harm, f->weight, p->from, p->to, f->indicator);
  for (int i = 0; i < force_jacobian_symbol_length(f->n_harm); ++i) f->symbol[i] += f->indicator[i];
  for (int d = 0; d < 2; ++d) {
    for (int i = 0; i < L; ++i) f->F[d * L + i] -= p->w[d] * f->indicator[i];
    for (int i = 0; derive && i < L; ++i) {
      double *row = f->by + (size_t)(d * L + i) * (size_t)f->n_col;
      for (int q = 0; q < f->n_col; ++q) row[q] -= f->indicator[i] * f->dw[d][q];
    }
  }
}

/* ---- a period ------------------------------------------------------------------------------------------ */

static void clear_sums(planar_force *f)
{
  memset(f->F, 0, 2 * (size_t)f->n_coef * sizeof *f->F);
  memset(f->by, 0, 2 * (size_t)f->n_coef * (size_t)f->n_col * sizeof *f->by);
  memset(f->symbol, 0, (size_t)force_jacobian_symbol_length(f->n_harm) * sizeof *f->symbol);
}

/* The integrals of all intervals. dw: derivatives of w0; on return those of w(2 pi). */
static void add_intervals(planar_force *f, bool derive)
{
  const planar_cycle *c = &f->cycle;
  double *base = f->base, *rate = f->rate;
  clear_sums(f);
  for (int i = 0; i < c->n; ++i) {
    const planar_interval *p = &c->interval[i];
    if (derive && !c->rest.exists) begin_interval(f, i, base, rate);
    if (p->state == CONTACT_STICK) add_stick(f, p, derive);
    for (int k = p->panel; p->state != CONTACT_STICK && k < p->panel + p->n_panels; ++k)
      add_panel(f, &c->slip.panel[k], derive);
  }
  const planar_interval *last = &c->interval[c->n - 1];
  if (!derive || c->n == 0 || last->state == CONTACT_STICK) return;
  fill_base(f->n_harm, last->to, base, rate);
  const planar_point at = planar_motion_at(&f->motion, last->to);
  come_to_rest(f, base, c->slip.panel[last->panel + last->n_panels - 1].phi[N - 1], at.R);
}

/* dw = derivatives of the rest position. */
static void follow_rest(planar_force *f)
{
  const planar_rest *r = &f->cycle.rest;
  const double per_v = f->motion.per_v;
  double *away[3], *across[3], *other[3];
  for (int i = 0; i < r->n; ++i) {
    const double *e = r->e[i];
    double **row[] = {&away[i], &across[i], &other[i]};
    for (int k = 0; k < 3; ++k) {
      *row[k] = f->node + (size_t)(3 * i + k) * (size_t)f->n_col;
      clear_row(f, *row[k]);
    }
    fill_base(f->n_harm, r->at[i].th, f->base, f->rate);
    add_motion(f, f->base, e[0], e[1], -per_v, away[i]);
    add_motion(f, f->base, -e[1], e[0], 0, across[i]);
    if (r->n == 1) add_motion(f, f->base, 0, 0, per_v, other[i]);
    else add_motion(f, f->rate, e[0], e[1], -per_v, other[i]);
  }
  for (int q = 0; q < f->n_size; ++q) {
    planar_disc_change change[3] = {{0}};
    double dw[2];
    for (int i = 0; i < r->n; ++i) change[i] = (planar_disc_change){away[i][q], across[i][q], other[i][q], other[i][q]};
    planar_rest_move(r, change, dw);
    f->dw[0][q] = dw[0], f->dw[1][q] = dw[1];
  }
}

static void integrate(planar_force *f, bool derive)
{
  const bool closes = derive && f->cycle.always && !f->cycle.rest.exists;
  if (f->cycle.n_contacts == 0) clear_sums(f);
  if (f->cycle.n_contacts == 0) return;
  for (int d = 0; d < 2 && closes; ++d) { /* from w0 */
    clear_row(f, f->dw[d]);
    f->dw[d][f->n_size + d] = 1;
  }
  if (derive && f->cycle.rest.exists) follow_rest(f);
  add_intervals(f, derive);
  /* On the closed orbit d w0 = A d w0 + B dX, A and B being in dw after the pass: dw becomes d w0/dX, then by +=
   * (derivatives by w0) d w0/dX. */
  if (closes) {
    const int n = f->n_size;
    const double a = 1 - f->dw[0][n], b = -f->dw[0][n + 1], c = -f->dw[1][n], d = 1 - f->dw[1][n + 1],
                 det = a * d - b * c;
    for (int q = 0; q < n; ++q) {
      const double x = f->dw[0][q], y = f->dw[1][q];
      f->dw[0][q] = (d * x - b * y) / det;
      f->dw[1][q] = (a * y - c * x) / det;
    }
    for (size_t i = 0; i < 2 * (size_t)f->n_coef; ++i) {
      double *by = f->by + i * (size_t)f->n_col;
      const double *by_w0 = by + n;
      for (int q = 0; q < n; ++q) by[q] += by_w0[0] * f->dw[0][q] + by_w0[1] * f->dw[1][q];
    }
  }
}

/* ---- put together --------------------------------------------------------------------------------------- */

/* dF/dX from the sums of integrate(): dF_d = kt (K du_d + by), K being Toeplitz + Hankel of the stick intervals. */
static void put_jacobian(const planar_force *f, double *jac)
{
  const size_t L = (size_t)f->n_coef, n = (size_t)f->n_size;
  for (size_t d = 0; d < 2; ++d) {
    for (size_t i = 0; i < L; ++i) {
      const double *by = f->by + (d * L + i) * (size_t)f->n_col;
      for (size_t q = 0; q < n; ++q) jac[d * L + i + n * q] = f->law.kt * by[q];
    }
    for (size_t q = 0; q < L; ++q)
      for (size_t i = 0; i < L; ++i) jac[d * L + i + n * (d * L + q)] += f->law.kt * f->matrix[i + L * q];
  }
  for (size_t q = 0; f->n_dof == 3 && q < n; ++q)
    for (size_t i = 0; i < L; ++i) jac[2 * L + i + n * q] = q < 2 * L ? 0 : f->jac_normal[i + L * (q - 2 * L)];
}

static hc_status find_force(planar_force *f, const double *X, bool may_shift, bool derive, double *F,
                            contact_report *report)
{
  double size = 0;
  for (int i = 0; i < f->n_size; ++i) size += fabs(X[i]);
  if (!(size <= TRANSITIONS_LARGEST)) return HC_NOT_FINITE;
  memcpy(f->X, X, (size_t)f->n_size * sizeof *X);
  for (int d = 0; d < 2; ++d) f->X[d * f->n_coef] -= f->start[d];
  f->cycle.may_shift = may_shift;
  hc_status st = find_orbit(f, f->X);
  if (st != HC_OK) return st;
  integrate(f, derive);
  const size_t L = (size_t)f->n_coef;
  memset(f->matrix, 0, L * L * sizeof *f->matrix);
  force_jacobian_add(f->n_harm, f->symbol, f->n_coef, f->matrix);
  for (size_t d = 0; d < 2; ++d) {
    for (size_t q = 0; q < L; ++q)
      for (size_t i = 0; i < L; ++i) f->F[d * L + i] += f->matrix[i + L * q] * f->X[d * L + q];
    for (size_t i = 0; i < L; ++i) F[d * L + i] = f->law.kt * f->F[d * L + i];
  }
  for (size_t i = 0; f->n_dof == 3 && i < L; ++i) F[2 * L + i] = f->F_normal[i];
  const planar_cycle *c = &f->cycle;
  for (int i = 0; i < c->n; ++i) { /* origin -1: variation.c propagates these sliders itself */
    const planar_interval *p = &c->interval[i];
    f->intervals[i] = (contact_interval){.from = p->from, .to = p->to, .state = p->state, .origin = -1};
  }
  if (report) *report = transitions_report(c->n, f->intervals);
  return HC_OK;
}

hc_status planar_force_eval(planar_force *f, const double *X, double *F, double *jac, contact_report *report)
{
  const hc_status st = find_force(f, X, jac != NULL, jac != NULL, F, report);
  if (st == HC_OK && jac) put_jacobian(f, jac);
  return st;
}

void planar_force_slider(const planar_force *f, double w[2])
{
  planar_cycle_slider(&f->cycle, w);
  for (int d = 0; d < 2; ++d) w[d] += f->start[d];
}

const planar_cycle *planar_force_cycle(const planar_force *f) { return &f->cycle; }

/* ---- as one of contact_evaluator.h -------------------------------------------------------------------- */

static hc_status make(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  planar_force *f;
  const hc_status st = planar_force_new(how->n_harm, c->n_dof, &c->moved.law, &f);
  *self = f;
  return st;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): the signature is contact_evaluator.h's */
static hc_status evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  return find_force(self, X, jac != NULL, false, F, report); /* `jacobian` derives */
}

/* dF/dX at the last evaluation, by one more integration over its orbit. */
static void jacobian(void *self, double *jac)
{
  planar_force *f = self;
  integrate(f, true);
  put_jacobian(f, jac);
}

static const contact_interval *intervals(const void *self, int *n)
{
  const planar_force *f = self;
  *n = f->cycle.n;
  return f->intervals;
}

static void let_go(void *self) { planar_force_free(self); }
static void sliders(const void *self, double *w) { planar_force_slider(self, w); }
static void start(void *self, const double *w)
{
  planar_force *f = self;
  memcpy(f->start, w, sizeof f->start);
  f->cycle.asked = w[0] != 0 || w[1] != 0;
}
static const planar_cycle *in_plane(const void *self) { return planar_force_cycle(self); }

const contact_evaluator planar_force_evaluator = {.make = make,
                                                  .free = let_go,
                                                  .evaluate = evaluate,
                                                  .jacobian = jacobian,
                                                  .sliders = sliders,
                                                  .start = start,
                                                  .intervals = intervals,
                                                  .in_plane = in_plane};
