/* laws.c - checks of one solution by itself: the balance of all degrees of freedom, each contact's force and work, the
 * product of the multipliers. The harmonics are those of x alone; contacts are taken one by one, each in its own
 * coordinates: neither condensation nor scattering of hbm/ has a part in it. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/stress/solved_scene.h"
#include "hbm/contact/exact_force.h"
#include "hbm/forces/contact_kind.h"
#include "hbm/planar/planar_force.h"
#include "hbm/planar/planar_slider.h"
#include "numerics/base/constants.h"
#include "numerics/dense.h"
#include "numerics/norm.h"
#include "numerics/random.h"
#include "numerics/series.h"

/* ---- one contact ---------------------------------------------------------------------------------------- */

/* One contact by itself, located and stepped through; two halves with one limit (model.h) are taken as one. */
enum { ONE_CONTACT_MOST = 3 };

typedef struct one_contact {
  const contact *law; /* of a circle: of either half */
  bool circle;
  double omega; /* of laws that depend on rates */
  int n_dof;    /* u, v; of a circle u_1, u_2, and v where N varies; 0: it belongs to the contact before it */
  const double *direction[ONE_CONTACT_MOST]; /* [n] */
  double stiffness[ONE_CONTACT_MOST];        /* [force/length] of the whole contact along each */
  double *motion, *force;                    /* [n_dof][2H+1] coordinates, and T and N - N0 along them */
  double rest[2];                            /* [length] of a circle: where its slider stays, if it never slips */
  contact_report report;
} one_contact;

static void one_contact_clear(one_contact *c)
{
  free(c->motion);
  free(c->force);
}

static size_t one_contact_length(const solved_scene *s, const one_contact *c)
{
  return (size_t)c->n_dof * (size_t)s->n_coef;
}

/* ---- located ------------------------------------------------------------------------------------------- */

/* What contact j is: without friction a circle's halves are two springs. */
static one_contact contact_of(const model *m, int j)
{
  const model_contact *mc = &m->contacts[j];
  const contact *law = &mc->law;
  if (!mc->circle || !contact_has_friction(law))
    return (one_contact){
        .law = law, .n_dof = 2, .direction = {mc->tangent, mc->normal}, .stiffness = {law->kt, law->kn}};
  if (mc->pair == CONTACT_SECOND) return (one_contact){.law = law, .circle = true};
  return (one_contact){.law = law,
                       .circle = true,
                       .n_dof = law->kn > 0 ? 3 : 2,
                       .direction = {mc->tangent, mc[1].tangent, mc->normal},
                       .stiffness = {law->kt, law->kt, 2 * law->kn}};
}

/* Sum of h^p times the sizes of harmonic h >= 1 of coordinate d: a bound of the p-th derivative by th. */
static double motion_size(const solved_scene *s, const one_contact *c, int d, int p)
{
  double sum = 0;
  for (int h = 1; h <= s->how.harmonics; ++h) {
    const double *a = c->motion + d * s->n_coef + 2 * h - 1;
    sum += pow(h, p) * hypot(a[0], a[1]);
  }
  return sum;
}

/* Bounds of coordinate d, and of a law's friction limit. */
static double reach_of(const solved_scene *s, const one_contact *c, int d)
{
  return fabs(c->motion[d * s->n_coef]) + motion_size(s, c, d, 0);
}
static double limit_of(const solved_scene *s, const one_contact *c)
{
  return c->law->mu * (c->law->kn * (reach_of(s, c, 1) + fabs(c->law->gap)) + c->law->load);
}

/* A smooth law has stiffnesses only as its motion is: the most that its force may be, over that. */
static void set_stiffness(const solved_scene *s, one_contact *c)
{
  const double u = reach_of(s, c, 0), v = reach_of(s, c, 1);
  if (c->law->smooth == CONTACT_TANH) c->stiffness[0] = u > 0 ? limit_of(s, c) / u : 0;
  for (int i = 0; i < CONTACT_POWERS && c->law->smooth == CONTACT_POLYNOMIAL; ++i)
    c->stiffness[1] += fabs(c->law->power[i]) * pow(v, i + CONTACT_LEAST_POWER - 1);
}

