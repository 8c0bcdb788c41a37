/* changes.c - see changes.h. A constant force p on the structure is carried by a static displacement d: with x = d + y
 * the contacts feel y at the gap + n . d (n: normal direction), so that
 *     K d + sum_j n_j kn_j (n_j . d) [+ what the constant force is] = 0
 * and y moves as x does in the model with those gaps. A slider follows d, and feels nothing of it. */
#include "compare/verify/equations/changes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/base/message.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

enum { MOST_PAIRED_DOFS = 8 };

int verify_change_variants(const model *m, verify_change c)
{
  const int contacts = model_whole_contacts(m);
  switch (verify_changes[c].part) {
  case PART_CONTACT: return 1 + (m->n > 1 && contacts > 1 && contacts <= VERIFY_MOST_CONTACTS) * contacts;
  case PART_ONE_CONTACT: return contacts <= VERIFY_MOST_CONTACTS ? 1 + contacts : 1;
  case PART_POWER: return contacts <= VERIFY_MOST_CONTACTS ? 1 + contacts * CONTACT_POWERS : 1;
  case PART_TWO_CONTACTS: return contacts > 1 && contacts <= VERIFY_MOST_CONTACTS ? contacts * VERIFY_MOST_CONTACTS : 1;
  case PART_LOAD: return m->n <= VERIFY_MOST_DOFS ? 1 + (1 + model_highest_load(m)) * m->n : 1;
  case PART_DOF: return m->n > 1 && m->n <= VERIFY_MOST_DOFS ? 1 + m->n : 1;
  case PART_PAIR: return m->n > 1 && m->n <= MOST_PAIRED_DOFS ? 1 + m->n * m->n : 1;
  default: return 1;
  }
}

/* A change being made. */
struct changing {
  const model *of;           /* the case's */
  verify_changed how;        /* its factor: that of the table, where the change has no number */
  int which;                 /* how.which - 1: < 0 all */
  model *own;                /* the other program's */
  verify_mistakes *mistakes; /* in its equations */
  bool keep_mean;
  double *p, *offset; /* [n] room for a constant force; [responses] [length] theirs are own's plus these */
  int contact, whole; /* number in the model of the contact that is changed, and of the one that it is a part of */
  bool there;         /* own has the number of the law that is changed, even where its factor is 1 */
  bool differs;       /* the equations do, whatever own is */
};

/* ---- vectors and matrices, by columns ---- */

static void scale_all(size_t n, double factor, double *a)
{
  for (size_t i = 0; i < n; ++i) a[i] *= factor;
}

static void swap(double *a, double *b)
{
  const double kept = *a;
  *a = *b;
  *b = kept;
}

static void transpose(int n, double *A)
{
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < k; ++i) swap(&A[i + n * k], &A[k + n * i]);
}

/* Rows i and k of A exchanged, and its columns. */
static void exchange_dofs(int n, int i, int k, double *A)
{
  for (int j = 0; j < n; ++j) swap(&A[i + n * j], &A[k + n * j]);
  for (int j = 0; j < n; ++j) swap(&A[j + n * i], &A[j + n * k]);
}

/* ---- which models are the same ---- */

static bool same_numbers(size_t n, const double *a, const double *b)
{
  for (size_t i = 0; i < n; ++i)
    if (a[i] != b[i]) return false;
  return true;
}

static bool same_direction(int n, const double *a, const double *b)
{
  for (int i = 0; i < n; ++i)
    if (!(fabs(a[i] - b[i]) < 1e-12)) return false;
  return true;
}

static bool same_model(const model *a, const model *b)
{
  const size_t n = (size_t)a->n;
  if (a->n_contacts != b->n_contacts) return false;
  bool same = same_numbers(n * n, a->mass, b->mass) && same_numbers(n * n, a->damping, b->damping) &&
              same_numbers(n * n, a->stiffness, b->stiffness) && same_numbers(n, a->responses, b->responses);
  for (int l = 0; l < a->n_loads; ++l)
    same &=
        same_numbers(n, a->loads[l].cosine, b->loads[l].cosine) && same_numbers(n, a->loads[l].sine, b->loads[l].sine);
  for (int j = 0; j < a->n_contacts; ++j) {
    const model_contact *p = &a->contacts[j], *q = &b->contacts[j];
    same &= p->law.kt == q->law.kt && p->law.kn == q->law.kn && p->law.mu == q->law.mu && p->law.gap == q->law.gap &&
            p->law.load == q->law.load && p->circle == q->circle && p->law.epsilon == q->law.epsilon &&
            same_numbers(CONTACT_POWERS, p->law.power, q->law.power);
    same &= same_direction(a->n, p->tangent, q->tangent) && same_direction(a->n, p->normal, q->normal);
  }
  return same;
}

