/* test_large.c - what makes steady states of structures of more than 64 modes affordable: fast modes slowed
 * (mass_scaling.h), products with the rows of contacts (structure_newton.h), orbits by chord steps (shoot.h); against
 * what the equations say of it, and on cases/structures/plates.yaml against an integrator of the tests' own. */
#include <float.h>

#include "compare/comparison.h"
#include "tests/hbm/structure_cases.h"
#include "tests/timeint/drawn.h"
#include "tests/timeint/force_steps.h"
#include "timeint/steady/mass_scaling.h"

/* ---- modes slowed ---------------------------------------------------------------------------------------- */

static const double plates_omega = TWO_PI * 138;

static model *plates_model(void) { return structure_case_named("plates", 7).model; }

/* All vectors that a base carries: rows of contacts and responses, loads. How many. */
enum { MOST_VECTORS = 100 };
static int vectors_of(const modal_base *b, const double *vector[MOST_VECTORS])
{
  const struct {
    int count;
    const double *first;
  } sets[] = {{b->n_contacts, b->tangent},
              {b->n_contacts, b->normal},
              {b->n_responses, b->response},
              {b->n_loads, b->cosine},
              {b->n_loads, b->sine}};
  int count = 0;
  for (size_t k = 0; k < sizeof sets / sizeof *sets; ++k)
    for (int j = 0; j < sets[k].count; ++j) vector[count++] = sets[k].first + (size_t)j * (size_t)b->n;
  assert_true(count <= MOST_VECTORS);
  return count;
}

/* a . K^-1 b of the base's modes; *size: of its terms. */
static double compliance(const modal_base *of, const double *a, const double *b, double *size)
{
  double sum = 0;
  *size = 0;
  for (int i = 0; i < of->n; ++i) {
    const double term = a[i] * b[i] / of->K[i];
    sum += term;
    *size += fabs(term);
  }
  return sum;
}

/* x -> q -> x, and what rows make of q: rounding of n^2 terms of the transformations. */
static void check_motion(uint64_t *seed, const modal_base *whole, const modal_base *slow)
{
  enum { MOST_MODES = 100 };
  const int n = whole->n, rows = whole->n_contacts;
  double x[MOST_MODES], q[2][MOST_MODES], back[MOST_MODES];
  assert_true(n <= MOST_MODES);
  for (int i = 0; i < n; ++i) x[i] = random_signed(seed);
  modal_base_to_modes(whole, x, q[0]);
  modal_base_to_modes(slow, x, q[1]);
  modal_base_to_model(slow, q[1], back);
  for (int i = 0; i < n; ++i) {
    double size = 0, terms = 0;
    for (int k = 0; k < n; ++k) {
      size += fabs(slow->shape[k * n + i] * q[1][k]);
      terms += fabs(whole->inverse[k * n + i] * x[k]);
    }
    CHECK_NEAR(back[i], x[i], n * n * DBL_EPSILON * fmax(1, size), "x -> q -> x, [%d]", i);
    CHECK_NEAR(q[1][i] / slow->slowed[i], q[0][i], (n + 4) * DBL_EPSILON * terms, "q[%d]", i);
  }
  for (int j = 0; j < rows; ++j) {
    double here = 0, there = 0, size = 0;
    for (int i = 0; i < n; ++i) {
      here += whole->tangent[j * n + i] * q[0][i] + whole->normal[j * n + i] * q[0][i];
      there += slow->tangent[j * n + i] * q[1][i] + slow->normal[j * n + i] * q[1][i];
      size += fabs(whole->tangent[j * n + i] * q[0][i]) + fabs(whole->normal[j * n + i] * q[0][i]);
    }
    CHECK_NEAR(there, here, 2 * n * DBL_EPSILON * size, "motion of contact %d", j);
  }
}

/* The power iteration comes from below; modal_base.c says how near. */
static void check_highest(const model *m, const modal_base *slow)
{
  const int n = slow->n;
  double *K = calloc((3 * (size_t)n + 1) * (size_t)n, sizeof *K), *one = K + n * n, *phi = one + n * n,
         *lambda = phi + n * n;
  for (int i = 0; i < n; ++i) K[i * (n + 1)] = slow->K[i], one[i * (n + 1)] = 1;
  for (int j = 0; j < m->n_contacts; ++j)
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        const double *t = slow->tangent + j * n, *normal = slow->normal + j * n, square = slow->s * slow->s;
        K[a * n + b] += square * (m->contacts[j].law.kt * t[a] * t[b] + m->contacts[j].law.kn * normal[a] * normal[b]);
      }
  assert_int_equal(dense_modes(n, K, one, lambda, phi), HC_OK);
  const double highest = sqrt(lambda[n - 1]);
  CHECK_LE(slow->highest, highest * (1 + n * DBL_EPSILON), "highest frequency, contacts stuck");
  CHECK_LE(0.99 * highest, slow->highest, "highest frequency, contacts stuck");
  free(K);
}

/* To the last bit: whose K differs from its transpose by rounding has modes that do not make it diagonal. */
static model *symmetric_structure(uint64_t *seed, int n, int n_contacts)
{
  model *m = random_structure(seed, n, n_contacts);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < j; ++i) m->stiffness[j * n + i] = m->stiffness[i * n + j];
  return m;
}