/* A polynomial knows v alone. */
static hc_status locate_smooth(int n_harm, one_contact *c)
{
  const bool rubs = c->law->smooth == CONTACT_TANH;
  const placed_contact placed = {.law = *c->law};
  const contact_coordinates alone = {
      .n_dof = 1 + rubs, .divisor = {1, 1}, .moved = {.law = *c->law, .cu = {rubs, 0}, .cv = {!rubs, 1}}};
  const evaluator_settings how = {.n_harm = n_harm};
  const int first = rubs ? 0 : series_length(n_harm);
  const contact_evaluator *law = contact_kind_of(&placed)->exact;
  void *self = NULL;
  hc_status st = law->make(&alone, &how, &self);
  if (st == HC_OK && law->at_omega) law->at_omega(self, c->omega);
  if (st == HC_OK) st = law->evaluate(self, c->motion + first, c->force + first, NULL, &c->report);
  law->free(self);
  return st;
}

/* c->force of c->motion. */
static hc_status locate(int n_harm, one_contact *c)
{
  if (c->law->smooth != CONTACT_KINKED) return locate_smooth(n_harm, c);
  const moving_contact alone = {.law = *c->law, .cu = {1, 0}, .cv = {0, 1}};
  exact_force *line = NULL;
  planar_force *plane = NULL;
  contact_report report = {0};
  hc_status st =
      c->circle ? planar_force_new(n_harm, c->n_dof, c->law, &plane) : exact_force_new(n_harm, 2, 1, &alone, &line);
  memset(c->rest, 0, sizeof c->rest);
  if (st == HC_OK && c->circle) st = planar_force_eval(plane, c->motion, c->force, NULL, &report);
  else if (st == HC_OK) st = exact_force_eval(line, c->motion, c->force, NULL, &report);
  if (st == HC_OK && c->circle && report.free_sliders > 0) planar_force_slider(plane, c->rest);
  c->report = report;
  exact_force_free(line);
  planar_force_free(plane);
  return st;
}

/* Contact j in the motion x[2H+1][n]. HC_NO_MEMORY, the evaluators' errors; one_contact_clear in any case. */
static hc_status one_contact_locate(const solved_scene *s, int j, const double *x, one_contact *c)
{
  *c = contact_of(s->model, j);
  c->omega = s->omega;
  if (c->n_dof == 0) return HC_OK;
  c->motion = calloc(one_contact_length(s, c), sizeof(double));
  c->force = calloc(one_contact_length(s, c), sizeof(double));
  if (!c->motion || !c->force) return HC_NO_MEMORY;
  for (int d = 0; d < c->n_dof; ++d)
    for (int k = 0; k < s->n_coef; ++k)
      for (int i = 0; i < s->n; ++i) c->motion[d * s->n_coef + k] += c->direction[d][i] * x[k * s->n + i];
  if (c->law->smooth != CONTACT_KINKED) set_stiffness(s, c);
  return locate(s->how.harmonics, c);
}

/* ---- stepped through ----------------------------------------------------------------------------------- */

/* basis[2H+1] = 1, cos th, sin th, .., cos H th, sin H th at instant i of N. */
static void basis_at(int n_harm, int i, int N, double *basis)
{
  const double c = cos(TWO_PI * i / N), s = sin(TWO_PI * i / N);
  double ch = basis[0] = 1, sh = 0;
  for (int h = 1; h <= n_harm; ++h) {
    series_turn(c, s, &ch, &sh);
    basis[2 * h - 1] = ch, basis[2 * h] = sh;
  }
}

/* The slider on its way: w, and the instant before. */
typedef struct stepper {
  double w[2];
  planar_sample before;
  bool begun;
} stepper;

/* f[n_dof], T and N - N0 at the instant that is reached by motion[n_dof], and the first one's rate behind it. A contact
 * on a line is one in the plane whose second tangent does not move. */
static void step(const one_contact *c, const double *motion, stepper *s, double *f)
{
  const contact *law = c->law;
  const int tangents = c->circle ? 2 : 1, last = c->n_dof - 1;
  const double v = last == tangents ? motion[last] : 0, limit = law->mu * (law->kn * (v + law->gap) + law->load);
  const planar_sample to = {.u = {motion[0], c->circle ? motion[1] : 0}, .r = limit / law->kt};
  planar_move move = PLANAR_APART;
  if (contact_has_friction(law))
    move = s->begun ? planar_slider_step(HBM_RESTART_INTERPOLATED, &s->before, &to, s->w, NULL)
                    : planar_slider_enter(&to, s->w, NULL);
  for (int d = 0; d < tangents; ++d) f[d] = move == PLANAR_APART ? 0 : law->kt * (to.u[d] - s->w[d]);
  if (last == tangents) f[last] = tangents * contact_normal_change(law, v);
  if (law->smooth == CONTACT_TANH) f[0] = fmax(limit, 0) * tanh(motion[c->n_dof] / law->epsilon);
  if (law->smooth == CONTACT_POLYNOMIAL) f[1] = contact_polynomial(law, v, &(double){0});
  s->before = to;
  s->begun = true;
}

