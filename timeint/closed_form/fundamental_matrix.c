/* fundamental_matrix.c - see fundamental_matrix.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/closed_form/fundamental_matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/linear.h"
#include "timeint/closed_form/modal_motion.h"

static hc_status modes_columns_make(modes_columns *s, const modal_base *base)
{
  const size_t n = (size_t)base->n, columns = 2 * n + (size_t)base->n_contacts;
  *s = (modes_columns){.n = base->n, .n_columns = (int)columns};
  s->change = calloc(2 * 4 * n * columns, sizeof *s->change);
  s->rate = s->change ? s->change + 4 * n * columns : NULL;
  return s->change ? HC_OK : HC_NO_MEMORY;
}

static void modes_columns_free(modes_columns *s) { free(s->change); }

/* to[count] += by from[count] */
static void add_real(int count, double by, const double *restrict from, double *restrict to)
{
  for (int q = 0; q < count; ++q) to[q] += by * from[q];
}

/* The same, to complex numbers whose parts are `apart` from each other. */
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

/* to := by z of all columns; to and z may be the same. */
static void multiply(const modes_columns *s, int count, double complex by, const double *z, double *to)
{
  const size_t apart = (size_t)s->n_columns;
  for (int q = 0; q < count; ++q) {
    const double re = z[q], im = z[apart + (size_t)q];
    to[q] = creal(by) * re - cimag(by) * im;
    to[apart + (size_t)q] = creal(by) * im + cimag(by) * re;
  }
}

/* count columns over `span`, contacts in the states of track[] and of the modes. The matrix as series_columns_advance
 * has it. */
static void modes_columns_advance(modes_columns *s, const scaled_model *m, const complex_modes *modes,
                                  const contact_track *track, double span, int count, int ld, double *matrix)
{
  const size_t n = (size_t)s->n, row = (size_t)ld, apart = (size_t)s->n_columns;
  for (size_t k = 0; k < (size_t)modes->count; ++k) {
    const double complex mu = modes->lambda[k] * m->by_C, grown = cexp(mu * span);
    double *change = s->change + k * 2 * apart, *rate = s->rate + k * 2 * apart;
    find_eta(s, m, modes, track, k, count, ld, matrix, change);
    multiply(s, count, modes->weight[k] * grown * mu, change, rate);
    multiply(s, count, modes->weight[k] * (grown - 1), change, change);
  }
  for (size_t i = 0; i < n; ++i) {
    double *x = matrix + i * row, *p = matrix + (n + i) * row;
    memset(p, 0, (size_t)count * sizeof *p);
    for (size_t k = 0; k < (size_t)modes->count; ++k) {
      const double complex V = modes->V[k * n + i];
      const double *change = s->change + k * 2 * apart, *rate = s->rate + k * 2 * apart;
      add_real(count, creal(V), change, x);
      add_real(count, creal(V), rate, p);
      if (cimag(V) == 0) continue;
      add_real(count, -cimag(V), change + apart, x);
      add_real(count, -cimag(V), rate + apart, p);
    }
  }
}

hc_status fundamental_matrix_make(fundamental_matrix *v, const modal_base *base, interval_modes *modes)
{
  const size_t states = 2 * (size_t)base->n + (size_t)base->n_contacts;
  *v = (fundamental_matrix){.n = base->n, .n_states = (int)states, .modes = modes};
  v->rows = calloc(states * (states + 4), sizeof *v->rows);
  v->state = calloc(states, sizeof *v->state);
  v->track = calloc(states, sizeof *v->track);
  if (!v->rows || !v->state || !v->track) return HC_NO_MEMORY;
  v->du = v->rows + states * states;
  v->dv = v->du + states;
  v->du2 = v->dv + states;
  v->y = v->du2 + states;
  hc_status st = series_columns_make(&v->series, base);
  if (st == HC_OK && base->n_planar > 0) st = motion_series_make(&v->motion, base);
  return st == HC_OK && modes ? modes_columns_make(&v->by_modes, base) : st;
}