static void check_slowed(uint64_t *seed, const model *m, double fastest)
{
  CHECK_MADE(modal_base, whole, modal_base_new(m, &whole));
  CHECK_MADE(modal_base, slow, modal_base_slowed(whole, m, fastest, &slow));
  assert_true(slow->slowed[0] == 1 && slow->slowed[m->n - 1] > 1);
  /* As springs all modes stay what they are: rounding of n terms, each of a handful of operations. */
  const double *of[2][MOST_VECTORS];
  const int count = vectors_of(whole, of[0]);
  double size;
  vectors_of(slow, of[1]);
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b) {
      const double there = compliance(slow, of[1][a], of[1][b], &size);
      const double here = compliance(whole, of[0][a], of[0][b], &size);
      CHECK_NEAR(there, here, (whole->n + 16) * DBL_EPSILON * size, "compliance [%d, %d]", a, b);
    }
  /* C_ij sqrt(a_i a_j) is what it was, and K_ii is capped: so are damping ratios C_ii/(2 omega_i). */
  const int n = whole->n;
  double slowest = INFINITY, decay = 0;
  for (int i = 0; i < n; ++i) {
    const double omega = sqrt(whole->K[i]), by = fmax(1, omega / fastest);
    CHECK_NEAR(slow->slowed[i], by, 4 * DBL_EPSILON * by, "mode %d", i);
    CHECK_NEAR(sqrt(slow->K[i]), fmin(omega, fastest), 8 * DBL_EPSILON * fastest, "frequency %d", i);
    for (int j = 0; j < n; ++j) {
      if (whole->diagonal_C && i != j) continue;
      const int at = whole->diagonal_C ? i : i + n * j;
      const double want = whole->C[at] / sqrt(by * fmax(1, sqrt(whole->K[j]) / fastest));
      CHECK_NEAR(slow->C[at], want, 16 * DBL_EPSILON * fabs(want), "C[%d, %d]", i, j);
    }
    const double C = slow->C[whole->diagonal_C ? i : i * (n + 1)];
    slowest = fmin(slowest, C / 2);
    decay = larger(decay, C);
  }
  CHECK_NEAR(slow->slowest, slowest, 0, "slowest decay");
  CHECK_NEAR(slow->decay, decay, 0, "fastest decay");
  CHECK_NEAR(slow->s, whole->s, 0, "unit");
  check_motion(seed, whole, slow);
  check_highest(m, slow);
  modal_base_free(slow);
  modal_base_free(whole);
}

/* The plates, whose damping is diagonal, and drawn structures, whose is not. */
static void slowed_modes_stay_springs(CHECK_STATE)
{
  uint64_t seed = 4;
  model *m = plates_model();
  for (int k = 0; k < 4; ++k) check_slowed(&seed, m, ldexp(20, 2 * k) * plates_omega);
  model_free(m);
  for (int trial = 0; trial < 40; ++trial) {
    const int n = random_int(&seed, 2, 20);
    m = symmetric_structure(&seed, n, random_int(&seed, 1, 6));
    CHECK_MADE(modal_base, whole, modal_base_new(m, &whole));
    const double lowest = sqrt(whole->K[0]), highest = sqrt(whole->K[n - 1]);
    modal_base_free(whole);
    check_slowed(&seed, m, lowest + (0.05 + 0.9 * random_unit(&seed)) * (highest - lowest));
    model_free(m);
  }
}

/* ---- when modes are slowed -------------------------------------------------------------------------------- */

/* Neighbours share a value: of rounding to quarters of an octave, half of one off at most, 2^(1/8) = 1.0905. */
static void neighbours_share_the_fastest_mode(CHECK_STATE)
{
  model *m = plates_model();
  CHECK_MADE(modal_base, whole, modal_base_new(m, &whole));
  const double highest = sqrt(whole->K[whole->n - 1]), per_octave = 1000;
  double last = NAN;
  int slowed = 0, values = 0;
  for (int step = 0; step <= 12 * (int)per_octave; ++step) {
    const double omega = highest / 2e5 * exp2(step / per_octave), fastest = mass_scaling_fastest(whole, omega);
    if (isfinite(fastest)) {
      CHECK_LE(fabs(log2(fastest / (200 * omega))), 0.125 * (1 + 1e-9), "at %g", omega);
      CHECK_LE(2 * fastest, highest, "at %g: it pays", omega);
      values += fastest != last;
      ++slowed;
    } else {
      CHECK_LE(highest, 2 * exp2(0.125) * 200 * omega * (1 + 1e-9), "at %g: it would pay", omega);
      assert_true(step == 0 || omega > 0);
    }
    last = fastest;
  }
  /* from highest/2e5 to about highest/400: log2(500) = 9 octaves, 4 values each, one more at either end */
  CHECK_NEAR(slowed, log2(500) * per_octave, per_octave / 4, "frequencies at which modes are slowed");
  CHECK_NEAR(values, 4 * log2(500), 2, "values of the fastest mode");
  CHECK_NEAR(mass_scaling_fastest(whole, plates_omega), mass_scaling_fastest(whole, 1.0001 * plates_omega), 0,
             "138 Hz");
  assert_true(isinf(mass_scaling_fastest(whole, highest / 100)));
  modal_base_free(whole);
  model_free(m);
}