/* One period of motion[N][n_dof + 1]; its harmonics are added to force[n_dof][2H+1] unless that is NULL. */
static void step_period(const one_contact *c, int n_harm, int N, const double *motion, stepper *s, double *force)
{
  const int n_coef = series_length(n_harm);
  double f[ONE_CONTACT_MOST] = {0}, basis[2 * HBM_MAX_HARMONICS + 1] = {0};
  for (int i = 0; i < N; ++i) {
    step(c, motion + (size_t)i * (size_t)(c->n_dof + 1), s, f);
    if (force) basis_at(n_harm, i, N, basis);
    for (int d = 0; d < c->n_dof && force; ++d)
      for (int k = 0; k < n_coef; ++k) force[d * n_coef + k] += (k == 0 ? 1 : 2) * f[d] / N * basis[k];
  }
}

/* The law stepped through N instants a period until the slider has settled: harmonics force[n_dof][2H+1] of one period
 * more. Between instants u and v go evenly, as in hbm/planar/planar_slider.h. From w = 0 a slider on a line comes to
 * where HBM has it in one period, even if it rests; in the plane it begins where it is said to rest and must stay, or
 * settles by a factor each, or creeps into a corner between two circles, the slower the nearer. HC_INTERRUPTED: after
 * 2^23 instants it still has not settled; HC_NO_MEMORY. */
static hc_status step_contact(const one_contact *c, int n_harm, int N, double *force)
{
  const int most = c->circle ? 1 << 23 : N; /* instants in all */
  const int n_coef = series_length(n_harm);
  const double settled = 1e-9, near = 5e-8; /* [w] moved by a period, and still to go */
  double basis[2 * HBM_MAX_HARMONICS + 1] = {0}, *motion = malloc((size_t)N * (size_t)(c->n_dof + 1) * sizeof *motion);
  stepper s = {.w = {c->rest[0], c->rest[1]}};
  bool rests = !c->circle;
  double last = INFINITY; /* moved by the period before */
  if (!motion) return HC_NO_MEMORY;
  for (int i = 0; i < N; ++i) {
    basis_at(n_harm, i, N, basis);
    double *at = motion + i * (c->n_dof + 1), *rate = at + c->n_dof;
    for (int d = 0; d < c->n_dof; ++d) at[d] = dot_product(n_coef, c->motion + d * n_coef, basis);
    *rate = 0;
    for (int h = 1; h <= n_harm; ++h)
      *rate += h * c->omega * (c->motion[2 * h] * basis[2 * h - 1] - c->motion[2 * h - 1] * basis[2 * h]);
  }
  for (int done = 0; done < most && (done == 0 || !rests); done += N) {
    const double before[2] = {s.w[0], s.w[1]};
    step_period(c, n_harm, N, motion, &s, NULL);
    const double moved = hypot(s.w[0] - before[0], s.w[1] - before[1]), size = hypot(s.w[0], s.w[1]);
    const double to_go = moved < last ? moved / (1 - moved / last) : moved > 0 ? INFINITY : 0; /* by that factor each */
    rests = rests || (moved <= settled * size && to_go <= near * size);
    last = moved;
  }
  memset(force, 0, (size_t)c->n_dof * (size_t)n_coef * sizeof *force);
  step_period(c, n_harm, N, motion, &s, force);
  free(motion);
  return rests ? HC_OK : HC_INTERRUPTED;
}