/* ---- the matrices ---- */

static hc_status scale_matrix(const changing *c, double *A)
{
  scale_all((size_t)c->own->n * (size_t)c->own->n, c->how.factor, A);
  return HC_OK;
}

static hc_status scale_mass(changing *c) { return scale_matrix(c, c->own->mass); }
static hc_status scale_damping(changing *c) { return scale_matrix(c, c->own->damping); }
static hc_status scale_stiffness(changing *c) { return scale_matrix(c, c->own->stiffness); }
static hc_status transpose_damping(changing *c) { return transpose(c->own->n, c->own->damping), HC_OK; }
static hc_status transpose_stiffness(changing *c) { return transpose(c->own->n, c->own->stiffness), HC_OK; }

/* The sums of M's rows on its diagonal. HC_BAD_INPUT: one of them is no mass. */
static hc_status lump_mass(changing *c)
{
  const int n = c->own->n;
  double *M = c->own->mass;
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (int k = 0; k < n; ++k) sum += M[i + n * k], M[i + n * k] = 0;
    if (!(sum > 0)) return HC_BAD_INPUT;
    M[i + n * i] = sum;
  }
  return HC_OK;
}

static double trace_of(int n, const double *A)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += A[(size_t)i * (size_t)(n + 1)];
  return sum;
}

/* C of the same damping ratio in every mode, the factor times the mean of theirs: M Phi diag(2 zeta omega) Phi^T M. */
static hc_status modal(changing *c)
{
  model *m = c->own;
  const double factor = c->how.factor;
  const int n = m->n;
  const size_t square = (size_t)n * (size_t)n;
  double *phi = malloc((4 * square + (size_t)n) * sizeof *phi);
  if (!phi) return HC_NO_MEMORY;
  double *P = phi + square, *room = P + square, *lambda = room + 2 * square, ratio = 0;
  hc_status st = dense_modes(n, m->stiffness, m->mass, lambda, phi);
  if (st == HC_OK) dense_congruence(n, n, phi, m->damping, room, P);
  for (int k = 0; k < n && st == HC_OK; ++k) {
    const double w = sqrt(fmax(lambda[k], 0));
    if (w > 0) ratio += factor * P[(size_t)k * (size_t)(n + 1)] / (2 * w * n);
  }
  if (st == HC_OK) dense_multiply(n, n, n, m->mass, phi, P);
  for (int k = 0; k < n && st == HC_OK; ++k)
    scale_all((size_t)n, sqrt(2 * ratio * sqrt(fmax(lambda[k], 0))), P + k * n);
  if (st == HC_OK) dense_transpose(n, n, P, room), dense_multiply(n, n, n, P, room, m->damping);
  free(phi);
  return st == HC_NO_MEMORY ? st : st == HC_OK && ratio > 0 ? HC_OK : HC_BAD_INPUT;
}

/* Damping like another matrix, of the same trace times the factor, and hysteretic times omega. HC_BAD_INPUT: it is like
 * that already. */
static hc_status damp_like(changing *c, const double *like, double omega)
{
  model *m = c->own;
  const double share = trace_of(m->n, m->damping) / trace_of(m->n, like);
  if (!(share > 0) || !isfinite(share * omega)) return HC_BAD_INPUT;
  const size_t square = (size_t)m->n * (size_t)m->n;
  double apart = 0, most = 0;
  for (size_t i = 0; i < square; ++i)
    apart = fmax(apart, fabs(m->damping[i] - share * like[i])), most = fmax(most, fabs(m->damping[i]));
  if (!c->mistakes->hysteretic && apart <= 1e-9 * most) return HC_BAD_INPUT;
  memcpy(m->damping, like, square * sizeof *like);
  scale_all(square, c->how.factor * share * omega, m->damping);
  return HC_OK;
}