/* 64 modes and 65 of the same matrix; and a stiffness that is not symmetric, whose modes are not those of K. */
static void small_or_unsymmetric_structures_are_not_slowed(CHECK_STATE)
{
  for (int n = MASS_SCALING_MODES; n <= MASS_SCALING_MODES + 1; ++n)
    for (int turned = 0; turned < 2; ++turned) {
      CHECK_MADE(model, m, model_new(n, 1, 0, 1, &m));
      m->responses[0] = 1;
      for (int i = 0; i < n; ++i) m->mass[i * (n + 1)] = 1, m->stiffness[i * (n + 1)] = exp2(i);
      if (turned) m->stiffness[1] = 0.1;
      CHECK_MADE(modal_base, whole, modal_base_new(m, &whole));
      const bool may = n > MASS_SCALING_MODES && !turned;
      assert_int_equal(mass_scaling_may_pay(whole), may);
      assert_int_equal(isfinite(mass_scaling_fastest(whole, 1)), may);
      modal_base_free(whole);
      model_free(m);
    }
}

/* ---- products with the rows of contacts -------------------------------------------------------------------- */

/* structure_newton_rate against scaled_rhs, at random states. Both sum the same terms in another order: up to 84 and
 * 36 of them, each some ten times what is left of their sum, n eps 10, times 10 for the law's own. */
static int check_rate(uint64_t *seed, const drawn *d, int trial)
{
  workspace memory = {0};
  const int n = d->scaled.n_states;
  double *y = calloc(3 * (size_t)n, sizeof *y), *dy[2] = {y + n, y + 2 * n};
  contact_state *state = calloc((size_t)n, sizeof *state);
  CHECK_FILLED(structure_newton, s, structure_newton_make(&s, d->base, &memory));
  for (int at = 0; at < 3; ++at) {
    double size = 1;
    for (int i = 0; i < n; ++i) y[i] = random_signed(seed), dy[0][i] = dy[1][i] = NAN;
    assert_true(scaled_rhs(&d->scaled, 1 + at, y, dy[0]));
    assert_true(structure_newton_rate(&s, &d->scaled, 1 + at, y, dy[1], state));
    for (int j = 0; j < d->scaled.n_contacts; ++j) assert_int_equal(state[j], scaled_contact_state(&d->scaled, j, y));
    for (int i = 0; i < n; ++i) size = fmax(size, fabs(dy[0][i]));
    for (int i = 0; i < n; ++i)
      CHECK_NEAR(dy[1][i], dy[0][i], 100 * (d->scaled.n + s.step.n_rows) * DBL_EPSILON * size, "trial %d, rate %d",
                 trial, i);
    y[random_int(seed, 0, n - 1)] = NAN;
    assert_int_equal(structure_newton_rate(&s, &d->scaled, 1, y, dy[1], NULL), scaled_rhs(&d->scaled, 1, y, dy[0]));
    y[random_int(seed, 0, 2 * d->scaled.n - 1)] = NAN; /* whatever a slider without friction is */
    assert_false(structure_newton_rate(&s, &d->scaled, 1, y, dy[1], NULL));
  }
  const int entries = s.step.n_rows * d->scaled.n;
  workspace_free(&memory);
  free(state);
  free(y);
  return entries;
}

/* With one tangent and two, and with fewer and more entries in the rows than BLAS is called for (dense.c: 1024). */
static void rates_by_rows_are_the_equations(CHECK_STATE)
{
  uint64_t seed = 21;
  int most = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const bool large = trial % 3 == 0;
    const int n = large ? random_int(&seed, 50, 64) : random_int(&seed, 1, 12);
    const int contacts = large ? MOST_CONTACTS : random_int(&seed, 1, MOST_CONTACTS);
    drawn d = {.m = random_structure(&seed, n, contacts)};
    /* The first `circles` pairs of contacts become circles of friction. */
    const int circles = random_int(&seed, 0, contacts / 2);
    for (int j = 0; j < 2 * circles; j += 2) {
      for (int a = 0; a < 2; ++a) random_direction(&seed, n, d.m->contacts[j + a].tangent);
      random_direction(&seed, n, d.m->contacts[j].normal);
      make_circle(d.m, j, (contact){.kt = 40, .kn = 60, .mu = 0.2, .gap = 0.1});
    }
    scale_drawn(&d, TRANSIENT_LAW_REGULARISED, 3 + 10 * random_unit(&seed));
    const int entries = check_rate(&seed, &d, trial);
    if (entries > most) most = entries;
    undraw(&d);
  }
  CHECK_LE(1024, most, "entries of the largest rows");
}

/* ---- the plates' orbits -------------------------------------------------------------------------------------- */

static const transient_settings closed_form = {.law = TRANSIENT_LAW_EXACT,
                                               .method = TRANSIENT_METHOD_CLOSED_FORM,
                                               .regularisation = 1e-4,
                                               .steady = TRANSIENT_STEADY_SHOOTING,
                                               .start = TRANSIENT_START_HBM,
                                               .tolerance = 1e-10,
                                               .max_periods = 1000};