/* What stepping through N instants, e = 2 pi/N apart, may do to a coefficient, over the largest force of the springs.
 * Up, Vp bound the p-th derivatives of u and v; r = mu N/kt.
 *     sums     a trapezoidal sum errs by e^2/12 times the mean of |(f cos h th)''|, twice that for h >= 1: with f of
 *              the springs, S2 + 2 h S1 + h^2 S0, Sp = kt Up + (1 + mu) kn Vp; and by e^2/8 times each jump of f', at
 *              most 2 S1, over pi
 *     slider   u and r go evenly between instants, off by e^2/8 (U2 + R2): on a line so is the slider
 *     circle   of two circles that are nowhere more than d apart the sliders differ by no more than the root of
 *              2 d (length of both paths) (Moreau's sweeping process), each path 2 pi (U1 + R1) at most
 * The second of the two is the larger one by far, and no better is known without the order of the motion's contact with
 * the circle; it is of first order in e. Of tanh Sp follows from limit and rate by the product's rule, with
 * |tanh'| <= 1, |tanh''| <= 0.77; sums of a polynomial are exact. */
static double stepping_bound(const solved_scene *s, const one_contact *c, int N)
{
  const contact *law = c->law;
  const int last = c->n_dof - 1, H = s->how.harmonics;
  const bool moves = c->circle ? c->n_dof == 3 : law->kn > 0;
  if (law->smooth == CONTACT_POLYNOMIAL && N > (contact_degree(law) + 1) * H) return 0;
  const double e = TWO_PI / N, r = law->kt > 0 ? law->mu * law->kn / law->kt : 0;
  double U[3] = {0}, V[3] = {0}, S[3], largest = 0;
  for (int p = 0; p < 3; ++p) {
    for (int d = 0; d < (c->circle ? 2 : 1); ++d) U[p] += motion_size(s, c, d, p);
    if (moves) V[p] = motion_size(s, c, last, p);
    S[p] = law->kt * U[p] + (c->circle ? 2 : 1) * (1 + law->mu) * law->kn * V[p];
  }
  if (law->smooth == CONTACT_TANH) {
    const double part = s->omega / law->epsilon, rate[] = {part * U[2], part * motion_size(s, c, 0, 3)},
                 limit[] = {limit_of(s, c), law->mu * law->kn * V[1], law->mu * law->kn * V[2]};
    S[0] += limit[0], S[1] += limit[1] + limit[0] * rate[0];
    S[2] += limit[2] + 2 * limit[1] * rate[0] + limit[0] * (rate[1] + 0.77 * rate[0] * rate[0]);
  }
  for (int k = 0; k < c->n_dof * s->n_coef; ++k)
    largest = fmax(largest, c->stiffness[k / s->n_coef] * fabs(c->motion[k]));
  const double sums = e * e * ((S[2] + 2 * H * S[1] + H * H * S[0]) / 6 + (c->report.transitions + 1) * S[1] / 4);
  const double line = e * e / 8 * (U[2] + r * V[2]);
  const double slider = c->circle ? e * sqrt(PI * (U[1] + r * V[1]) * (U[2] + r * V[2])) : line;
  return (sums + 2 * law->kt * slider) / fmax(largest, DBL_MIN);
}

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
static void add_product(const solved_scene *s, const double *A, double by, const double *x, int from, int to,
                        balance *b)
{
  const int n = s->n;
  for (int j = 0; j < n && by != 0; ++j)
    for (int i = 0; i < n; ++i)
      add_force(by * A[(size_t)j * (size_t)n + (size_t)i] * x[from * n + j], &b->left[to * n + i],
                &b->size[to * n + i]);
}

/* Its force as located, or stepped through N > 0 instants, with *bound more. HC_INTERRUPTED: not settled. */
static hc_status add_contact(const solved_scene *s, int j, const double *x, int N, balance *b, double *bound)
{
  one_contact c;
  hc_status st = one_contact_locate(s, j, x, &c);
  if (st == HC_OK && N > 0 && c.n_dof > 0) {
    *bound += stepping_bound(s, &c, N);
    st = step_contact(&c, s->how.harmonics, N, c.force);
  }
  for (int d = 0; d < c.n_dof && st == HC_OK; ++d)
    for (int k = 0; k < s->n_coef; ++k) {
      const double force = c.force[d * s->n_coef + k];
      /* What a contact's force is made of: kt u and kn v, themselves sums over x. */
      double sum = 0;
      for (int i = 0; i < s->n; ++i) sum += fabs(c.direction[d][i] * (x + k * s->n)[i]);
      const double size = fabs(force) + c.stiffness[d] * sum;
      for (int i = 0; i < s->n; ++i) {
        b->left[k * s->n + i] += c.direction[d][i] * force;
        b->size[k * s->n + i] += fabs(c.direction[d][i]) * size;
      }
    }
  one_contact_clear(&c);
  return st;
}

