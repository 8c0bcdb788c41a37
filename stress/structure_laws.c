/* structure_laws.c - checks of one solution by itself: the balance of all degrees of freedom, each contact's force and
 * work, the product of the multipliers. The harmonics are those of x alone; contacts are taken one by one, each in
 * its own coordinates (one_contact.h): neither condensation nor scattering of hbm/ has a part in it. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/dense.h"
#include "stress/one_contact.h"
#include "stress/outcomes.h"
#include "stress/solved_structure.h"

/* ---- balance ---------------------------------------------------------------------------------------- */

typedef struct balance {
  double *left, *size; /* [2H+1][n] of all forces: their sum, and the sum of their sizes */
} balance;

static void add_force(double force, double *left, double *size)
{
  *left += force;
  *size += fabs(force);
}

/* A matrix by `by` times coefficient `from` into coefficient `to`. */
static void add_product(const solved_structure *s, const double *A, double by, const double *x, int from, int to,
                        balance *b)
{
  const int n = s->n;
  for (int j = 0; j < n && by != 0; ++j)
    for (int i = 0; i < n; ++i)
      add_force(by * A[(size_t)j * (size_t)n + (size_t)i] * x[from * n + j], &b->left[to * n + i],
                &b->size[to * n + i]);
}

static void add_structure(const solved_structure *s, const double *x, balance *b)
{
  const model *m = s->model;
  for (int c = 0; c < s->n_coef; ++c) {
    const int h = (c + 1) / 2, other = c == 0 ? 0 : c % 2 ? c + 1 : c - 1;
    const double w = h * s->omega;
    add_product(s, m->stiffness, 1, x, c, c, b);
    add_product(s, m->mass, -w * w, x, c, c, b);
    add_product(s, m->damping, c % 2 ? w : -w, x, other, c, b); /* of a cos + b sin: w b cos - w a sin */
  }
  for (int l = 0; l < m->n_loads; ++l) {
    const model_load *p = &m->loads[l];
    const int cosine = p->harmonic ? 2 * p->harmonic - 1 : 0;
    for (int i = 0; i < s->n; ++i) {
      add_force(-p->cosine[i], &b->left[cosine * s->n + i], &b->size[cosine * s->n + i]);
      if (p->harmonic) add_force(-p->sine[i], &b->left[(cosine + 1) * s->n + i], &b->size[(cosine + 1) * s->n + i]);
    }
  }
}

/* What a contact's force is made of: kt u and kn v, themselves sums over x. */
static double spring_size(const solved_structure *s, double stiffness, const double *direction, const double *x)
{
  double sum = 0;
  for (int i = 0; i < s->n; ++i) sum += fabs(direction[i] * x[i]);
  return stiffness * sum;
}

static hc_status add_contact(const solved_structure *s, int j, const double *x, balance *b)
{
  one_contact c;
  hc_status st = one_contact_locate(s, j, x, &c);
  for (int d = 0; d < c.n_dof && st == HC_OK; ++d)
    for (int k = 0; k < s->n_coef; ++k) {
      const double force = c.force[d * s->n_coef + k];
      const double size = fabs(force) + spring_size(s, c.stiffness[d], c.direction[d], x + k * s->n);
      for (int i = 0; i < s->n; ++i) {
        b->left[k * s->n + i] += c.direction[d][i] * force;
        b->size[k * s->n + i] += fabs(c.direction[d][i]) * size;
      }
    }
  one_contact_clear(&c);
  return st;
}

double stress_imbalance(solved_structure *s, const double *x)
{
  const size_t length = (size_t)s->n * (size_t)s->n_coef;
  balance b = {calloc(length, sizeof(double)), calloc(length, sizeof(double))};
  double left = 0, size = 0;
  hc_status st = b.left && b.size ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) add_structure(s, x, &b);
  for (int j = 0; j < s->model->n_contacts && st == HC_OK; ++j) st = add_contact(s, j, x, &b);
  for (size_t i = s->how.keep_mean ? 0 : (size_t)s->n; i < length && st == HC_OK; ++i) {
    if (isnan(b.left[i])) st = HC_NOT_FINITE;
    left = fmax(left, fabs(b.left[i]));
    size = fmax(size, b.size[i]);
  }
  free(b.left);
  free(b.size);
  if (st == HC_NO_MEMORY) s->fatal = st;
  return st != HC_OK ? NAN : left == 0 ? 0 : left / size;
}

stress_check stress_structure_balance(solved_structure *s)
{
  return stress_agree(stress_imbalance(s, s->base.x), stress_balanced(s));
}

/* ---- a contact's force and work ------------------------------------------------------------------------ */

/* Largest difference over the largest force of the springs. */
static double forces_apart(int n_coef, const one_contact *c, const double *stepped)
{
  double apart = 0, size = 0;
  for (int k = 0; k < c->n_dof * n_coef; ++k) {
    apart = fmax(apart, fabs(c->force[k] - stepped[k]));
    if (isnan(c->force[k])) return NAN;
    size = fmax(size, c->stiffness[k / n_coef] * fabs(c->motion[k]));
  }
  return apart == 0 ? 0 : apart / fmax(size, DBL_MIN);
}

/* Steps err by the second power of their length, where transitions lie between them; by the first where a contact that
 * touched down found its slider between two of them, and by luck of where they lie: as of samples (limits.c), 256 times
 * as many have to come eight times nearer, or the last sixteen times as many twice. A slider that creeps into a corner
 * is in neither by then. */
