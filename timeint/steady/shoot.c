/* shoot.c - see shoot.h. Newton itself is numerics/newton.h. Here is the period map, integrated once at each point: the
 * residual and the Jacobian are asked for one after the other, and come from the same periods. */
#include "timeint/steady/shoot.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include <kinsol/kinsol.h>

#include "numerics/dense.h"
#include "numerics/floquet.h"
#include "numerics/newton.h"
#include "numerics/norm.h"
#include "numerics/sundials_compat.h"
#include "numerics/vectors.h"
#include "timeint/closed_form/series_columns.h"
#include "timeint/steady/timeint_private.h"

enum {
  NEWTON_ITERATIONS = 12,    /* twice the 3 to 7 periods that it takes from the HBM orbit (docs/measurements) */
  KEPT_ITERATIONS = 24,      /* with matrices that are kept: twice as many */
  ANDERSON_ITERATIONS = 100, /* what a contraction of 0.8 a period needs to 1e-9 without acceleration: 0.8^93 = 1e-9 */
  ANDERSON_DEPTH = 4,        /* about the states of an oscillator: with as many as states it is the secant method */
  LAST_STEPS = 4,            /* digits double: from 1e-2 to rounding in three, and one that shows it */
  CONFIRM_STEPS = 8,         /* 0.3^8 = 7e-5: slower than that Newton with variational equations is cheaper */
  USUAL_STEPS = 2000,        /* of a period, or fewer: on such ones its scatter was measured */
  CHORD_STEPS = 60,          /* of 0.5 at worst, from 1 to rounding */
  REST_TRIES = 4,            /* the second shows that all rest, as a rule */
  CHORD_IDLE = 3,            /* steps before the matrix is renewed: it costs 25 to 150 of them */
  CHORD_RENEWALS = 3,        /* of a matrix without which steps do not contract: then there is no orbit */
  SLOWED_STEPS = 3,          /* of 0.02: to 1e-5 of what slowed modes change */
  DIRECTION_STEPS = 64       /* of the power iteration: a second multiplier of 0.8 of the first leaves 0.8^64 = 6e-7 */
};
enum { EDGE_SCATTERS = 100 }; /* sliders are moved off the edge of slip by so much more than rounding */

static const double same_state = 1e-6; /* [size] a state that returns as near is the same, but for integration errors */

static const double same_frequency = 2e-4; /* [omega] where no multiplier is asked for, a matrix serves as far away */
static const double same_matrix = 1e-4;    /* [size] a state as near has the same monodromy matrix, but for some 1e-4 */
static const double scatter_seen = 1e-6; /* [size] a chord step of CVODE's that short, and no shorter than the last, is
                                            the scatter of periods: of fast modes it is not known beforehand */
static const double chord_contracts_to = 0.1; /* [last factor] that by which the next step is shorter, as a rule */
static const double slowed_near = 1e-7;       /* [size] the slowed orbit is where the whole model's begins, 1e-6 off */
static const double nearly_at_rest = 1e-7;    /* [size] a slider that travels less may rest on the orbit itself: */
static const double resolves_rest = 1e-11;    /* [size] distance to the orbit at which it no longer moves */
static const double next_to_orbit = 1e-8;     /* [size] |F^k(z) - z|: the orbit is some 1e-7 off */
static const double chord_contracts = 0.5;    /* [least residual] a chord step that leaves more is idle */
static const double chord_leads_away = 10;    /* [least residual] the matrix is renewed at once where one leaves that */

static const double coarse_scatter = 0.02; /* [expected step] what coarse periods may scatter, at worst, */
static const double coarsest = 1e-8;       /* their tolerance at most */
static const double coarse_until = 20;     /* [attainable] the expected step of fine ones */
static const double chord_leaves = 0.05;   /* [last step] twice what was seen */
static const double as_expected = 10;      /* [expected step] a longer one is not taken */

static const double rounding_of_step = 20 * DBL_EPSILON; /* [L] of the sums that make a step */
/* In a period, about; of the 1000 to 4000 of a large structure, whose errors die away: 1.3e-13 was seen. */
enum { CLOSED_FORM_STEPS = 10, CVODE_STEPS = 1000, LARGE_CLOSED_FORM_STEPS = 100 };
static const double both_scatter = 1e3; /* [tolerance] of F(z0) and F(z*) together: twice 250, and twice that */
static const double contracts = 0.3;    /* [last step] a Newton step no shorter than that leads nowhere */
/* What periods come with: nothing where another gives the matrix or none is needed; for Newton; to be reported. */
typedef enum matrix_kind { NO_MATRIX, COARSE_MATRIX, MATRIX } matrix_kind;

struct shoot { /* from shoot_new, to shoot_free */
  timeint *ti;
  int n, k;
  const hc_monitor *monitor;
  double *z, *f;                /* [n] the last point, and F^k of it */
  double *phi;                  /* [n][n] column by column, dF^k/dz there; as giver of it: */
  double *phi_at;               /* [n] where, */
  double phi_omega, phi_length; /* at which frequency, in which unit, */
  double phi_fastest;           /* with modes slowed to this, */
  int phi_k;                    /* and of how many periods; 0: none */
  long phi_events;              /* contacts' changes of state in these */
  double *travel;               /* [n] of each slider, the farthest it was in a period from where that began */
  double *start, *first;        /* [n] where the solve began, and F^k of that */
  bool known, begun;            /* z, f are valid; start, first are valid */
  matrix_kind has;              /* of these periods, in phi */
  long events;                  /* in these periods, where the law is exact */
  bool measures;                /* the next point is expected on the orbit of a large structure: measured, too */
  double *before;               /* [n] ti->y when the solve began */
  double *found_from;           /* [n] the same of the last orbit of a large structure, in closed form: s->best; */
  double found_omega, found_length;
  int found_k; /* 0: none; and what was reported of it */
  shoot_report found;
  double *iterate, *step, *best; /* [n] of a solve; Newton's step from there; the iterate nearest to the orbit */
  double *weight;                /* [n] 1/size of each state: of Newton's unknowns and residuals */
  double *vector, *other;        /* [n] for what one function needs */
  double *one_period, *product;  /* [n][n] monodromy matrix of one period out of k; a copy of phi */
  double *matrix;                /* [n][n] factors of Newton's matrix */
  int *pivot;                    /* [n] theirs */
  double complex *multipliers;   /* [n] */
  int *active;                   /* [n] the states that are not free sliders */
  workspace memory;              /* of all the arrays above */
  newton *newton;
  floquet *floquet;
  SUNContext ctx; /* of what follows */
  N_Vector u, weights;
  void *kin; /* Anderson's */
  hc_status refusal;
};