double stress_imbalance_sampled(solved_scene *s, const double *x, int N, double *bound)
{
  const size_t length = (size_t)s->n * (size_t)s->n_coef;
  balance b = {calloc(length, sizeof(double)), calloc(length, sizeof(double))};
  double left = 0, size = 0;
  *bound = 0;
  hc_status st = b.left && b.size ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) {
    const model *m = s->model;
    for (int c = 0; c < s->n_coef; ++c) {
      const int h = (c + 1) / 2, other = c == 0 ? 0 : c % 2 ? c + 1 : c - 1;
      const double w = h * s->omega;
      add_product(s, m->stiffness, 1, x, c, c, &b);
      add_product(s, m->mass, -w * w, x, c, c, &b);
      add_product(s, m->damping, c % 2 ? w : -w, x, other, c, &b); /* of a cos + b sin: w b cos - w a sin */
    }
    for (int l = 0; l < m->n_loads; ++l) {
      const model_load *p = &m->loads[l];
      const int cosine = p->harmonic ? 2 * p->harmonic - 1 : 0;
      for (int i = 0; i < s->n; ++i) {
        add_force(-p->cosine[i], &b.left[cosine * s->n + i], &b.size[cosine * s->n + i]);
        if (p->harmonic) add_force(-p->sine[i], &b.left[(cosine + 1) * s->n + i], &b.size[(cosine + 1) * s->n + i]);
      }
    }
  }
  for (int j = 0; j < s->model->n_contacts && st == HC_OK; ++j) st = add_contact(s, j, x, N, &b, bound);
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

stress_check stress_check_balance(solved_scene *s)
{
  return stress_agree(stress_imbalance(s, s->base.x), stress_balanced(s));
}

/* ---- a contact's force and work ------------------------------------------------------------------------ */

/* Steps get finer until the difference is 1e-6 of the springs' largest force, or what it must be. */
static stress_check hold_force(solved_scene *s, const one_contact *c)
{
  enum { LEAST = 512, MOST = 131072 };
  const double near = 1e-6;
  double error = 0, *stepped = malloc(one_contact_length(s, c) * sizeof *stepped);
  hc_status st = stepped ? HC_OK : HC_NO_MEMORY;
  for (int N = LEAST; N <= MOST && st != HC_NO_MEMORY; N *= 4) {
    st = step_contact(c, s->how.harmonics, N, stepped);
    if (st == HC_NO_MEMORY) break;
    double apart = 0, size = DBL_MIN;
    for (int k = 0; k < c->n_dof * s->n_coef; ++k) {
      apart = larger(apart, fabs(c->force[k] - stepped[k]));
      size = fmax(size, c->stiffness[k / s->n_coef] * fabs(c->motion[k]));
    }
    error = apart / size;
    if (error <= near) break;
  }
  free(stepped);
  if (st != HC_NO_MEMORY && !(error > near)) return stress_agree(error, near); /* NaN, too */
  if (st != HC_OK) return stress_refuse(s, st);
  const double bound = fmin(stepping_bound(s, c, MOST), STRESS_SAYS_SOMETHING);
  return error <= bound ? stress_explain(STRESS_ALIASED, error, bound) : stress_find(STRESS_DISAGREES, error, bound);
}

/* A motion falling as 1/h^2 that crosses the gap or the friction limit, as the solution may not. */
static void draw_motion(solved_scene *s, one_contact *c)
{
  const contact *law = c->law;
  double reach = law->kn > 0 ? fabs(law->gap) : law->kt > 0 ? law->mu * law->load / law->kt : 0;
  if (law->smooth != CONTACT_KINKED) reach = fmax(reach_of(s, c, 0), reach_of(s, c, 1));
  if (reach == 0) reach = 1;
  for (int d = 0; d < c->n_dof; ++d)
    for (int k = 0; k < s->n_coef; ++k) {
      const int h = (k + 1) / 2;
      c->motion[d * s->n_coef + k] = reach * random_signed(&s->random) * (h == 0 ? 0.1 : 1.5 / (h * h));
    }
  if (law->smooth != CONTACT_KINKED) c->stiffness[1] = law->kn, set_stiffness(s, c);
}