/* Some pairs stick, the others slip; all slip, three of them lift off. */
enum { N_ORBITS = 2 };
static const double frequency[N_ORBITS] = {135, 138};

/* Found once for all tests below. */
static model *plates;
static struct orbit {
  double omega, *state; /* [2 n + contacts] */
  timeint_result r;
} orbits[N_ORBITS];

/* orbit[n] next to solutions of HBM; their states are the caller's. */
static void find_at(structure_case *c, int n, const double *hertz, struct orbit *orbit)
{
  hbm_solver *s = structure_solver(c);
  double *X = calloc((size_t)hbm_n_coefficients(s), sizeof *X);
  CHECK_MADE(timeint, ti, timeint_new(c->model, &closed_form, &ti));
  for (int k = 0; k < n; ++k) {
    struct orbit *o = &orbit[k];
    o->omega = TWO_PI * hertz[k];
    o->state = calloc((size_t)timeint_n_states(ti), sizeof *o->state);
    CHECK_FILLED(hbm_point, point, hbm_first_solution(s, o->omega, NULL, X, &point));
    assert_int_equal(comparison_orbit_start(s, X, o->omega, o->state), HC_OK);
    assert_int_equal(timeint_orbit(ti, o->omega, 1, o->state, NULL, &o->r), HC_OK);
  }
  timeint_free(ti);
  hbm_solver_free(s);
  free(X);
}

static int find_orbits(CHECK_STATE)
{
  structure_case c = structure_case_named("plates", 7);
  plates = c.model;
  find_at(&c, N_ORBITS, frequency, orbits);
  return 0;
}

static int free_orbits(CHECK_STATE)
{
  for (int k = 0; k < N_ORBITS; ++k) free(orbits[k].state);
  model_free(plates);
  return 0;
}

/* The equations of `base` at an orbit's frequency in units of its amplitude, and its state there. */
typedef struct plates_map {
  modal_base *base; /* to be freed */
  scaled_contact contacts[2 * STEPS_PAIRS];
  scaled_model m;
  integrator *in;
  double *y; /* [m.n_states] */
} plates_map;

static void map_make(plates_map *p, const struct orbit *o, modal_base *base)
{
  const int n = plates->n;
  const double length = o->r.amplitude;
  p->base = base;
  p->m = (scaled_model){.contact = p->contacts, .base = base};
  scaled_make(&p->m, plates, &closed_form, o->omega, length);
  assert_int_equal(integrate_new_closed_form(base, INTERVAL_MODES_STIFF, &p->in), HC_OK);
  p->y = calloc((size_t)p->m.n_states, sizeof *p->y);
  modal_base_to_modes(base, o->state, p->y);
  modal_base_to_modes(base, o->state + n, p->y + n);
  for (int i = 0; i < p->m.n_states; ++i)
    p->y[i] = (i < 2 * n ? p->y[i] : o->state[i]) / (i >= n && i < 2 * n ? o->omega * length : length);
}

static void map_free(plates_map *p)
{
  integrate_free(p->in);
  modal_base_free(p->base);
  free(p->y);
}

static void map_whole(plates_map *p, const struct orbit *o)
{
  CHECK_MADE(modal_base, base, modal_base_new(plates, &base));
  map_make(p, o, base);
}

/* The same of the structure with fast modes slowed as orbits' matrices have them. */
static void map_slowed(plates_map *p, const struct orbit *o)
{
  CHECK_MADE(modal_base, base, modal_base_new(plates, &base));
  const double fastest = mass_scaling_fastest(base, o->omega);
  CHECK_MADE(modal_base, slowed, modal_base_slowed(base, plates, fastest, &slowed));
  map_make(p, o, slowed);
  modal_base_free(base);
}

/* What was asked for, by the handle's own word and by a period of the whole model. */
static void orbits_close(CHECK_STATE)
{
  for (int k = 0; k < N_ORBITS; ++k) {
    plates_map whole;
    const struct orbit *o = &orbits[k];
    CHECK_LE(o->r.closure, 1e-10, "%g Hz", frequency[k]);
    map_whole(&whole, o);
    double size = 0, apart = 0, *end = calloc((size_t)whole.m.n_states, sizeof *end);
    memcpy(end, whole.y, (size_t)whole.m.n_states * sizeof *end);
    assert_int_equal(integrate_period(whole.in, &whole.m, end, NULL, NULL), HC_OK);
    for (int i = 0; i < whole.m.n_states; ++i) {
      size = hypot(size, whole.y[i]);
      apart = hypot(apart, end[i] - whole.y[i]);
    }
    CHECK_LE(apart, 1e-10 * size, "%g Hz: a period", frequency[k]);
    assert_int_equal(o->r.regime, k == 0 ? CONTACT_SLIPS : CONTACT_SEPARATES);
    assert_int_equal(o->r.free_sliders, k == 0 ? 6 : 0);
    free(end);
    map_free(&whole);
  }
}

