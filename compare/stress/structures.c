/* structures.c - random structures, see scenes.h.
 *
 * 1 to 12 degrees of freedom: chains, trees, full matrices; 1 to 6 contacts: Jenkins elements, unilateral springs,
 * friction under a normal force that moves, along single degrees of freedom, differences and mixtures, one in three of
 * them along what another one has already; stiffness of a contact 1e-2..1e3 of the structure's, mu 0..1.5; damping by
 * Rayleigh, modal, mode by mode or a full matrix, with a gyroscopic part in some and a circulatory in few; up to three
 * loads of harmonics up to 5 with phases, and a static one; H 1..20. Friction limits and gaps are of the order of
 * what the structure without contacts does at that frequency: far from it nothing happens. What the numbers are many
 * of (matrices, directions) comes from a generator of its own for each scene, all else from the Sobol point. In two
 * scenes of five contacts become polynomials, tables or tanh friction, by a generator of their own; in one of six one
 * degree of freedom hangs on a cubic spring; in one of 24 each contact across which a spring acts faces its like. */
#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/stress/scenes.h"
#include "model/casefile/case_file.h"
#include "model/casefile/fields.h"
#include "model/casefile/structure.h"
#include "model/modes.h"
#include "numerics/dense.h"
#include "numerics/norm.h"
#include "numerics/random.h"

enum { DOFS, CONTACTS, SHAPE, HELD, MASS, STIFFNESS, LENGTH, DAMPING, RATIO, TURNING, LOADS, STATIC, MODE, BETWEEN };
enum { BESIDE = BETWEEN + 1, HARMONICS, KEEP_MEAN, CONTACT_STIFFNESS };
enum { MOST_DOFS = 12, MOST_CONTACTS = 6, MOST_HARMONICS = 20, MOST_UNKNOWNS = 250, MOST_OSCILLATIONS = 200 };

#define AT(A, i, j) ((A)[(size_t)(i) + (size_t)n * (size_t)(j)])

static double geometric(uint64_t *r, double from, double to) { return from * pow(to / from, random_unit(r)); }

/* ---- matrices ---------------------------------------------------------------------------------- */

/* A += k d d^T, d = e_i - e_j, or e_i alone for j < 0. */
static void add_between(int n, double *A, double k, int i, int j)
{
  AT(A, i, i) += k;
  if (j < 0) return;
  AT(A, j, j) += k;
  AT(A, i, j) -= k;
  AT(A, j, i) -= k;
}

/* A += scale v v^T for n random v. */
static void add_full(uint64_t *r, int n, double *A, double scale)
{
  for (int k = 0; k < n; ++k) {
    double v[MOST_DOFS];
    for (int i = 0; i < n; ++i) v[i] = random_signed(r);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) AT(A, i, j) += scale * v[i] * v[j];
  }
}

/* A += scale (G - G^T) */
static void add_skew(uint64_t *r, int n, double *A, double scale)
{
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < j; ++i) {
      const double g = scale * random_signed(r);
      AT(A, i, j) += g;
      AT(A, j, i) -= g;
    }
}

/* Damping of the order of `ratio` of critical. */
static hc_status draw_damping(uint64_t *r, const double *p, scene_structure *s)
{
  const double ratio = p[RATIO] < 0.05 ? 0 : 1e-4 * pow(3000, p[RATIO]), by = p[TURNING];
  const int n = s->n;
  s->how = (structure_damping)fmin(4 * p[DAMPING], 3);
  s->rayleigh[0] = s->rayleigh[1] = ratio;
  s->modal = ratio;
  if (s->how == STRUCTURE_DAMPING_MODES) {
    if (!(s->ratios = calloc((size_t)n, sizeof *s->ratios))) return HC_NO_MEMORY;
    for (int i = 0; i < n; ++i) s->ratios[i] = ratio * geometric(r, 0.1, 3);
  }
  if (s->how != STRUCTURE_DAMPING_MATRIX) return HC_OK;
  if (!(s->damping.v = calloc((size_t)n * (size_t)n, sizeof(double)))) return HC_NO_MEMORY;
  for (int i = 0; i < n; ++i) AT(s->damping.v, i, i) = ratio * geometric(r, 0.5, 5);
  add_full(r, n, s->damping.v, ratio / n);
  if (by < 0.4) add_skew(r, n, s->damping.v, 0.5);
  if (by > 0.8) add_skew(r, n, s->stiffness.v, 0.05);
  return HC_OK;
}