static hc_status like_mass(changing *c) { return damp_like(c, c->own->mass, 1); }
static hc_status like_stiffness(changing *c) { return damp_like(c, c->own->stiffness, 1); }

static hc_status hysteretic(changing *c)
{
  const model *m = c->own;
  c->mistakes->hysteretic = true;
  return damp_like(c, m->stiffness, sqrt(trace_of(m->n, m->stiffness) / trace_of(m->n, m->mass)));
}

/* Degrees of freedom i < k exchanged in the matrices. */
static hc_status swap_matrices(changing *c)
{
  model *m = c->own;
  const int i = c->which / m->n, k = c->which % m->n;
  if (c->which < 0 || i >= k) return HC_BAD_INPUT;
  exchange_dofs(m->n, i, k, m->mass), exchange_dofs(m->n, i, k, m->damping), exchange_dofs(m->n, i, k, m->stiffness);
  return HC_OK;
}

/* And in the contacts. */
static hc_status swap_dofs(changing *c)
{
  const int i = c->which / c->own->n, k = c->which % c->own->n;
  if (c->which < 0 || i >= k) return HC_BAD_INPUT;
  for (int j = 0; j < c->own->n_contacts; ++j) {
    swap(&c->own->contacts[j].tangent[i], &c->own->contacts[j].tangent[k]);
    swap(&c->own->contacts[j].normal[i], &c->own->contacts[j].normal[k]);
  }
  return HC_OK;
}

/* ---- the loads ---- */

static void scale_load(const changing *c, double factor, model_load *load)
{
  scale_all((size_t)c->own->n, factor, load->cosine), scale_all((size_t)c->own->n, factor, load->sine);
}

static void scale_force(changing *c, model_load *load)
{
  if (load->harmonic > 0) scale_load(c, c->how.factor, load);
}

static void scale_static_load(changing *c, model_load *load)
{
  if (load->harmonic == 0) scale_load(c, c->how.factor, load);
}

static void turn_phase(changing *c, model_load *load) { scale_all((size_t)c->own->n, -1, load->sine); }

/* The number of loads of single degrees of freedom: static ones (fixed), or those of all other harmonics. */
static int count_single_loads(const model *m, bool fixed)
{
  int count = 0;
  for (int l = 0; l < m->n_loads; ++l)
    for (int i = 0; i < m->n && (m->loads[l].harmonic == 0) == fixed; ++i)
      count += m->loads[l].cosine[i] != 0 || m->loads[l].sine[i] != 0;
  return count;
}

static void scale_one_load(changing *c, model_load *load)
{
  const int n = c->of->n, i = c->which % n;
  if (c->which < 0 || c->which / n != load->harmonic || count_single_loads(c->of, load->harmonic == 0) <= 1) return;
  load->cosine[i] *= c->how.factor, load->sine[i] *= c->how.factor;
}

/* All of it to one degree of freedom. */
static void gather_load(int n, int to, double *load)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += load[i], load[i] = 0;
  load[to] = sum;
}

static void move_load(changing *c, model_load *load)
{
  if (c->which < 0 || load->harmonic == 0) return;
  gather_load(c->own->n, c->which, load->cosine), gather_load(c->own->n, c->which, load->sine);
}

/* ---- each contact that is meant ---- */

static void scale_kt(changing *c, model_contact *k) { k->law.kt *= c->how.factor; }
static void scale_kn(changing *c, model_contact *k) { k->law.kn *= c->how.factor; }
static void scale_mu(changing *c, model_contact *k) { k->law.mu *= c->how.factor; }
static void scale_gap(changing *c, model_contact *k) { k->law.gap *= c->how.factor; }

static void scale_law(changing *c, model_contact *k)
{
  const double factor = c->how.factor;
  k->law.kt *= factor, k->law.kn *= factor, k->law.load *= factor;
  scale_all(CONTACT_POWERS, factor, k->law.power);
}

static void scale_epsilon(changing *c, model_contact *k)
{
  c->there |= k->law.epsilon > 0;
  k->law.epsilon *= c->how.factor;
}

static void scale_power(changing *c, model_contact *k)
{
  for (int i = 0; i < CONTACT_POWERS; ++i)
    if (k->law.power[i] != 0 && (c->which < 0 || c->which == c->whole * CONTACT_POWERS + i))
      k->law.power[i] *= c->how.factor, c->there = true;
}