/* At 1100 Hz the fastest mode is less than 400 times as fast; from one where modes are slowed, and back. */
static void orbits_are_found_where_nothing_is_slowed(CHECK_STATE)
{
  static const double hertz[] = {135, 1100, 135};
  structure_case c = structure_case_named("plates", 7);
  struct orbit found[3];
  CHECK_MADE(modal_base, base, modal_base_new(c.model, &base));
  assert_true(isinf(mass_scaling_fastest(base, TWO_PI * hertz[1])));
  find_at(&c, 3, hertz, found);
  for (int k = 0; k < 3; ++k) CHECK_LE(found[k].r.closure, 1e-10, "orbit %d", k);
  CHECK_NEAR(found[2].r.amplitude, found[0].r.amplitude, 1e-9 * found[0].r.amplitude, "there and back");
  for (int k = 0; k < 3; ++k) free(found[k].state);
  modal_base_free(base);
  model_free(c.model);
}

/* ---- against the tests' own integrator ---- */

enum { N_STEPS = 4, FEWEST_STEPS = 2048, MOST_STEPS = FEWEST_STEPS << (N_STEPS - 1) };

/* A period of force_steps.h from the orbit's state, with 2048, 4096, 8192 and 16384 steps. Errors are of second order:
 * they fall by 4 each time. A kink is somewhere in its step, which changes its share of the error by a factor of 0 to
 * 1: all kinks together, some 24 to 48, by less than 2: each time by 2 to 8, three times by 4^3 / 2 or more. By what
 * waves of successive numbers of steps differ, of which the last error is a third, the other integrator says itself how
 * good it is; the closed form is no farther from it than twice that, and its own closure. */
static void orbits_are_those_of_another_integrator(CHECK_STATE)
{
  static force_steps s;
  static steps_state from;
  static double wave[N_STEPS][MOST_STEPS];
  const int n = plates->n;
  force_steps_make(&s, plates);
  for (int k = 0; k < N_ORBITS; ++k) {
    const struct orbit *o = &orbits[k];
    double error[N_STEPS] = {0}, back[N_STEPS], change[N_STEPS] = {0}, extrapolated = 0;
    dense_times_vector(n, n, 1, s.inverse, o->state, 0, from.q);
    dense_times_vector(n, n, 1, s.inverse, o->state + n, 0, from.dq);
    memcpy(from.w, o->state + 2 * n, sizeof from.w);
    for (int l = 0; l < N_STEPS; ++l) {
      steps_state to = from;
      const int steps = FEWEST_STEPS << l, each = steps / TIMEINT_WAVE;
      force_steps_period(&s, o->omega, steps, &to, wave[l]);
      /* How far from `o` a period of the other integrator from its state leads, in units of the motion. */
      double apart = 0, size = 0;
      for (int i = 0; i < n; ++i) {
        apart = hypot(apart, hypot(to.q[i] - from.q[i], (to.dq[i] - from.dq[i]) / o->omega));
        size = hypot(size, hypot(from.q[i], from.dq[i] / o->omega));
      }
      back[l] = apart / size;
      for (int i = 0; i < TIMEINT_WAVE; ++i) {
        const double here = wave[l][i * each], coarser = l > 0 ? wave[l - 1][i * each / 2] : NAN;
        error[l] = larger(error[l], fabs(here - o->r.wave[i]) / o->r.amplitude);
        if (l == 0) continue;
        change[l] = larger(change[l], fabs(here - coarser) / o->r.amplitude);
        if (l == N_STEPS - 1)
          extrapolated = larger(extrapolated, fabs((4 * here - coarser) / 3 - o->r.wave[i]) / o->r.amplitude);
      }
      if (l > 0) CHECK_LE(2 * error[l], error[l - 1], "%g Hz, %d steps: error of the wave", frequency[k], steps);
      if (l > 0) CHECK_LE(2 * back[l], back[l - 1], "%g Hz, %d steps: return", frequency[k], steps);
    }
    const int last = N_STEPS - 1;
    const double expected = change[last] / 3;
    CHECK_LE(expected, 1e-8, "%g Hz: the other integrator's own error", frequency[k]);
    CHECK_LE(error[last], 2 * expected + o->r.closure, "%g Hz: wave", frequency[k]);
    CHECK_LE(extrapolated, error[last] / 2, "%g Hz: wave, extrapolated", frequency[k]);
    CHECK_LE(32 * error[last], error[0], "%g Hz: second order", frequency[k]);
    CHECK_LE(32 * back[last], back[0], "%g Hz: second order", frequency[k]);
  }
}

/* ---- the monodromy matrix ---- */

static bool row_is_of_identity(int n, const double *phi, int i)
{
  for (int j = 0; j < n; ++j)
    if (phi[i + j * n] != (i == j)) return false;
  return true;
}