/* The period just integrated. A circle's two directions rest or slip as one. */
static void note_travel(shoot *s)
{
  const int moving = 2 * s->ti->n_dof;
  for (int i = moving; i < s->n; ++i) {
    const int j = scaled_first(&s->ti->scaled, i - moving), n = scaled_directions(&s->ti->scaled, j);
    for (int a = 0; a < n; ++a) s->travel[i] = fmax(s->travel[i], integrate_travel(s->ti->in, j + a));
  }
}

/* The handle that gives matrices of a large structure (shoot.h), which may be ti; or NULL: periods come with theirs. */
static timeint *matrix_giver(timeint *ti)
{
  if (ti->slowed) return ti->slowed;
  if (ti->closed_form) return ti->closed_form->slowed;
  return ti->how.method == TRANSIENT_METHOD_CLOSED_FORM && isfinite(ti->fastest) ? ti : NULL;
}

/* y goes on by a period, by `in`; s->phi becomes the monodromy matrix of this and the i periods before it. */
static hc_status add_period(shoot *s, integrator *in, const scaled_model *m, bool coarse, int i, double *y)
{
  double *phi = i == 0 ? s->phi : s->one_period;
  hc_status st = coarse ? integrate_coarse_monodromy(in, m, y, phi) : integrate_monodromy(in, m, y, phi);
  if (st != HC_OK || i == 0) return st;
  memcpy(s->product, s->phi, sizeof *s->phi * (size_t)(s->n * s->n));
  dense_multiply(s->n, s->n, s->n, s->one_period, s->product, s->phi);
  return HC_OK;
}

/* ti->measure is of the orbit of k periods that ended at end[n]. */
static void note_measured(timeint *ti, int k, const double *end, int switches, int returns)
{
  ti->last.k = k;
  ti->last.omega = ti->omega;
  ti->last.length = ti->length;
  ti->last.switches = switches;
  ti->last.returns = returns;
  memcpy(ti->last.end, end, sizeof *end * (size_t)ti->n);
}

/* s->f becomes F^k(s->f), s->phi the matrix of these k periods. */
static hc_status integrate_k_periods(shoot *s, matrix_kind matrix)
{
  timeint *ti = s->ti;
  const bool measured = s->measures && s->k == 1;
  const long transitions = integrate_transitions(ti->in);
  memset(s->travel, 0, (size_t)s->n * sizeof *s->travel);
  if (measured) {
    measure_begin(&ti->measure, &ti->scaled);
    measure_period(&ti->measure, s->f);
    ti->measured = false;
    ti->last.k = 0;
  }
  for (int i = 0; i < s->k; ++i) {
    if (ti->periods >= ti->how.max_periods - s->k) return HC_NOT_SETTLED; /* k are kept for the report */
    if (!hc_monitor_tick(s->monitor, -1)) return HC_INTERRUPTED;
    integrate_watch *watch = measured ? measure_step : NULL;
    hc_status st = matrix ? add_period(s, ti->in, &ti->scaled, matrix == COARSE_MATRIX, i, s->f)
                          : integrate_period(ti->in, &ti->scaled, s->f, watch, &ti->measure);
    if (st != HC_OK) return st;
    ++ti->periods;
    note_travel(s);
  }
  s->events = integrate_transitions(ti->in) - transitions;
  if (measured) note_measured(ti, 1, s->f, (int)s->events, 1);
  return HC_OK;
}

/* F^k at z, with that matrix or a better one: integrated only if z is not the last point asked. */
static hc_status integrate_from(shoot *s, const double *z, matrix_kind matrix)
{
  const size_t bytes = sizeof *z * (size_t)s->n;
  if (s->known && s->has >= matrix && memcmp(s->z, z, bytes) == 0) return HC_OK;
  memcpy(s->z, z, bytes);
  memcpy(s->f, z, bytes);
  hc_status st = integrate_k_periods(s, matrix);
  s->known = st == HC_OK;
  s->has = matrix;
  if (s->known && !s->begun) {
    memcpy(s->start, z, bytes);
    memcpy(s->first, s->f, bytes);
    s->begun = true;
  }
  return st;
}

/* F^k and its Jacobian at z, unless another is to give that. */
static hc_status evaluate(shoot *s, const double *z)
{
  return integrate_from(s, z, matrix_giver(s->ti) ? NO_MATRIX : MATRIX);
}

/* Has Newton a coarse matrix of its own? Its steps contract by the error of that, too. Such a matrix takes ten times as
 * long as the periods: these come without, and it serves on as long as it does. */
static bool takes_coarse(const shoot *s) { return !matrix_giver(s->ti) && integrate_has_coarse(s->ti->in); }

/* State i of one handle in units of another, whose modes are not as slow (modal_base.h). */
static double unit_ratio(const timeint *of, const timeint *in, int i)
{
  const int n = of->n_dof;
  return i < 2 * n ? of->base->slowed[i % n] / in->base->slowed[i % n] : 1;
}

/* Sliders that rest all period from s->z on (or slip by rounding) are moved in y, the giver's state there, until they
 * rest in its period, too, whose motion is a little another. */
static hc_status keep_at_rest(const shoot *s, timeint *giver, double *y)
{
  shoot *of = giver->shoot;
  const double size = timeint_scaled_size(s->ti);
  bool moved = true;
  for (int tries = 0; tries < REST_TRIES && moved; ++tries) {
    moved = false;
    memcpy(of->f, y, sizeof *y * (size_t)s->n);
    memset(of->travel, 0, sizeof *y * (size_t)s->n);
    for (int k = 0; k < s->k; ++k) {
      hc_status st = integrate_period(giver->in, &giver->scaled, of->f, NULL, NULL);
      if (st != HC_OK) return st;
      note_travel(of);
    }
    for (int i = 2 * s->ti->n_dof; i < s->n; ++i) {
      const double own = size * s->ti->sizes.of[i];
      if (!(s->travel[i] <= MEASURE_RESTS * own && of->travel[i] > 0 && isfinite(of->travel[i]))) continue;
      const double moves = fmin(own, state_sizes_slider(&s->ti->sizes, i - 2 * s->ti->n_dof) / s->ti->length);
      y[i] += copysign(of->travel[i] + same_matrix * moves, of->f[i] - y[i]);
      moved = true;
    }
  }
  return HC_OK;
}

