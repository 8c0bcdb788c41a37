/* modal_flow.c - see modal_flow.h. With accelerations a at the points of a step of length h, Radau's weights A, points
 * x, and p the contact forces on a mode there,
 *     (1 + h c A + h^2 lambda A^2) a = -c eta' - lambda (eta + h x eta') - p
 * so that, with 1 + h c A + h^2 lambda A^2 = D,
 *     eta at the points = alpha eta + beta eta' - Gamma p,        Gamma = h^2 D^-1 A^2
 * and motions of the contacts are q = sum_k b_k (alpha eta + beta eta')_k - G f,  G = sum_k b_k b_k^T Gamma_k. Forces
 * are made of unknowns u: q itself while stuck, dv while it slips with one tangent; dv and y of a circle that slips.
 * There zeta = dw.e_perp = du.e_perp - y obeys
 *     R zeta' = s (du.e_perp - zeta) - R phi' (du.e - dR)
 * without a derivative of the motion, which at the points is y = P q + (what y was). */
#include "hbm/stability/modal_flow.h"

#include <complex.h>
#include <string.h>

#include "hbm/forces/contact_kind.h"
#include "model/modes.h"
#include "numerics/base/constants.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/norm.h"
#include "numerics/wide_vectors.h"

enum { S = 5 /* points of a step */, MOST_ROWS = 3 };

/* A contact in touch with its rows of directions: tangent and normal, or both tangents and the normal of a pair under
 * one limit. */
typedef struct contact_site {
  int contact; /* of the model; of a pair the first */
  int rows;    /* directions: 2, or 3 of a circle */
  int first;   /* of these, among the rows of all sites */
} contact_site;

/* What a site's contact does over a step. */
typedef struct site_law {
  bool slides;                        /* a circle that slips: unknowns are dv and y */
  int unknowns, at;                   /* their number at a point, 0 while separated; place of the first among all */
  int held;                           /* rows whose force contains a dheld: tangents of one that sticks */
  double force[S][MOST_ROWS][3];      /* at a point, f = force u - dheld */
  double y[S][S][MOST_ROWS], y_of[S]; /* y at a point = sum of y q over all points + y_of zeta at the start */
  double across[2];                   /* e_perp at the start */
} site_law;

struct modal_flow {
  model *modes;             /* the model in its modes */
  int n, n_states;          /* modes; 2 n + contacts */
  int n_sites, rows;        /* contacts, of a pair one; all sites' rows */
  contact_site *site;       /* [n_sites] */
  double *damping, *lambda; /* [n] c [1/time], omega^2 [1/time^2] */
  double *stuck, *stuck_c;  /* [n] lambda and c of the structure with its contacts stuck */
  double *direction;        /* [rows][n] by rows: b of all sites */
  double *turned;           /* [n][rows] by rows: its transpose */
  int first_fast;           /* modes from here on are stable by Metelitsyn's criterion */
  double *jump;             /* [n] the largest part of the energy of modes k.. that one change of contact moves */
  double *least_damping;    /* [n] the least c of modes k.. */
  double omega;             /* [rad/time] of modal_flow_begin */
  int fast;                 /* modes from here on are left to decay on this orbit */
  double width;             /* [rad] of a step */
  collocation c;            /* nodes of the panels of slip (planar_slip.h) */
  /* Radau's points and weights, A^2, A^-1, and the sums of its rows */
  double x[S], a[S * S], a2[S * S], inverse[S * S], inverse_sum[S];
  double h;                     /* [time] the step length that the following is for */
  double *gamma, *alpha, *beta; /* [n][S][S], [n][S], [n][S] eta at the points (head of this file) */
  double *kappa, *dv, *dv_v;    /* [n][S], [n], [n] eta' at the end = dv eta + dv_v eta' - kappa p */
  double *weighted;             /* [n][rows] of fill_modes: gamma b */
  double *G, *G_sum;            /* [S][S][rows][rows], [S][rows][rows] summed over the second point */
  double *Q;                    /* [S rows][2 n] by rows: alpha b, beta b */
  site_law *law;                /* [n_sites] */
  double *matrix;               /* [S rows]^2 by columns: 1 + P G force */
  int *pivot;                   /* [S rows] of its factors */
  double *q, *u, *f;            /* [S rows][columns] by rows: motions, unknowns, forces of contacts at the points */
  double *solved;               /* [columns][S rows] by rows: unknowns of a column together */
  double *p;                    /* [n][columns] forces on modes */
  double *zeta;                 /* [n_sites][columns] at the start of the step */
  workspace memory;             /* of all the arrays above */
};

/* ---- what is fast ------------------------------------------------------------------------------------ */

static bool is_circle(const contact_site *s) { return s->rows == 3; }
static const contact *law_of(const modal_flow *f, const contact_site *s) { return &f->modes->contacts[s->contact].law; }
static double mu_kn(const contact *c) { return contact_has_friction(c) ? c->mu * c->kn : 0; }