/* The largest multiplier of phi[n][n] but for rows of the identity, and its right and left vectors [n]. */
static double complex dominant(int n, const double *phi, double complex *right, double complex *left)
{
  const size_t all = (size_t)n;
  int *state = calloc(all, sizeof *state), count = 0, largest = 0;
  double *A = calloc(all * all, sizeof *A);
  double complex *lambda = calloc(all * (2 * all + 1), sizeof *lambda), *V = lambda + all, *W = V + all * all;
  for (int i = 0; i < n; ++i)
    if (!row_is_of_identity(n, phi, i)) state[count++] = i;
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) A[i + j * count] = phi[state[i] + state[j] * n];
  assert_int_equal(dense_eigen(count, A, lambda, V, W), HC_OK);
  for (int k = 0; k < count; ++k)
    if (cabs(lambda[k]) > cabs(lambda[largest])) largest = k;
  for (int i = 0; i < n; ++i) right[i] = left[i] = 0;
  for (int i = 0; i < count; ++i) {
    right[state[i]] = V[largest * count + i];
    left[state[i]] = W[largest * count + i];
  }
  const double complex multiplier = lambda[largest];
  free(lambda);
  free(A);
  free(state);
  return multiplier;
}

/* out += by Phi v, of central differences of the period map over 2e. */
static void apply_differences(plates_map *p, double complex by, const double *v, double e, double complex *out)
{
  const int n = p->m.n_states;
  double *end = calloc((size_t)n, sizeof *end);
  for (int side = -1; side <= 1; side += 2) {
    for (int i = 0; i < n; ++i) end[i] = p->y[i] + side * e * v[i];
    assert_int_equal(integrate_period(p->in, &p->m, end, NULL, NULL), HC_OK);
    for (int i = 0; i < n; ++i) out[i] += by * side * end[i] / (2 * e);
  }
  free(end);
}

/* S[n][n] := K and what contacts, as they begin at y, do to the motion there. */
static void stiffness_at(const scaled_model *m, const double *y, double *S)
{
  const size_t n = (size_t)m->n;
  memset(S, 0, n * n * sizeof *S);
  for (size_t i = 0; i < n; ++i) S[i * (n + 1)] = m->by_K * m->base->K[i];
  for (int j = 0, directions; j < m->n_contacts; j += directions) {
    contact_track begun[2];
    const contact_motion at = scaled_motion_at(m, j, y);
    directions = scaled_directions(m, j);
    contact_track_begin(begun, &m->contact[j], &at, y + 2 * n + j);
    for (int a = 0; a < directions; ++a) {
      const contact_forces_linear law = contact_track_forces(&begun[a], &m->contact[j + a]);
      const double *t = m->base->tangent + (size_t)(j + a) * n, *normal = m->base->normal + (size_t)(j + a) * n;
      for (size_t col = 0; col < n; ++col)
        for (size_t row = 0; row < n; ++row)
          S[col * n + row] += t[row] * (law.t_u * t[col] + law.t_v * normal[col]) + normal[row] * law.n_v * normal[col];
    }
  }
}

/* F[n][f] by columns, f slowed modes: where the motion is 1 in mode i these are where S holds them, S_ff F_i = -S_fi.
 * How many there are; which, into fast[]. */
static int follow_as_springs(const scaled_model *m, const double *y, int *fast, double *F)
{
  const int n = m->n;
  int count = 0, *pivot = calloc((size_t)n, sizeof *pivot);
  double *S = calloc(2 * (size_t)n * (size_t)n, sizeof *S), *held = S + n * n;
  stiffness_at(m, y, S);
  for (int i = 0; i < n; ++i)
    if (m->base->slowed[i] != 1) fast[count++] = i;
  for (int g = 0; g < count; ++g)
    for (int f = 0; f < count; ++f) held[f + g * count] = S[fast[f] + fast[g] * n];
  for (int i = 0; i < n; ++i)
    for (int f = 0; f < count; ++f) F[f + i * count] = -S[fast[f] + i * n];
  assert_int_equal(dense_factor(count, held, pivot), HC_OK);
  dense_solve(count, held, pivot, n, F);
  free(S);
  free(pivot);
  return count;
}

/* Every third column of the matrix of a structure with slowed modes, at the plates' orbits: modes that are not slowed
 * move, those that are follow as springs; columns of the latter are 0. Against differences of its period map along that
 * motion: 1e-12 of rounding over 2 e, e times the second derivative where transitions move, and truncation, 1e-5 of a
 * column per step: 2.3e-5 was measured. */
static void slowed_modes_follow_in_columns(CHECK_STATE)
{
  const double e = 1e-7;
  for (int k = 0; k < N_ORBITS; ++k) {
    plates_map p;
    map_slowed(&p, &orbits[k]);
    const int n = plates->n, states = p.m.n_states;
    int *fast = calloc((size_t)n, sizeof *fast), compared = 0;
    double *F = calloc((size_t)n * (size_t)n, sizeof *F), *phi = calloc((size_t)states * (size_t)states, sizeof *phi);
    double *v = calloc((size_t)states, sizeof *v), *end = calloc((size_t)states, sizeof *end);
    double complex *moved = calloc((size_t)states, sizeof *moved);
    const int count = follow_as_springs(&p.m, p.y, fast, F);
    memcpy(end, p.y, (size_t)states * sizeof *end);
    assert_int_equal(integrate_monodromy(p.in, &p.m, end, phi), HC_OK);
    for (int q = k; q < 2 * n; q += 3) {
      double largest = 0;
      for (int i = 0; i < 2 * n; ++i) largest = fmax(largest, fabs(phi[i + q * states]));
      if (p.base->slowed[q % n] == 1) {
        memset(v, 0, (size_t)states * sizeof *v);
        memset(moved, 0, (size_t)states * sizeof *moved);
        v[q] = 1;
        for (int f = 0; f < count; ++f) v[fast[f] + (q < n ? 0 : n)] = F[f + q % n * count];
        apply_differences(&p, 1, v, e, moved);
        for (int i = 0; i < 2 * n; ++i)
          CHECK_NEAR(phi[i + q * states], creal(moved[i]), 1e-4 * fmax(1, largest), "%g Hz: [%d, %d]", frequency[k], i,
                     q);
        ++compared;
      } else {
        CHECK_NEAR(largest, 0, 0, "%g Hz: column %d, of a slowed mode", frequency[k], q);
      }
    }
    CHECK_LE(10, compared, "columns");
    CHECK_LE(10, count, "slowed modes");
    free(moved);
    free(end);
    free(v);
    free(phi);
    free(F);
    free(fast);
    map_free(&p);
  }
}

