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

const verify_change_kind verify_changes[] = {
#define VERIFY_CHANGE_WORDS(code, cause, words, scan, part) {cause, words, scan, part},
    VERIFY_CHANGE_LIST(VERIFY_CHANGE_WORDS)
#undef VERIFY_CHANGE_WORDS
};

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

/* ---- vectors and matrices, by columns ---- */

static void scale(size_t n, double factor, double *a)
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
static void exchange(int n, int i, int k, double *A)
{
  for (int j = 0; j < n; ++j) swap(&A[i + n * j], &A[k + n * j]);
  for (int j = 0; j < n; ++j) swap(&A[j + n * i], &A[j + n * k]);
}

/* ---- numbers of the model ---- */

static void turn(int n, model_contact *c, double angle_deg)
{
  if (n == 1 && !contact_never_opens(&c->law)) model_direction(angle_deg, c->tangent, c->normal);
}

/* One side of the contact moves the other way: the last entry of a direction that has several. */
static void turn_one_side(int n, double *direction)
{
  int entries = 0, last = 0;
  for (int i = 0; i < n; ++i)
    if (direction[i] != 0) ++entries, last = i;
  if (entries > 1) direction[last] = -direction[last];
}

/* Tangent and normal by an angle in the plane that they span. */
static void turn_both(int n, model_contact *c, double angle_deg)
{
  double along, across;
  model_direction(angle_deg, &along, &across);
  for (int i = 0; i < n; ++i) {
    const double t = c->tangent[i], v = c->normal[i];
    c->tangent[i] = along * t - across * v;
    c->normal[i] = along * v + across * t;
  }
}

/* Each direction by itself, or only one of the two. */
static void change_pair(model_contact *c, verify_change change)
{
  const contact_pair without = change == CHANGE_NO_TANGENT_1 ? CONTACT_FIRST : CONTACT_SECOND;
  if (c->pair == CONTACT_ALONE || c->pair == CONTACT_MORE) return;
  c->circle = change == CHANGE_CIRCLE_LIMIT;
  if ((change == CHANGE_NO_TANGENT_1 || change == CHANGE_NO_TANGENT_2) && c->pair == without) c->law.mu = 0;
}

/* A polynomial with powers one higher or lower; of lowered ones the linear spring goes into K. */
static void change_powers(model *m, model_contact *c, bool up)
{
  double *const k = c->law.power;
  if (up && k[CONTACT_POWERS - 1] != 0) return;
  if (!up) add_outer(m->n, k[0], c->normal, c->normal, m->stiffness);
  memmove(k + up, k + !up, (CONTACT_POWERS - 1) * sizeof *k);
  k[up ? 0 : CONTACT_POWERS - 1] = 0;
}

