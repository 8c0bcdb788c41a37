/* survey_starts.c - see survey_starts.h. Proof: tests/compare/test_survey.c. */
#include "compare/survey_starts.h"

#include <gsl/gsl_qrng.h>
#include <string.h>

#include "model/modes.h"
#include "numerics/base/constants.h"
#include "numerics/base/workspace.h"
#include "numerics/norm.h"
#include "numerics/random.h"

enum { SOBOL_DIMENSIONS = 40, MOST_MODES = 12 };
static const double least_share = 0.1;     /* [velocity of the most moved mode] of a mode that no load moves */
static const double few = 4;               /* times the size */
static const double most_kept_up = 100;    /* [size] where little damps a mode, and motions take as long to settle */
static const double least_distance = 0.01; /* [1] from resonance, where nothing damps it */

struct survey_starts {
  const model *model;
  double omega;
  workspace memory;      /* of the arrays below, and of this */
  double *rest;          /* [n] [length] */
  double *omega_mode;    /* [n] [rad/time] max(omega, natural frequency) */
  double *phi;           /* [n][n] modes, phi^T M phi = 1 */
  double *bound;         /* [n] [length] largest amplitude that the loads can keep up */
  double *size;          /* [n] of each mode's coordinate */
  int drawn[MOST_MODES]; /* modes that starts are drawn in */
  int n, dimensions;
  double *units; /* [n][dimensions] numbers in [0, 1): r; xi and eta of each mode; zeta of each contact */
};

static int n_modes(const survey_starts *s) { return s->model->n < MOST_MODES ? s->model->n : MOST_MODES; }

/* The points of the sequence, each coordinate shifted modulo 1. */
static hc_status make_units(survey_starts *s, unsigned seed)
{
  const int d = s->dimensions, sobol = d < SOBOL_DIMENSIONS ? d : SOBOL_DIMENSIONS;
  double *shift = workspace_doubles(&s->memory, (size_t)d);
  gsl_qrng *q = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)sobol);
  uint64_t random = seed;
  if (q && shift) {
    for (int k = 0; k < d; ++k) shift[k] = random_unit(&random);
    for (int i = 0; i < s->n; ++i) {
      double *u = s->units + (size_t)i * (size_t)d;
      gsl_qrng_get(q, u);
      for (int k = sobol; k < d; ++k) u[k] = random_unit(&random);
      for (int k = 0; k < d; ++k) u[k] = fmod(u[k] + shift[k], 1);
    }
  }
  const bool made = q && shift;
  gsl_qrng_free(q);
  return made ? HC_OK : HC_NO_MEMORY;
}

static const double *mode_shape(const survey_starts *s, int i) { return s->phi + (size_t)i * (size_t)s->model->n; }
static double speed(const survey_starts *s, int i) { return s->size[i] * s->omega_mode[i]; }

/* size[i]: amplitude of mode i in the linear response, as if damping did not couple modes; bound[i]. */
static void size_of_mode(survey_starts *s, int i, double omega2)
{
  const model *m = s->model;
  const double *phi = mode_shape(s, i);
  double damping = 0;
  for (int col = 0; col < m->n; ++col)
    damping += phi[col] * dot_product(m->n, phi, m->damping + (size_t)col * (size_t)m->n);
  for (int k = 0; k < m->n_loads; ++k) {
    const model_load *l = &m->loads[k];
    const double at = l->harmonic * s->omega;
    const double p = model_load_factor(l->inertial, s->omega) *
                     hypot(dot_product(m->n, phi, l->cosine), dot_product(m->n, phi, l->sine));
    const double stiffness = fmax(hypot(omega2 - at * at, at * damping), least_distance * fmax(omega2, at * at));
    if (l->harmonic == 0 || !(p > 0)) continue;
    s->size[i] += p / stiffness;
    s->bound[i] += p / (damping * s->omega);
  }
}