/* The largest eigenvalue of sum_{i >= k} b b^T/omega_i over tangents or normals, each times sqrt(mu kn). */
static hc_status gram_norm(const modal_flow *f, int k, bool normals, double *out)
{
  const size_t rows = (size_t)f->rows;
  double *gram = calloc(3 * rows * rows + rows, sizeof *gram);
  if (!gram) return HC_NO_MEMORY;
  double *unit = gram + rows * rows, *vectors = unit + rows * rows, *values = vectors + rows * rows;
  for (size_t i = 0; i < rows; ++i) unit[i * (rows + 1)] = 1;
  for (int a = 0; a < f->n_sites; ++a)
    for (int b = 0; b < f->n_sites; ++b) {
      const contact_site *one = &f->site[a], *two = &f->site[b];
      const double weight = sqrt(mu_kn(law_of(f, one)) * mu_kn(law_of(f, two)));
      for (int r = 0; r < one->rows; ++r)
        for (int t = 0; t < two->rows; ++t) {
          if ((r == one->rows - 1) != normals || (t == two->rows - 1) != normals) continue;
          const double *da = f->direction + (size_t)(one->first + r) * (size_t)f->n,
                       *db = f->direction + (size_t)(two->first + t) * (size_t)f->n;
          double sum = 0;
          for (int i = k; i < f->n; ++i) sum += da[i] * db[i] / sqrt(f->lambda[i]);
          gram[(size_t)(one->first + r) * rows + (size_t)(two->first + t)] = weight * sum;
        }
    }
  const hc_status st = dense_modes(f->rows, gram, unit, values, vectors);
  *out = values[rows - 1];
  free(gram);
  return st;
}

/* True if half of mode k lasts over a period. */
static bool lasts(const modal_flow *f, int k, double period)
{
  return exp(-0.5 * f->damping[k] * period) > 0.5 || exp(-0.5 * f->stuck_c[k] * period) > 0.5;
}

/* modal_flow.h's criterion for modes k..; the symmetric part of slip's stiffness lowers k by no more than a quarter of
 * mu times the tangents' part. */
static hc_status decays(const modal_flow *f, int k, bool *out)
{
  double zeta = INFINITY, tangents = 0, normals = 0;
  *out = false;
  if (!(f->lambda[k] > 0)) return HC_OK;
  for (int i = k; i < f->n; ++i) zeta = fmin(zeta, f->damping[i] / (2 * sqrt(f->lambda[i])));
  hc_status st = gram_norm(f, k, false, &tangents);
  if (st == HC_OK) st = gram_norm(f, k, true, &normals);
  double mu = 0;
  for (int j = 0; j < f->modes->n_contacts; ++j) mu = fmax(mu, f->modes->contacts[j].law.mu);
  const double omega = sqrt(f->lambda[k]), lowered = 0.25 * mu * tangents / omega;
  *out = st == HC_OK && lowered < 0.5 && sqrt(tangents * normals) < zeta * omega * sqrt(1 - lowered);
  return st;
}

static hc_status find_fast(modal_flow *f)
{
  int low = -1, high = f->n; /* modes high.. decay, low.. do not */
  hc_status st = HC_OK;
  while (high - low > 1 && st == HC_OK) {
    const int k = (low + high) / 2;
    bool good;
    if ((st = decays(f, k, &good)) == HC_OK) *(good ? &high : &low) = k;
  }
  f->first_fast = high;
  for (int k = f->n - 1; k >= 0; --k) {
    const bool last = k == f->n - 1;
    f->least_damping[k] = last ? f->damping[k] : fmin(f->damping[k], f->least_damping[k + 1]);
  }
  for (int s = 0; s < f->n_sites && f->n_sites; ++s) {
    const contact *law = law_of(f, &f->site[s]);
    double sum = 0;
    for (int k = f->n - 1; k >= 0 && f->lambda[k] > 0; --k) {
      for (int r = 0; r < f->site[s].rows; ++r) {
        const bool normal = r == f->site[s].rows - 1;
        const double b = f->direction[(size_t)(f->site[s].first + r) * (size_t)f->n + (size_t)k];
        sum += (normal ? law->kn * (is_circle(&f->site[s]) ? 2 : 1) : law->kt) * b * b / f->lambda[k];
      }
      f->jump[k] = fmax(f->jump[k], sum);
    }
  }
  return st;
}

/* ---- made and freed ------------------------------------------------------------------------------------ */

static void list_sites(modal_flow *f)
{
  const model *m = f->modes;
  for (int j = 0; j < m->n_contacts;) {
    const bool circle = placed_contact_of(m, j).planar;
    f->site[f->n_sites++] = (contact_site){j, circle ? 3 : 2, f->rows};
    for (int r = 0; r < (circle ? 3 : 2); ++r, ++f->rows) {
      const double *d = r == (circle ? 2 : 1) ? m->contacts[j].normal : m->contacts[j + r].tangent;
      memcpy(f->direction + (size_t)f->rows * (size_t)f->n, d, (size_t)f->n * sizeof *d);
    }
    j += circle ? 2 : 1;
  }
  dense_transpose(f->n, f->rows, f->direction, f->turned);
}

static void modal_project(int n, const double *phi, const double *from, double *to)
{
  for (int k = 0; k < n; ++k) to[k] = dot_product(n, phi + (size_t)k * (size_t)n, from);
}