static void change_contact(int n, model_contact *c, verify_change change, double factor)
{
  /* two contacts of a pair have half of the normal stiffness each (model.h) */
  const double halves = c->pair == CONTACT_ALONE || c->pair == CONTACT_MORE ? 1 : 2;
  const double kt = c->law.kt, angle = n == 1 ? atan2(*c->normal, *c->tangent) : 0, degree = TWO_PI / 360;
  switch (change) {
  case CHANGE_KT: c->law.kt *= factor; break;
  case CHANGE_KN: c->law.kn *= factor; break;
  case CHANGE_FRICTION: c->law.mu *= factor; break;
  case CHANGE_GAP: c->law.gap *= factor; break;
  case CHANGE_TURNED:
    if (c->pair == CONTACT_ALONE && !is_zero(n, c->tangent) && !is_zero(n, c->normal)) turn_both(n, c, factor);
    break;
  case CHANGE_CONTACT_FORCE:
    c->law.kt *= factor, c->law.kn *= factor, c->law.load *= factor;
    scale(CONTACT_POWERS, factor, c->law.power);
    break;
  case CHANGE_EPSILON: c->law.epsilon *= factor; break;
  case CHANGE_GAP_SIGN: c->law.gap = -c->law.gap; break;
  case CHANGE_ANGLE_COMPLEMENT:
    if (n == 1 && !contact_never_opens(&c->law)) swap(c->tangent, c->normal);
    break;
  case CHANGE_ANGLE_IN_RADIANS: turn(n, c, angle / (degree * degree)); break;
  case CHANGE_ANGLE_IN_DEGREES: turn(n, c, angle); break;
  case CHANGE_EXCHANGED:
    if (c->law.load == 0) c->law.kt = halves * c->law.kn, c->law.kn = kt / halves;
    break;
  case CHANGE_NO_FRICTION: c->law.mu = 0; break;
  case CHANGE_NO_KT: c->law.kt = 0; break;
  case CHANGE_SQUARE_LIMIT:
  case CHANGE_CIRCLE_LIMIT:
  case CHANGE_NO_TANGENT_2:
  case CHANGE_NO_TANGENT_1: change_pair(c, change); break;
  case CHANGE_ONE_SIDE: turn_one_side(n, c->tangent), turn_one_side(n, c->normal); break;
  default: break;
  }
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

/* kt of whole contacts i < k, and kn where both have a normal spring; of a pair each of the two has half of kn. Not of
 * smooth ones, nor of those that are several springs across. */
static void exchange_contacts(const model *m, int i, int k)
{
  int n[2];
  model_contact *c[2] = {whole_contact(m, i, &n[0]), whole_contact(m, k, &n[1])};
  for (int a = 0; a < 2; ++a)
    if (c[a]->law.smooth != CONTACT_KINKED || (n[a] > 1 && c[a][1].pair == CONTACT_MORE)) return;
  const contact law[2] = {c[0]->law, c[1]->law};
  const bool normal = law[0].load == 0 && law[1].load == 0, tangential = law[0].mu > 0 && law[1].mu > 0;
  for (int a = 0; a < 2; ++a)
    for (int j = 0; j < n[a]; ++j) {
      if (tangential) c[a][j].law.kt = law[!a].kt;
      if (normal) c[a][j].law.kn = law[!a].kn * n[!a] / n[a];
    }
}

/* The sums of M's rows on its diagonal. HC_BAD_INPUT: one of them is no mass. */
static hc_status lump(int n, double *M)
{
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (int k = 0; k < n; ++k) sum += M[i + n * k], M[i + n * k] = 0;
    if (!(sum > 0)) return HC_BAD_INPUT;
    M[i + n * i] = sum;
  }
  return HC_OK;
}

static void change_matrices(model *m, verify_change change, double factor)
{
  const size_t entries = (size_t)m->n * (size_t)m->n;
  if (change == CHANGE_MASS) scale(entries, factor, m->mass);
  if (change == CHANGE_DAMPING) scale(entries, factor, m->damping);
  if (change == CHANGE_STIFFNESS) scale(entries, factor, m->stiffness);
  /* Every contact stuck for good. */
  if (change == CHANGE_STUCK) {
    for (int j = 0; j < m->n_contacts; ++j) {
      const model_contact *c = &m->contacts[j];
      add_outer(m->n, c->law.kt, c->tangent, c->tangent, m->stiffness);
      add_outer(m->n, c->law.kn, c->normal, c->normal, m->stiffness);
    }
  }
  if (change == CHANGE_STUCK || change == CHANGE_NO_CONTACT) m->n_contacts = 0;
  if (change == CHANGE_DAMPING_TRANSPOSED) transpose(m->n, m->damping);
  if (change == CHANGE_STIFFNESS_TRANSPOSED) transpose(m->n, m->stiffness);
}

static double trace(int n, const double *A)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += A[(size_t)i * (size_t)(n + 1)];
  return sum;
}

/* C of the same damping ratio in every mode, the factor times the mean of theirs: M Phi diag(2 zeta omega) Phi^T M. */
static hc_status damp_modes(model *m, double factor)
{
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
  for (int k = 0; k < n && st == HC_OK; ++k) scale((size_t)n, sqrt(2 * ratio * sqrt(fmax(lambda[k], 0))), P + k * n);
  if (st == HC_OK) dense_transpose(n, n, P, room), dense_multiply(n, n, n, P, room, m->damping);
  free(phi);
  return st == HC_NO_MEMORY ? st : st == HC_OK && ratio > 0 ? HC_OK : HC_BAD_INPUT;
}