/* A polynomial with powers one higher. */
static void raise_powers(changing *c, model_contact *k)
{
  double *const power = k->law.power;
  (void)c;
  if (power[CONTACT_POWERS - 1] != 0) return;
  memmove(power + 1, power, (CONTACT_POWERS - 1) * sizeof *power);
  power[0] = 0;
}

/* One lower: the linear spring goes into K. */
static void lower_powers(changing *c, model_contact *k)
{
  double *const power = k->law.power;
  add_outer(c->own->n, power[0], k->normal, k->normal, c->own->stiffness);
  memmove(power, power + 1, (CONTACT_POWERS - 1) * sizeof *power);
  power[CONTACT_POWERS - 1] = 0;
}

/* Two contacts of a pair have half of the normal stiffness each (model.h). */
static void swap_springs(changing *c, model_contact *k)
{
  const double halves = k->pair == CONTACT_ALONE || k->pair == CONTACT_MORE ? 1 : 2, kt = k->law.kt;
  (void)c;
  if (k->law.load == 0) k->law.kt = halves * k->law.kn, k->law.kn = kt / halves;
}

/* Tangent and normal turned by an angle in the plane that they span. */
static void turn_both(changing *c, model_contact *k)
{
  const int n = c->own->n;
  double along, across;
  if (k->pair != CONTACT_ALONE || is_zero(n, k->tangent) || is_zero(n, k->normal)) return;
  model_direction(c->how.factor, &along, &across);
  for (int i = 0; i < n; ++i) {
    const double t = k->tangent[i], v = k->normal[i];
    k->tangent[i] = along * t - across * v;
    k->normal[i] = along * v + across * t;
  }
}

static void complement(changing *c, model_contact *k)
{
  (void)c;
  if (!contact_never_opens(&k->law)) swap(k->tangent, k->normal);
}

static const double degree = TWO_PI / 360;
static void take_angle(model_contact *k, double unit)
{
  if (!contact_never_opens(&k->law)) model_direction(atan2(*k->normal, *k->tangent) / unit, k->tangent, k->normal);
}

static void as_radians(changing *c, model_contact *k) { (void)c, take_angle(k, degree * degree); }
static void as_degrees(changing *c, model_contact *k) { (void)c, take_angle(k, 1); }

/* One side moves the other way: the last entry of a direction that has several. */
static void turn_last(int n, double *direction)
{
  int entries = 0, last = 0;
  for (int i = 0; i < n; ++i)
    if (direction[i] != 0) ++entries, last = i;
  if (entries > 1) direction[last] = -direction[last];
}

static void turn_one_side(changing *c, model_contact *k)
{
  turn_last(c->own->n, k->tangent), turn_last(c->own->n, k->normal);
}

/* Of a contact with two tangents: one limit for both (circle) or one for each; and no friction along the one called
 * `without`. */
static void change_pair(model_contact *k, bool circle, contact_pair without)
{
  if (k->pair == CONTACT_ALONE || k->pair == CONTACT_MORE) return;
  k->circle = circle;
  if (k->pair == without) k->law.mu = 0;
}

static void limit_squarely(changing *c, model_contact *k) { (void)c, change_pair(k, false, CONTACT_ALONE); }
static void limit_by_circle(changing *c, model_contact *k) { (void)c, change_pair(k, true, CONTACT_ALONE); }
static void no_tangent_2(changing *c, model_contact *k) { (void)c, change_pair(k, false, CONTACT_SECOND); }
static void no_tangent_1(changing *c, model_contact *k) { (void)c, change_pair(k, false, CONTACT_FIRST); }

static bool rubs(const changing *c, const model_contact *k) { return c->contact < 32 && contact_has_friction(&k->law); }

static void turn_friction(changing *c, model_contact *k)
{
  if (rubs(c, k)) c->mistakes->turned |= 1U << c->contact, c->differs = true;
  if (k->law.smooth != CONTACT_KINKED) k->law.mu = -k->law.mu;
}

static void change_mean(changing *c, const model_contact *k, verify_friction_mean mean)
{
  if (rubs(c, k)) c->mistakes->mean = mean, c->differs = true;
}