/* The model in its modes, from m's. */
static hc_status make_modal(const model *m, const double *phi, const double *lambda, modal_flow *f)
{
  const size_t n = (size_t)m->n;
  double *work = malloc(3 * n * n * sizeof *work), *C = work ? work + 2 * n * n : NULL;
  hc_status st = work ? model_copy(m, &f->modes) : HC_NO_MEMORY;
  if (st == HC_OK) {
    dense_congruence(m->n, m->n, phi, m->damping, work, C);
    if (!dense_is_symmetric(m->n, m->stiffness) || !dense_is_diagonal(m->n, C, m->n)) st = HC_BAD_INPUT;
  }
  for (size_t i = 0; i < n * n && st == HC_OK; ++i) {
    const bool diagonal = i % (n + 1) == 0;
    f->modes->mass[i] = diagonal;
    f->modes->stiffness[i] = diagonal ? lambda[i / (n + 1)] : 0;
    f->modes->damping[i] = diagonal ? C[i] : 0;
  }
  for (size_t k = 0; k < n && st == HC_OK; ++k) f->damping[k] = C[k * (n + 1)], f->lambda[k] = lambda[k];
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    modal_project(m->n, phi, m->contacts[j].tangent, f->modes->contacts[j].tangent);
    modal_project(m->n, phi, m->contacts[j].normal, f->modes->contacts[j].normal);
  }
  free(work);
  return st;
}

static hc_status make_rule(modal_flow *f)
{
  double lu[S * S];
  int pivot[S];
  collocation_fill(&f->c);
  collocation_radau(S, f->x, f->a);
  memset(f->a2, 0, sizeof f->a2);
  for (int i = 0; i < S; ++i)
    for (int j = 0; j < S; ++j)
      for (int k = 0; k < S; ++k) f->a2[i * S + j] += f->a[i * S + k] * f->a[k * S + j];
  for (int i = 0; i < S; ++i) /* by columns, and so transposed twice */
    for (int j = 0; j < S; ++j) lu[j * S + i] = f->a[j * S + i], f->inverse[i * S + j] = i == j;
  const hc_status st = dense_factor(S, lu, pivot);
  if (st != HC_OK) return st;
  dense_solve(S, lu, pivot, S, f->inverse);
  for (int i = 0; i < S; ++i) {
    f->inverse_sum[i] = 0;
    for (int j = 0; j < S; ++j) f->inverse_sum[i] += f->inverse[i * S + j];
  }
  return HC_OK;
}

static void take_memory(modal_flow *f)
{
  const size_t n = (size_t)f->n, states = (size_t)f->n_states, contacts = (size_t)f->n_states - 2 * n + 1,
               rows = 2 * contacts, points = S * rows;
  f->site = workspace_array(&f->memory, contacts, sizeof *f->site);
  f->law = workspace_array(&f->memory, contacts, sizeof *f->law);
  double **of_modes[] = {&f->damping, &f->lambda,        &f->stuck, &f->stuck_c,
                         &f->jump,    &f->least_damping, &f->dv,    &f->dv_v};
  for (size_t i = 0; i < sizeof of_modes / sizeof *of_modes; ++i) *of_modes[i] = workspace_doubles(&f->memory, n);
  double **of_points[] = {&f->alpha, &f->beta, &f->kappa};
  for (int i = 0; i < 3; ++i) *of_points[i] = workspace_doubles(&f->memory, n * S);
  f->gamma = workspace_doubles(&f->memory, n * S * S);
  f->direction = workspace_doubles(&f->memory, rows * n);
  f->turned = workspace_doubles(&f->memory, rows * n);
  f->G = workspace_doubles(&f->memory, points * points);
  f->G_sum = workspace_doubles(&f->memory, points * rows);
  f->Q = workspace_doubles(&f->memory, points * (2 * n));
  f->matrix = workspace_doubles(&f->memory, points * points);
  f->pivot = workspace_array(&f->memory, points, sizeof *f->pivot);
  double **of_columns[] = {&f->q, &f->u, &f->solved, &f->f};
  for (int i = 0; i < 4; ++i) *of_columns[i] = workspace_doubles(&f->memory, points * states);
  f->weighted = workspace_doubles(&f->memory, n * rows);
  f->p = workspace_doubles(&f->memory, n * states);
  f->zeta = workspace_doubles(&f->memory, contacts * states);
}

hc_status modal_flow_new(const model *m, modal_flow **out)
{
  const size_t n = (size_t)m->n;
  modal_flow *f = calloc(1, sizeof *f);
  double *phi = malloc((2 * n * n + n) * sizeof *phi), *lambda = phi ? phi + n * n : NULL;
  hc_status st = f && phi ? HC_OK : HC_NO_MEMORY;
  *out = NULL;
  if (st == HC_OK) {
    f->n = m->n;
    f->n_states = 2 * m->n + m->n_contacts;
    take_memory(f);
    st = f->memory.failed ? HC_NO_MEMORY : model_modes(m, true, f->stuck, phi);
  }
  if (st == HC_OK) {
    double *C_phi = lambda + n;
    dense_multiply(m->n, m->n, m->n, m->damping, phi, C_phi);
    for (size_t k = 0; k < n; ++k) f->stuck_c[k] = dot_product(m->n, phi + k * n, C_phi + k * n);
  }
  if (st == HC_OK) st = model_modes(m, false, lambda, phi);
  if (st == HC_OK) st = make_modal(m, phi, lambda, f);
  if (st == HC_OK) list_sites(f), st = make_rule(f);
  if (st == HC_OK) st = find_fast(f);
  free(phi);
  if (st == HC_OK) *out = f;
  else modal_flow_free(f);
  return st;
}

void modal_flow_free(modal_flow *f)
{
  if (!f) return;
  model_free(f->modes);
  workspace_free(&f->memory);
  free(f);
}

const model *modal_flow_model(const modal_flow *f) { return f->modes; }