/* Damping of another kind, of the same trace times the factor. */
static hc_status change_damping(model *m, verify_change change, double factor)
{
  const double *like = change == CHANGE_DAMPING_OF_M ? m->mass : m->stiffness;
  const double stiff = trace(m->n, m->stiffness), share = trace(m->n, m->damping) / trace(m->n, like),
               omega = change == CHANGE_HYSTERETIC ? sqrt(stiff / trace(m->n, m->mass)) : 1;
  if (!verify_change_of_kind(change)) return HC_OK;
  if (m->n == 1 && change != CHANGE_HYSTERETIC) return HC_BAD_INPUT;
  if (change == CHANGE_DAMPING_MODAL) return damp_modes(m, factor);
  if (!(share > 0) || !isfinite(share * omega)) return HC_BAD_INPUT;
  const size_t square = (size_t)m->n * (size_t)m->n;
  double apart = 0, most = 0;
  for (size_t i = 0; i < square; ++i)
    apart = fmax(apart, fabs(m->damping[i] - share * like[i])), most = fmax(most, fabs(m->damping[i]));
  if (change != CHANGE_HYSTERETIC && apart <= 1e-9 * most) return HC_BAD_INPUT; /* it is of this kind */
  memcpy(m->damping, like, square * sizeof *like);
  scale(square, factor * share * omega, m->damping);
  return HC_OK;
}

/* The number of loads of single degrees of freedom: static ones (fixed), or those of all other harmonics. */
static int count_loads(const model *m, bool fixed)
{
  int count = 0;
  for (int l = 0; l < m->n_loads; ++l)
    for (int i = 0; i < m->n && (m->loads[l].harmonic == 0) == fixed; ++i)
      count += m->loads[l].cosine[i] != 0 || m->loads[l].sine[i] != 0;
  return count;
}

static void move_load(int n, int to, double *load)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += load[i], load[i] = 0;
  load[to] = sum;
}

/* Degrees of freedom i and k exchanged in the matrices, or in the contacts. */
static void change_numbering(model *m, verify_change change, int i, int k)
{
  if (i >= k) return;
  if (change == CHANGE_MATRICES_EXCHANGED)
    exchange(m->n, i, k, m->mass), exchange(m->n, i, k, m->damping), exchange(m->n, i, k, m->stiffness);
  for (int j = 0; j < m->n_contacts && change == CHANGE_CONTACT_DOFS_EXCHANGED; ++j) {
    swap(&m->contacts[j].tangent[i], &m->contacts[j].tangent[k]);
    swap(&m->contacts[j].normal[i], &m->contacts[j].normal[k]);
  }
}

/* ---- constant forces ---- */

/* d := A^-1 d; A[n][n] becomes its factors. HC_BAD_INPUT: nothing holds the structure. */
static hc_status solve(int n, double *A, double *d)
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
  hc_status st = solve(n, K, force);
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
  scale((size_t)m->n, factor, p);
}

/* ---- more contacts ---- */

/* Each contact and a second one. Without separation that is on the other side, and pulls where the first would be
 * separated: max(kn g, 0) - max(-kn g, 0) = kn g. Of a constant limit it is T with N0; N is left to the first. */
