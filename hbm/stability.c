/* stability.c - see stability.h. The state is (dx, dx', dheld_1, ..., dheld_n); dheld_j counts only while contact j
 * is stuck. */
#include "hbm/stability.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/ascending.h"
#include "base/constants.h"
#include "hbm/exact_force.h"
#include "model/linear.h"
#include "numerics/floquet.h"

struct stability {
  int cap;                     /* of boundary */
  double *boundary;            /* [cap] [rad] every instant a contact changes state, sorted */
  int room;                    /* states: 2 + contacts */
  double *phi;                 /* [room][room] */
  double *share;               /* [room] */
  const contact_piece **piece; /* [room] the piece of each contact on the stretch at hand */
  int *active;                 /* [room] */
  double complex *lambda;      /* [room] */
  floquet *floquet;
};

hc_status stability_new(int n_contacts, stability **out)
{
  *out = calloc(1, sizeof **out);
  stability *s = *out;
  if (!s) return HC_NO_MEMORY;
  s->cap = 2;
  s->boundary = malloc((size_t)s->cap * sizeof(double));
  s->room = 2 + n_contacts;
  const size_t m = (size_t)s->room;
  s->phi = malloc(m * m * sizeof *s->phi);
  s->share = malloc(m * sizeof *s->share);
  s->piece = malloc(m * sizeof *s->piece);
  s->active = malloc(m * sizeof *s->active);
  s->lambda = malloc(m * sizeof *s->lambda);
  if (s->boundary && s->phi && s->share && s->piece && s->active && s->lambda &&
      floquet_new(s->room, &s->floquet) == HC_OK)
    return HC_OK;
  stability_free(s);
  *out = NULL;
  return HC_NO_MEMORY;
}

void stability_free(stability *s)
{
  if (!s) return;
  floquet_free(s->floquet);
  free(s->boundary);
  free(s->phi);
  free(s->share);
  free(s->piece);
  free(s->active);
  free(s->lambda);
  free(s);
}

static double wrap(double th) { return th >= TWO_PI ? th - TWO_PI : th; }

/* All instants of change in [0, 2 pi], ends included; their number or -1 without memory. */
static int collect_boundaries(stability *s, const exact_force *e, int n_contacts)
{
  int n = 2;
  for (int j = 0, n_pieces; j < n_contacts; ++j) {
    exact_force_pieces(e, j, &n_pieces);
    n += 2 * n_pieces;
  }
  if (n > s->cap) {
    double *more = realloc(s->boundary, 2 * (size_t)n * sizeof(double));
    if (!more) return -1;
    s->boundary = more;
    s->cap = 2 * n;
  }
  n = 0;
  s->boundary[n++] = 0;
  s->boundary[n++] = TWO_PI;
  for (int j = 0, n_pieces; j < n_contacts; ++j) {
    const contact_piece *p = exact_force_pieces(e, j, &n_pieces);
    for (int i = 0; i < n_pieces; ++i) {
      s->boundary[n++] = wrap(p[i].from);
      s->boundary[n++] = wrap(p[i].to);
    }
  }
  qsort(s->boundary, (size_t)n, sizeof(double), ascending);
  return n;
}

/* The piece of contact j that covers th, NULL while separated. */
static const contact_piece *piece_at(const exact_force *e, int j, double th)
{
  int n;
  const contact_piece *p = exact_force_pieces(e, j, &n);
  for (int i = 0; i < n; ++i)
    if ((th >= p[i].from && th < p[i].to) || (th + TWO_PI >= p[i].from && th + TWO_PI < p[i].to)) return &p[i];
  return NULL;
}

/* Is contact j's slider held for ever? Also where it has slipped until friction just holds it (shakedown): such an
 * orbit is the last of a family that differs by where the slider rests, and it touches the limit without passing it,
 * in no time. Its one-sided derivative, as if it slipped there, has a multiplier 1 that is the family's. What passes
 * for no time: the slip's path goes with its length squared, so 1e-6 rad move it by rounding. */
static bool held_for_ever(const exact_force *e, int j)
{
  const double no_time = 1e-6;
  double stuck = 0, touching = 0;
  int n;
  const contact_piece *p = exact_force_pieces(e, j, &n);
  for (int i = 0; i < n; ++i) {
    touching += p[i].to - p[i].from;
    if (p[i].state == CONTACT_STICK) stuck += p[i].to - p[i].from;
  }
  return touching >= TWO_PI * (1 - 1e-15) && stuck >= touching - no_time;
}