void fundamental_matrix_free(fundamental_matrix *v)
{
  series_columns_free(&v->series);
  modes_columns_free(&v->by_modes);
  motion_series_free(&v->motion);
  free(v->track);
  free(v->rows);
  free(v->state);
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
static void find_motion(fundamental_matrix *v, const modal_base *b, int j)
{
  project(v, b->tangent + (size_t)j * (size_t)b->n, v->du);
  project(v, b->normal + (size_t)j * (size_t)b->n, v->dv);
}

/* ---- circles --------------------------------------------------------------------------------------------- */

/* v->du, v->du2 and v->dv of the circle whose first direction is j. */
static void find_planar(fundamental_matrix *v, const modal_base *b, int j)
{
  project(v, b->tangent + (size_t)(j + 1) * (size_t)b->n, v->du2);
  find_motion(v, b, j);
}

/* dphi into the first slider's row, from those of a slider with |U - W| = R. */
static void begin_to_turn(fundamental_matrix *v, const scaled_model *m, int j, const contact_track t[2], double radius)
{
  double *one = slider_of(v, j), *two = slider_of(v, j + 1);
  find_planar(v, m->base, j);
  for (int q = 0; q < v->n_columns; ++q)
    one[q] = (t[0].along * (v->du2[q] - two[q]) - t[1].along * (v->du[q] - one[q])) / radius;
}

/* dW of both from dphi in the first one's row. */
static void tie_planar(fundamental_matrix *v, const scaled_model *m, int j, const contact_track t[2], double radius)
{
  const law_regularised *law = &m->contact[j].law;
  const double shrinks = law->mu * law->kn / law->kt;
  double *one = slider_of(v, j), *two = slider_of(v, j + 1);
  find_planar(v, m->base, j);
  for (int q = 0; q < v->n_columns; ++q) {
    const double angle = one[q];
    one[q] = v->du[q] - shrinks * v->dv[q] * t[0].along + radius * t[1].along * angle;
    two[q] = v->du2[q] - shrinks * v->dv[q] * t[1].along - radius * t[0].along * angle;
  }
}

/* At the start of a period, where w has just been put on the circle: dphi; dW where it sticks there. */
static void begin_planar(fundamental_matrix *v, const scaled_model *m, int j, const contact_track t[2], const double *y)
{
  const double *w = y + 2 * v->n + j;
  double u[2], normal;
  if (t->state == CONTACT_SEPARATED || t->since_start) return;
  scaled_planar_motion(m, j, y, u, &normal);
  begin_to_turn(v, m, j, t, hypot(u[0] - w[0], u[1] - w[1]));
  if (t->state == CONTACT_STICK) tie_planar(v, m, j, t, planar_track_radius(&m->contact[j], normal));
}

void fundamental_matrix_planar(fundamental_matrix *v, const scaled_model *m, int j, const contact_track before[2],
                               const contact_track after[2], const planar_contact_motion *at)
{
  const double radius = planar_track_radius(&m->contact[j], at->v);
  if (before->state == CONTACT_STICK && after->state == CONTACT_SLIP_PLUS) begin_to_turn(v, m, j, after, radius);
  if (before->state == CONTACT_SLIP_PLUS && after->state == CONTACT_STICK) tie_planar(v, m, j, before, radius);
  if (before->state != CONTACT_SEPARATED || after->state != CONTACT_STICK) return;
  for (int a = 0; a < 2; ++a) {
    const contact_motion one = {at->u[a], at->v, at->du[a], at->dv};
    fundamental_matrix_stick(v, m, j + a, CONTACT_SEPARATED, &one);
  }
}

void fundamental_matrix_follow(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                               const double *y)
{
  if (m->base->n_planar == 0) return;
  memcpy(v->y, y, 2 * (size_t)v->n * sizeof *y);
  memcpy(v->track, track, (size_t)m->n_contacts * sizeof *track);
}

static bool has_slipping_planar(const scaled_model *m, const contact_track *track)
{
  for (int j = 0; j < m->n_contacts; ++j)
    if (m->contact[j].circle && track[j].state == CONTACT_SLIP_PLUS) return true;
  return false;
}

/* Does the period begin with the slider of the circle, of which j is a direction, on it? */
static bool is_on_circle(const scaled_model *m, const contact_track *track, int j)
{
  return (m->contact[j].circle || m->contact[j].second) && track[j].state != CONTACT_SEPARATED;
}

/* A step from v->theta of the motion and its columns together, up to `most`. Its length; 0: not finite. */
static double step_along(fundamental_matrix *v, const scaled_model *m, double most)
{
  const double safe = 0.7; /* terms of columns grow with their number faster by a factor of that */
  const double held = motion_series_hold(m, v->track, v->y);
  const double reach = motion_series_begin(&v->motion, m, v->track, v->theta, v->y);
  const double h = fmin(most, fmin(held, safe * reach));
  if (!(h > 0)) return 0;
  series_columns_begin(&v->series, m, v->track);
  series_columns_turn(&v->series, m, &v->motion, h, v->n_columns, v->n_states, v->rows);
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

/* ---------------------------------------------------------------------------------------------------------- */

/* A single mass: its columns in closed form. The response to a constant force 1 from rest is `step` in X, e01 in P. */
static void advance_single(fundamental_matrix *v, const scaled_model *m, const contact_track *track, double span)
{
  const modal_base *b = m->base;
  double *x = row_of(v, 0), *p = row_of(v, 1), *pull = v->du, e[2][2], k = m->by_K * b->K[0];
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

void fundamental_matrix_begin(fundamental_matrix *v, const scaled_model *m, const contact_track *track, const double *y)
{
  const size_t n = (size_t)v->n_states;
  memset(v->rows, 0, n * n * sizeof *v->rows);
  v->n_columns = 0;
  for (int i = 0; i < v->n_states; ++i) {
    const int j = i - 2 * v->n;
    const bool moves = j < 0 || (m->contact[j].law.has_friction && (track[j].since_start || is_on_circle(m, track, j)));
    if (!moves) continue;
    row_of(v, i)[v->n_columns] = 1;
    v->state[v->n_columns++] = i;
  }
  for (int j = 0; j < m->n_contacts; ++j) { /* on its limit: put there, as the motion has it */
    const contact_track *t = &track[j];
    if (m->contact[j].circle) begin_planar(v, m, j, t, y);
    if (m->contact[j].circle || m->contact[j].second) continue;
    if (t->state != CONTACT_STICK || !m->contact[j].law.has_friction || t->since_start) continue;
    const contact_state slip = t->limit > 0 ? CONTACT_SLIP_PLUS : CONTACT_SLIP_MINUS;
    fundamental_matrix_stick(v, m, j, slip, &(contact_motion){0});
  }
}

hc_status fundamental_matrix_advance(fundamental_matrix *v, const scaled_model *m, const contact_track *track,
                                     double theta)
{
  const double span = theta - v->theta;
  if (m->base->n_planar > 0 && has_slipping_planar(m, v->track)) return advance_along(v, m, theta);
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
    modes_columns_advance(&v->by_modes, m, modes, track, span, v->n_columns, v->n_states, v->rows);
    return HC_OK;
  }
  series_columns_begin(&v->series, m, track);
  return series_columns_advance(&v->series, m, span, v->n_columns, v->n_states, v->rows);
}

void fundamental_matrix_stick(fundamental_matrix *v, const scaled_model *m, int j, contact_state before,
                              const contact_motion *at)
{
  if (!m->contact[j].law.has_friction) return;
  double *slider = slider_of(v, j);
  find_motion(v, m->base, j);
  for (int q = 0; q < v->n_columns; ++q)
    slider[q] = contact_track_vary_rest(&m->contact[j], before, at, v->du[q], v->dv[q]);
}

void fundamental_matrix_end(fundamental_matrix *v, const scaled_model *m, const contact_track *track, const double *y,
                            double *monodromy)
{
  const size_t n = (size_t)v->n_states;
  for (int j = 0; j < m->n_contacts; ++j) {
    if (m->contact[j].law.has_friction && track[j].state == CONTACT_STICK) continue;
    if (track[j].state != CONTACT_SEPARATED && (m->contact[j].circle || m->contact[j].second)) {
      double u[2], normal;
      if (m->contact[j].second) continue;
      scaled_planar_motion(m, j, y, u, &normal);
      tie_planar(v, m, j, &track[j], planar_track_radius(&m->contact[j], normal));
      continue;
    }
    double *slider = slider_of(v, j);
    find_motion(v, m->base, j);
    for (int q = 0; q < v->n_columns; ++q)
      slider[q] = contact_track_vary_slider(&track[j], &m->contact[j], v->du[q], v->dv[q]);
  }
  memset(monodromy, 0, n * n * sizeof *monodromy);
  for (int q = 0; q < v->n_columns; ++q)
    for (size_t i = 0; i < n; ++i) monodromy[(size_t)v->state[q] * n + i] = row_of(v, (int)i)[q];
}