static hc_status double_contacts(const model *m, verify_change change, bool keep_mean, double *p, model **out,
                                 double *offset)
{
  const int n = m->n_contacts;
  hc_status st = model_copy_sized(m, 2 * n, m->n_responses, out);
  if (st != HC_OK) return st;
  model_contact *contacts = (*out)->contacts;
  (*out)->n_contacts = n; /* the others follow */
  const bool linear = change == CHANGE_NO_SEPARATION || change == CHANGE_NO_SEPARATION_PULLS;
  static_force(*out, false, -1, p);
  if (linear && keep_mean) st = displace(*out, p, 1, true, offset);
  for (int j = 0; j < n; ++j) {
    model_contact *c = &contacts[j], *added = &contacts[n + j];
    /* Its normal force is constant as it is, or there is none: the other is nothing. */
    if (c->law.load > 0 || contact_never_opens(&c->law)) continue;
    added->law = c->law;
    added->pair = c->pair, added->circle = c->circle;
    for (int i = 0; i < m->n; ++i) added->tangent[i] = c->tangent[i], added->normal[i] = linear ? -c->normal[i] : 0;
    if (linear) added->law.gap = -c->law.gap;
    if (linear && change != CHANGE_NO_SEPARATION_PULLS) added->law.kt = added->law.mu = 0;
    if (!linear) c->law.kt = c->law.mu = 0;
    if (change == CHANGE_CONSTANT_LIMIT_LINEAR) add_outer(m->n, c->law.kn, c->normal, c->normal, (*out)->stiffness);
    if (change == CHANGE_CONSTANT_LIMIT_LINEAR || change == CHANGE_CONSTANT_N) c->law.kn = 0;
  }
  (*out)->n_contacts = 2 * n;
  return st;
}

/* ---- all of them ---- */

static bool doubles(verify_change c) { return c >= CHANGE_NO_SEPARATION && c <= CHANGE_CONSTANT_LIMIT_LINEAR; }

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

static bool any_preload(const model *m)
{
  bool any = false;
  for (int j = 0; j < m->n_contacts; ++j) any |= m->contacts[j].law.gap > 0;
  return any;
}

