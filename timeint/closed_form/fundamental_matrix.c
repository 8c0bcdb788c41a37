/* fundamental_matrix.c - see fundamental_matrix.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/closed_form/fundamental_matrix.h"

#include <string.h>

#include "model/linear.h"
#include "numerics/dense.h"
#include "timeint/closed_form/modal_motion.h"

/* [reach of the motion] Step lengths. fine: the terms of columns converge 0.7 times as fast as the motion's. coarse,
 * for 1e-6: twice the reach multiplies the truncation error, rounding, by 2^24, to 1e-9; the step is halved where that
 * fails. */
static const double fine_step = 0.7, coarse_step = 2;
/* [column] Truncation tolerances of a step. Measured change of multipliers by coarse steps: 4e-11, with slowed modes
 * 5e-10; the slowing itself changes them by 4e-6. */
static const double of_coarse = 1e-6, of_slowed = 1e-5;

/* to[count] += by from[count] */
static void add_real(int count, double by, const double *restrict from, double *restrict to)
{
  for (int q = 0; q < count; ++q) to[q] += by * from[q];
}

/* The same for complex numbers: imaginary parts are `apart` behind the real ones. */
static void add_complex(int count, double complex by, const double *from, double *to, size_t apart)
{
  add_real(count, creal(by), from, to);
  if (cimag(by) != 0) add_real(count, cimag(by), from, to + apart);
}

/* eta_k of all columns. */
static void find_eta(const modes_columns *s, const scaled_model *m, const complex_modes *modes,
                     const contact_track *track, size_t k, int count, int ld, const double *matrix, double *eta)
{
  const size_t n = (size_t)s->n, row = (size_t)ld, contacts = (size_t)m->n_contacts, apart = (size_t)s->n_columns;
  memset(eta, 0, 2 * apart * sizeof *eta);
  for (size_t i = 0; i < n; ++i) {
    add_complex(count, modes->by_x[k * n + i], matrix + i * row, eta, apart);
    add_complex(count, modes->by_v[k * n + i] / m->by_C, matrix + (n + i) * row, eta, apart);
  }
  for (size_t j = 0; j < contacts; ++j) {
    const double pull = contact_track_forces(&track[j], &m->contact[j]).t_w;
    if (pull == 0) continue;
    const double complex held = pull * modes->along[k * contacts + j] / (m->by_K * modes->lambda[k]);
    add_complex(count, -held, matrix + (2 * n + j) * row, eta, apart);
  }
}

/* to := by z, all columns; to and z may be the same. */
static void multiply(const modes_columns *s, int count, double complex by, const double *z, double *to)
{
  const size_t apart = (size_t)s->n_columns;
  for (int q = 0; q < count; ++q) {
    const double re = z[q], im = z[apart + (size_t)q];
    to[q] = creal(by) * re - cimag(by) * im;
    to[apart + (size_t)q] = creal(by) * im + cimag(by) * re;
  }
}

static void make_slowed(fundamental_matrix *v, const modal_base *base, workspace *w)
{
  const size_t slowed = (size_t)v->n_slowed;
  v->spring = workspace_doubles(w, slowed * slowed);
  v->follow = workspace_doubles(w, slowed * (size_t)v->n_states);
  v->fast = workspace_array(w, slowed, sizeof *v->fast);
  v->pivot = workspace_array(w, slowed, sizeof *v->pivot);
  for (int i = 0, f = 0; i < base->n && !w->failed; ++i)
    if (base->slowed[i] != 1) v->fast[f++] = i;
}

hc_status fundamental_matrix_make(fundamental_matrix *v, const modal_base *base, interval_modes *modes, workspace *w)
{
  const size_t n = (size_t)base->n, states = 2 * n + (size_t)base->n_contacts;
  *v = (fundamental_matrix){.n = base->n, .n_states = (int)states, .modes = modes};
  v->rows = workspace_doubles(w, states * states);
  double **const vectors[] = {&v->du[0], &v->du[1], &v->dv, &v->y};
  for (size_t i = 0; i < 4; ++i) *vectors[i] = workspace_doubles(w, states);
  v->state = workspace_array(w, states, sizeof *v->state);
  v->track = workspace_array(w, states, sizeof *v->track);
  for (int i = 0; i < base->n; ++i) v->n_slowed += base->slowed[i] != 1;
  if (v->n_slowed > 0) make_slowed(v, base, w);
  if (modes) {
    v->by_modes = (modes_columns){.n = base->n, .n_columns = (int)states};
    v->by_modes.change = workspace_doubles(w, 4 * n * states);
    v->by_modes.rate = workspace_doubles(w, 4 * n * states);
  }
  const hc_status st = series_columns_make(&v->series, base, w);
  return st == HC_OK && base->n_planar > 0 ? motion_series_make(&v->motion, base, w) : st;
}