static stress_check check_force(const solved_structure *s, const one_contact *c)
{
  enum { LEAST = 512, MOST = 131072 };
  const double near = 1e-6;
  double worst = 0, before = 0, error = 0;
  double *turn = malloc(2 * MOST * sizeof *turn), *stepped = malloc(one_contact_length(s, c) * sizeof *stepped);
  const bool room = turn && stepped;
  bool settled = true;
  for (int N = LEAST; N <= MOST && room; N *= 16) {
    one_contact_turn(N, turn);
    settled = one_contact_step(c, s->how.harmonics, N, turn, stepped);
    before = error;
    error = forces_apart(s->n_coef, c, stepped);
    worst = fmax(worst, error);
    if (error <= near) break;
  }
  free(turn);
  free(stepped);
  if (!room) return stress_refusal(HC_NO_MEMORY);
  const double bound = fmax(worst / 8, before / 2);
  if (!(error > near)) return stress_agree(error, near);
  if (!settled && error > bound) return stress_explain(STRESS_TOO_DEAR, error, bound);
  return error <= bound ? stress_explain(STRESS_ALIASED, error, bound) : stress_find(STRESS_DISAGREES, error, near);
}

stress_check stress_structure_force(solved_structure *s)
{
  stress_check worst = stress_skip(STRESS_NOT_APPLICABLE);
  for (int j = 0; j < s->model->n_contacts; ++j) {
    one_contact c;
    hc_status st = one_contact_locate(s, j, s->base.x, &c);
    const stress_check one = st == HC_OK ? check_force(s, &c) : stress_refusal(st);
    one_contact_clear(&c);
    if (one.status == HC_NO_MEMORY) s->fatal = HC_NO_MEMORY;
    if (one.outcome > worst.outcome || (one.outcome == worst.outcome && one.error > worst.error)) worst = one;
  }
  return worst;
}

/* Work per period over pi: the sum of h (b_x a_F - a_x b_F), and the sizes of what it is made of. */
static double work_over_pi(const solved_structure *s, const one_contact *c, double *size)
{
  double work = 0;
  for (int h = 1; h <= s->how.harmonics; ++h)
    for (int d = 0; d < c->n_dof; ++d) {
      const int a = d * s->n_coef + 2 * h - 1, b = a + 1;
      const double x = hypot(c->motion[a], c->motion[b]);
      work += h * (c->motion[b] * c->force[a] - c->motion[a] * c->force[b]);
      *size += h * x * (hypot(c->force[a], c->force[b]) + c->stiffness[d] * x);
    }
  return work;
}

/* Each contact by itself, of the truncated motion, too: its force is the exact one. Rounding of the sums. */
stress_check stress_structure_work(solved_structure *s)
{
  double worst = 0;
  for (int j = 0; j < s->model->n_contacts; ++j) {
    const contact *law = &s->model->contacts[j].law;
    one_contact c;
    double size = 0;
    hc_status st = one_contact_locate(s, j, s->base.x, &c);
    if (st == HC_OK) {
      const double work = work_over_pi(s, &c, &size);
      const bool takes = contact_has_friction(law) && c.report.regime >= CONTACT_SLIPS;
      const double wrong = takes ? fmax(-work, 0) : fabs(work);
      if (isnan(work)) worst = NAN;
      else if (wrong > 0 && !isnan(worst)) worst = fmax(worst, wrong / size);
    }
    one_contact_clear(&c);
    if (st != HC_OK) return stress_motion_refuse(s, st);
  }
  return stress_agree(worst, 1e-11);
}

/* ---- multipliers -------------------------------------------------------------------------------------- */

/* trace M^-1 C; NaN: out of memory, or M is singular. */
static double damping_trace(const model *m)
{
  const int n = m->n;
  double trace = 0, *lu = malloc((size_t)n * (size_t)n * sizeof *lu), *x = malloc((size_t)n * sizeof *x);
  int *pivot = malloc((size_t)n * sizeof *pivot);
  const bool room = lu && x && pivot;
  if (room) memcpy(lu, m->mass, (size_t)n * (size_t)n * sizeof *lu);
  const bool factored = room && dense_factor(n, lu, pivot) == HC_OK;
  for (int j = 0; j < n && factored; ++j) {
    memcpy(x, m->damping + (size_t)j * (size_t)n, (size_t)n * sizeof *x);
    dense_solve(n, lu, pivot, 1, x);
    trace += x[j];
  }
  free(lu);
  free(x);
  free(pivot);
  return factored ? trace : NAN;
}

/* Liouville: without slip the flow contracts by the trace of M^-1 C alone, whatever opens and closes. Multipliers are
 * good to rounding of the largest: 1e-6 of their product is let pass where it is above 1e-8 and the largest below 10,
 * beyond that it says nothing. */
stress_check stress_structure_determinant(solved_structure *s)
{
  if (s->base.stability_status != HC_OK) return stress_motion_refuse(s, s->base.stability_status);
  for (int j = 0; j < s->model->n_contacts; ++j) {
    one_contact c;
    hc_status st = one_contact_locate(s, j, s->base.x, &c);
    one_contact_clear(&c);
    if (st != HC_OK) return stress_motion_refuse(s, st);
    if (contact_has_friction(&s->model->contacts[j].law) && c.report.regime >= CONTACT_SLIPS)
      return stress_skip(STRESS_NOT_APPLICABLE);
  }
  const double expected = exp(-TWO_PI / s->omega * damping_trace(s->model));
  if (!(expected > 1e-8 && expected < 1e8 && s->base.stability.multiplier < 10))
    return stress_skip(STRESS_NOT_APPLICABLE);
  return stress_agree(fabs(s->base.stability.determinant / expected - 1), 1e-6);
}