static void mean_of_u(changing *c, model_contact *k) { change_mean(c, k, FRICTION_MEAN_OF_U); }
static void drop_mean(changing *c, model_contact *k) { change_mean(c, k, FRICTION_NO_MEAN); }

/* ---- all contacts ---- */

static hc_status no_contact(changing *c) { return c->own->n_contacts = 0, HC_OK; }

/* Stuck for good. HC_BAD_INPUT: they have no stiffness. */
static hc_status stick_contacts(changing *c)
{
  model *m = c->own;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *k = &m->contacts[j];
    add_outer(m->n, k->law.kt, k->tangent, k->tangent, m->stiffness);
    add_outer(m->n, k->law.kn, k->normal, k->normal, m->stiffness);
  }
  m->n_contacts = 0;
  return same_numbers((size_t)m->n * (size_t)m->n, c->of->stiffness, m->stiffness) ? HC_BAD_INPUT : HC_OK;
}

/* The first of the *parts that whole contact number `which` is in the model. */
static model_contact *whole_contact(const model *m, int which, int *parts)
{
  int first = 0;
  for (int whole = -1; first < m->n_contacts; ++first)
    if ((whole += !contact_goes_on(m->contacts[first].pair)) == which) break;
  for (*parts = 1; first + *parts < m->n_contacts && contact_goes_on(m->contacts[first + *parts].pair);) ++*parts;
  return &m->contacts[first];
}

/* kt of two whole contacts, and kn where both have a normal spring; of a pair each of the two has half of kn. Not of
 * smooth ones, nor of those that are several springs across. */
static hc_status swap_contacts(changing *c)
{
  const int i = c->which / VERIFY_MOST_CONTACTS, k = c->which % VERIFY_MOST_CONTACTS;
  if (c->which < 0 || i >= k || k >= model_whole_contacts(c->of)) return HC_BAD_INPUT;
  int n[2];
  model_contact *both[2] = {whole_contact(c->own, i, &n[0]), whole_contact(c->own, k, &n[1])};
  for (int a = 0; a < 2; ++a)
    if (both[a]->law.smooth != CONTACT_KINKED || (n[a] > 1 && both[a][1].pair == CONTACT_MORE)) return HC_BAD_INPUT;
  const contact law[2] = {both[0]->law, both[1]->law};
  const bool normal = law[0].load == 0 && law[1].load == 0, tangential = law[0].mu > 0 && law[1].mu > 0;
  for (int a = 0; a < 2; ++a)
    for (int j = 0; j < n[a]; ++j) {
      if (tangential) both[a][j].law.kt = law[!a].kt;
      if (normal) both[a][j].law.kn = law[!a].kn * n[!a] / n[a];
    }
  return HC_OK;
}

/* d := A^-1 d; A[n][n] becomes its factors. HC_BAD_INPUT: nothing holds the structure. */
static hc_status solve_static_force(int n, double *A, double *d)
{
  if (n == 1 && !(*A > 0)) return HC_BAD_INPUT;
  int *pivot = malloc((size_t)n * sizeof *pivot);
  if (!pivot) return HC_NO_MEMORY;
  const bool factored = dense_factor(n, A, pivot) == HC_OK;
  if (factored) dense_solve(n, A, pivot, 1, d);
  free(pivot);
  return factored ? HC_OK : HC_BAD_INPUT;
}

/* The displacement by a constant force[n], with mean_factor times the contacts' force in the balance; the gaps follow
 * it, offset[r] is what response r gets of it. HC_BAD_INPUT if that opens a contact under preload. */
static hc_status displace(model *m, double *force, double mean_factor, bool all_linear, double *offset)
{
  const int n = m->n;
  double *K = malloc((size_t)n * (size_t)n * sizeof *K);
  if (!K) return HC_NO_MEMORY;
  memcpy(K, m->stiffness, (size_t)n * (size_t)n * sizeof *K);
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    if (all_linear || c->law.gap > 0) add_outer(n, mean_factor * c->law.kn, c->normal, c->normal, K);
  }
  hc_status st = solve_static_force(n, K, force);
  free(K);
  if (st != HC_OK) return st;
  for (int r = 0; r < m->n_responses; ++r) offset[r] = dot_product(n, m->responses + (size_t)r * (size_t)n, force);
  /* The contacts' gaps follow the displacement d. HC_BAD_INPUT if that opens a contact under preload. */
  for (int j = 0; j < m->n_contacts; ++j) {
    model_contact *c = &m->contacts[j];
    const double before = c->law.gap;
    if (is_zero(m->n, c->normal)) continue;
    if (contact_never_opens(&c->law) && dot_product(n, c->normal, force) != 0) return HC_BAD_INPUT;
    c->law.gap += dot_product(m->n, c->normal, force);
    if (!all_linear && (c->law.gap > 0) != (before > 0)) return HC_BAD_INPUT;
  }
  return HC_OK;
}