/* ---- contacts and loads -------------------------------------------------------------------------- */

/* Entries d[n] of a degree of freedom, of a difference of two, or of all. Not all are 0. */
static void draw_direction(uint64_t *r, int n, double *d)
{
  const double kind = random_unit(r);
  memset(d, 0, (size_t)n * sizeof *d);
  d[random_int(r, 0, n - 1)] = 1;
  if (kind > 0.4) d[random_int(r, 0, n - 1)] -= kind < 0.7 ? 1 : random_signed(r);
  for (int i = 0; i < n && kind > 0.9; ++i) d[i] = random_signed(r);
  for (int i = 0; i < n; ++i)
    if (d[i] != 0) return;
  d[0] = 1; /* e_i - e_i */
}

static void draw_contact(uint64_t *r, double stiffness, scene_structure *s, structure_contact *c)
{
  const int n = s->n;
  const double kind = random_unit(r);
  scene_contact *g = &c->given;
  field_contact_defaults(g);
  g->angle_deg = 0;
  g->law = (contact){.kt = stiffness * geometric(r, 0.1, 10), .kn = stiffness * geometric(r, 0.1, 10)};
  g->law.mu = random_unit(r) < 0.05 ? 0 : 1.5 * random_unit(r);
  draw_direction(r, n, c->tangent);
  draw_direction(r, n, c->normal);
  const structure_contact *like = &s->contacts[random_int(r, 0, s->n_contacts - 1)];
  if (random_unit(r) < 0.33)
    memcpy(c->tangent, random_unit(r) < 0.5 ? like->tangent : like->normal, (size_t)n * sizeof *c->normal);
  if (random_unit(r) < 0.33)
    memcpy(c->normal, random_unit(r) < 0.5 ? like->tangent : like->normal, (size_t)n * sizeof *c->normal);
  bool tangent = false, normal = false;
  for (int i = 0; i < n; ++i) tangent |= c->tangent[i] != 0, normal |= c->normal[i] != 0;
  if (kind < 0.25 || !normal) { /* a Jenkins element */
    memset(c->normal, 0, (size_t)n * sizeof *c->normal);
    g->law.kn = 0;
    if (!tangent) c->tangent[0] = 1;
  } else if (kind < 0.5 || !tangent) { /* a unilateral spring */
    memset(c->tangent, 0, (size_t)n * sizeof *c->tangent);
    g->law.kt = g->law.mu = 0;
  }
}

static hc_status draw_loads(uint64_t *r, const double *p, int n_harm, scene_structure *s)
{
  const int n = s->n, moving = 1 + (int)(3 * p[LOADS]), highest = n_harm < 5 ? n_harm : 5;
  for (int k = 0; k <= moving; ++k) {
    const bool at_rest = k == moving;
    if (at_rest && p[STATIC] > 0.4) break;
    structure_load *load = structure_add_load(s);
    if (!load) return HC_NO_MEMORY;
    draw_direction(r, n, load->direction);
    load->amplitude = geometric(r, 0.1, 3);
    load->harmonic = at_rest ? 0 : k == 0 && random_unit(r) < 0.9 ? 1 : random_int(r, 1, highest);
    const double phase = random_unit(r);
    load->phase_deg = at_rest || phase < 0.3 ? 0 : phase < 0.4 ? 90 : phase < 0.5 ? 180 : 360 * random_signed(r);
  }
  return HC_OK;
}