/* Newton's matrix is that of the structure with its fast modes slowed. Along its dominant vector v that is nearly the
 * whole model's: of |Phi v - lambda v| <= 1e-2 |v| the quotient w* Phi v / w* v keeps the square, as long as w is as
 * good as v. Phi v by differences of the whole period map: rounding, 1e-12 of some 1000 steps over 2 e = 2e-6, and e
 * times its second derivative where transitions move. */
static void the_multiplier_is_that_of_the_whole_model(CHECK_STATE)
{
  for (int k = 0; k < N_ORBITS; ++k) {
    const struct orbit *o = &orbits[k];
    const double e = 1e-6;
    plates_map whole, slow;
    map_whole(&whole, o);
    map_slowed(&slow, o);
    const int n = slow.m.n_states;
    double *phi = calloc((size_t)n * (size_t)n, sizeof *phi),
           *part[2] = {calloc((size_t)n, sizeof **part), calloc((size_t)n, sizeof **part)};
    double complex *v = calloc(3 * (size_t)n, sizeof *v), *w = v + n, *moved = w + n, above = 0, below = 0;
    assert_int_equal(integrate_monodromy(slow.in, &slow.m, slow.y, phi), HC_OK);
    const double complex of_slowed = dominant(n, phi, v, w);
    for (int i = 0; i < n; ++i) { /* modal_base.h: q of the whole = q of the slowed / a */
      const double a = i < 2 * plates->n ? slow.base->slowed[i % plates->n] : 1;
      v[i] /= a, w[i] *= a;
      part[0][i] = creal(v[i]), part[1][i] = cimag(v[i]);
    }
    apply_differences(&whole, 1, part[0], e, moved);
    if (cimag(of_slowed) != 0) apply_differences(&whole, I, part[1], e, moved);
    for (int i = 0; i < n; ++i) above += conj(w[i]) * moved[i], below += conj(w[i]) * v[i];
    const double complex quotient = above / below, given = o->r.multiplier_re + I * fabs(o->r.multiplier_im);
    double left = 0, size = 0;
    for (int i = 0; i < n; ++i) {
      left = hypot(left, cabs(moved[i] - quotient * v[i]));
      size = hypot(size, cabs(v[i]));
    }
    const double complex upper = creal(quotient) + I * fabs(cimag(quotient));
    CHECK_LE(cabs(given - upper), 1e-4, "%g Hz: multiplier", frequency[k]);
    CHECK_NEAR(o->r.multiplier, cabs(quotient), 1e-4, "%g Hz: its modulus", frequency[k]);
    CHECK_LE(left, 1e-2 * size, "%g Hz: its vector", frequency[k]);
    free(v);
    free(part[0]);
    free(part[1]);
    free(phi);
    map_free(&slow);
    map_free(&whole);
  }
}

/* ---- an orbit asked again, nearby, from rest ---- */

/* The state and the result of an orbit of the plates next to orbits[1]; *periods: of the whole model and the slowed. */
static void ask_next(timeint *ti, double omega, timeint_result *r, long *periods)
{
  double *state = calloc((size_t)timeint_n_states(ti), sizeof *state);
  long cvode = 0, before = 0, after = 0;
  memcpy(state, orbits[1].state, (size_t)timeint_n_states(ti) * sizeof *state);
  timeint_count(ti, &cvode, &before);
  assert_int_equal(timeint_orbit(ti, omega, 1, state, NULL, r), HC_OK);
  timeint_count(ti, &cvode, &after);
  *periods = after - before;
  free(state);
}

/* Both are within the tolerance of the orbit, relative to the state's size, up to 1.4 amplitudes (the waveform of the
 * response is nearly all of it): 4 of them. Without multipliers a matrix of another frequency does, and no period is
 * integrated for one: at the second frequency a matrix more is a period more. From next to the orbit it takes a period
 * to see that, and those after one step or two. */