/* The giver's matrix at z, found anew; z of s->ti. */
static hc_status find_slowed_matrix(const shoot *s, const double *z)
{
  timeint *ti = s->ti, *giver = matrix_giver(ti);
  shoot *of = giver->shoot;
  double *y = of->vector;
  of->phi_k = 0;
  hc_status st = timeint_slow_modes(giver, ti->omega);
  if (st != HC_OK) return st;
  scaled_make(&giver->scaled, ti->model, &giver->how, ti->omega, ti->length);
  for (int i = 0; i < s->n; ++i) of->phi_at[i] = y[i] = z[i] * unit_ratio(giver, ti, i);
  if (s->known && z == s->z && of != s) st = keep_at_rest(s, giver, y);
  const long events = integrate_transitions(giver->in);
  for (int i = 0; i < s->k && st == HC_OK; ++i) {
    if (!hc_monitor_tick(s->monitor, -1)) return HC_INTERRUPTED;
    st = add_period(of, giver->in, &giver->scaled, false, i, y);
  }
  if (st != HC_OK) return st;
  of->phi_k = s->k;
  of->phi_events = integrate_transitions(giver->in) - events;
  of->phi_omega = ti->omega;
  of->phi_length = ti->length;
  of->phi_fastest = giver->fastest;
  return HC_OK;
}

/* Has the giver a matrix of these periods? */
static bool has_slowed_matrix(const shoot *s)
{
  timeint *ti = s->ti, *giver = matrix_giver(ti);
  const shoot *of = giver->shoot;
  const double within = ti->no_multipliers ? same_frequency * ti->omega : 0;
  return of->phi_k == s->k && of->phi_fastest == giver->fastest && fabs(of->phi_omega - ti->omega) <= within;
}

/* s->phi: the giver's, in the units of s->ti. */
static void take_slowed_matrix(shoot *s)
{
  const timeint *giver = matrix_giver(s->ti);
  for (int j = 0; j < s->n && giver != s->ti; ++j)
    for (int i = 0; i < s->n; ++i)
      s->phi[i + j * s->n] =
          giver->shoot->phi[i + j * s->n] * unit_ratio(giver, s->ti, j) / unit_ratio(giver, s->ti, i);
}

/* The giver's matrix is that of the periods from s->z on, whose contacts do not change, by s->ti itself: as little work
 * then. */
static hc_status give_own_matrix(shoot *s)
{
  const timeint *giver = matrix_giver(s->ti);
  shoot *of = giver->shoot;
  hc_status st = HC_OK;
  memcpy(s->vector, s->z, (size_t)s->n * sizeof *s->z);
  for (int i = 0; i < s->k && st == HC_OK; ++i) st = add_period(s, s->ti->in, &s->ti->scaled, false, i, s->vector);
  for (int j = 0; j < s->n && st == HC_OK; ++j) {
    of->phi_at[j] = s->z[j] * unit_ratio(giver, s->ti, j);
    for (int i = 0; i < s->n; ++i)
      of->phi[i + j * s->n] = s->phi[i + j * s->n] * unit_ratio(giver, s->ti, i) / unit_ratio(giver, s->ti, j);
  }
  of->phi_events = 0;
  of->phi_omega = s->ti->omega;
  of->phi_length = s->ti->length;
  return st;
}

static bool is_unit_row(const shoot *s, int i)
{
  for (int j = 0; j < s->n; ++j)
    if (s->phi[i + j * s->n] != (i == j)) return false;
  return true;
}

/* Did slider i rest in the last periods, but for a slip as small as rounding? */
static bool rested(const shoot *s, int i)
{
  return s->travel[i] <= MEASURE_RESTS * timeint_scaled_size(s->ti) * s->ti->sizes.of[i];
}

/* Is the giver's matrix one along which a slider slips that rested? */
static bool slips_where_rested(const shoot *s, const shoot *of)
{
  for (int i = 2 * s->ti->n_dof; i < s->n; ++i)
    if (rested(s, i) && !is_unit_row(of, i)) return true;
  return false;
}

/* s->phi at the last point asked, to within same_matrix, if it is for a giver to find. Where nothing changes at the
 * contacts, but did on the giver's periods, as slowed modes shake them or from a point where they still slip, its
 * matrix is of another motion, however near. */
static hc_status find_matrix(shoot *s)
{
  const timeint *giver = matrix_giver(s->ti);
  double apart = 0;
  hc_status st = HC_OK;
  if (!giver) return HC_OK;
  const shoot *of = giver->shoot;
  const bool exact = s->ti->how.method == TRANSIENT_METHOD_CLOSED_FORM && s->n <= SERIES_COLUMNS_SQUARED;
  for (int i = 0; i < s->n && has_slowed_matrix(s) && !s->ti->no_multipliers; ++i) {
    const double at = of->phi_at[i] / unit_ratio(giver, s->ti, i) * of->phi_length / s->ti->length;
    apart = fmax(apart, fabs(s->z[i] - at) / s->ti->sizes.of[i]);
  }
  if (exact && giver != s->ti && s->events == 0 && has_slowed_matrix(s) && of->phi_events > 0) st = give_own_matrix(s);
  else if (!has_slowed_matrix(s) || !(apart <= same_matrix * timeint_scaled_size(s->ti)) ||
           (apart > 0 && giver != s->ti && slips_where_rested(s, of)))
    st = find_slowed_matrix(s, s->z);
  if (st == HC_OK) take_slowed_matrix(s);
  return st;
}

/* Is state i a slider at a fixed point of F^k wherever it is, or one that rested? */
static bool is_free(const shoot *s, int i)
{
  if (i < 2 * s->ti->n_dof) return false;
  if (rested(s, i)) return true;
  return s->f[i] == s->z[i] && is_unit_row(s, i);
}

static hc_status residual(void *self, const double *z, double *r)
{
  shoot *s = self;
  hc_status st = takes_coarse(s) ? integrate_from(s, z, NO_MATRIX) : evaluate(s, z);
  for (int i = 0; i < s->n && st == HC_OK; ++i) r[i] = z[i] - s->f[i];
  return st;
}

/* I - Phi, of s->phi. */
static void fill_jacobian(const shoot *s, double *jac)
{
  for (int i = 0; i < s->n; ++i) {
    const bool fixed = is_free(s, i); /* its equation becomes: stay where the start is */
    for (int j = 0; j < s->n; ++j) jac[i + j * s->n] = (i == j) - (fixed ? 0 : s->phi[i + j * s->n]);
  }
}

static hc_status jacobian(void *self, const double *z, double *jac)
{
  shoot *s = self;
  hc_status st = takes_coarse(s) ? integrate_from(s, z, COARSE_MATRIX) : evaluate(s, z);
  if (st == HC_OK) st = find_matrix(s);
  if (st != HC_OK) return st;
  fill_jacobian(s, jac);
  return HC_OK;
}

/* Anderson's map u -> F^k(u). Out of memory is told as a fixed point, at which KINSOL ends: SUNDIALS 7 crashes where it
 * has no memory to tell of a failure (room.h). */