/* ---- what is of the order of the motion ------------------------------------------------------------ */

/* Z x = p of the harmonic-1 load, or of the first there is; what its largest entry is where that cannot be solved. */
static hc_status free_response(const model *m, double omega, double complex *x)
{
  const int n = m->n;
  double complex *Z = calloc((size_t)n * (size_t)n, sizeof *Z);
  int pivot[MOST_DOFS], at = 0;
  if (!Z) return HC_NO_MEMORY;
  while (at < m->n_loads - 1 && m->loads[at].harmonic == 0) ++at;
  const double w = m->loads[at].harmonic * omega;
  for (int i = 0; i < n * n; ++i) Z[i] = m->stiffness[i] - w * w * m->mass[i] + I * w * m->damping[i];
  for (int i = 0; i < n; ++i) x[i] = m->loads[at].cosine[i] - I * m->loads[at].sine[i];
  if (dense_factor_complex(n, Z, pivot) == HC_OK) dense_solve_complex(n, Z, pivot, false, 1, x);
  free(Z);
  return HC_OK;
}

static double along(int n, const double *d, const double complex *x)
{
  double complex sum = 0;
  for (int i = 0; i < n; ++i) sum += d[i] * x[i];
  const double size = cabs(sum);
  return size > 1e-6 && size < 1e6 ? size : 1;
}

static void draw_limits(uint64_t *r, int n, const double complex *x, structure_contact *c)
{
  scene_contact *g = &c->given;
  const double u = along(n, c->tangent, x), v = along(n, c->normal, x), kind = random_unit(r);
  if (g->law.kn == 0) {
    g->preload = g->law.kt * u * geometric(r, 0.02, 3);
    return;
  }
  g->law.gap = kind < 0.05 ? 0 : (kind < 0.5 ? -1 : 1) * v * geometric(r, 0.02, 5);
  if (kind > 0.8) g->preload = g->law.kn * g->law.gap, g->law.gap = 0;
}

/* In the place of friction and gap: a polynomial whose odd powers hold it together, up to a few times as stiff as the
 * contact was; a table of as many kinks as it has points between its ends, hardening or not; or tanh friction. */
static void draw_law(uint64_t *r, int n, double omega, const double complex *x, structure_contact *c)
{
  scene_contact *g = &c->given;
  const double kind = random_unit(r), k = fmax(g->law.kt, g->law.kn) * geometric(r, 0.01, 1);
  const bool rubs = !is_zero(n, c->tangent);
  if (kind < 0.3 && rubs) {
    g->kind = CONTACT_TANH;
    g->law.kt = 0;
    g->law.epsilon = omega * along(n, c->tangent, x) * geometric(r, 0.05, 2);
    return;
  }
  g->law = (contact){0};
  g->preload = 0;
  if (is_zero(n, c->normal)) memcpy(c->normal, c->tangent, (size_t)n * sizeof *c->normal);
  memset(c->tangent, 0, (size_t)n * sizeof *c->tangent);
  const double v = along(n, c->normal, x);
  if (kind < 0.65) {
    const int odd = random_unit(r) < 0.7 ? 3 : 5;
    g->kind = CONTACT_POLYNOMIAL;
    g->law.power[odd - CONTACT_LEAST_POWER] = k / pow(v, odd - 1);
    if (random_unit(r) < 0.3) g->law.power[0] = 0.5 * k / v * random_signed(r);
    return;
  }
  g->kind = SCENE_LAW_TABLE;
  g->n_points = random_int(r, 2, 6);
  g->points[0][0] = -v * geometric(r, 0.2, 2);
  for (int i = 1; i < g->n_points; ++i) {
    g->points[i][0] = g->points[i - 1][0] + v * geometric(r, 0.1, 1);
    g->points[i][1] = g->points[i - 1][1] + (g->points[i][0] - g->points[i - 1][0]) * k * 3 * random_unit(r);
  }
}