/* Without loads: the largest length of any contact's law, else 1. */
static double contact_size(const model *m)
{
  double most = 0;
  for (int j = 0; j < m->n_contacts; ++j) most = fmax(most, contact_length(&m->contacts[j].law));
  return most > 0 ? most : 1;
}

/* The fastest modes into drawn[], of equal ones the lowest; none is slower than least_share of the first. */
static void choose_modes(survey_starts *s)
{
  double fastest = 0;
  for (int i = 0; i < s->model->n; ++i) fastest = fmax(fastest, speed(s, i));
  for (int i = 0; i < s->model->n; ++i) s->size[i] = fmax(s->size[i], least_share * fastest / s->omega_mode[i]);
  for (int k = 0; k < n_modes(s); ++k) {
    s->drawn[k] = -1;
    for (int i = 0; i < s->model->n; ++i) {
      bool taken = false;
      for (int l = 0; l < k; ++l) taken |= s->drawn[l] == i;
      if (!taken && (s->drawn[k] < 0 || speed(s, i) > speed(s, s->drawn[k]) * (1 + 1e-9))) s->drawn[k] = i;
    }
  }
}

static hc_status make_sizes(survey_starts *s)
{
  const model *m = s->model;
  bool touches = false; /* at rest */
  for (int j = 0; j < m->n_contacts; ++j) touches |= contact_preload(&m->contacts[j].law) + m->contacts[j].law.load > 0;
  hc_status st = model_modes(m, touches, s->omega_mode, s->phi);
  double fastest = 0;
  for (int i = 0; i < m->n && st == HC_OK; ++i) {
    const double omega2 = s->omega_mode[i];
    size_of_mode(s, i, omega2);
    s->omega_mode[i] = fmax(s->omega, sqrt(fmax(omega2, 0)));
    fastest = fmax(fastest, s->size[i] * s->omega_mode[i]);
  }
  for (int i = 0; i < m->n && st == HC_OK && !(fastest > 0); ++i)
    s->size[i] = contact_size(m) / norm_max(m->n, mode_shape(s, i));
  if (st == HC_OK) choose_modes(s);
  return st;
}

static hc_status make(survey_starts *s, unsigned seed, const double *rest)
{
  const size_t n = (size_t)s->model->n;
  s->rest = workspace_doubles(&s->memory, n);
  s->omega_mode = workspace_doubles(&s->memory, n);
  s->phi = workspace_doubles(&s->memory, n * n);
  s->size = workspace_doubles(&s->memory, n);
  s->bound = workspace_doubles(&s->memory, n);
  s->units = workspace_doubles(&s->memory, (size_t)s->n * (size_t)s->dimensions);
  if (s->memory.failed) return HC_NO_MEMORY;
  memcpy(s->rest, rest, n * sizeof *rest);
  hc_status st = make_units(s, seed);
  return st == HC_OK ? make_sizes(s) : st;
}

hc_status survey_starts_new(const model *m, double omega, const double *rest, int n, unsigned seed, survey_starts **out)
{
  *out = NULL;
  survey_starts *s = calloc(1, sizeof *s);
  if (!s) return HC_NO_MEMORY;
  *s = (survey_starts){.model = m, .omega = omega, .n = n};
  s->dimensions = 1 + 2 * n_modes(s) + m->n_contacts;
  hc_status st = make(s, seed, rest);
  if (st == HC_OK) *out = s;
  else survey_starts_free(s);
  return st;
}

void survey_starts_free(survey_starts *s)
{
  if (!s) return;
  workspace_free(&s->memory);
  free(s);
}

/* phi^T M y. */
static double coordinate(const model *m, const double *phi, const double *y)
{
  double sum = 0;
  for (int col = 0; col < m->n; ++col) sum += y[col] * dot_product(m->n, phi, m->mass + (size_t)col * (size_t)m->n);
  return sum;
}

void survey_starts_see(survey_starts *s, const double *state)
{
  const model *m = s->model;
  for (int i = 0; i < m->n; ++i) {
    const double *phi = mode_shape(s, i);
    const double q = coordinate(m, phi, state) - coordinate(m, phi, s->rest), dq = coordinate(m, phi, state + m->n);
    const double size = hypot(q, dq / s->omega_mode[i]);
    if (isfinite(size)) s->size[i] = fmax(s->size[i], size);
  }
  choose_modes(s);
}