/* p[n] = factor sum_j n_j kn_j gap_j of the contacts under preload, or of those with a clearance. */
static void static_force(const model *m, bool preloaded, double factor, double *p)
{
  memset(p, 0, (size_t)m->n * sizeof *p);
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    for (int i = 0; i < m->n && (c->law.gap > 0) == preloaded; ++i) p[i] += c->normal[i] * c->law.kn * c->law.gap;
  }
  scale_all((size_t)m->n, factor, p);
}

static hc_status mean(changing *c)
{
  c->mistakes->mean_error = c->how.factor - 1;
  c->differs = true;
  return HC_OK;
}

static hc_status mean_of_n(changing *c)
{
  static_force(c->of, true, 1, c->p);
  if (is_zero(c->of->n, c->p)) return HC_BAD_INPUT;
  scale_all((size_t)c->of->n, -(c->how.factor - 1), c->p);
  return mean(c), displace(c->own, c->p, c->how.factor, false, c->offset);
}

static hc_status add_preload(changing *c)
{
  static_force(c->of, true, -1, c->p);
  c->differs = true;
  return is_zero(c->of->n, c->p) ? HC_BAD_INPUT : displace(c->own, c->p, 1, false, c->offset);
}

/* Each contact and a second one. Without separation that is on the other side, and pulls where the first would be
 * separated: max(kn g, 0) - max(-kn g, 0) = kn g. Of a constant limit it is T with N0; N is left to the first. */
static hc_status doubled(changing *c)
{
  model *m = c->own;
  const verify_change change = c->how.change;
  const int n = m->n_contacts; /* there is room for twice as many */
  const bool linear = change == CHANGE_NO_SEPARATION || change == CHANGE_NO_SEPARATION_PULLS;
  static_force(m, false, -1, c->p);
  const hc_status st = linear && c->keep_mean ? displace(m, c->p, 1, true, c->offset) : HC_OK;
  for (int j = 0; j < n; ++j) {
    model_contact *k = &m->contacts[j], *added = &m->contacts[n + j];
    /* Its normal force is constant as it is, or there is none: the other is nothing. */
    if (k->law.load > 0 || contact_never_opens(&k->law)) continue;
    added->law = k->law;
    added->pair = k->pair, added->circle = k->circle;
    for (int i = 0; i < m->n; ++i) added->tangent[i] = k->tangent[i], added->normal[i] = linear ? -k->normal[i] : 0;
    if (linear) added->law.gap = -k->law.gap;
    if (linear && change != CHANGE_NO_SEPARATION_PULLS) added->law.kt = added->law.mu = 0;
    if (!linear) k->law.kt = k->law.mu = 0;
    if (change == CHANGE_CONSTANT_LIMIT_LINEAR) add_outer(m->n, k->law.kn, k->normal, k->normal, m->stiffness);
    if (change == CHANGE_CONSTANT_LIMIT_LINEAR || change == CHANGE_CONSTANT_N) k->law.kn = 0;
  }
  m->n_contacts = 2 * n;
  return st;
}

/* ---- the table ---- */