static int period_map(N_Vector u, N_Vector f, void *self)
{
  shoot *s = self;
  if (s->refusal != HC_NO_MEMORY) s->refusal = integrate_from(s, NV_DATA_S(u), NO_MATRIX);
  if (s->refusal == HC_NO_MEMORY) {
    memcpy(NV_DATA_S(f), NV_DATA_S(u), sizeof(double) * (size_t)s->n);
    return 0;
  }
  memcpy(NV_DATA_S(f), s->f, sizeof(double) * (size_t)s->n);
  return s->refusal == HC_OK ? 0 : 1;
}

static hc_status make_anderson(shoot *s)
{
  if (hc_sundials_context(&s->ctx)) return HC_NO_MEMORY;
  s->u = vectors_new(s->n, s->ctx);
  s->weights = vectors_new(s->n, s->ctx);
  s->kin = s->u && s->weights ? KINCreate(s->ctx) : NULL;
  if (!s->kin || !hc_room_for(0)) return HC_NO_MEMORY;
  int bad = HC_KINSOL_QUIET(s->kin);
  bad |= KINSetUserData(s->kin, s);
  bad |= KINSetNumMaxIters(s->kin, ANDERSON_ITERATIONS);
  bad |= KINSetMAA(s->kin, ANDERSON_DEPTH < s->n ? ANDERSON_DEPTH : s->n); /* before KINInit, which makes room for it */
  bad |= KINInit(s->kin, period_map, s->u);
  return bad ? HC_NO_MEMORY : HC_OK;
}

static hc_status make_memory(shoot *s)
{
  double **const vectors[] = {&s->z,    &s->f,      &s->start,  &s->first, &s->before, &s->iterate, &s->step,
                              &s->best, &s->weight, &s->vector, &s->other, &s->travel, &s->phi_at,  &s->found_from};
  double **const matrices[] = {&s->phi, &s->one_period, &s->product, &s->matrix};
  const size_t n = (size_t)s->n;
  workspace *w = &s->memory;
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i) *vectors[i] = workspace_doubles(w, n);
  for (size_t i = 0; i < sizeof matrices / sizeof *matrices; ++i) *matrices[i] = workspace_doubles(w, n * n);
  s->multipliers = workspace_array(w, n, sizeof *s->multipliers);
  s->active = workspace_array(w, n, sizeof *s->active);
  s->pivot = workspace_array(w, n, sizeof *s->pivot);
  return w->failed ? HC_NO_MEMORY : HC_OK;
}

hc_status shoot_new(timeint *ti, shoot **out)
{
  *out = NULL;
  shoot *s = calloc(1, sizeof *s); /* zeroed, so free works half-built */
  if (!s) return HC_NO_MEMORY;
  s->ti = ti;
  s->n = ti->n;
  const newton_problem problem = {.n = s->n, .self = s, .residual = residual, .jacobian = jacobian};
  hc_status st = make_memory(s);
  if (st == HC_OK) st = newton_new(&problem, &s->newton);
  if (st == HC_OK) st = floquet_new(s->n, &s->floquet);
  if (st == HC_OK) st = make_anderson(s);
  if (st == HC_OK) {
    *out = s;
    return HC_OK;
  }
  shoot_free(s);
  return st;
}

void shoot_free(shoot *s)
{
  if (!s) return;
  newton_free(s->newton);
  floquet_free(s->floquet);
  if (s->kin) KINFree(&s->kin);
  if (s->u) N_VDestroy(s->u);
  if (s->weights) N_VDestroy(s->weights);
  if (s->ctx) SUNContext_Free(&s->ctx);
  workspace_free(&s->memory);
  free(s);
}

static void begin(shoot *s, int k, const hc_monitor *monitor)
{
  const size_t bytes = sizeof *s->before * (size_t)s->n;
  memcpy(s->before, s->ti->y, bytes);
  memcpy(s->iterate, s->ti->y, bytes);
  for (int i = 0; i < s->n; ++i) s->weight[i] = 1 / s->ti->sizes.of[i];
  s->k = k;
  s->monitor = monitor;
  s->known = s->begun = s->measures = false;
}

/* Is the solve that begins at ti->y the one that found s->best? */
static bool is_found(const shoot *s, int k)
{
  const timeint *ti = s->ti;
  return s->found_k == k && s->found_omega == ti->omega && s->found_length == ti->length &&
         !memcmp(s->found_from, ti->y, sizeof *ti->y * (size_t)s->n);
}

static void note_found(shoot *s, const shoot_report *report)
{
  s->found = *report;
  memcpy(s->found_from, s->before, sizeof *s->before * (size_t)s->n);
  s->found_omega = s->ti->omega;
  s->found_length = s->ti->length;
  s->found_k = s->k;
}

double orbit_goal(const timeint *ti) { return fmax(ti->how.tolerance * timeint_scaled_size(ti), 100 * ti->tolerance); }

/* [L] The scatter of k integrated periods: how far F^k(z) may be off. */
static double orbit_scatter(const timeint *ti, int k)
{
  if (ti->how.method == TRANSIENT_METHOD_CLOSED_FORM)
    return k * (ti->slowed ? LARGE_CLOSED_FORM_STEPS : CLOSED_FORM_STEPS) * rounding_of_step;
  return k * fmax(integrate_scatter(ti->in) * ti->tolerance, CVODE_STEPS * rounding_of_step);
}

static const double matrix_keeps = 0.1;  /* [residual] where it takes less to leave than to renew: 10^-10 in ten */
static const double share_of_goal = 0.1; /* the matrix' inverse is known to its order of magnitude only */

/* The residual at which Newton stops. A residual r is a distance of about r/(1 - rho) from the orbit: hence
 * share_of_goal times the goal times 1 - rho, but no less than the scatter of periods. finish() judges what is left. */
static double small_residual(const shoot *s, double goal)
{
  return fmax(share_of_goal * goal * (1 - fmin(s->ti->contraction, 1)), orbit_scatter(s->ti, s->k));
}

/* |F^k(z0) - z* - Phi (z0 - z*)| / |z0 - z*|, z* = z. */
static double nonlinear_part(const shoot *s, const double *z)
{
  const int n = s->n;
  double *e = s->vector, *left = s->other;
  for (int i = 0; i < n; ++i) e[i] = s->start[i] - z[i];
  for (int i = 0; i < n; ++i) {
    left[i] = s->first[i] - s->f[i]; /* F(z*) is z*, and nearer to F(z0)'s own errors */
    for (int j = 0; j < n; ++j) left[i] -= s->phi[i + j * n] * e[j];
  }
  const double size = timeint_norm(s->ti, e), rounding = both_scatter * s->ti->tolerance;
  return size > rounding ? fmax(timeint_norm(s->ti, left) - rounding, 0) / size : 0;
}

