/* multipliers.c - the monodromy matrix of the orbit, and bounds of its eigenvalues. */
#include "proof/orbit.h"

/* Gradient [n] of w by x, for a contact that begins to stick at an event with velocities v. */
static void new_slider(const orbit *o, int contact, char before, arb_srcptr v, arb_ptr gradient)
{
  const contact_balls *f = &o->friction[contact];
  slider_line(o, contact, before, gradient);
  if (before != 'O')
    return; /* s -> S: the gradient of t.x - s mu N/kt; the instant has no part, since the derivative of w by time is 0
               there */
  /* O -> S: dw = (t - (u'/v') n).dx, since the instant of touching moves */
  LOCAL(arb) u = {0}, w = {0};
  arb_dot(u, NULL, 0, f->t, 1, v, 1, o->n, o->precision);
  arb_dot(w, NULL, 0, f->n, 1, v, 1, o->n, o->precision);
  arb_div(u, u, w, o->precision);
  arb_neg(u, u);
  _arb_vec_scalar_addmul(gradient, f->n, o->n, u, o->precision);
}

/* The derivative of the state after event i + 1 by that after event i. */
static void transfer(const orbit *o, int i, arb_srcptr columns, arb_mat_t m)
{
  const orbit_segment *s = &o->segments[i], *t = &o->segments[(i + 1) % o->m];
  const int n = o->n, next = (i + 1) % o->m;
  arb_mat_init(m, t->state, s->state);
  /* x, v: the flow, and the identity at the event, since forces are continuous */
  for (int c = 0; c < 2 * n; c++)
    for (int r = 0; r < 2 * n; r++) arb_set(arb_mat_entry(m, r, c), columns + c * s->size + r);
  for (int j = 0; j < o->contacts; j++) {
    const int number = s->slider[j] - 1 - 2 * o->harmonics;
    for (int r = 0; r < 2 * n && s->place[j] >= 0; r++)
      arb_set(arb_mat_entry(m, r, s->place[j]), columns + number * s->size + r);
  }
  /* w: unchanged while stick continues, dropped when it ends, new when it begins */
  arb_ptr gradient = o->scratch;
  for (int j = 0; j < o->contacts; j++) {
    const int row = t->place[j];
    if (row >= 0 && s->place[j] >= 0) arb_one(arb_mat_entry(m, row, s->place[j]));
    if (row < 0 || s->place[j] >= 0) continue;
    new_slider(o, j, t->from[j], orbit_event(o, next) + n, gradient);
    for (int c = 0; c < s->state; c++)
      arb_dot(arb_mat_entry(m, row, c), NULL, 0, gradient, 1, arb_mat_entry(m, 0, c),
              arb_mat_entry(m, 1, 0) - arb_mat_entry(m, 0, 0), n, o->precision);
  }
}

int monodromy(const orbit *o, arb_mat_t product, failure *f)
{
  /* Start at the event with the fewest sliders in the state, which avoids spurious zero multipliers. */
  int first = 0;
  for (int i = 1; i < o->m; i++)
    if (o->segments[i].state < o->segments[first].state) first = i;
  const int fewest = o->segments[first].state;
  arb_mat_init(product, fewest, fewest);
  arb_mat_one(product);
  LOCAL(pool) own = {0};
  arb_ptr end = pool_balls(own, (slong)o->largest * (2 * o->n + o->contacts + 1)), columns = end + o->largest;
  bool fine = true;
  for (int k = 0; k < o->m && fine; k++) {
    LOCAL(arb_mat) one = {0}, both = {0};
    fine = flow_end(o, (first + k) % o->m, end, columns);
    transfer(o, (first + k) % o->m, columns, one);
    arb_mat_init(both, arb_mat_nrows(one), fewest);
    arb_mat_mul(both, one, product, o->precision);
    arb_mat_swap(both, product);
  }
  if (!fine) refute(f, -1, -1, "stability unproven: the precision does not suffice");
  return fewest;
}

