/* monodromy.c - see monodromy.h. The state is (dx, dx', dheld_1, ..., dheld_n); dheld_j counts only while contact j
 * is stuck. Row i of phi is state i, column q the initial state q. */
#include "hbm/monodromy.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/ascending.h"
#include "base/constants.h"
#include "hbm/stretch_flow.h"
#include "model/linear.h"
#include "numerics/floquet.h"

struct monodromy {
  int n;                       /* degrees of freedom */
  int n_states;                /* 2 n + contacts */
  int cap;                     /* of boundary */
  double *boundary;            /* [cap] [rad] every angle at which a contact changes state, ascending */
  double *phi;                 /* [n_states][n_states] by rows */
  double *share;               /* [n_states] */
  stretch_flow *flow;          /* of a structure; NULL of an oscillator */
  const contact_piece **piece; /* [n_states] of each contact, on the current stretch; NULL while separated */
  int *active;                 /* [n_states] the initial states that the multipliers are made of */
  double complex *lambda;      /* [n_states] */
  floquet *floquet;
};

hc_status monodromy_new(const model *m, monodromy **out)
{
  *out = calloc(1, sizeof **out);
  monodromy *w = *out;
  if (!w) return HC_NO_MEMORY;
  w->cap = 2;
  w->boundary = malloc((size_t)w->cap * sizeof(double));
  w->n = m->n;
  w->n_states = 2 * m->n + m->n_contacts;
  const size_t n = (size_t)w->n_states;
  w->phi = malloc(n * n * sizeof *w->phi);
  w->share = malloc(n * sizeof *w->share);
  w->piece = malloc(n * sizeof *w->piece);
  w->active = malloc(n * sizeof *w->active);
  w->lambda = malloc(n * sizeof *w->lambda);
  bool allocated = w->boundary && w->phi && w->share && w->piece && w->active && w->lambda;
  hc_status st = allocated ? floquet_new(w->n_states, &w->floquet) : HC_NO_MEMORY;
  if (st == HC_OK && m->n > 1) st = stretch_flow_new(m, &w->flow);
  if (st == HC_OK) return HC_OK;
  monodromy_free(w);
  *out = NULL;
  return st;
}

void monodromy_free(monodromy *w)
{
  if (!w) return;
  floquet_free(w->floquet);
  stretch_flow_free(w->flow);
  free(w->boundary);
  free(w->phi);
  free(w->share);
  free(w->piece);
  free(w->active);
  free(w->lambda);
  free(w);
}

static double wrap(double th) { return th >= TWO_PI ? th - TWO_PI : th; }

/* All angles of change in [0, 2 pi], ends included; their number or -1 without memory. */
static int collect_boundaries(monodromy *w, const contact_forces *orbit, int n_contacts)
{
  int n = 2;
  for (int j = 0, n_pieces; j < n_contacts; ++j) {
    contact_forces_pieces(orbit, j, &n_pieces);
    n += 2 * n_pieces;
  }
  if (n > w->cap) {
    double *more = realloc(w->boundary, 2 * (size_t)n * sizeof(double));
    if (!more) return -1;
    w->boundary = more;
    w->cap = 2 * n;
  }
  n = 0;
  w->boundary[n++] = 0;
  w->boundary[n++] = TWO_PI;
  for (int j = 0, n_pieces; j < n_contacts; ++j) {
    const contact_piece *p = contact_forces_pieces(orbit, j, &n_pieces);
    for (int i = 0; i < n_pieces; ++i) {
      w->boundary[n++] = wrap(p[i].from);
      w->boundary[n++] = wrap(p[i].to);
    }
  }
  qsort(w->boundary, (size_t)n, sizeof(double), ascending);
  return n;
}