double modal_flow_operations(const modal_flow *f)
{
  const double unknowns = (double)S * f->rows, columns = 2.0 * f->fast + f->n_states - 2 * f->n,
               steps = TWO_PI / f->width;
  return steps * (unknowns * unknowns * unknowns * 2 / 3 + 2 * columns * unknowns * (unknowns + 4.0 * f->n));
}

/* Of LAPACK: 10 (2 n)^3 for eigenvalues, at a third of the speed of products. */
double modal_flow_operations_of_roots(const modal_flow *f) { return 240.0 * f->n * f->n * f->n; }

/* Modes fast.. are left to decay. [rad] of modes and of th that a step takes at most; half of it where that costs a
 * tenth of a second. */
static void set_width(modal_flow *f, int fast)
{
  const double period = TWO_PI / f->omega, exact = 0.6, rough = 3, forces = 0.25, cheap = 1e9;
  f->fast = fast;
  f->width = forces;
  if (fast > 0) f->width = fmin(f->width, rough * f->omega / sqrt(fmax(f->stuck[fast - 1], 0)));
  for (int k = 0; k < f->n; ++k)
    if (lasts(f, k, period)) f->width = fmin(f->width, exact * f->omega / sqrt(fmax(f->stuck[k], 0)));
  if (modal_flow_operations(f) < cheap) f->width *= 0.5;
}

void modal_flow_begin(modal_flow *f, double omega, int changes)
{
  const double period = TWO_PI / omega;
  int fast = f->n;
  f->omega = omega;
  while (fast > 0 && !lasts(f, fast - 1, period) && f->lambda[fast - 1] > 0 &&
         2 * changes * f->jump[fast - 1] < f->least_damping[fast - 1] * period)
    --fast;
  set_width(f, fast);
  f->h = 0;
}

/* The contacts' stiffness for motions far faster than slip turns, from direction t to direction r at Z[r + rows t]:
 * across slip a circle is stuck. */
static void modal_add_contact(const modal_flow *f, const contact_site *s, const contact_interval *at,
                              const planar_slipping *slipping, double th, double *Z)
{
  const contact *c = law_of(f, s);
  const int rows = f->rows, normal = s->first + s->rows - 1;
  double *own = Z + s->first * (rows + 1), *of_normal = Z + normal * rows + s->first;
  if (at || slipping) Z[normal * (rows + 1)] += c->kn * (is_circle(s) ? 2 : 1);
  if (slipping) {
    const planar_state now = planar_slipping_at(&f->c, slipping, th, th, f->omega);
    const double across[2] = {-now.e[1], now.e[0]};
    for (int t = 0; t < 2; ++t) {
      of_normal[t] += mu_kn(c) * now.e[t];
      for (int o = 0; o < 2; ++o) own[t + o * rows] += c->kt * across[t] * across[o];
    }
  } else
    for (int t = 0; at && t < s->rows - 1; ++t)
      *(contact_interval_holds(c, at) ? &own[t + t * rows] : &of_normal[t]) += contact_interval_stiffness(c, at);
}

/* A symmetric matrix whose rows and columns are divided by the roots of its diagonal: `own`, the largest entry between
 * a mode's displacement and its own velocity, and the sum of the squares of all others beside the diagonal. With
 * sqrt(sum) < 1 - own it is positive definite: no eigenvalue of those entries is larger, and a mode's two rows alone
 * have none below 1 - own. */
typedef struct dominance {
  double sum, own;
  bool positive;
} dominance;

static void add_entry(dominance *of, double entry, double one, double other)
{
  of->positive = of->positive && one > 0 && other > 0;
  of->sum += entry * entry / (one * other);
}

static void add_own(dominance *of, double entry, double one, double other)
{
  const double own = fabs(entry) / sqrt(one * other);
  of->positive = of->positive && one > 0 && other > 0;
  of->own = larger(of->own, own);
}

static bool is_positive(const dominance *of) { return of->positive && of->own < 1 && sqrt(of->sum) < 1 - of->own; }

/* True if modal_flow.h's L and Q are positive definite, for the modes fast.. held by K[n][n]. b[n][n], bK = b K. */
static bool energy_decays(const modal_flow *f, int n, const double *K, const double *b, const double *bK)
{
  const double *w2 = f->lambda + f->fast, *c = f->damping + f->fast, rate = 0.5 * f->least_damping[f->fast];
  dominance L = {.positive = true}, Q = {.positive = true};
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l) {
      const double kl = K[k + (size_t)l * n], lk = K[l + (size_t)k * n], skew = 0.5 * (kl - lk),
                   by = b[k + (size_t)l * n], a = by != 0 ? skew + by * w2[l] : 0, sum = 0.5 * (kl + lk) + a,
                   k_k = w2[k] + K[k + (size_t)k * n], k_l = w2[l] + K[l + (size_t)l * n], Lk = k_k + 0.5 * c[k] * c[k],
                   Ll = k_l + 0.5 * c[l] * c[l], Qk = c[k] * k_k - rate * Lk, Ql = c[l] * k_l - rate * Ll,
                   Qv_k = c[k] - rate, Qv_l = c[l] - rate, cross = bK[l + (size_t)k * n] + (by != 0 ? 0 : -skew);
      if (k != l) {
        add_entry(&L, sum, Lk, Ll);
        add_entry(&L, by, 1, 1);
        add_entry(&Q, 0.5 * (c[k] * kl + c[l] * lk) - rate * sum, Qk, Ql);
        add_entry(&Q, by * (c[k] + c[l] - rate), Qv_k, Qv_l);
        add_entry(&Q, cross, Qk, Qv_l), add_entry(&Q, cross, Qk, Qv_l);
      } else {
        add_own(&L, 0.5 * c[k], Lk, 1);
        add_own(&Q, cross - 0.5 * rate * c[k], Qk, Qv_k);
      }
    }
  return is_positive(&L) && is_positive(&Q);
}

