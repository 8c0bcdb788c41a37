/* mistakes.c - see mistakes.h. */
#include "compare/verify/equations/mistakes.h"

#include <complex.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/planar/planar_slider.h"
#include "numerics/series.h"

/* ---- sliders ---- */

static void zero(double *w, slider_origin *origin)
{
  (void)origin; /* it depends on nothing */
  *w = 0;
}

/* A step by radial return. As contact is made the slider starts where the line between the samples meets r = 0, or at
 * w = 0. */
static planar_move return_radially(bool on_line, const planar_sample *from, const planar_sample *to, double w[2],
                                   planar_slope *slope)
{
  if (!(to->r > 0)) {
    memcpy(w, to->u, sizeof to->u);
    return PLANAR_APART;
  }
  if (from->r > 0) return planar_slider_enter(to, w, slope);
  const double rise = to->r - from->r, t = on_line ? -from->r / rise : 0;
  const double way[2] = {to->u[0] - from->u[0], to->u[1] - from->u[1]};
  for (int d = 0; d < 2; ++d) w[d] = on_line ? from->u[d] + t * way[d] : 0;
  if (slope) *slope = (planar_slope){.w = {{1, 0}, {0, 1}}};
  const planar_move move = planar_slider_enter(to, w, slope);
  for (int d = 0; d < 2 && slope; ++d) {
    double *const by_w = slope->w[d], by_t = (by_w[0] * way[0] + by_w[1] * way[1]) / (rise * rise);
    for (int c = 0; c < 2; ++c) {
      slope->from[d][c] = on_line ? (1 - t) * by_w[c] : 0;
      slope->to[d][c] += t * by_w[c];
      by_w[c] = 0;
    }
    slope->from[d][2] = on_line ? -by_t * to->r : 0;
    slope->to[d][2] += on_line ? by_t * from->r : 0;
  }
  return move == PLANAR_HELD ? PLANAR_PLACED : move;
}

static planar_move step_radially(const planar_sample *from, const planar_sample *to, double w[2], planar_slope *slope)
{
  return return_radially(true, from, to, w, slope);
}

static planar_move step_zeroed(const planar_sample *from, const planar_sample *to, double w[2], planar_slope *slope)
{
  return return_radially(false, from, to, w, slope);
}

static planar_move step_kept(const planar_sample *from, const planar_sample *to, double w[2], planar_slope *slope)
{
  (void)from;
  return to->r > 0 ? planar_slider_enter(to, w, slope) : PLANAR_APART;
}

const slider_rule verify_on_line = {.restart = HBM_RESTART_INTERPOLATED},
                  verify_on_sample = {.restart = HBM_RESTART_SAMPLE},
                  verify_radial = {.in_plane = &(const planar_rule){step_radially}},
                  verify_zeroed = {.touch = zero, .in_plane = &(const planar_rule){step_zeroed}},
                  verify_kept = {.in_plane = &(const planar_rule){step_kept}, .keeps = true},
                  verify_once = {.once = true}, verify_once_sampled = {.restart = HBM_RESTART_SAMPLE, .once = true};

/* ---- a contact force whose harmonics are multiplied, and the mean of u added: any evaluator's ---- */

typedef struct spoiled {
  contact_evaluator own;
  void *inner;           /* own's */
  int n_tangents;        /* coordinates, the first ones, that friction alone acts on */
  size_t length, n_coef; /* 2H+1; of all coordinates */
  double spring;         /* [force/length] that adds to the mean force on each of these by the mean motion */
  double factor[];       /* [n_coef] [1] */
} spoiled;

static void spoil_jacobian(const spoiled *s, double *jac)
{
  for (size_t q = 0; q < s->n_coef; ++q)
    for (size_t p = 0; p < s->n_coef; ++p) jac[q * s->n_coef + p] *= s->factor[p];
  for (size_t d = 0; d < (size_t)s->n_tangents; ++d) jac[d * s->length * (s->n_coef + 1)] += s->spring;
}

static hc_status spoiled_evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  const spoiled *s = self;
  const hc_status st = s->own.evaluate(s->inner, X, F, jac, report);
  if (st != HC_OK) return st;
  for (size_t i = 0; i < s->n_coef; ++i) F[i] *= s->factor[i];
  for (size_t d = 0; d < (size_t)s->n_tangents; ++d) F[d * s->length] += s->spring * X[d * s->length];
  if (jac && !s->own.jacobian) spoil_jacobian(s, jac);
  return HC_OK;
}

static void spoiled_jacobian(void *self, double *jac)
{
  const spoiled *s = self;
  s->own.jacobian(s->inner, jac);
  spoil_jacobian(s, jac);
}

static void spoiled_free(void *self)
{
  spoiled *s = self;
  if (s) s->own.free(s->inner);
  free(s);
}