/* The states in s->active[m] without those whose column of Phi is rounding: their multiplier is 0. How many are
 * left. */
static int drop_negligible_columns(shoot *s, int m)
{
  int kept = 0;
  double largest = 0;
  for (int i = 0; i < s->n * s->n; ++i) largest = fmax(largest, fabs(s->phi[i]));
  for (int a = 0; a < m; ++a) {
    const double *column = s->phi + (size_t)s->active[a] * (size_t)s->n;
    double size = 0;
    for (int i = 0; i < s->n; ++i) size = fmax(size, fabs(column[i]));
    if (size > DBL_EPSILON * largest) s->active[kept++] = s->active[a];
  }
  return kept;
}

/* Sliders that the law ties to X leave columns of some 1e-20 with the regularised law. The QR iteration may fail to
 * converge on many of these; it is then repeated without them. */
static hc_status find_multiplier(shoot *s, shoot_report *r)
{
  const int moving = 2 * s->ti->n_dof;
  int m = 0;
  r->free_sliders = 0;
  for (int i = 0; i < s->n; ++i) {
    const scaled_contact *c = &s->ti->scaled.contact[i < moving ? 0 : i - moving];
    if (!is_free(s, i)) s->active[m++] = i;
    else r->free_sliders += c->law.has_friction && c->direction == 0;
  }
  hc_status st = floquet_multipliers(s->floquet, s->phi, 1, s->n, m, s->active, s->multipliers);
  if (st == HC_NOT_CONVERGED) {
    m = drop_negligible_columns(s, m);
    st = floquet_multipliers(s->floquet, s->phi, 1, s->n, m, s->active, s->multipliers);
  }
  r->multiplier = st == HC_OK ? floquet_largest(m, s->multipliers) : NAN;
  return st;
}

/* Newton's step from z into step[n], and its length [L]. */
static hc_status newton_step(shoot *s, const double *z, double *step, double *length)
{
  hc_status st = jacobian(s, z, s->matrix);
  if (st == HC_OK) st = dense_factor(s->n, s->matrix, s->pivot);
  if (st != HC_OK) return st;
  for (int i = 0; i < s->n; ++i) step[i] = z[i] - s->f[i];
  dense_solve(s->n, s->matrix, s->pivot, 1, step);
  *length = timeint_norm(s->ti, step);
  return HC_OK;
}

/* shoot_report.attainable: Frobenius norm, factors of the last step. */
static double attainable(shoot *s)
{
  double sum = 0, *column = s->vector;
  for (int j = 0; j < s->n; ++j) {
    for (int i = 0; i < s->n; ++i) column[i] = i == j ? s->ti->sizes.of[j] : 0;
    dense_solve(s->n, s->matrix, s->pivot, 1, column);
    const double length = timeint_norm(s->ti, column);
    sum += length * length;
  }
  return sqrt(sum) * orbit_scatter(s->ti, s->k);
}

/* HC_SINGULAR where no digit of the orbit is attainable: it is as any other along a motion that nothing holds. */
static hc_status is_known(const shoot *s, const shoot_report *r)
{
  return r->attainable < timeint_scaled_size(s->ti) ? HC_OK : HC_SINGULAR;
}

/* An orbit on the edge of slip, where F has one derivative on either side: s->phi becomes that of the side that sticks,
 * whichever rounding chose. Sliders that slip by rounding are moved on by that and EDGE_SCATTERS times what periods
 * scatter, as are those that slip then; where one that was moved slips again, no side is known, and s->phi stays. A
 * giver's matrix is of that side already (keep_at_rest). */
static hc_status take_side_that_sticks(shoot *s)
{
  const double rests = MEASURE_RESTS * timeint_scaled_size(s->ti);
  double *z = s->vector, *travel = s->other; /* of s->best */
  bool slips = !matrix_giver(s->ti);
  memcpy(z, s->best, sizeof *z * (size_t)s->n);
  memcpy(travel, s->travel, sizeof *z * (size_t)s->n);
  while (slips) {
    slips = false;
    for (int i = 2 * s->ti->n_dof; i < s->n; ++i) {
      const double own = s->ti->sizes.of[i];
      if (!(travel[i] <= rests * own && s->travel[i] > 0)) continue;
      if (z[i] != s->best[i]) return evaluate(s, s->best);
      z[i] += copysign(s->travel[i] + EDGE_SCATTERS * orbit_scatter(s->ti, s->k) * own, s->f[i] - z[i]);
      slips = true;
    }
    const hc_status st = slips ? evaluate(s, z) : HC_OK;
    if (st != HC_OK) return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : evaluate(s, s->best);
  }
  return HC_OK;
}

/* From s->iterate, next to the orbit: further Newton steps until it is as near as the goal asks or the scatter of
 * periods allows; ti->y and *r are then those of the nearest point. */
static hc_status finish(shoot *s, double goal, shoot_report *r)
{
  const size_t bytes = sizeof *s->best * (size_t)s->n;
  double *z = s->iterate;
  hc_status st = HC_OK;
  for (int tries = 0; tries < LAST_STEPS && st == HC_OK; ++tries) {
    double length;
    if (tries == 0 && (st = evaluate(s, z)) != HC_OK) break; /* as a rule the orbit, and its matrix the last */
    if ((st = newton_step(s, z, s->step, &length)) != HC_OK) break;
    if (length < r->distance) memcpy(s->best, z, bytes), r->distance = length;
    if (r->distance <= goal) break;
    for (int i = 0; i < s->n; ++i) z[i] -= s->step[i];
  }
  if (st == HC_OK && r->distance < INFINITY) st = evaluate(s, s->best);
  if (st == HC_OK && r->distance < INFINITY) st = find_matrix(s);
  if (st != HC_OK || !(r->distance < INFINITY)) return st != HC_OK ? st : HC_NOT_CONVERGED;
  const bool asked = !(matrix_giver(s->ti) && s->ti->no_multipliers);
  r->moved = timeint_distance(s->ti, s->start, s->best);
  r->nonlinear = nonlinear_part(s, s->best);
  if ((st = take_side_that_sticks(s)) != HC_OK || (st = asked ? find_multiplier(s, r) : HC_OK) != HC_OK) return st;
  memcpy(s->ti->y, s->best, bytes);
  r->attainable = attainable(s);
  return r->distance <= fmax(goal, r->attainable) ? is_known(s, r) : HC_NOT_CONVERGED;
}

/* The giver's matrix at s->z, renewed or not, factored. */
static hc_status factor_slowed_matrix(shoot *s, bool renewed)
{
  hc_status st = renewed || !has_slowed_matrix(s) ? find_slowed_matrix(s, s->z) : HC_OK;
  if (st != HC_OK) return st;
  take_slowed_matrix(s);
  fill_jacobian(s, s->matrix);
  return dense_factor(s->n, s->matrix, s->pivot);
}