/* Gershgorin discs of e[n][n]: a connected group of discs contains as many eigenvalues as discs. So the largest modulus
 * is at most that of the farthest point of all discs, and at least that of the nearest point of each group. */
static void largest_modulus(const acb_mat_t e, int n, arb_t modulus, slong precision)
{
  LOCAL(pool) own = {0};
  int *group = pool_take(own, POOL_BYTES, (size_t)n * sizeof *group);
  arb_ptr radius = pool_balls(own, 2L * n), disc = radius + n;
  LOCAL(acb) between = {0};
  LOCAL(arb) gap = {0};
  LOCAL(mag) entry = {0}, sum = {0};
  LOCAL(arf) least = {0}, most = {0}, nearest = {0}, bound = {0};
  for (int i = 0; i < n; i++) {
    mag_zero(sum);
    for (int j = 0; j < n; j++) {
      acb_get_mag(entry, acb_mat_entry(e, i, j));
      if (j != i) mag_add(sum, sum, entry);
    }
    arf_set_mag(arb_midref(radius + i), sum);
    acb_abs(disc + i, acb_mat_entry(e, i, i), precision);
    arb_add_error_mag(disc + i, sum);
    arb_get_ubound_arf(bound, disc + i, precision);
    arf_max(most, most, bound);
    group[i] = i;
    for (int j = 0; j < i; j++) {
      acb_sub(between, acb_mat_entry(e, i, i), acb_mat_entry(e, j, j), precision);
      acb_abs(gap, between, precision);
      arb_sub(gap, gap, radius + i, precision);
      arb_sub(gap, gap, radius + j, precision);
      const int joined = group[j];
      for (int k = 0; k <= i && !arb_is_positive(gap); k++) /* discs that may touch are one group */
        if (group[k] == joined) group[k] = group[i];
    }
  }
  for (int g = 0; g < n; g++) {
    arf_pos_inf(nearest);
    for (int i = 0; i < n; i++) {
      arb_get_lbound_arf(bound, disc + i, precision);
      if (group[i] == g) arf_min(nearest, nearest, bound);
    }
    if (arf_is_finite(nearest)) arf_max(least, least, nearest);
  }
  arb_set_interval_arf(modulus, least, most, precision);
}

void multipliers(const orbit *o, quantities *q, failure *f)
{
  const certificate *c = o->c;
  const slong p = o->precision;
  LOCAL(arb_mat) m = {0};
  LOCAL(acb_mat) v = {0}, product = {0}, e = {0};
  LOCAL(arb) one = {0};
  const int n = monodromy(o, m, f);
  q->stability = STABILITY_UNPROVEN;
  if (c->n_vectors != n || f->reason[0]) return;
  acb_mat_init(v, n, n);
  acb_mat_init(product, n, n);
  acb_mat_init(e, n, n);
  for (int i = 0; i < n * n; i++) {
    acb_ptr entry = acb_mat_entry(v, i / n, i % n);
    arb_set_fmpq(acb_realref(entry), c->vectors + 2L * i, p);
    arb_set_fmpq(acb_imagref(entry), c->vectors + 2L * i + 1, p);
  }
  acb_mat_set_arb_mat(e, m);
  acb_mat_mul(product, e, v, p);
  /* V^-1 M V: the same eigenvalues; with an approximate inverse first, since V may be almost singular */
  if (!acb_mat_solve_precond(e, v, product, p)) return;
  arb_one(one);
  largest_modulus(e, n, q->value[CLAIM_MULTIPLIER], p);
  q->multiplier_known = arb_is_finite(q->value[CLAIM_MULTIPLIER]);
  if (q->multiplier_known && arb_lt(q->value[CLAIM_MULTIPLIER], one)) q->stability = STABILITY_STABLE;
  if (q->multiplier_known && arb_gt(q->value[CLAIM_MULTIPLIER], one)) q->stability = STABILITY_UNSTABLE;
}