/* Does contact j's slider remember the motion? Not if it is stuck for ever, and not if every stick starts with a
 * touch-down that puts it at the same place whatever the motion: dheld is then 0 at all times and no state of the
 * system. */
static bool remembers(const exact_force *e, int j)
{
  int n;
  const contact_piece *p = exact_force_pieces(e, j, &n);
  for (int i = 0; i < n && !held_for_ever(e, j); ++i)
    if (p[i].state == CONTACT_STICK && p[i].held_by_x[0] != 0) return true;
  return false;
}

/* Sliders that come to rest at this boundary: dheld from dx there. */
static void set_sliders(stability *s, const model *m, const exact_force *e, double th)
{
  const int n = s->room;
  for (int j = 0; j < m->n_contacts; ++j) {
    const contact_piece *p = s->piece[j];
    if (!p || p->state != CONTACT_STICK || p->from != p->origin || wrap(p->from) != th || held_for_ever(e, j)) continue;
    for (int q = 0; q < n; ++q) s->phi[(2 + j) * n + q] = p->held_by_x[0] * s->phi[q];
  }
}

/* Stiffness to x, and the share of each dheld in the force on x. */
static double stiffness_now(const model *m, const contact_piece *const *piece, double *share)
{
  double k = m->stiffness;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const double t = c->tangent, n = c->normal;
    share[j] = 0;
    if (!piece[j]) continue;
    int slip = contact_slip_sign(piece[j]->state);
    k += (slip ? slip * c->law.mu * c->law.kn * n : c->law.kt * t) * t + c->law.kn * n * n;
    share[j] = slip ? 0 : t;
  }
  return k;
}

static void advance_stretch(stability *s, const model *m, double t)
{
  const int n = s->room;
  double e[2][2], k = stiffness_now(m, s->piece, s->share), *x = s->phi, *v = s->phi + n;
  linear_free_motion(m->mass, m->damping, k, t, e);
  for (int q = 0; q < n; ++q) {
    double pull = 0;
    for (int j = 0; j < m->n_contacts; ++j) pull += s->share[j] * s->phi[(2 + j) * n + q];
    double rest = k != 0 ? pull / k : 0, dx = x[q] - rest, dv = v[q];
    x[q] = rest + e[0][0] * dx + e[0][1] * dv;
    v[q] = e[1][0] * dx + e[1][1] * dv;
  }
}

static void summarise(int m, const double complex *lambda, hbm_stability *out)
{
  double complex flip = 1, fold = 1, all = 1;
  const double complex most = floquet_largest(m, lambda);
  for (int i = 0; i < m; ++i) {
    flip *= 1 + lambda[i];
    fold *= 1 - lambda[i];
    all *= lambda[i];
  }
  *out = (hbm_stability){.multiplier = cabs(most), .re = creal(most), .im = cimag(most)};
  out->flip = creal(flip);
  out->fold = creal(fold);
  out->determinant = creal(all);
}

hc_status stability_of(stability *s, const model *m, const exact_force *e, double omega, hbm_stability *out)
{
  const int room = s->room, n = collect_boundaries(s, e, m->n_contacts);
  int n_active = 0;
  if (n < 0) return HC_NO_MEMORY;
  s->active[n_active++] = 0;
  s->active[n_active++] = 1;
  memset(s->phi, 0, (size_t)room * (size_t)room * sizeof *s->phi);
  for (int q = 0; q < room; ++q) s->phi[q * room + q] = 1;
  for (int i = 0; i + 1 < n; ++i) {
    double a = s->boundary[i], b = s->boundary[i + 1];
    if (!(b > a)) continue;
    for (int j = 0; j < m->n_contacts; ++j) s->piece[j] = piece_at(e, j, 0.5 * (a + b));
    if (i == 0 || a == 0) /* sliders at rest at the start of the period are states of their own */
      for (int j = 0; j < m->n_contacts; ++j)
        if (s->piece[j] && s->piece[j]->state == CONTACT_STICK && remembers(e, j) &&
            !(s->piece[j]->from == s->piece[j]->origin && wrap(s->piece[j]->from) == a))
          s->active[n_active++] = 2 + j;
    set_sliders(s, m, e, a);
    advance_stretch(s, m, (b - a) / omega);
  }
  hc_status st = floquet_multipliers(s->floquet, s->phi, room, 1, n_active, s->active, s->lambda);
  if (st == HC_OK) summarise(n_active, s->lambda, out);
  return st;
}