/* The piece of contact j that covers th, NULL while separated. */
static const contact_piece *piece_at(const contact_forces *orbit, int j, double th)
{
  int n;
  const contact_piece *p = contact_forces_pieces(orbit, j, &n);
  for (int i = 0; i < n; ++i) {
    bool covers = th >= p[i].from && th < p[i].to;
    bool covers_wrapped = th + TWO_PI >= p[i].from && th + TWO_PI < p[i].to;
    if (covers || covers_wrapped) return &p[i];
  }
  return NULL;
}

/* Is contact j's slider stuck all period? Slip pieces of less than 1e-6 rad in all count as stick: the slip path goes
 * with the square of their length, so 1e-6 rad move the slider by rounding only. They occur at shakedown: the slider
 * has moved until the largest |T| is just mu N, a graze. Such an orbit is the last of a family that differs by where
 * the slider rests; its one-sided derivative, as if it slipped at the graze, has the family's multiplier 1. */
static bool stuck_all_period(const contact_forces *orbit, int j)
{
  const double negligible_slip = 1e-6;
  double stuck = 0, touching = 0;
  int n;
  const contact_piece *p = contact_forces_pieces(orbit, j, &n);
  for (int i = 0; i < n; ++i) {
    touching += p[i].to - p[i].from;
    if (p[i].state == CONTACT_STICK) stuck += p[i].to - p[i].from;
  }
  return touching >= TWO_PI * (1 - 1e-15) && stuck >= touching - negligible_slip;
}

/* Is dheld_j a state of the system? Not if the slider is stuck all period, and not if every stick piece starts with a
 * touch-down that puts the slider at the same place whatever the motion: dheld_j is then 0 at all times. */
static bool slider_is_state(const contact_forces *orbit, int j)
{
  int n;
  const contact_piece *p = contact_forces_pieces(orbit, j, &n);
  for (int i = 0; i < n && !stuck_all_period(orbit, j); ++i) {
    double by[2];
    contact_forces_held_by(orbit, j, &p[i], by);
    if (p[i].state == CONTACT_STICK && (by[0] != 0 || by[1] != 0)) return true;
  }
  return false;
}

/* Does the slider of stick piece p come to rest at its start, which is th? */
static bool comes_to_rest_at(const contact_piece *p, double th) { return p->from == p->origin && wrap(p->from) == th; }

static void set_slider(monodromy *w, const model *m, const contact_forces *orbit, int j, const contact_piece *p)
{
  const int n = w->n_states;
  const model_contact *c = &m->contacts[j];
  double *held = w->phi + (size_t)(2 * w->n + j) * (size_t)n, by[2];
  contact_forces_held_by(orbit, j, p, by);
  for (int q = 0; q < n; ++q) held[q] = w->n == 1 ? by[0] * w->phi[q] : 0;
  for (int i = 0; i < w->n && w->n > 1; ++i) {
    const double by_x = by[0] * c->tangent[i] + by[1] * c->normal[i];
    for (int q = 0; q < n; ++q) held[q] += by_x * w->phi[(size_t)i * (size_t)n + (size_t)q];
  }
}

/* Sliders that come to rest at th: dheld from dx there. */
static void set_sliders(monodromy *w, const model *m, const contact_forces *orbit, double th)
{
  for (int j = 0; j < m->n_contacts; ++j) {
    const contact_piece *p = w->piece[j];
    bool rests = p && p->state == CONTACT_STICK && comes_to_rest_at(p, th);
    if (!rests || stuck_all_period(orbit, j)) continue;
    set_slider(w, m, orbit, j, p);
  }
}

/* Initial states: dx, dx', and dheld of each slider that is at rest when the period starts. Their number. */
static int collect_initial_sliders(monodromy *w, const model *m, const contact_forces *orbit, int n_active, double th)
{
  for (int j = 0; j < m->n_contacts; ++j) {
    const contact_piece *p = w->piece[j];
    bool at_rest = p && p->state == CONTACT_STICK && !comes_to_rest_at(p, th);
    if (at_rest && slider_is_state(orbit, j)) w->active[n_active++] = 2 * w->n + j;
  }
  return n_active;
}