static void orbits_need_no_matrix_of_their_own(CHECK_STATE)
{
  timeint_result at[2], again, one;
  long periods[2], bare_periods[2], none;
  CHECK_MADE(timeint, plain, timeint_new(plates, &closed_form, &plain));
  CHECK_MADE(timeint, bare, timeint_new(plates, &closed_form, &bare));
  timeint_leave_multipliers(bare);
  for (int k = 0; k < 2; ++k) {
    const double omega = orbits[1].omega * (1 + 1e-4 * k);
    ask_next(plain, omega, &at[k], &periods[k]);
    ask_next(plain, omega, &again, &none);
    assert_int_equal(none, 0);
    CHECK_LE(fabs(again.amplitude - at[k].amplitude), 0, "asked again");
    assert_int_equal(again.switches, at[k].switches);
    ask_next(bare, omega, &one, &bare_periods[k]);
    CHECK_LE(fabs(one.amplitude - at[k].amplitude), 4 * closed_form.tolerance * at[k].amplitude, "%d", k);
    assert_true(isnan(one.multiplier) && at[k].multiplier < 1);
  }
  assert_true(bare_periods[1] < periods[1]);
  ask_next(bare, orbits[1].omega * (1 + 1e-9), &one, &none);
  CHECK_LE((double)none, 3, "periods from next to the orbit; by the slowed copy, 1e-6 off, %ld", bare_periods[0]);
  timeint_free(plain);
  timeint_free(bare);
}

/* The motion from rest goes where the copy with slowed modes has gone before: to the only orbit there is at 138 Hz. */
static void rest_leads_to_the_orbit(CHECK_STATE)
{
  transient_settings how = closed_form;
  how.start = TRANSIENT_START_REST;
  how.steady = TRANSIENT_STEADY_AUTO;
  CHECK_MADE(timeint, ti, timeint_new(plates, &how, &ti));
  double *y = calloc((size_t)timeint_n_states(ti), sizeof *y);
  timeint_rest(ti, y);
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, orbits[1].omega, y, NULL, &r));
  CHECK_LE(fabs(r.amplitude - orbits[1].r.amplitude), 4 * how.tolerance * r.amplitude, "from rest");
  assert_true(r.periods < 20); /* of the whole model: those of the orbit, none of the way there */
  timeint_free(ti);
  free(y);
}

/* ---- CVODE ---- */

static bool stop_once(void *asked, double done) { return (void)done, ++*(int *)asked > 1; }

/* The orbit by CVODE with that law, whose fast modes are slowed, is off from the whole model's in closed form by no
 * more than it predicts, which is little. */
static void check_cvode(const struct orbit *o, transient_law law, double tolerance)
{
  const size_t n_states = 2 * (size_t)plates->n + (size_t)plates->n_contacts;
  double *state = calloc(n_states, sizeof *state);
  transient_settings how = closed_form;
  how.method = TRANSIENT_METHOD_CVODE;
  how.law = law;
  how.scout = true;
  how.tolerance = tolerance;
  memcpy(state, o->state, n_states * sizeof *state);
  CHECK_MADE(timeint, ti, timeint_new(plates, &how, &ti));
  CHECK_FILLED(timeint_result, r, timeint_orbit(ti, o->omega, 1, state, NULL, &r));
  state[0] *= 1.01; /* a state that no orbit is remembered at */
  assert_int_equal(timeint_predict(ti, state, &(hc_monitor){stop_once, &(int){0}}, 1, &r), HC_INTERRUPTED);
  state[0] /= 1.01;
  assert_int_equal(timeint_predict(ti, state, NULL, 1, &r), HC_OK);
  const double off = fabs(r.amplitude - o->r.amplitude);
  CHECK_LE(off, r.predicted.amplitude, "law %d", law);
  CHECK_LE(r.predicted.amplitude, 1e-4 * o->r.amplitude, "law %d: predicted", law);
  assert_true(r.rhs > 0); /* by CVODE */
  how.tolerance /= 10;
  CHECK_MADE(timeint, finer, timeint_new_beside(ti, &how, &finer));
  timeint *closed = timeint_closed_form_of(ti),
          *same = law == TRANSIENT_LAW_EXACT ? finer : timeint_closed_form_of(finer);
  assert_ptr_equal(same, closed);
  timeint_free(closed), timeint_free(ti), timeint_free(finer);
  if (law != TRANSIENT_LAW_EXACT) timeint_free(same);
  free(state);
}

/* At 1e-9 integration errors are less than what slowed modes and the regularisation cost, 8e-7 and 9e-7: neither may be
 * missing from the prediction. */
static void cvode_is_off_by_what_it_predicts(CHECK_STATE)
{
  check_cvode(&orbits[1], TRANSIENT_LAW_REGULARISED, 1e-9);
  check_cvode(&orbits[1], TRANSIENT_LAW_EXACT, 1e-7);
}

CHECK_TESTS_AND_LONG_WITH("timeint.large", 120, find_orbits, free_orbits,
                          (slowed_modes_stay_springs, neighbours_share_the_fastest_mode,
                           small_or_unsymmetric_structures_are_not_slowed, rates_by_rows_are_the_equations,
                           orbits_close, orbits_are_those_of_another_integrator,
                           the_multiplier_is_that_of_the_whole_model),
                          (orbits_are_found_where_nothing_is_slowed, slowed_modes_follow_in_columns,
                           orbits_need_no_matrix_of_their_own, rest_leads_to_the_orbit,
                           cvode_is_off_by_what_it_predicts))