/* True if a slider of the whole model slips, but travels less than nearly_at_rest in a period. */
static bool has_slider_nearly_at_rest(const shoot *s)
{
  const double size = timeint_scaled_size(s->ti);
  for (int i = 2 * s->ti->n_dof; i < s->n && s->ti->slowed; ++i)
    if (s->travel[i] > 0 && s->travel[i] <= nearly_at_rest * size * s->ti->sizes.of[i]) return true;
  return false;
}

/* s->iterate to where |z - F^k(z)| <= enough, or the orbit is no farther than `near`, by steps no longer than `reach`
 * with one matrix as long as some of them contract: one that does not may have let sliders slip to where they rest. */
static hc_status by_chords(shoot *s, double reach, double enough, double near)
{
  double *z = s->iterate, least = INFINITY, last = 0;
  for (int steps = 0, renewals = 0, idle = 0; steps < CHORD_STEPS; ++steps) {
    hc_status st = evaluate(s, z);
    if (st != HC_OK) return st;
    for (int i = 0; i < s->n; ++i) s->step[i] = z[i] - s->f[i];
    const double size = timeint_norm(s->ti, s->step);
    const bool near_rest = has_slider_nearly_at_rest(s);
    if (size <= enough && !near_rest) return HC_OK;
    idle = size <= chord_contracts * least ? 0 : idle + 1;
    least = fmin(least, size);
    const bool renewed = idle > CHORD_IDLE || size > chord_leads_away * least;
    if (renewed && ++renewals > CHORD_RENEWALS) return HC_NOT_CONVERGED;
    if (renewed) least = size, idle = 0;
    if (renewed || steps == 0) st = factor_slowed_matrix(s, renewed);
    if (st != HC_OK) return st;
    dense_solve(s->n, s->matrix, s->pivot, 1, s->step);
    const double length = timeint_norm(s->ti, s->step), share = length > reach ? reach / length : 1;
    if (!isfinite(length)) return HC_NOT_FINITE;
    if (length <= near && (length <= resolves_rest * timeint_scaled_size(s->ti) || !near_rest)) return HC_OK;
    const double shorter = steps > 0 ? chord_contracts_to * fmin(length / last, 1) : chord_contracts_to;
    s->measures = s->ti->slowed && shorter * length <= near;
    last = length;
    for (int i = 0; i < s->n; ++i) z[i] -= share * s->step[i];
  }
  return HC_NOT_CONVERGED;
}

/* s->iterate, from s->ti->y, onto the orbit next to it of the giver, whose periods cost a fifth: as near to that of
 * s->ti as slowed modes leave it. If there is none it stays. */
static hc_status begin_with_slowed(shoot *s, double reach, double enough)
{
  timeint *ti = s->ti, *giver = ti->slowed;
  shoot *of = giver->shoot;
  double *state = ti->point[0];
  timeint_get_state(ti, state);
  hc_status st = timeint_begin(giver, ti->omega, state);
  if (st != HC_OK || !isfinite(giver->fastest)) return st; /* nothing is slowed at this frequency */
  const double unit = giver->length / ti->length;
  begin(of, s->k, s->monitor);
  st = by_chords(of, reach / unit, fmax(enough, orbit_scatter(giver, s->k)) / unit,
                 slowed_near * timeint_scaled_size(giver));
  if (st == HC_OK) st = find_matrix(of);
  if (st != HC_OK) return shoot_found_no_orbit(st) ? HC_OK : st;
  memcpy(giver->y, of->iterate, sizeof *giver->y * (size_t)s->n);
  timeint_get_state(giver, state);
  timeint_take_state(ti, state, s->iterate);
  memcpy(s->start, s->before, sizeof *s->start * (size_t)s->n);
  for (int i = 0; i < s->n; ++i) s->first[i] = of->first[i] / unit_ratio(giver, ti, i) * unit;
  s->begun = true;
  return HC_OK;
}

/* Is the start nearer to the orbit than the giver's orbit is? Asked where a matrix is there, and none is asked for. */
static bool starts_next_to(shoot *s)
{
  return s->ti->no_multipliers && has_slowed_matrix(s) && evaluate(s, s->iterate) == HC_OK &&
         timeint_distance(s->ti, s->z, s->f) <= next_to_orbit * timeint_scaled_size(s->ti);
}

/* s->iterate next to the orbit of a large structure. */
static hc_status by_chords_from_start(shoot *s, double reach, double enough, double goal)
{
  s->found_k = 0;
  hc_status st = s->ti->slowed && !starts_next_to(s) ? begin_with_slowed(s, reach, enough) : HC_OK;
  return st == HC_OK ? by_chords(s, reach, enough, share_of_goal * goal) : st;
}

hc_status shoot_newton(shoot *s, int k, double reach, double goal, const hc_monitor *monitor, shoot_report *report)
{
  newton_report iterations;
  if (is_found(s, k) && s->found.distance <= goal && cabs(s->found.multiplier) < 1) {
    memcpy(s->ti->y, s->best, sizeof *s->best * (size_t)s->n);
    *report = s->found;
    return HC_OK;
  }
  begin(s, k, monitor);
  const newton_options options = {.z_scale = s->weight,
                                  .r_scale = s->weight,
                                  .tolerance = small_residual(s, goal),
                                  .max_step = reach,
                                  .max_iterations = takes_coarse(s) ? KEPT_ITERATIONS : NEWTON_ITERATIONS,
                                  .keeps = takes_coarse(s) ? matrix_keeps : 0};
  *report = (shoot_report){.distance = INFINITY, .moved = INFINITY, .nonlinear = INFINITY, .multiplier = NAN};
  hc_status st = matrix_giver(s->ti) ? by_chords_from_start(s, reach, options.tolerance, goal)
                                     : newton_solve(s->newton, s->iterate, &options, &iterations);
  if (st == HC_OK) st = finish(s, goal, report);
  if (st != HC_OK) memcpy(s->ti->y, s->before, sizeof *s->before * (size_t)s->n);
  else if (s->ti->slowed) note_found(s, report);
  return st;
}