/* One degree of freedom, to which next to nothing of K is left, held by a cubic spring that is as stiff as K was at the
 * motion x: in the place of the last contact, or beside the only one. Damping stays. */
static hc_status weaken(uint64_t *r, const double complex *x, scene_structure *s)
{
  const int n = s->n, i = random_int(r, 0, n - 1);
  const double weak = sqrt(stress_scenes_weak(r)), k = fmax(AT(s->stiffness.v, i, i), 0.1);
  structure_contact *c = s->n_contacts > 1 ? &s->contacts[s->n_contacts - 1] : structure_add_contact(s);
  if (!c) return HC_NO_MEMORY;
  for (int j = 0; j < n; ++j) AT(s->stiffness.v, i, j) *= weak, AT(s->stiffness.v, j, i) *= weak;
  memset(c->tangent, 0, (size_t)n * sizeof *c->tangent);
  memset(c->normal, 0, (size_t)n * sizeof *c->normal);
  c->normal[i] = 1;
  field_contact_defaults(&c->given);
  c->given.kind = CONTACT_POLYNOMIAL;
  c->given.law = (contact){0};
  c->given.law.power[3 - CONTACT_LEAST_POWER] = k / pow(along(n, c->normal, x), 2);
  s->how = STRUCTURE_DAMPING_MATRIX;
  return HC_OK;
}

/* Each contact with a normal has one of the same law on the other side, and loads are of odd harmonics: -x(t + T/2)
 * solves the equations with each x(t). */
static hc_status face(int n_harm, scene_structure *s)
{
  const int n = s->n, given = s->n_contacts;
  for (int l = 0; l < s->n_loads; ++l)
    s->loads[l].harmonic = s->loads[l].harmonic < n_harm ? s->loads[l].harmonic | 1 : 1;
  for (int j = 0; j < given; ++j) {
    if (is_zero(n, s->contacts[j].normal)) continue;
    structure_contact *c = structure_add_contact(s);
    if (!c) return HC_NO_MEMORY;
    const structure_contact *like = &s->contacts[j];
    c->given = like->given;
    memcpy(c->tangent, like->tangent, (size_t)n * sizeof *c->tangent);
    for (int i = 0; i < n; ++i) c->normal[i] = -like->normal[i];
  }
  return HC_OK;
}

/* Between a mode with the contacts apart and with all of them stuck, or beside. */
static hc_status draw_frequency(uint64_t *r, const double *p, const model *m, double *omega)
{
  double apart[MOST_DOFS], stuck[MOST_DOFS], phi[MOST_DOFS * MOST_DOFS];
  const int k = (int)(m->n * p[MODE] * p[MODE]); /* rather a low one */
  hc_status st = model_modes(m, false, apart, phi);
  if (st == HC_OK) st = model_modes(m, true, stuck, phi);
  if (st != HC_OK) return st;
  const double high = sqrt(fmax(stuck[k], 1e-4)), low = sqrt(fmax(apart[k], 1e-4 * high * high));
  *omega = low * pow(high / low, fmin(fmax(1.5 * p[BETWEEN] - 0.25, 0), 1)) * geometric(r, 0.5, 2);
  *omega = fmax(*omega, sqrt(fmax(stuck[m->n - 1], 0)) / MOST_OSCILLATIONS);
  return HC_OK;
}

/* ---- units ------------------------------------------------------------------------------------------ */

static void scale(double *v, int n, double by)
{
  for (int i = 0; i < n; ++i) v[i] *= by;
}

/* ---- the whole --------------------------------------------------------------------------------------- */

/* MOST_UNKNOWNS at most, but for the coordinates that their number keeps. */
static int most_harmonics(int n, int n_directions)
{
  const int dim = n_directions + 1 < n ? n_directions + 1 : n, most = (MOST_UNKNOWNS / dim - 1) / 2;
  return most < MOST_HARMONICS ? most : MOST_HARMONICS;
}