static double *row_of(const fundamental_matrix *v, int i) { return v->rows + (size_t)i * (size_t)v->n_states; }
static double *slider_of(const fundamental_matrix *v, int j) { return row_of(v, 2 * v->n + j); }

/* out[n_columns] := along . D */
static void project(const fundamental_matrix *v, const double *along, double *restrict out)
{
  memset(out, 0, (size_t)v->n_columns * sizeof *out);
  for (int i = 0; i < v->n; ++i) {
    const double *row = row_of(v, i), a = along[i];
    for (int q = 0; q < v->n_columns && a != 0; ++q) out[q] += a * row[q];
  }
}

/* v->du and v->dv of contact j. */
static void find_motion(fundamental_matrix *v, const scaled_model *m, int j)
{
  const size_t n = (size_t)v->n, at = (size_t)j * n;
  for (int a = 0; a < scaled_directions(m, j); ++a) project(v, m->base->tangent + at + (size_t)a * n, v->du[a]);
  project(v, m->base->normal + at, v->dv);
}

/* dphi into the first slider's row at the start of a slip with |U - W| = R, from dW in both rows. */
static void begin_to_turn(fundamental_matrix *v, const scaled_model *m, int j, const contact_track *t, double radius)
{
  double *one = slider_of(v, j), *two = slider_of(v, j + 1);
  find_motion(v, m, j);
  for (int q = 0; q < v->n_columns; ++q)
    one[q] = (t[0].along * (v->du[1][q] - two[q]) - t[1].along * (v->du[0][q] - one[q])) / radius;
}

/* dW of a slider that follows from the motion; with two directions also from dphi in the first one's row. */
static void tie(fundamental_matrix *v, const scaled_model *m, int j, const contact_track *t, double radius)
{
  const scaled_contact *c = &m->contact[j];
  const int directions = c->kind->directions > 1 ? 2 : 1;
  const bool turned = directions > 1 && t->state != CONTACT_SEPARATED;
  const double by_angle[2] = {turned ? radius * t[1].along : 0, turned ? -radius * t[0].along : 0};
  find_motion(v, m, j);
  for (int a = directions - 1; a >= 0; --a) { /* the first row last, since it holds dphi */
    const double *angle = slider_of(v, j);
    double *row = slider_of(v, j + a);
    for (int q = 0; q < v->n_columns; ++q)
      row[q] = contact_track_vary_slider(&t[a], c, v->du[a][q], v->dv[q]) + (turned ? by_angle[a] * angle[q] : 0);
  }
}

void fundamental_matrix_pass(fundamental_matrix *v, const scaled_model *m, int j, const contact_track *before,
                             const contact_track *after, const contact_motion *at)
{
  const double radius = contact_track_radius(&m->contact[j], at->v);
  if (!m->contact[j].law.has_friction) return;
  if (before->state == CONTACT_STICK && after->turns) begin_to_turn(v, m, j, after, radius);
  if (after->state != CONTACT_STICK) return;
  if (before->state != CONTACT_SEPARATED) {
    tie(v, m, j, before, radius);
    return;
  }
  find_motion(v, m, j);
  for (int a = 0; a < scaled_directions(m, j); ++a)
    for (int q = 0; q < v->n_columns; ++q)
      slider_of(v, j + a)[q] = contact_track_vary_touch(at, a, v->du[a][q], v->dv[q]);
}

void fundamental_matrix_follow(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                               const double *y)
{
  if (m->base->n_planar == 0) return;
  memcpy(v->y, y, 2 * (size_t)v->n * sizeof *y);
  memcpy(v->track, track, (size_t)m->n_contacts * sizeof *track);
}

/* True if any contact slips in two directions, turning or held. */
static bool has_slip_that_turns(const scaled_model *m, const contact_track *track)
{
  for (int j = 0; j < m->n_contacts; ++j)
    if (m->contact[j].kind->hold && contact_slip_sign(track[j].state) != 0) return true;
  return false;
}

/* A step from v->theta of the motion and its columns together, of at most `most`. Returns its length; 0: not finite. */
static double step_along(fundamental_matrix *v, const scaled_model *m, double most)
{
  const double shortest = 1e-12; /* [reach] */
  double held;
  const double reach = motion_series_begin(&v->motion, m, v->track, v->theta, v->y, &held);
  double h = fmin(most, fmin(held, v->safe * reach));
  if (!(h > 0)) return 0;
  series_columns_begin(&v->series, m, v->track);
  while (!series_columns_turn(&v->series, m, &v->motion, h, v->n_columns, v->n_states, v->rows))
    if (!((v->safe = (h *= 0.5) / reach) > shortest)) return 0;
  motion_series_at(&v->motion, h, 0, v->y);
  motion_series_turn(&v->motion, h, v->track);
  v->theta += h;
  return h;
}