hc_status shoot_anderson(shoot *s, int k, double goal, const hc_monitor *monitor, shoot_report *report)
{
  const size_t bytes = sizeof *s->before * (size_t)s->n;
  begin(s, k, monitor);
  s->found_k = 0;
  *report = (shoot_report){.distance = INFINITY, .moved = INFINITY, .nonlinear = INFINITY, .multiplier = NAN};
  s->refusal = HC_OK;
  if (KINSetFuncNormTol(s->kin, small_residual(s, goal)) != KIN_SUCCESS) return HC_NOT_FINITE;
  memcpy(NV_DATA_S(s->u), s->before, bytes);
  memcpy(NV_DATA_S(s->weights), s->weight, bytes);
  int flag = KINSol(s->kin, s->u, KIN_FP, s->weights, s->weights);
  memcpy(s->iterate, NV_DATA_S(s->u), bytes);
  if (s->refusal != HC_OK) return s->refusal;
  if (flag == KIN_MEM_FAIL) return HC_NO_MEMORY;
  hc_status st = finish(s, goal, report); /* whatever KINSOL says: finish() judges the iterate itself */
  if (st != HC_OK) memcpy(s->ti->y, s->before, bytes);
  return st;
}

hc_status orbit_find(timeint *ti, int k, double reach, const hc_monitor *monitor, timeint_method *method,
                     shoot_report *found)
{
  *method = TIMEINT_BY_SHOOTING;
  hc_status st = shoot_newton(ti->shoot, k, reach, orbit_goal(ti), monitor, found);
  if (!shoot_found_no_orbit(st)) return st;
  *method = TIMEINT_BY_ANDERSON;
  hc_status second = shoot_anderson(ti->shoot, k, orbit_goal(ti), monitor, found);
  return second == HC_OK || second == HC_INTERRUPTED ? second : st;
}

bool shoot_found_no_orbit(hc_status st)
{
  return st == HC_SINGULAR || st == HC_STALLED || st == HC_NOT_CONVERGED || st == HC_CHATTER || st == HC_NOT_SETTLED;
}

void shoot_direction(shoot *s, double *z)
{
  double *next = s->vector;
  for (int i = 0; i < s->n; ++i) z[i] = s->ti->sizes.of[i] / sqrt(s->n);
  for (int step = 0; step < DIRECTION_STEPS; ++step) {
    for (int i = 0; i < s->n; ++i) {
      next[i] = 0;
      for (int j = 0; j < s->n; ++j) next[i] += (is_free(s, i) ? 0 : s->phi[i + j * s->n]) * z[j];
    }
    double size = timeint_norm(s->ti, next);
    if (!(size > 0)) return;
    for (int i = 0; i < s->n; ++i) z[i] = next[i] / size;
  }
}

/* ---- an orbit measured ---- */

/* The number of periods after which an orbit of k repeats itself: the smallest divisor d of k with returned[d] =
 * |F^d(z) - z| as small as integration errors leave it. */
static int shortest_period(int k, double size, const double *returned)
{
  for (int d = 1; d < k; ++d)
    if (k % d == 0 && returned[d] <= same_state * size) return d;
  return k;
}

static double relative_closure(const timeint *ti, double distance, double amplitude)
{
  if (amplitude > 0) return distance * timeint_response_unit(ti, 0) / amplitude;
  return distance > 0 ? INFINITY : 0;
}

/* Does ti->y lie on the orbit of k periods that was measured last? Then the motion is where these ended. */
static bool is_measured(timeint *ti, int k)
{
  double apart = 0;
  if (ti->last.k != k || ti->last.omega != ti->omega) return false;
  for (int i = 0; i < ti->n; ++i) {
    const double there = ti->last.end[i] * ti->last.length / ti->length;
    apart = fmax(apart, fabs(ti->y[i] - there) / ti->sizes.of[i]);
  }
  if (!(apart <= orbit_goal(ti))) return false;
  timeint_use_length(ti, ti->last.length);
  memcpy(ti->y, ti->last.end, sizeof *ti->y * (size_t)ti->n);
  return true;
}

static void report_measured(timeint *ti, timeint_result *r)
{
  timeint_report(ti, 0, r);
  r->free_sliders = measure_resting_sliders(&ti->measure);
  ti->measured = true;
}

hc_status orbit_measure(timeint *ti, int k, timeint_result *r)
{
  double returned[SETTLE_MAX_MULTIPLE + 1];
  if (is_measured(ti, k)) {
    report_measured(ti, r);
    r->switches = ti->last.switches;
    r->period_multiple = ti->last.returns;
    return HC_OK;
  }
  const long transitions = integrate_transitions(ti->in);
  const size_t moving = 2 * (size_t)ti->n_dof;
  double *began = ti->began;
  memcpy(began, ti->y, moving * sizeof *began);
  measure_begin(&ti->measure, &ti->scaled);
  for (int i = 0; i < k; ++i) {
    hc_status st = timeint_period(ti, true);
    if (st != HC_OK) return st;
    returned[i + 1] = 0;
    for (size_t c = 0; c < moving; ++c)
      returned[i + 1] = fmax(returned[i + 1], fabs(ti->y[c] - began[c]) / ti->sizes.of[c]);
  }
  report_measured(ti, r);
  r->switches = (int)(integrate_transitions(ti->in) - transitions);
  r->period_multiple = shortest_period(k, timeint_size(ti) / ti->length, returned);
  if (ti->slowed) note_measured(ti, k, ti->y, r->switches, r->period_multiple);
  return HC_OK;
}

/* Into *r, measured before: what is known of the orbit found by `method`. */
static void orbit_fill(const timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r)
{
  r->method = method;
  r->closure = relative_closure(ti, found->distance, r->amplitude);
  r->attainable = relative_closure(ti, found->attainable, r->amplitude);
  r->multiplier = cabs(found->multiplier);
  r->multiplier_re = creal(found->multiplier);
  r->multiplier_im = cimag(found->multiplier);
  r->contraction = pow(r->multiplier, 1.0 / k);
  if (found->free_sliders > r->free_sliders) r->free_sliders = found->free_sliders;
}

hc_status orbit_report(timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r)
{
  hc_status st = orbit_measure(ti, k, r);
  if (st == HC_OK) orbit_fill(ti, k, method, found, r);
  return st;
}

hc_status orbit_report_none(timeint *ti, hc_status why, timeint_result *r)
{
  const shoot_report none = {.distance = INFINITY, .attainable = INFINITY, .multiplier = NAN};
  hc_status st = orbit_report(ti, 1, TIMEINT_BY_MARCHING, &none, r);
  r->period_multiple = 0;
  return st == HC_OK ? why : st;
}

/* ---- an orbit known in closed form, confirmed ---- */

/* s->phi of the exact law in closed form along the k periods from ti->y on. */
static hc_status closed_form_matrix(shoot *s)
{
  timeint *ti = s->ti, *closed = ti->closed_form;
  scaled_make(&closed->scaled, ti->model, &closed->how, ti->omega, ti->length);
  memcpy(s->f, ti->y, sizeof *s->f * (size_t)s->n);
  hc_status st = HC_OK;
  for (int i = 0; i < s->k && st == HC_OK; ++i) st = add_period(s, closed->in, &closed->scaled, true, i, s->f);
  return st;
}