/* All but the limits of the order of the motion. What nothing holds gets a spring to the ground. */
static hc_status draw_structure(uint64_t *r, const double *p, int n_contacts, int n_harm, scene_structure *s)
{
  const double stiffness = 1e-2 * pow(1e5, p[CONTACT_STIFFNESS]);
  double x[MOST_DOFS];
  bool adrift;
  /* Entries of the order of 1: a chain, a tree, or full; not held by itself, contacts have to. */
  const int n = s->n;
  double *M = s->mass.v, *K = s->stiffness.v;
  const bool full = p[SHAPE] > 0.7, chain = p[SHAPE] < 0.4, held = p[HELD] < 0.9;
  for (int i = 0; i < n; ++i) AT(M, i, i) = geometric(r, 0.2, 5);
  if (full) add_full(r, n, M, 0.3 / n);
  if (full && held) add_full(r, n, K, 2.0 / n);
  for (int i = held ? 0 : 1; i < n; ++i)
    add_between(n, K, geometric(r, 0.1, 10), i, chain ? i - 1 : i == 0 ? -1 : random_int(r, 0, i - 1));
  if (chain && held && random_unit(r) < 0.3) add_between(n, K, geometric(r, 0.1, 10), n - 1, -1);
  hc_status st = draw_damping(r, p, s);
  for (int j = 0; j < n_contacts && st == HC_OK; ++j) {
    structure_contact *c = structure_add_contact(s);
    if (!c) return HC_NO_MEMORY;
    draw_contact(r, stiffness, s, c);
    if (c->given.law.kn == 0) c->given.preload = 1; /* it holds; how much comes later */
  }
  if (st == HC_OK) st = draw_loads(r, p, n_harm, s);
  if (st == HC_OK && random_unit(r) >= 0.3) { /* else the default */
    structure_response *response = structure_add_response(s);
    if (!response) return HC_NO_MEMORY;
    draw_direction(r, s->n, response->direction);
  }
  if (st == HC_OK) st = structure_free_motion(s, false, x, &adrift);
  if (st == HC_OK && adrift) add_between(s->n, s->stiffness.v, 1, 0, -1);
  return st == HC_OK ? structure_resolve_damping(s) : st;
}