/* Each contact in the solution's motion, and in one that is drawn. */
stress_check stress_check_force(solved_scene *s)
{
  stress_check worst = stress_skip(STRESS_NOT_APPLICABLE);
  for (int j = 0; j < s->model->n_contacts; ++j) {
    one_contact c;
    hc_status st = one_contact_locate(s, j, s->base.x, &c);
    for (int drawn = 0; drawn < 2 && c.n_dof > 0; ++drawn) {
      if (drawn && st == HC_OK) draw_motion(s, &c), st = locate(s->how.harmonics, &c);
      worst = stress_worse(worst, st == HC_OK ? hold_force(s, &c) : stress_refuse(s, st));
    }
    one_contact_clear(&c);
  }
  return worst;
}

/* Each contact by itself, of the truncated motion, too: its force is the exact one. The work per period over pi is the
 * sum of h (b_x a_F - a_x b_F), and errs by rounding of what it is made of. */
stress_check stress_check_work(solved_scene *s)
{
  double worst = 0;
  for (int j = 0; j < s->model->n_contacts; ++j) {
    const contact *law = &s->model->contacts[j].law;
    one_contact c;
    double work = 0, size = 0;
    hc_status st = one_contact_locate(s, j, s->base.x, &c);
    for (int h = 1; h <= s->how.harmonics && st == HC_OK; ++h)
      for (int d = 0; d < c.n_dof; ++d) {
        const int a = d * s->n_coef + 2 * h - 1, b = a + 1;
        const double x = hypot(c.motion[a], c.motion[b]);
        work += h * (c.motion[b] * c.force[a] - c.motion[a] * c.force[b]);
        size += h * x * (fabs(c.force[d * s->n_coef]) + hypot(c.force[a], c.force[b]) + c.stiffness[d] * x);
      }
    const bool takes = law->smooth == CONTACT_TANH || (contact_has_friction(law) && c.report.regime >= CONTACT_SLIPS);
    const double wrong = takes ? fmax(-work, 0) : fabs(work);
    one_contact_clear(&c);
    if (st != HC_OK) return stress_refuse(s, st);
    if (isnan(work)) worst = NAN;
    else if (wrong > 0 && !isnan(worst)) worst = fmax(worst, wrong / size);
  }
  return stress_agree(worst, 1e-11);
}

/* ---- multipliers -------------------------------------------------------------------------------------- */

/* trace M^-1 C; NaN: out of memory, or M is singular. */
static double damping_trace(const model *m)
{
  const size_t n = (size_t)m->n, bytes = n * n * sizeof(double);
  double trace = 0, *lu = malloc(bytes), *product = malloc(bytes);
  int *pivot = malloc(n * sizeof *pivot);
  bool solved = lu && product && pivot;
  if (solved) {
    memcpy(lu, m->mass, bytes);
    memcpy(product, m->damping, bytes);
    solved = dense_factor(m->n, lu, pivot) == HC_OK;
  }
  if (solved) dense_solve(m->n, lu, pivot, m->n, product);
  for (size_t j = 0; j < n && solved; ++j) trace += product[j * (n + 1)];
  free(lu);
  free(product);
  free(pivot);
  return solved ? trace : NAN;
}

/* Liouville: without slip the flow contracts by the trace of M^-1 C, whatever opens and closes. 1e-6 of the
 * multipliers' product is let pass where it is above 1e-8 and the largest below 10; else it says nothing. */
stress_check stress_check_determinant(solved_scene *s)
{
  if (s->base.stability_status != HC_OK) return stress_refuse(s, s->base.stability_status);
  for (int j = 0; j < s->model->n_contacts; ++j) {
    one_contact c;
    hc_status st = one_contact_locate(s, j, s->base.x, &c);
    one_contact_clear(&c);
    if (st != HC_OK) return stress_refuse(s, st);
    const contact *law = &s->model->contacts[j].law;
    if (law->smooth == CONTACT_TANH || (contact_has_friction(law) && c.report.regime >= CONTACT_SLIPS))
      return stress_skip(STRESS_NOT_APPLICABLE);
  }
  const double expected = exp(-TWO_PI / s->omega * damping_trace(s->model));
  if (!(expected > 1e-8 && expected < 1e8 && s->base.stability.multiplier < 10))
    return stress_skip(STRESS_NOT_APPLICABLE);
  return stress_agree(fabs(s->base.stability.determinant / expected - 1), 1e-6);
}