/* The same of a large structure: as it is next to there. */
static hc_status nearby_matrix(shoot *s)
{
  hc_status st = has_slowed_matrix(s) ? HC_OK : find_slowed_matrix(s, s->ti->y);
  if (st == HC_OK) take_slowed_matrix(s);
  return st;
}

/* s->matrix becomes the factors of I - Phi^k of the exact law in closed form along the k periods from ti->y on. The
 * equation of a slider that stays wherever it is becomes: go where the period takes it. */
static hc_status factor_closed_form(shoot *s)
{
  timeint *ti = s->ti;
  hc_status st = matrix_giver(ti) ? nearby_matrix(s) : closed_form_matrix(s);
  if (st != HC_OK) return st;
  for (int i = 0; i < s->n; ++i) {
    const bool stays = i >= 2 * ti->n_dof && is_unit_row(s, i);
    for (int j = 0; j < s->n; ++j) s->matrix[i + j * s->n] = (i == j) - (stays ? 0 : s->phi[i + j * s->n]);
  }
  return dense_factor(s->n, s->matrix, s->pivot);
}

hc_status shoot_slowed(shoot *s, int k, const hc_monitor *monitor)
{
  timeint *slowed = s->ti->slowed;
  shoot *of = slowed->shoot;
  begin(s, k, monitor);
  memcpy(s->z, s->iterate, sizeof *s->z * (size_t)s->n);
  hc_status st = find_matrix(s);
  for (int i = 0; i < s->n && st == HC_OK; ++i) {
    const bool stays = i >= 2 * s->ti->n_dof && is_unit_row(of, i);
    for (int j = 0; j < s->n; ++j) s->matrix[i + j * s->n] = (i == j) - (stays ? 0 : of->phi[i + j * s->n]);
  }
  if (st == HC_OK) st = dense_factor(s->n, s->matrix, s->pivot);
  for (int steps = 0; steps < SLOWED_STEPS && st == HC_OK; ++steps) {
    memcpy(s->iterate, slowed->y, sizeof *s->iterate * (size_t)s->n);
    for (int i = 0; i < k && st == HC_OK; ++i)
      st = integrate_period(slowed->in, &slowed->scaled, slowed->y, NULL, NULL);
    for (int i = 0; i < s->n; ++i) s->step[i] = slowed->y[i] - s->iterate[i];
    dense_solve(s->n, s->matrix, s->pivot, 1, s->step);
    for (int i = 0; i < s->n; ++i) slowed->y[i] = s->iterate[i] + s->step[i];
  }
  return st;
}

/* s->k periods from s->iterate on, measured unless r is NULL; s->step: from the orbit to s->iterate, *length of it. */
static hc_status integrate_and_step(shoot *s, double *length, timeint_result *r)
{
  timeint *ti = s->ti;
  hc_status st = HC_OK;
  if (ti->periods + s->k > ti->how.max_periods) return HC_NOT_SETTLED;
  if (!hc_monitor_tick(s->monitor, -1)) return HC_INTERRUPTED;
  memcpy(ti->y, s->iterate, sizeof *s->iterate * (size_t)s->n);
  if (r) st = orbit_measure(ti, s->k, r);
  for (int i = 0; !r && i < s->k && st == HC_OK; ++i, ++ti->periods)
    st = integrate_period(ti->in, &ti->scaled, ti->y, NULL, NULL);
  if (st != HC_OK) return st;
  for (int i = 0; i < s->n; ++i) s->step[i] = s->iterate[i] - ti->y[i];
  dense_solve(s->n, s->matrix, s->pivot, 1, s->step);
  *length = timeint_norm(s->ti, s->step);
  return isfinite(*length) ? HC_OK : HC_NOT_FINITE;
}

/* The first steps of a large structure, whose orbit is about `off` [L] away: with periods as coarse as the step that is
 * expected allows. */
static hc_status confirm_coarsely(shoot *s, double off, double attainable)
{
  timeint *ti = s->ti;
  const double fine = ti->tolerance, by_tolerance = attainable / fine;
  hc_status st = HC_OK;
  for (double expected = off; expected > coarse_until * attainable && st == HC_OK;) {
    double length = NAN;
    st = timeint_set_tolerance(ti, fmin(fmax(coarse_scatter * expected / by_tolerance, fine), coarsest));
    if (st == HC_OK) st = integrate_and_step(s, &length, NULL);
    if (st != HC_OK || !(length <= as_expected * expected)) break;
    for (int i = 0; i < s->n; ++i) s->iterate[i] -= s->step[i];
    expected = chord_leaves * length;
  }
  const hc_status back = timeint_set_tolerance(ti, fine);
  return st == HC_OK ? back : st;
}

hc_status shoot_confirm(shoot *s, int k, double goal, double off, const hc_monitor *monitor, shoot_report *found,
                        timeint_result *r)
{
  timeint *ti = s->ti;
  const size_t bytes = sizeof *s->iterate * (size_t)s->n;
  double length = INFINITY, last = INFINITY;
  const double size = timeint_scaled_size(ti);
  const bool large = matrix_giver(ti) != NULL;
  begin(s, k, monitor);
  hc_status st = factor_closed_form(s);
  if (st == HC_OK) found->attainable = attainable(s), st = is_known(s, found);
  if (st == HC_OK && large) st = confirm_coarsely(s, off, found->attainable);
  for (int tries = 0; st == HC_OK; ++tries) {
    st = integrate_and_step(s, &length, r);
    found->distance = length;
    if (st != HC_OK || length <= (large ? fmax(goal, found->attainable) : goal)) break;
    if (tries == CONFIRM_STEPS || !(length <= contracts * last)) { /* as near as periods can tell, or not at all */
      /* Errors of steps add up as their square root does: a period of many scatters by more. */
      const double steps = (double)(integrate_steps(ti->in) - ti->steps0) / (double)ti->periods;
      const double within = large ? scatter_seen * size : found->attainable * sqrt(fmax(steps / USUAL_STEPS, 1));
      if (length <= within) found->attainable = fmax(found->attainable, length);
      else st = HC_NOT_CONVERGED;
      break;
    }
    for (int i = 0; i < s->n; ++i) s->iterate[i] -= s->step[i];
    if (!(timeint_distance(s->ti, s->iterate, s->before) <= ORBIT_REGULARISED_WITHIN * size)) st = HC_NOT_CONVERGED;
    last = length;
  }
  if (st != HC_OK) memcpy(ti->y, s->before, bytes);
  else orbit_fill(ti, k, TIMEINT_BY_SHOOTING, found, r);
  return st;
}