/* The same of K = left turned; work[2 n n + n rows]. */
static bool has_energy(const modal_flow *f, int n, const double *K, const double *left, double *work)
{
  const double most = 0.02, *w2 = f->lambda + f->fast;
  double *b = work, *bK = b + (size_t)n * (size_t)n, *b_left = bK + (size_t)n * (size_t)n;
  for (int l = 0; l < n; ++l)
    for (int k = 0; k < n; ++k) {
      const double by = (K[k + (size_t)l * n] - K[l + (size_t)k * n]) / (w2[k] - w2[l]);
      b[k + (size_t)l * n] = fabs(by) < most ? by : 0; /* NaN: two modes of one frequency, or one */
    }
  dense_multiply(n, f->rows, n, b, left, b_left);
  dense_multiply(n, n, f->rows, b_left, f->turned + (size_t)f->fast * (size_t)f->rows, bK);
  return energy_decays(f, n, K, b, bK);
}

/* Modes first.. with the contacts' stiffness K = left direction. */
typedef struct held_modes {
  int first, n;
  double *left, *K, *work; /* [rows][n], [n][n] by columns, [4 n n + n (rows + 4)] */
  workspace memory;
} held_modes;

/* At th; memory is freed in any case by the caller. */
static hc_status hold_modes(const modal_flow *f, int first, const contact_interval *const *interval, int n_slipping,
                            const planar_slipping *slipping, double th, held_modes *held)
{
  const size_t n = (size_t)(f->n - first), rows = (size_t)f->rows;
  *held = (held_modes){.first = first, .n = (int)n};
  double *Z = workspace_doubles(&held->memory, rows * rows);
  held->left = workspace_doubles(&held->memory, n * rows);
  held->K = workspace_doubles(&held->memory, n * n);
  held->work = workspace_doubles(&held->memory, 4 * n * n + n * (rows + 4));
  if (held->memory.failed) return HC_NO_MEMORY;
  for (int s = 0; s < f->n_sites; ++s) {
    const planar_slipping *slips = NULL;
    for (int k = 0; k < n_slipping && !slips; ++k)
      if (slipping[k].contact == f->site[s].contact) slips = &slipping[k];
    modal_add_contact(f, &f->site[s], interval[f->site[s].contact], slips, th, Z);
  }
  dense_add_product(held->n, f->rows, f->rows, 1, f->direction + first, f->n, Z, f->rows, 0, held->left, held->n);
  dense_multiply(held->n, held->n, f->rows, held->left, f->turned + (size_t)first * rows, held->K);
  return HC_OK;
}

/* The roots of s^2 + c s + omega^2 + K, as eigenvalues in (w x, x'), w = omega but where a motion is free; *root[2 n]
 * in held->work. */
static hc_status find_roots(const modal_flow *f, const held_modes *held, double complex **root)
{
  const size_t n = (size_t)held->n;
  double *A = held->work;
  *root = (double complex *)(A + 4 * n * n);
  memset(A, 0, 4 * n * n * sizeof *A);
  for (size_t k = 0; k < n; ++k) {
    const double lambda = f->lambda[(size_t)held->first + k], w = sqrt(fmax(lambda, f->omega * f->omega));
    A[(n + k) * 2 * n + k] = w;
    for (size_t row = 0; row < n; ++row) A[k * 2 * n + n + row] = -held->K[k * n + row] / w;
    A[k * 2 * n + n + k] -= lambda / w;
    A[(n + k) * 2 * n + n + k] = -f->damping[(size_t)held->first + k];
  }
  return dense_eigen(2 * held->n, A, *root, NULL, NULL);
}

/* True if they are to the left of -c/4. */
static hc_status roots_decay(const modal_flow *f, const held_modes *held, bool *decays)
{
  double complex *root;
  const hc_status st = find_roots(f, held, &root);
  *decays = st == HC_OK;
  for (int k = 0; k < 2 * held->n && *decays; ++k) *decays = creal(root[k]) <= -0.25 * f->least_damping[held->first];
  return st == HC_NOT_CONVERGED ? HC_OK : st;
}

hc_status modal_flow_check(modal_flow *f, const contact_interval *const *interval, int n_slipping,
                           const planar_slipping *slipping, double th)
{
  held_modes held;
  bool decays = true;
  if (f->fast >= f->first_fast) return HC_OK;
  hc_status st = hold_modes(f, f->fast, interval, n_slipping, slipping, th, &held);
  if (st == HC_OK) decays = has_energy(f, held.n, held.K, held.left, held.work);
  if (st == HC_OK && !decays) st = roots_decay(f, &held, &decays);
  if (st == HC_OK && !decays) set_width(f, f->first_fast);
  workspace_free(&held.memory);
  return st;
}

hc_status modal_flow_roots(const modal_flow *f, const contact_interval *const *interval, double complex *root)
{
  held_modes held;
  double complex *found;
  hc_status st = hold_modes(f, 0, interval, 0, NULL, 0, &held);
  if (st == HC_OK) st = find_roots(f, &held, &found);
  if (st == HC_OK) memcpy(root, found, 2 * (size_t)held.n * sizeof *root);
  workspace_free(&held.memory);
  return st;
}