const verify_change_kind verify_changes[] = {
#define VERIFY_CHANGE_ROW(code, cause, words, scan, part, in, ...)                                                     \
  {CAUSE_##cause, words, SCAN_##scan, PART_##part, IN_##in, __VA_ARGS__},
    VERIFY_CHANGE_LIST(VERIFY_CHANGE_ROW)
#undef VERIFY_CHANGE_ROW
};
_Static_assert(CHANGE_SLIDER_ON_SAMPLE - VERIFY_MODEL_CHANGES == HBM_RESTART_SAMPLE, "in the order of hbm_restart");

bool verify_change_applies(const model *m, verify_change c, bool keep_mean)
{
  unsigned in = m->n > 1 ? IN_STRUCTURE : m->n_contacts > 0 ? IN_ANGLE : 0;
  if (keep_mean) in |= IN_MEAN;
  if (m->n_contacts > 0) in |= IN_CONTACT;
  if (model_whole_contacts(m) < m->n_contacts) in |= IN_PARTS;
  for (int j = 0; j < m->n_contacts; ++j)
    if (m->contacts[j].law.gap > 0) in |= IN_PRELOAD;
  return (verify_changes[c].in & ~in) == 0;
}

static hc_status make_change(changing *c)
{
  const verify_change_kind *kind = &verify_changes[c->how.change];
  model *own = c->own;
  if (!kind->scan) c->how.factor = kind->times;
  const hc_status st = kind->model ? kind->model(c) : HC_OK;
  if (st != HC_OK) return st;
  for (int l = 0; l < own->n_loads && kind->load; ++l) kind->load(c, &own->loads[l]);
  for (c->whole = -1; c->contact < own->n_contacts && kind->contact; ++c->contact) {
    c->whole += !contact_goes_on(own->contacts[c->contact].pair);
    if (c->which < 0 || c->which == c->whole || kind->part == PART_POWER) kind->contact(c, &own->contacts[c->contact]);
  }
  if ((kind->part == PART_POWER || c->how.change == CHANGE_EPSILON) && !c->there) return HC_BAD_INPUT;
  /* A fit passes through the factor that changes nothing. */
  c->differs |= kind->scan && c->how.factor == (kind->scan == SCAN_TURN ? 0 : 1);
  return c->differs || !same_model(c->of, own) ? HC_OK : HC_BAD_INPUT;
}

hc_status verify_changed_model(const model *m, const verify_changed *how, bool keep_mean, model **out, double *offset,
                               verify_mistakes *mistakes)
{
  *out = NULL;
  memset(offset, 0, (size_t)m->n_responses * sizeof *offset);
  if (!verify_change_applies(m, how->change, keep_mean)) return HC_BAD_INPUT;
  changing c = {.of = m, .how = *how, .which = how->which - 1, .keep_mean = keep_mean, .mistakes = mistakes};
  c.offset = offset;
  c.p = malloc((size_t)m->n * sizeof *c.p);
  hc_status st = c.p ? model_copy_sized(m, 2 * m->n_contacts, m->n_responses, out) : HC_NO_MEMORY;
  if (st == HC_OK) {
    c.own = *out;
    c.own->n_contacts = m->n_contacts;
    if (how->change != CHANGE_NONE) st = make_change(&c);
  }
  for (int l = 0; st == HC_OK && mistakes->odd_only && l < c.own->n_loads; ++l)
    if (c.own->loads[l].harmonic > 0 && c.own->loads[l].harmonic % 2 == 0) scale_load(&c, 0, &c.own->loads[l]);
  free(c.p);
  if (st == HC_OK) return HC_OK;
  model_free(*out);
  *out = NULL;
  return st;
}

/* ---- the causes ---- */

_Static_assert((int)CAUSE_OUTLIER <= (int)VERIFY_MOST_BITS, "one bit each");

static const struct {
  const char *word, *meaning, *remedy;
} causes[] = {
#define VERIFY_CAUSE_WORDS(code, word, meaning, remedy) {word, meaning, remedy},
    VERIFY_CAUSE_LIST(VERIFY_CAUSE_WORDS)
#undef VERIFY_CAUSE_WORDS
};

const char *verify_cause_meaning(int cause) { return causes[cause].meaning; }
const char *verify_cause_remedy(int cause) { return causes[cause].remedy; }

const char *verify_cause_words(verify_causes bits, char text[VERIFY_TEXT])
{
  message m;
  message_start(&m, text, VERIFY_TEXT);
  for (int i = 0; i < VERIFY_CAUSES; ++i)
    if (verify_has(bits, i)) message_add(&m, "%s%s", m.used ? "+" : "", causes[i].word);
  if (!m.used) message_add(&m, "none");
  return text;
}

int verify_cause_count(verify_causes bits)
{
  int n = 0;
  for (; bits; bits &= bits - 1) ++n;
  return n;
}