static hc_status advance_along(fundamental_matrix *v, const scaled_model *m, double theta)
{
  for (double left = theta - v->theta; left > 0;) {
    const double h = step_along(v, m, left);
    if (!(h > 0)) return HC_NOT_FINITE;
    left -= h;
  }
  v->theta = theta;
  return HC_OK;
}

/* Columns of a single mass in closed form. `step` and e[0][1]: response of X and P from rest to a constant force 1. */
static void advance_single(fundamental_matrix *v, const scaled_model *m, const contact_track *track, double span)
{
  const modal_base *b = m->base;
  double *x = row_of(v, 0), *p = row_of(v, 1), *pull = v->du[0], e[2][2], k = m->by_K * b->K[0];
  const double c = m->by_C * b->C[0];
  memset(pull, 0, (size_t)v->n_columns * sizeof *pull);
  for (int j = 0; j < m->n_contacts; ++j) {
    const contact_forces_linear f = contact_track_forces(&track[j], &m->contact[j]);
    const double t = b->tangent[j], n = b->normal[j], *slider = slider_of(v, j);
    k += t * (f.t_u * t + f.t_v * n) + n * f.n_v * n;
    for (int q = 0; q < v->n_columns && f.t_w != 0; ++q) pull[q] -= t * f.t_w * slider[q];
  }
  linear_free_motion(1, c, k, span, e);
  const double step = fabs(k) > MODE_SOFT ? (1 - e[0][0]) / k : linear_step_response(c, k, span);
  for (int q = 0; q < v->n_columns; ++q) {
    const double x0 = x[q], p0 = p[q];
    x[q] = e[0][0] * x0 + e[0][1] * p0 + step * pull[q];
    p[q] = e[1][0] * x0 + e[1][1] * p0 + e[0][1] * pull[q];
  }
}

/* Force of contact j on slowed mode f for a unit motion of mode `at`, or (-1) of its slider. */
static double force_on(const fundamental_matrix *v, const scaled_model *m, const contact_forces_linear *law, int j,
                       int f, int at)
{
  const double *t = m->base->tangent + (size_t)j * (size_t)v->n, *normal = m->base->normal + (size_t)j * (size_t)v->n;
  const int i = v->fast[f];
  if (at < 0) return t[i] * law->t_w;
  return t[i] * (law->t_u * t[at] + law->t_v * normal[at]) + normal[i] * law->n_v * normal[at];
}

/* v->follow: solves (by_K K + contacts) follow = -(forces of contacts) for the slowed modes. */
static hc_status find_following(fundamental_matrix *v, const scaled_model *m, const contact_track *track)
{
  const size_t slowed = (size_t)v->n_slowed;
  memset(v->spring, 0, slowed * slowed * sizeof *v->spring);
  memset(v->follow, 0, slowed * (size_t)v->n_states * sizeof *v->follow);
  for (size_t f = 0; f < slowed; ++f) v->spring[f * (slowed + 1)] = m->by_K * m->base->K[v->fast[f]];
  for (int j = 0; j < v->n_states - 2 * v->n; ++j) {
    const contact_forces_linear law = contact_track_forces(&track[j], &m->contact[j]);
    double *slider = v->follow + (size_t)(2 * v->n + j) * slowed;
    for (int f = 0; f < v->n_slowed; ++f) {
      for (int g = 0; g < v->n_slowed; ++g)
        v->spring[(size_t)g * slowed + (size_t)f] += force_on(v, m, &law, j, f, v->fast[g]);
      for (int i = 0; i < v->n; ++i)
        if (m->base->slowed[i] == 1) v->follow[(size_t)i * slowed + (size_t)f] -= force_on(v, m, &law, j, f, i);
      slider[f] -= force_on(v, m, &law, j, f, -1);
    }
  }
  hc_status st = dense_factor(v->n_slowed, v->spring, v->pivot);
  if (st == HC_OK) dense_solve(v->n_slowed, v->spring, v->pivot, v->n_states, v->follow);
  return st;
}