/* ---- modes over a step of one length -------------------------------------------------------------------- */

static hc_status fill_mode(modal_flow *f, int k)
{
  const double h = f->h, c = f->damping[k], lambda = f->lambda[k];
  double D[S * S], right[2 * S * S];
  double *gamma = f->gamma + (size_t)k * S * S, *kappa = f->kappa + (size_t)k * S;
  int pivot[S];
  for (int i = 0; i < S; ++i)
    for (int j = 0; j < S; ++j) {
      D[j * S + i] = (i == j) + h * c * f->a[i * S + j] + h * h * lambda * f->a2[i * S + j];
      right[j * S + i] = h * h * f->a2[i * S + j];
      right[(S + j) * S + i] = h * f->a[i * S + j];
    }
  const hc_status st = dense_factor(S, D, pivot);
  if (st != HC_OK) return st;
  dense_solve(S, D, pivot, 2 * S, right);
  f->dv[k] = 0, f->dv_v[k] = 1;
  for (int i = 0; i < S; ++i) {
    double alpha = 1, beta = h * f->x[i];
    for (int j = 0; j < S; ++j) {
      gamma[i * S + j] = right[j * S + i];
      alpha -= lambda * gamma[i * S + j];
      beta -= gamma[i * S + j] * (c + lambda * h * f->x[j]);
    }
    f->alpha[k * S + i] = alpha, f->beta[k * S + i] = beta;
    kappa[i] = right[(S + i) * S + S - 1];
    f->dv[k] -= lambda * kappa[i];
    f->dv_v[k] -= kappa[i] * (c + lambda * h * f->x[i]);
  }
  return HC_OK;
}

static hc_status fill_modes(modal_flow *f, double h)
{
  const size_t n = (size_t)f->n, rows = (size_t)f->rows;
  hc_status st = HC_OK;
  if (h == f->h) return HC_OK;
  f->h = h;
  for (int k = 0; k < f->n && st == HC_OK; ++k) st = fill_mode(f, k);
  for (int i = 0; i < S; ++i) {
    for (size_t r = 0; r < rows; ++r)
      for (size_t k = 0; k < n; ++k) {
        double *at = f->Q + ((size_t)i * rows + r) * 2 * n + k;
        at[0] = f->alpha[k * S + (size_t)i] * f->direction[r * n + k];
        at[n] = f->beta[k * S + (size_t)i] * f->direction[r * n + k];
      }
    double *sum = f->G_sum + (size_t)i * rows * rows;
    memset(sum, 0, rows * rows * sizeof *sum);
    for (int j = 0; j < S; ++j) {
      double *G = f->G + (size_t)(i * S + j) * rows * rows;
      for (size_t k = 0; k < n; ++k)
        for (size_t r = 0; r < rows; ++r)
          f->weighted[k * rows + r] = f->gamma[(k * S + (size_t)i) * S + (size_t)j] * f->turned[k * rows + r];
      dense_multiply(f->rows, f->rows, f->n, f->weighted, f->direction, G);
      for (size_t e = 0; e < rows * rows; ++e) sum[e] += G[e];
    }
  }
  return st;
}

/* ---- contacts over a step ------------------------------------------------------------------------------- */

/* y of a circle that slips from q at all points. */
static hc_status fill_slip(const modal_flow *f, const planar_slipping *s, double from, double to, double omega,
                           const contact *c, site_law *law)
{
  const double middle = 0.5 * (from + to), h = f->h, by_v = c->mu * c->kn / c->kt;
  double Z[S * S], right[S * S] = {0}, start[S];
  planar_state at[S];
  int pivot[S];
  const planar_state first = planar_slipping_at(&f->c, s, from, middle, omega);
  law->slides = true, law->unknowns = 2, law->held = 0;
  law->across[0] = -first.e[1], law->across[1] = first.e[0];
  for (int i = 0; i < S; ++i) {
    const planar_state *a = &at[i];
    at[i] = planar_slipping_at(&f->c, s, from + (to - from) * f->x[i], middle, omega);
    const double weight = 1 / (a->R + a->speed * h);
    for (int j = 0; j < S; ++j) Z[j * S + i] = weight * (a->R * f->inverse[i * S + j] + (i == j) * h * a->speed);
    right[i * S + i] = weight * h;
    start[i] = weight * a->R * f->inverse_sum[i];
    const double force[3][2] = {
        {c->kt * by_v * a->e[0], -c->kt * a->e[1]}, {c->kt * by_v * a->e[1], c->kt * a->e[0]}, {2 * c->kn, 0}};
    for (int r = 0; r < 3; ++r) memcpy(law->force[i][r], force[r], sizeof force[r]);
  }
  const hc_status st = dense_factor(S, Z, pivot);
  if (st != HC_OK) return st;
  dense_solve(S, Z, pivot, S, right);
  dense_solve(S, Z, pivot, 1, start);
  for (int i = 0; i < S; ++i) {
    law->y_of[i] = -start[i];
    for (int j = 0; j < S; ++j) {
      const planar_state *a = &at[j];
      const double by = right[j * S + i], turning = a->R * a->turning, own = i == j;
      law->y[i][j][0] = by * (turning * a->e[0] + a->speed * a->e[1]) - own * a->e[1];
      law->y[i][j][1] = by * (turning * a->e[1] - a->speed * a->e[0]) + own * a->e[0];
      law->y[i][j][2] = -by * turning * by_v;
    }
  }
  return HC_OK;
}