/* p[n]: room for a constant force. */
static hc_status change_copy(const model *m, const verify_changed *how, bool keep_mean, double *p, model *own,
                             double *offset, verify_mistakes *mistakes)
{
  const verify_change c = how->change;
  const int which = how->which - 1;
  change_matrices(own, c, how->factor);
  const hc_status damped = change_damping(own, c, how->factor);
  if (damped != HC_OK) return damped;
  mistakes->hysteretic = c == CHANGE_HYSTERETIC;
  if (c == CHANGE_LUMPED && lump(own->n, own->mass) != HC_OK) return HC_BAD_INPUT;
  if (c == CHANGE_CONTACTS_EXCHANGED && which / VERIFY_MOST_CONTACTS < which % VERIFY_MOST_CONTACTS &&
      which % VERIFY_MOST_CONTACTS < model_whole_contacts(m))
    exchange_contacts(own, which / VERIFY_MOST_CONTACTS, which % VERIFY_MOST_CONTACTS);
  const double one_load = c == CHANGE_LOAD_SIGN ? -1 : how->factor;
  const size_t n = (size_t)own->n;
  for (int l = 0; l < own->n_loads; ++l) {
    model_load *load = &own->loads[l];
    const bool fixed = load->harmonic == 0;
    if (c == CHANGE_FORCE && !fixed) scale(n, how->factor, load->cosine), scale(n, how->factor, load->sine);
    if (c == CHANGE_STATIC_LOAD && fixed) scale(n, how->factor, load->cosine);
    if (c == CHANGE_PHASE_SIGN) scale(n, -1, load->sine);
    if (verify_changes[c].part == PART_LOAD && which >= 0 && which / m->n == load->harmonic &&
        count_loads(m, fixed) > 1)
      load->cosine[which % m->n] *= one_load, load->sine[which % m->n] *= one_load;
    if (c == CHANGE_LOAD_DOF && which >= 0 && !fixed)
      move_load(own->n, which, load->cosine), move_load(own->n, which, load->sine);
  }
  if (verify_changes[c].part == PART_PAIR && which >= 0) change_numbering(own, c, which / m->n, which % m->n);
  const bool of_power = verify_changes[c].part == PART_POWER;
  bool there = false; /* of a law's own number: even where its factor is 1 */
  for (int j = 0, whole = -1; j < own->n_contacts; ++j) {
    model_contact *one = &own->contacts[j];
    whole += !contact_goes_on(one->pair);
    const bool meant = which < 0 || which == whole;
    if (meant) change_contact(m->n, one, c, how->factor);
    if (meant && (c == CHANGE_POWER_UP || c == CHANGE_POWER_DOWN)) change_powers(own, one, c == CHANGE_POWER_UP);
    for (int i = 0; i < CONTACT_POWERS && of_power; ++i)
      if (one->law.power[i] != 0 && (which < 0 || which == whole * CONTACT_POWERS + i))
        one->law.power[i] *= c == CHANGE_COEFFICIENT ? how->factor : -1, there = true;
    there |= meant && one->law.epsilon > 0;
    const bool rubs = j < 32 && contact_has_friction(&one->law);
    if (c == CHANGE_FRICTION_SIGN && rubs && meant) mistakes->turned |= 1U << j;
    if (c == CHANGE_FRICTION_SIGN && one->law.smooth != CONTACT_KINKED && meant) one->law.mu = -one->law.mu;
    if (c == CHANGE_SLIDER_MEAN && rubs) mistakes->mean = FRICTION_MEAN_OF_U;
    if (c == CHANGE_FRICTION_MEAN && rubs) mistakes->mean = FRICTION_NO_MEAN;
  }
  if (c == CHANGE_STUCK && same_numbers(n * n, m->stiffness, own->stiffness)) return HC_BAD_INPUT; /* no contact */
  if ((of_power || c == CHANGE_EPSILON) && !there) return HC_BAD_INPUT;
  if (c >= CHANGE_FRICTION_SIGN && c <= CHANGE_FRICTION_MEAN && same_model(m, own))
    return mistakes->turned || (m->n > 1 && mistakes->mean && keep_mean) ? HC_OK : HC_BAD_INPUT;
  static_force(m, true, 1, p);
  const bool preload = !is_zero(m->n, p);
  if (c == CHANGE_MEAN || c == CHANGE_MEAN_OF_N) {
    if (!keep_mean || m->n_contacts == 0) return HC_BAD_INPUT;
    mistakes->mean_error = how->factor - 1;
    if (c == CHANGE_MEAN) return HC_OK;
    scale((size_t)m->n, -(how->factor - 1), p);
    return preload ? displace(own, p, how->factor, false, offset) : HC_BAD_INPUT;
  }
  if (c == CHANGE_PRELOAD_ADDED && (!keep_mean || !preload)) return HC_BAD_INPUT;
  scale((size_t)m->n, -1, p);
  if (c == CHANGE_PRELOAD_ADDED) return displace(own, p, 1, false, offset);
  /* A fit passes through it. */
  const double none = verify_changes[c].scan == SCAN_TURN ? 0 : 1;
  return (verify_changes[c].scan && how->factor == none) || !same_model(m, own) ? HC_OK : HC_BAD_INPUT;
}

hc_status verify_changed_model(const model *m, const verify_changed *how, bool keep_mean, model **out, double *offset,
                               verify_mistakes *mistakes)
{
  const verify_change c = how->change;
  const bool constant = c >= CHANGE_CONSTANT_N && c <= CHANGE_CONSTANT_LIMIT_LINEAR;
  *out = NULL;
  memset(offset, 0, (size_t)m->n_responses * sizeof *offset);
  if (doubles(c) && (m->n_contacts == 0 || (constant && !any_preload(m)))) return HC_BAD_INPUT;
  double *p = malloc((size_t)m->n * sizeof *p);
  if (!p) return HC_NO_MEMORY;
  hc_status st = doubles(c) ? double_contacts(m, c, keep_mean, p, out, offset) : model_copy(m, out);
  if (st == HC_OK && c != CHANGE_NONE && !doubles(c)) st = change_copy(m, how, keep_mean, p, *out, offset, mistakes);
  free(p);
  for (int l = 0; st == HC_OK && mistakes->odd_only && l < (*out)->n_loads; ++l) {
    model_load *load = &(*out)->loads[l];
    if (load->harmonic > 0 && load->harmonic % 2 == 0)
      scale((size_t)m->n, 0, load->cosine), scale((size_t)m->n, 0, load->sine);
  }
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