/* Of an oscillator: stiffness to x, and the share of each dheld in the force on x. */
static double stiffness_of_stretch(const model *m, const contact_piece *const *piece, double *share)
{
  double k = *m->stiffness;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const double t = *c->tangent, n = *c->normal;
    share[j] = 0;
    if (!piece[j]) continue;
    int slip = contact_slip_sign(piece[j]->state);
    k += (slip ? slip * c->law.mu * c->law.kn * n : c->law.kt * t) * t + c->law.kn * n * n;
    share[j] = slip ? 0 : t;
  }
  return k;
}

/* dx and dx' over a stretch of duration t, from each initial state. */
static void advance_oscillator(monodromy *w, const model *m, double t)
{
  const int n = w->n_states;
  double e[2][2], k = stiffness_of_stretch(m, w->piece, w->share), *x = w->phi, *v = w->phi + n;
  linear_free_motion(*m->mass, *m->damping, k, t, e);
  for (int q = 0; q < n; ++q) {
    double pull = 0;
    for (int j = 0; j < m->n_contacts; ++j) pull += w->share[j] * w->phi[(2 + j) * n + q];
    double rest = k != 0 ? pull / k : 0, dx = x[q] - rest, dv = v[q];
    x[q] = rest + e[0][0] * dx + e[0][1] * dv;
    v[q] = e[1][0] * dx + e[1][1] * dv;
  }
}

static void summarise(int m, const double complex *lambda, hbm_stability *out)
{
  double complex flip = 1, fold = 1, all = 1;
  const double complex largest = floquet_largest(m, lambda);
  for (int i = 0; i < m; ++i) {
    flip *= 1 + lambda[i];
    fold *= 1 - lambda[i];
    all *= lambda[i];
  }
  *out = (hbm_stability){.multiplier = cabs(largest), .re = creal(largest), .im = cimag(largest), .pair = NAN};
  for (int i = 0; i < m; ++i) {
    const double size = cabs(lambda[i]);
    if (!(cimag(lambda[i]) > 0)) continue; /* one of the two */
    out->pairs_outside += size > 1 + 1e-10;
    if (!(fabs(size - 1) >= fabs(out->pair - 1))) out->pair = size;
  }
  out->flip = creal(flip);
  out->fold = creal(fold);
  out->determinant = creal(all);
}

hc_status monodromy_stability(monodromy *w, const model *m, const contact_forces *orbit, double omega,
                              hbm_stability *out)
{
  const int n_states = w->n_states, n = collect_boundaries(w, orbit, m->n_contacts);
  int n_active = 0;
  hc_status st = n < 0 ? HC_NO_MEMORY : HC_OK;
  while (n_active < 2 * w->n) w->active[n_active] = n_active, ++n_active;
  memset(w->phi, 0, (size_t)n_states * (size_t)n_states * sizeof *w->phi);
  for (int q = 0; q < n_states; ++q) w->phi[q * n_states + q] = 1;
  for (int i = 0; i + 1 < n && st == HC_OK; ++i) {
    double a = w->boundary[i], b = w->boundary[i + 1];
    if (!(b > a)) continue;
    for (int j = 0; j < m->n_contacts; ++j) w->piece[j] = piece_at(orbit, j, 0.5 * (a + b));
    if (a == 0) n_active = collect_initial_sliders(w, m, orbit, n_active, a);
    set_sliders(w, m, orbit, a);
    if (w->flow) st = stretch_flow_advance(w->flow, w->piece, (b - a) / omega, w->phi);
    else advance_oscillator(w, m, (b - a) / omega);
  }
  if (st == HC_OK) st = floquet_multipliers(w->floquet, w->phi, n_states, 1, n_active, w->active, w->lambda);
  if (st == HC_OK) summarise(n_active, w->lambda, out);
  return st;
}