/* What the evaluator itself is asked, where it answers. */
static const contact_evaluator *own_of(const void *self) { return &((const spoiled *)self)->own; }
static void *inner_of(const void *self) { return ((const spoiled *)self)->inner; }
static void ask_sliders(const void *self, double *w) { own_of(self)->sliders(inner_of(self), w); }
static const contact_interval *ask_intervals(const void *self, int *n)
{
  return own_of(self)->intervals(inner_of(self), n);
}
static const struct planar_cycle *ask_in_plane(const void *self) { return own_of(self)->in_plane(inner_of(self)); }
static void ask_at_omega(void *self, double omega) { own_of(self)->at_omega(inner_of(self), omega); }
static const double *ask_by_omega(const void *self) { return own_of(self)->by_omega(inner_of(self)); }
static contact_slopes ask_slopes(const void *self, double th, double omega)
{
  return own_of(self)->slopes(inner_of(self), th, omega);
}

/* The factors of contact j in the coordinates *x. */
static void choose_factors(const verify_mistakes *wrong, bool turned, const contact *law, spoiled *s)
{
  for (size_t i = 0; i < s->n_coef; ++i) {
    const size_t harmonic = (i % s->length + 1) / 2, coordinate = i / s->length;
    const bool friction = coordinate < (size_t)s->n_tangents;
    s->factor[i] = friction && turned ? -1 : 1;
    if (harmonic == 0) s->factor[i] *= friction && wrong->mean ? 0 : 1 + wrong->mean_error;
    if (wrong->odd_only && harmonic % 2 == 0) s->factor[i] = 0;
  }
  s->spring = wrong->mean == FRICTION_MEAN_OF_U ? law->kt : 0;
}

static hc_status spoiled_make(const hbm_plug_in *plug_in, int j, contact_coordinates *x, const placed_contact *c,
                              const evaluator_settings *how, contact_evaluator *by, void **self)
{
  const verify_mistakes *wrong = (const verify_mistakes *)plug_in;
  const bool turned = wrong->turned >> (j < 31 ? j : 31) & 1;
  evaluator_settings settings = *how;
  if (wrong->slider) settings.slider = *wrong->slider;
  if (!turned && !wrong->mean && wrong->mean_error == 0 && !wrong->odd_only) return by->make(x, &settings, self);
  if (turned && x->n_dof == 1 && x->moved.cu[0] != 0 && x->moved.cv[0] != 0) /* T and N are told apart by u and v */
    *x = (contact_coordinates){.n_dof = 2,
                               .direction = {c->tangent, c->normal},
                               .divisor = {1, 1},
                               .moved = {.law = c->law, .cu = {1}, .cv = {0, 1}}};
  const size_t length = (size_t)series_length(how->n_harm), n_coef = (size_t)x->n_dof * length;
  spoiled *s = calloc(1, sizeof *s + n_coef * sizeof *s->factor);
  *self = NULL;
  if (!s) return HC_NO_MEMORY;
  *s = (spoiled){.own = *by, .length = length, .n_coef = n_coef};
  if (x->n_dof > 1) s->n_tangents = c->planar ? 2 : 1;
  else s->n_tangents = x->moved.cv[0] == 0 && contact_has_friction(&c->law);
  choose_factors(wrong, turned, &c->law, s);
  if (x->n_dof == 1) s->spring *= x->moved.cu[0] * x->moved.cu[0];
  const hc_status st = by->make(x, &settings, &s->inner);
  if (st != HC_OK) {
    free(s);
    return st;
  }
  *by = (contact_evaluator){.free = spoiled_free,
                            .evaluate = spoiled_evaluate,
                            .jacobian = by->jacobian ? spoiled_jacobian : NULL,
                            .sliders = ask_sliders,
                            .intervals = by->intervals ? ask_intervals : NULL,
                            .in_plane = by->in_plane ? ask_in_plane : NULL,
                            .slopes = by->slopes ? ask_slopes : NULL,
                            .at_omega = by->at_omega ? ask_at_omega : NULL,
                            .by_omega = by->by_omega ? ask_by_omega : NULL};
  *self = s;
  return HC_OK;
}

/* ---- all of them ---- */

static double complex hysteretic_damping(int h, double omega, double complex *by_omega)
{
  (void)omega;
  *by_omega = 0;
  return h > 0 ? I : 0;
}

void verify_plug_in(verify_mistakes *wrong, hbm_settings *how)
{
  const bool of_model = wrong->mean_error != 0 || wrong->turned || wrong->mean || wrong->hysteretic;
  wrong->plug_in = (hbm_plug_in){spoiled_make, wrong->hysteretic ? hysteretic_damping : NULL};
  how->plug_in = &wrong->plug_in;
  if (of_model) how->skip_linear = false; /* the closed form is the model's as it is */
}