static void fill_steady(const contact_site *s, const contact *c, const contact_interval *at, site_law *law)
{
  const bool stuck = contact_interval_holds(c, at);
  law->unknowns = !at ? 0 : stuck ? s->rows : 1;
  law->held = stuck ? s->rows - 1 : 0;
  for (int i = 0; i < S && at; ++i) {
    memset(law->force[i], 0, sizeof law->force[i]);
    for (int r = 0; r < s->rows - 1; ++r) law->force[i][r][stuck ? r : 0] = contact_interval_stiffness(c, at);
    law->force[i][s->rows - 1][law->unknowns - 1] = c->kn * (is_circle(s) ? 2 : 1);
  }
}

/* The laws of all contacts; the number of unknowns. */
static hc_status fill_laws(modal_flow *f, const contact_interval *const *interval, int n_slipping,
                           const planar_slipping *slipping, double from, double to, double omega, int *unknowns)
{
  hc_status st = HC_OK;
  *unknowns = 0;
  for (int s = 0; s < f->n_sites && st == HC_OK; ++s) {
    const contact_site *site = &f->site[s];
    site_law *law = &f->law[s];
    law->slides = false;
    fill_steady(site, law_of(f, site), interval[site->contact], law);
    for (int k = 0; k < n_slipping && st == HC_OK; ++k)
      if (slipping[k].contact == site->contact) st = fill_slip(f, &slipping[k], from, to, omega, law_of(f, site), law);
    law->at = *unknowns;
    *unknowns += S * law->unknowns;
  }
  return st;
}

/* What the motion of site a at its points, by unknowns, takes from motions q[S][rows]; of one column of width apart. */
static void to_unknowns(const contact_site *s, const site_law *law, const double *q, size_t point, size_t row,
                        double *u)
{
  for (int i = 0; i < S; ++i, u += law->unknowns) {
    const double *at = q + (size_t)i * point;
    if (law->slides) {
      u[0] = at[2 * row], u[1] = 0;
      for (int j = 0; j < S; ++j)
        for (int r = 0; r < 3; ++r) u[1] += law->y[i][j][r] * q[(size_t)j * point + (size_t)r * row];
    } else if (law->held)
      for (int r = 0; r < s->rows; ++r) u[r] = at[(size_t)r * row];
    else u[0] = at[(size_t)(s->rows - 1) * row];
  }
}

/* 1 + P G force, by columns. */
static void fill_matrix(modal_flow *f, int unknowns)
{
  const size_t rows = (size_t)f->rows;
  for (int b = 0; b < f->n_sites; ++b)
    for (int j = 0; j < S; ++j)
      for (int e = 0; e < f->law[b].unknowns; ++e) {
        double *column = f->matrix + (size_t)(f->law[b].at + j * f->law[b].unknowns + e) * (size_t)unknowns;
        for (int a = 0; a < f->n_sites; ++a) {
          const contact_site *one = &f->site[a], *two = &f->site[b];
          double q[S * MOST_ROWS];
          if (!f->law[a].unknowns) continue;
          for (int i = 0; i < S; ++i)
            for (int r = 0; r < one->rows; ++r) {
              const double *G = f->G + ((size_t)(i * S + j) * rows + (size_t)two->first) * rows + one->first + r;
              double sum = 0;
              for (int t = 0; t < two->rows; ++t) sum += G[(size_t)t * rows] * f->law[b].force[j][t][e];
              q[i * MOST_ROWS + r] = sum;
            }
          to_unknowns(one, &f->law[a], q, MOST_ROWS, 1, column + f->law[a].at);
        }
        column[f->law[b].at + j * f->law[b].unknowns + e] += 1;
      }
}

/* to[columns] += by from[columns]. */
static inline void modal_add_row(int columns, double by, const double *restrict from, double *restrict to)
{
  for (int q = 0; q < columns; ++q) to[q] += by * from[q];
}

/* f->q: motions without what contact forces change but for dheld; f->zeta at the start. */
WIDE_VECTORS static void fill_free(modal_flow *f, int columns, const double *phi)
{
  const size_t n = (size_t)f->n, rows = (size_t)f->rows, states = (size_t)f->n_states, width = (size_t)columns;
  dense_add_product(columns, S * f->rows, 2 * f->n, 1, phi, f->n_states, f->Q, 2 * f->n, 0, f->q, columns);
  for (int s = 0; s < f->n_sites; ++s) {
    const contact_site *site = &f->site[s];
    for (int t = 0; t < f->law[s].held; ++t)
      for (size_t i = 0; i < S; ++i)
        for (size_t r = 0; r < rows; ++r)
          modal_add_row(columns, f->G_sum[(i * rows + (size_t)(site->first + t)) * rows + r],
                        phi + (2 * n + (size_t)(site->contact + t)) * states, f->q + (i * rows + r) * width);
    if (!f->law[s].slides) continue;
    double *zeta = f->zeta + (size_t)s * width;
    for (size_t q = 0; q < width; ++q) zeta[q] = -phi[(2 * n + (size_t)site->contact) * states + q];
    for (int t = 0; t < 2; ++t)
      for (size_t k = 0; k < n; ++k)
        modal_add_row(columns, f->law[s].across[t] * f->direction[(size_t)(site->first + t) * n + k], phi + k * states,
                      zeta);
  }
}