static hc_status structure_at(stress_scenes *scenes, long index, bool may_have_laws, scene *out)
{
  double p[STRESS_DIMENSIONS];
  if (index < 0) return HC_BAD_INPUT;
  stress_scenes_point(scenes, index, p);
  uint64_t key = ((uint64_t)stress_scenes_seed(scenes) << 32) + (uint64_t)index, r = random_bits(&key);
  scene sc;
  field_defaults(&sc);
  snprintf(sc.title, sizeof sc.title, "Stress structure %ld of seed %lu", index, stress_scenes_seed(scenes));
  const int n = 1 + (int)(MOST_DOFS * p[DOFS]), n_contacts = 1 + (int)(MOST_CONTACTS * p[CONTACTS]);
  sc.hbm.harmonics = (int)pow(most_harmonics(n, 2 * n_contacts) + 0.999, p[HARMONICS]);
  sc.hbm.keep_mean = p[KEEP_MEAN] < 0.9;
  sc.compare.omega.n = 1;
  scene_structure *s = sc.structure = structure_new();
  if (!s) return HC_NO_MEMORY;
  s->n = n;
  s->mass.v = calloc((size_t)n * (size_t)n, sizeof(double));
  s->stiffness.v = calloc((size_t)n * (size_t)n, sizeof(double));
  hc_status st = s->mass.v && s->stiffness.v ? draw_structure(&r, p, n_contacts, sc.hbm.harmonics, s) : HC_NO_MEMORY;
  if (st == HC_OK) {
    double complex x[MOST_DOFS];
    model *m;
    st = structure_model(s, &m);
    if (st == HC_OK) st = draw_frequency(&r, p, m, &sc.compare.omega.v[0]);
    if (st == HC_OK) st = free_response(m, sc.compare.omega.v[0], x);
    for (int j = 0; j < s->n_contacts && st == HC_OK; ++j) draw_limits(&r, s->n, x, &s->contacts[j]);
    uint64_t of_laws = key ^ 0x1a35ULL << 48, own = random_bits(&of_laws);
    const bool other_laws = may_have_laws && random_unit(&own) < 0.4;
    for (int j = 0; j < s->n_contacts && st == HC_OK && other_laws; ++j)
      if (random_unit(&own) < 0.6) draw_law(&own, s->n, sc.compare.omega.v[0], x, &s->contacts[j]);
    const bool cubic = stress_scenes_cubic(scenes, index, &own);
    if (st == HC_OK && cubic) st = weaken(&own, x, s);
    if (st == HC_OK && stress_scenes_facing(scenes, index, &own)) st = face(sc.hbm.harmonics, s);
    double moves[MOST_DOFS];
    bool adrift = false;
    if (st == HC_OK && (other_laws || cubic)) st = structure_free_motion(s, false, moves, &adrift);
    if (adrift) add_between(s->n, s->stiffness.v, 1, 0, -1);
    model_free(m);
  }
  if (st == HC_OK) {
    /* Masses, stiffnesses and lengths, all of the order of 1 so far, in units of these; the unit of time follows. */
    const double mass = 1e-3 * pow(1e6, p[MASS]);
    const double stiffness = pow(1e6, p[STIFFNESS]);
    const double length = 1e-4 * pow(1e4, p[LENGTH]);
    const double rate = sqrt(stiffness / mass);
    scale(s->mass.v, s->n * s->n, mass);
    scale(s->stiffness.v, s->n * s->n, stiffness);
    if (s->how == STRUCTURE_DAMPING_MATRIX) scale(s->damping.v, s->n * s->n, sqrt(stiffness * mass));
    s->rayleigh[0] *= rate, s->rayleigh[1] /= rate;
    for (int i = 0; i < s->n_loads; ++i) s->loads[i].amplitude *= stiffness * length;
    for (int j = 0; j < s->n_contacts; ++j) {
      scene_contact *g = &s->contacts[j].given;
      g->law = contact_in_units(&g->law, 1 / stiffness, 1 / length, 1 / (length * rate));
      g->preload *= stiffness * length;
      for (int i = 0; i < g->n_points; ++i) g->points[i][0] *= length, g->points[i][1] *= stiffness * length;
    }
    scale(sc.compare.omega.v, 1, rate);
    st = structure_resolve_damping(s);
  }
  sc.omega_from = 0.97 * sc.compare.omega.v[0];
  sc.omega_to = 1.03 * sc.compare.omega.v[0];
  if (st == HC_OK) *out = sc;
  else case_clear(&sc);
  return st;
}

hc_status stress_structures_at(stress_scenes *scenes, long index, scene *out)
{
  return structure_at(scenes, index, true, out);
}

/* ---- in space ----
 *
 * Friction and gaps alone, but for cubic springs. Most contacts with friction get a second tangent. One in seven has
 * nearly the line of the first, by 1e-1 .. 1e-4: the motion then is nearly straight, and slip turns about at once. The
 * limit is the circle's in four of five. In one scene of ten circles turn under static loads. Numbers come from a
 * generator of its own for each scene: what is drawn above is what it is without. */

/* |sin| of the angle between a and b, of which neither is 0. */
static double across(int n, const double *a, const double *b)
{
  const double ab = dot_product(n, a, b);
  return sqrt(fmax(1 - ab * ab / (dot_product(n, a, a) * dot_product(n, b, b)), 0));
}

/* Two contacts or more with two tangents, pressed together by a static load along each normal, and loads that turn in
 * their planes: what sticks, creeps and lifts off under dampers and joints. */