/* r_i of a number in [0, 1). */
static double scale_of(const survey_starts *s, int mode, double unit)
{
  const double small = 0.2, usual = 0.7; /* shares of the starts, summed */
  const double largest = fmin(fmax(few, s->bound[mode] / s->size[mode]), most_kept_up);
  return unit < small ? 0.1 : unit < usual ? 1 : pow(largest, (unit - usual) / (1 - usual));
}

/* [force length] Of the normal springs at x beyond what the static loads balance: 0 at rest. */
static double pressed_energy(const survey_starts *s, const double *x)
{
  const model *m = s->model;
  double sum = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const double at_rest = fmax(dot_product(m->n, c->normal, s->rest) + c->law.gap, 0);
    const double pressed = fmax(dot_product(m->n, c->normal, x) + c->law.gap, 0) - at_rest;
    sum += 0.5 * c->law.kn * pressed * pressed;
  }
  return sum;
}

/* No motion presses stiff contacts as far as the size of free flight: x back towards rest until they hold no more than
 * that energy. 200 steps are a factor of 1e-19. */
static void draw_back(const survey_starts *s, double energy, double *x)
{
  enum { MOST = 200 };
  const double less = 0.8;
  for (int i = 0; i < MOST && pressed_energy(s, x) > energy; ++i)
    for (int row = 0; row < s->model->n; ++row) x[row] = s->rest[row] + less * (x[row] - s->rest[row]);
}

/* Sliders within what friction allows about u, and within a few times the motion; w = u where the contact is open. */
static void draw_sliders(const survey_starts *s, const double *unit, const double *x, double scale, double *w)
{
  const model *m = s->model;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    if (!contact_has_friction(&c->law)) continue;
    double moves = 0;
    for (int k = 0; k < n_modes(s); ++k)
      moves += scale * s->size[s->drawn[k]] * fabs(dot_product(m->n, c->tangent, mode_shape(s, s->drawn[k])));
    const double u = dot_product(m->n, c->tangent, x), N = contact_normal(&c->law, dot_product(m->n, c->normal, x));
    double zeta = 2 * unit[j] - 1;
    if (c->circle && c->pair == CONTACT_FIRST) zeta = sqrt(unit[j]) * cos(TWO_PI * unit[j + 1]);
    if (c->circle && c->pair == CONTACT_SECOND) zeta = sqrt(unit[j - 1]) * sin(TWO_PI * unit[j]);
    w[j] = u + zeta * fmin(c->law.mu * N / c->law.kt, few * moves);
  }
}

void survey_starts_draw(const survey_starts *s, int i, double *state)
{
  const model *m = s->model;
  const double *unit = s->units + (size_t)i * (size_t)s->dimensions;
  double *x = state, *v = state + m->n, energy = 0;
  memset(state, 0, (size_t)(2 * m->n + m->n_contacts) * sizeof *state);
  memcpy(x, s->rest, (size_t)m->n * sizeof *x);
  if (i == 0) return;
  for (int k = 0; k < n_modes(s); ++k) {
    const int mode = s->drawn[k];
    const double size = scale_of(s, mode, *unit) * s->size[mode], fastest = size * s->omega_mode[mode];
    const double q = size * (2 * unit[1 + 2 * k] - 1), dq = fastest * (2 * unit[2 + 2 * k] - 1);
    for (int row = 0; row < m->n; ++row)
      x[row] += q * mode_shape(s, mode)[row], v[row] += dq * mode_shape(s, mode)[row];
    energy += 0.5 * fastest * fastest;
  }
  draw_back(s, energy, x);
  draw_sliders(s, unit + 1 + 2 * n_modes(s), x, fmax(1, scale_of(s, s->drawn[0], *unit)), state + 2 * m->n);
}