/* f->u: right sides, by rows. */
WIDE_VECTORS static void modal_fill_right(modal_flow *f, int columns)
{
  const size_t width = (size_t)columns, rows = (size_t)f->rows;
  for (int s = 0; s < f->n_sites; ++s) {
    const contact_site *site = &f->site[s];
    const site_law *law = &f->law[s];
    for (int i = 0; i < S; ++i)
      for (int e = 0; e < law->unknowns; ++e) {
        double *u = f->u + (size_t)(law->at + i * law->unknowns + e) * width;
        const int row = law->held ? e : site->rows - 1;
        const double *q = f->q + (size_t)site->first * width;
        if (!law->slides || e == 0) memcpy(u, q + ((size_t)i * rows + (size_t)row) * width, width * sizeof *u);
        else {
          for (size_t c = 0; c < width; ++c) u[c] = law->y_of[i] * f->zeta[(size_t)s * width + c];
          for (int j = 0; j < S; ++j)
            for (int r = 0; r < 3; ++r)
              modal_add_row(columns, law->y[i][j][r], q + ((size_t)j * rows + (size_t)r) * width, u);
        }
      }
  }
}

/* Forces at the points, by rows. */
WIDE_VECTORS static void fill_forces(modal_flow *f, int columns, const double *phi)
{
  const size_t width = (size_t)columns, rows = (size_t)f->rows, states = (size_t)f->n_states;
  memset(f->f, 0, S * rows * width * sizeof *f->f);
  for (int s = 0; s < f->n_sites; ++s) {
    const contact_site *site = &f->site[s];
    const site_law *law = &f->law[s];
    for (int i = 0; i < S && law->unknowns; ++i)
      for (int r = 0; r < site->rows; ++r) {
        double *to = f->f + ((size_t)i * rows + (size_t)(site->first + r)) * width;
        for (int e = 0; e < law->unknowns; ++e)
          if (law->force[i][r][e] != 0)
            modal_add_row(columns, law->force[i][r][e], f->u + (size_t)(law->at + i * law->unknowns + e) * width, to);
        if (r < law->held) modal_add_row(columns, -1, phi + (size_t)(2 * f->n + site->contact + r) * states, to);
      }
  }
}

/* phi at the end of the step. */
WIDE_VECTORS static void modal_finish(modal_flow *f, int columns, double *phi)
{
  const size_t n = (size_t)f->n, states = (size_t)f->n_states, width = (size_t)columns;
  for (size_t k = 0; k < n; ++k) {
    double *restrict x = phi + k * states, *restrict v = phi + (n + k) * states;
    const double a = f->alpha[k * S + S - 1], b = f->beta[k * S + S - 1], c = f->dv[k], d = f->dv_v[k];
    for (size_t q = 0; q < width; ++q) {
      const double was = x[q];
      x[q] = a * was + b * v[q];
      v[q] = c * was + d * v[q];
    }
  }
  for (size_t i = 0; i < S; ++i) {
    const double *force = f->f + i * (size_t)f->rows * width;
    dense_add_product(columns, f->n, f->rows, 1, force, columns, f->turned, f->rows, 0, f->p, columns);
    for (size_t k = 0; k < n; ++k) {
      modal_add_row(columns, -f->gamma[(k * S + S - 1) * S + i], f->p + k * width, phi + k * states);
      modal_add_row(columns, -f->kappa[k * S + i], f->p + k * width, phi + (n + k) * states);
    }
  }
  for (int s = 0; s < f->n_sites; ++s)
    if (f->law[s].slides)
      memcpy(phi + (2 * n + (size_t)f->site[s].contact) * states,
             f->u + (size_t)(f->law[s].at + (S - 1) * 2 + 1) * width, width * sizeof *phi);
}

static hc_status modal_step(modal_flow *f, const contact_interval *const *interval, int n_slipping,
                            const planar_slipping *slipping, double from, double to, double omega, double h,
                            int columns, double *phi)
{
  int unknowns = 0;
  hc_status st = fill_modes(f, h);
  if (st == HC_OK) st = fill_laws(f, interval, n_slipping, slipping, from, to, omega, &unknowns);
  if (st != HC_OK) return st;
  if (unknowns) {
    fill_matrix(f, unknowns);
    if (dense_factor(unknowns, f->matrix, f->pivot) != HC_OK) return HC_SINGULAR;
    fill_free(f, columns, phi);
    modal_fill_right(f, columns);
    dense_transpose(columns, unknowns, f->u, f->solved);
    dense_solve(unknowns, f->matrix, f->pivot, columns, f->solved);
    dense_transpose(unknowns, columns, f->solved, f->u);
  }
  fill_forces(f, columns, phi);
  modal_finish(f, columns, phi);
  return isfinite(phi[0]) ? HC_OK : HC_NOT_FINITE;
}

hc_status modal_flow_advance(modal_flow *f, const contact_interval *const *interval, int n_slipping,
                             const planar_slipping *slipping, double from, double to, double omega, int columns,
                             double *phi)
{
  hc_status st = HC_OK;
  for (double at = from; at < to && st == HC_OK;) {
    const double end = planar_slipping_step(n_slipping, slipping, at, to, to - at);
    const int steps = (int)ceil((end - at) / f->width * (1 - 1e-12));
    const double h = (end - at) / (steps > 0 ? steps : 1);
    for (int i = 0; i < steps && st == HC_OK; ++i)
      st = modal_step(f, interval, n_slipping, slipping, at + i * h, i + 1 < steps ? at + (i + 1) * h : end, omega,
                      h / omega, columns, phi);
    at = end;
  }
  return st;
}