static hc_status turn_in_planes(uint64_t *r, scene_structure *s)
{
  const int n = s->n;
  double stiffness = 0;
  for (int i = 0; i < n; ++i) stiffness = fmax(stiffness, AT(s->stiffness.v, i, i));
  while (s->n_contacts < 2)
    if (!structure_add_contact(s)) return HC_NO_MEMORY;
  for (int j = 0; j < s->n_contacts; ++j) {
    structure_contact *c = &s->contacts[j];
    if (!is_zero(n, c->tangent) && !is_zero(n, c->normal)) continue;
    draw_contact(r, stiffness, s, c);
    if (is_zero(n, c->normal)) draw_direction(r, n, c->normal);
    if (is_zero(n, c->tangent)) draw_direction(r, n, c->tangent);
    c->given.law.kt = stiffness * geometric(r, 0.1, 10), c->given.law.kn = stiffness * geometric(r, 0.1, 10);
    c->given.law.mu = 0.1 + 0.5 * random_unit(r);
    c->given.preload = c->given.law.gap = 0;
  }
  const double size = s->n_loads > 0 ? fabs(s->loads[0].amplitude) : 1;
  for (int k = 0; k < 3; ++k) {
    structure_load *load = structure_add_load(s);
    if (!load) return HC_NO_MEMORY;
    const structure_contact *c = &s->contacts[random_int(r, 0, s->n_contacts - 1)];
    memcpy(load->direction, k == 0 ? c->normal : c->tangent, (size_t)n * sizeof *load->direction);
    load->amplitude = size * geometric(r, 0.3, 3);
    load->harmonic = k == 0 ? 0 : 1;
    load->phase_deg = k == 2 ? 90 : 0;
  }
  return HC_OK;
}

/* Not along the tangent, which a structure of one degree of freedom could not have. */
static void draw_second_tangent(uint64_t *r, int n, structure_contact *c)
{
  const double least = 0.05;
  do draw_direction(r, n, c->tangent_2);
  while (across(n, c->tangent, c->tangent_2) < least);
  if (random_unit(r) > 1.0 / 7) return;
  const double by = pow(10, -1 - 3 * random_unit(r)), along = 2 * random_signed(r);
  for (int i = 0; i < n; ++i) c->tangent_2[i] = along * c->tangent[i] + by * c->tangent_2[i];
}

hc_status stress_scene_of(stress_scenes *scenes, stress_family family, long index, scene *out)
{
  switch (family) {
  case STRESS_SPACE: {
    const uint64_t other = 0x5eedULL << 48; /* than that of structures.c */
    hc_status st = structure_at(scenes, index, false, out);
    if (st != HC_OK) return st;
    scene_structure *s = out->structure;
    uint64_t key = (((uint64_t)stress_scenes_seed(scenes) << 32) + (uint64_t)index) ^ other, r = random_bits(&key);
    snprintf(out->title, sizeof out->title, "Stress structure in space %ld of seed %lu", index,
             stress_scenes_seed(scenes));
    uint64_t own;
    const bool faces = stress_scenes_facing(scenes, index, &own),
               turns = s->n > 1 && !faces && stress_scenes_circles(scenes, index, &own);
    if (turns && (st = turn_in_planes(&own, s)) != HC_OK) return case_clear(out), st;
    int directions = 2 * s->n_contacts;
    for (int j = 0; j < s->n_contacts && s->n > 1 && !faces; ++j) {
      structure_contact *c = &s->contacts[j];
      if (is_zero(s->n, c->tangent) || (random_unit(&r) > 0.7 && !turns)) continue;
      draw_second_tangent(&r, s->n, c);
      c->given.limit = random_unit(&r) < 0.8 || turns ? CONTACT_LIMIT_CIRCLE : CONTACT_LIMIT_SQUARE;
      ++directions;
    }
    const int most = most_harmonics(s->n, directions);
    if (out->hbm.harmonics > most) out->hbm.harmonics = most;
    return HC_OK;
  }
  case STRESS_STRUCTURES: return stress_structures_at(scenes, index, out);
  case STRESS_OSCILLATORS: break;
  }
  return stress_scenes_at(scenes, index, out);
}