hc_status fundamental_matrix_begin(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                                   const double *y, bool coarse)
{
  const size_t n = (size_t)v->n_states;
  v->series.rounding = v->n_slowed > 0 ? of_slowed : coarse ? of_coarse : SERIES_COLUMNS_ROUNDING;
  v->safe = coarse || v->n_slowed > 0 ? coarse_step : fine_step;
  hc_status st = v->n_slowed > 0 ? find_following(v, m, track) : HC_OK;
  if (st != HC_OK) return st;
  memset(v->rows, 0, n * n * sizeof *v->rows);
  v->theta = 0;
  v->n_columns = 0;
  for (int i = 0; i < v->n_states; ++i) {
    const int j = i - 2 * v->n;
    const bool on_limit = j >= 0 && scaled_directions(m, j) > 1 && track[j].state != CONTACT_SEPARATED; /* w determines
                                                                                                           e */
    const bool moves =
        j < 0 ? m->base->slowed[i % v->n] == 1 : (m->contact[j].law.has_friction && (track[j].since_start || on_limit));
    if (!moves) continue;
    row_of(v, i)[v->n_columns] = 1;
    /* Slowed modes follow that state as springs. */
    if (v->n_slowed > 0) {
      const bool rate = i >= v->n && i < 2 * v->n;
      const double *follow = v->follow + (size_t)(rate ? i - v->n : i) * (size_t)v->n_slowed;
      for (int f = 0; f < v->n_slowed; ++f) row_of(v, v->fast[f] + (rate ? v->n : 0))[v->n_columns] = follow[f];
    }
    v->state[v->n_columns++] = i;
  }
  for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
    const contact_track *t = &track[j];
    if (t->state != CONTACT_SEPARATED && m->contact[j].law.has_friction && !t->since_start) {
      /* w was on or beyond the limit at the start: dphi; dW if it sticks. */
      const double *w = y + 2 * v->n + j;
      double u[2], normal;
      scaled_contact_motion(m, j, y, u, &normal);
      if (scaled_directions(m, j) > 1) begin_to_turn(v, m, j, t, hypot(u[0] - w[0], u[1] - w[1]));
      if (t->state == CONTACT_STICK) tie(v, m, j, t, contact_track_radius(&m->contact[j], normal));
    }
  }
  fundamental_matrix_follow(v, m, track, y);
  return HC_OK;
}

hc_status fundamental_matrix_advance(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                                     double theta)
{
  const double span = theta - v->theta;
  if (m->base->n_planar > 0 && has_slip_that_turns(m, v->track)) return advance_along(v, m, theta);
  v->theta = theta;
  if (!(span > 0)) return HC_OK;
  if (m->n == 1) {
    advance_single(v, m, track, span);
    return HC_OK;
  }
  const complex_modes *modes = NULL;
  hc_status st = HC_OK;
  if (interval_modes_pay(v->modes, 1 / m->by_C, span)) st = interval_modes_of(v->modes, m, track, &modes);
  if (st != HC_OK) return st;
  if (modes) {
    /* All columns over `span` by complex modes, with the matrix layout of series_columns_advance. */
    const size_t n = (size_t)v->by_modes.n, row = (size_t)v->n_states, apart = (size_t)v->by_modes.n_columns;
    for (size_t k = 0; k < (size_t)modes->count; ++k) {
      const double complex mu = modes->lambda[k] * m->by_C, grown = cexp(mu * span);
      double *change = v->by_modes.change + k * 2 * apart, *rate = v->by_modes.rate + k * 2 * apart;
      find_eta(&v->by_modes, m, modes, track, k, v->n_columns, v->n_states, v->rows, change);
      multiply(&v->by_modes, v->n_columns, modes->weight[k] * grown * mu, change, rate);
      multiply(&v->by_modes, v->n_columns, modes->weight[k] * (grown - 1), change, change);
    }
    for (size_t i = 0; i < n; ++i) {
      double *x = v->rows + i * row, *p = v->rows + (n + i) * row;
      memset(p, 0, (size_t)v->n_columns * sizeof *p);
      for (size_t k = 0; k < (size_t)modes->count; ++k) {
        const double complex V = modes->V[k * n + i];
        const double *change = v->by_modes.change + k * 2 * apart, *rate = v->by_modes.rate + k * 2 * apart;
        add_real(v->n_columns, creal(V), change, x);
        add_real(v->n_columns, creal(V), rate, p);
        if (cimag(V) == 0) continue;
        add_real(v->n_columns, -cimag(V), change + apart, x);
        add_real(v->n_columns, -cimag(V), rate + apart, p);
      }
    }
    return HC_OK;
  }
  series_columns_begin(&v->series, m, track);
  return series_columns_advance(&v->series, m, span, v->n_columns, v->n_states, v->rows);
}

void fundamental_matrix_end(fundamental_matrix *v, const scaled_model *m, const contact_track *track, const double *y,
                            double *monodromy)
{
  const size_t n = (size_t)v->n_states;
  for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
    double u[2], normal;
    if (m->contact[j].law.has_friction && track[j].state == CONTACT_STICK) continue;
    scaled_contact_motion(m, j, y, u, &normal);
    tie(v, m, j, &track[j], contact_track_radius(&m->contact[j], normal));
  }
  memset(monodromy, 0, n * n * sizeof *monodromy);
  for (int q = 0; q < v->n_columns; ++q)
    for (size_t i = 0; i < n; ++i) monodromy[(size_t)v->state[q] * n + i] = row_of(v, (int)i)[q];
}
