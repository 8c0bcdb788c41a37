/* test_structure_stability.c - multipliers of structures: of oscillators side by side they are those of each, which a
 * closed form has; where eigenvectors fail, those of the matrix exponential; and a structure that has none to go by. */

#include <float.h>

#include "hbm/hbm.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "hbm/stability/interval_flow.h"
#include "numerics/floquet.h"
#include "tests/hbm/random_structures.h"

enum { H = 7, LENGTH = 2 * H + 1 };

static const hbm_settings how = {.harmonics = H, .keep_mean = true, .tolerance = 1e-13, .accuracy = 1e-4};

static hbm_stability stability_of(const model *m, double omega, double *X)
{
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
  CHECK_FILLED(hbm_point, point, hbm_solve(s, omega, X, &point));
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, omega, X, &st));
  hbm_solver_free(s);
  return st;
}

/* Case 2 of the paper at 8, whose solutions slip, separate and are unstable, and a linear oscillator beside it; written
 * in x = Q y, so that nothing is decoupled. Multipliers of the linear one: exp((-c/2 +- i w) T/m). */
static void oscillators_side_by_side(CHECK_STATE)
{
  const double omega = 8, mass = 2, damping = 0.7, stiffness = 30, turn = 0.6;
  const double Q[4] = {cos(turn), sin(turn), -sin(turn), cos(turn)};
  const contact laws[] = {{.kt = 100, .kn = 1000, .mu = 0.3, .gap = -5}, {.kt = 100, .kn = 200, .mu = 0.3, .gap = 0.5}};
  for (int k = 0; k < 2; ++k) {
    double X[LENGTH] = {0}, both[2 * LENGTH];
    CHECK_MADE(model, one, model_oscillator(1, 0.4, 40, k ? 10 : 100, 1, &one));
    one->contacts[0].law = laws[k];
    model_direction(45, one->contacts[0].tangent, one->contacts[0].normal);
    CHECK_MADE(model, two, model_new(2, 1, 1, 1, &two));
    two->mass[0] = 1, two->mass[3] = mass;
    two->damping[0] = 0.4, two->damping[3] = damping;
    two->stiffness[0] = 40, two->stiffness[3] = stiffness;
    two->loads[0].harmonic = 1;
    two->loads[0].cosine[0] = k ? 10 : 100;
    two->contacts[0].law = laws[k];
    model_direction(45, two->contacts[0].tangent, two->contacts[0].normal);
    two->responses[0] = 1;
    model *turned = turned_structure(two, Q);
    const double at = k ? 13 : omega, period = TWO_PI / at;
    const hbm_stability alone = stability_of(one, at, X);
    CHECK_MADE(hbm_solver, s, hbm_solver_new(turned, &how, &s));
    const int dim = s->sys.dim; /* q is one motion of x_0, or both */
    memset(both, 0, sizeof both);
    const double *row = condensation_first_response(s->sys.linear);
    for (int c = 0; c < LENGTH; ++c)
      for (int d = 0; d < dim; ++d) both[c * dim + d] = X[c] * (dim == 1 ? 1 / row[0] : row[d]);
    hbm_solver_free(s);
    const hbm_stability beside = stability_of(turned, at, both);
    const double decay = exp(-damping / (2 * mass) * period);
    const double swing = sqrt(stiffness / mass - damping * damping / (4 * mass * mass));
    const double complex pair = decay * cexp(I * swing * period);
    CHECK_NEAR(beside.multiplier, fmax(alone.multiplier, decay), 1e-9 * alone.multiplier, "largest, %d", k);
    CHECK_NEAR(beside.determinant, alone.determinant * decay * decay, 1e-9 * fabs(alone.determinant), "all, %d", k);
    CHECK_NEAR(beside.fold, alone.fold * creal((1 - pair) * conj(1 - pair)), 1e-9 * fabs(alone.fold) + 1e-9, "fold");
    CHECK_NEAR(beside.flip, alone.flip * creal((1 + pair) * conj(1 + pair)), 1e-9 * fabs(alone.flip) + 1e-9, "flip");
    model_free(one);
    model_free(two);
    model_free(turned);
  }
}

/* A free body without damping has A = [0 1; 0 0], which has one eigenvector: x moves by v t, under a stuck slider's
 * pull by t^2/2 more. Another one beside it turns by 1 rad per unit time. */
static void a_free_body_has_no_eigenvectors(CHECK_STATE)
{
  CHECK_MADE(model, m, model_new(2, 0, 1, 1, &m));
  m->mass[0] = m->mass[3] = m->stiffness[3] = 2;
  m->contacts[0].law = (contact){.kt = 1e-300, .mu = 1, .load = 1};
  m->contacts[0].tangent[0] = 1;
  CHECK_MADE(interval_flow, f, interval_flow_new(m, &f));
  const contact_interval stuck = {.state = CONTACT_STICK};
  const contact_interval *interval[] = {&stuck};
  double phi[25] = {0};
  for (int i = 0; i < 5; ++i) phi[i * 6] = 1;
  assert_int_equal(interval_flow_advance(f, interval, 0.5, 5, phi), HC_OK);
  const double c = cos(0.5), s = sin(0.5);
  const double expected[25] = {1, 0, 0.5, 0, 0.125 / 2, 0, c, 0, s, 0, 0, 0, 1, 0, 0.25, 0, -s, 0, c, 0, 0, 0, 0, 0, 1};
  for (int i = 0; i < 25; ++i) CHECK_NEAR(phi[i], expected[i], 1e-14, "entry %d", i);
  interval_flow_free(f);
  model_free(m);
}

enum { SLIP, STUCK, STATES = 5 };

/* Over the period that ends with the interval `last`: the map of all states, or only what lasts. */
static void products_of(const model *m, int last, bool all, double *fold, double *flip, int *columns)
{
  const double duration[] = {0.4, 0.5}, *t = m->contacts[0].tangent, kt = m->contacts[0].law.kt;
  const contact_interval slip = {.state = CONTACT_SLIP_PLUS}, stuck = {.state = CONTACT_STICK};
  const contact_interval *const at[2][1] = {{&slip}, {&stuck}};
  double phi[STATES * STATES] = {0}, left[STATES * STATES];
  double complex lambda[STATES];
  int slider[] = {0}, active[] = {0, 1, 2, 3, 4};
  const bool sticks_on[] = {false};
  CHECK_MADE(interval_flow, f, interval_flow_new(m, &f));
  CHECK_MADE(floquet, eigen, floquet_new(STATES, &eigen));
  *columns = 4;
  for (int i = 0; i < 4; ++i) phi[i * (STATES + 1)] = 1;
  if (!all)
    assert_int_equal(
        interval_flow_survivors(f, at[last], duration[last], last == STUCK, slider, sticks_on, phi, columns), HC_OK);
  for (int i = 0; i < 2; ++i) {
    const int now = (last + 1 + i) % 2;
    for (int q = 0; q < *columns && now == STUCK; ++q)
      phi[4 * STATES + q] = kt * (t[0] * phi[q] + t[1] * phi[STATES + q]);
    assert_int_equal(interval_flow_advance(f, at[now], duration[now], *columns, phi), HC_OK);
  }
  if (!all) assert_int_equal(interval_flow_coordinates(f, at[last], slider, *columns, phi, left), HC_OK);
  assert_int_equal(floquet_multipliers(eigen, all ? phi : left, STATES, 1, *columns, active, lambda), HC_OK);
  double complex both[2] = {1, 1};
  for (int i = 0; i < *columns; ++i) {
    both[0] *= 1 - lambda[i];
    both[1] *= 1 + lambda[i];
  }
  *fold = creal(both[0]);
  *flip = creal(both[1]);
  floquet_free(eigen);
  interval_flow_free(f);
}

/* The second mass's motions decay by 300 a time, e^(-300 0.4) = 1e-52, and as fast under the stuck slider. What remains
 * has two multipliers, which the products over 1 - lambda and 1 + lambda tell, and a slider's 0. The map of all states
 * rounds by 2e-16 of its entries, 1e2 to 1e3 times as large as the multipliers: velocities of motions at 300 beside
 * displacements. With kt = 1e9 a slider's force in the place of its motion would make entries of 1e9, and 1e-7. */
static void what_a_interval_leaves_has_all_the_multipliers(CHECK_STATE)
{
  static const double stiffness[] = {100, 1e9};
  for (int i = 0; i < 4; ++i) {
    const int last = i % 2 ? STUCK : SLIP;
    /* Two masses, a Jenkins element on both, and a damper on the second one, whose motions die out in an interval. A
     * period slips and then sticks, from where the mass was then: dheld = kt t . dx. */
    CHECK_MADE(model, m, model_new(2, 0, 1, 1, &m));
    m->mass[0] = m->mass[3] = 1;
    m->stiffness[0] = 40, m->stiffness[1] = m->stiffness[2] = -15, m->stiffness[3] = 1e5;
    m->damping[0] = 0.5, m->damping[3] = 600;
    m->contacts[0].law = (contact){.kt = stiffness[i / 2], .mu = 1, .load = 1};
    m->contacts[0].tangent[0] = 1, m->contacts[0].tangent[1] = -0.5;
    double fold[2], flip[2];
    int columns[2];
    for (int all = 0; all < 2; ++all) products_of(m, last, all, &fold[all], &flip[all], &columns[all]);
    assert_int_equal(columns[1], 4);
    assert_true(columns[0] < 4);
    CHECK_NEAR(fold[0], fold[1], 1e-12, "fold %d", i);
    CHECK_NEAR(flip[0], flip[1], 1e-12, "flip %d", i);
    model_free(m);
  }
}

/* A free chain keeps its momentum: sum m dx moves by t sum m dx' whatever the springs do. Its eigenvectors of the free
 * motion are nearly one and the same; those of the other motions are good, which must not be taken for all. Rounding of
 * a sum of n terms, each of the size of m dx or m t dx', through exponentials of ten oscillations: 1e-11. */
static void a_free_chain_keeps_its_momentum(CHECK_STATE)
{
  enum { N = 10, ALL = 2 * N };
  uint64_t seed = 3;
  static double phi[ALL * ALL];
  const double t = 20;
  CHECK_MADE(model, m, model_new(N, 0, 0, 1, &m));
  for (int i = 0; i < N; ++i) m->mass[i * (N + 1)] = 1 + 2 * random_unit(&seed);
  for (int i = 1; i < N; ++i) {
    const double k = 5 + 10 * random_unit(&seed);
    m->stiffness[i * (N + 1)] += k, m->stiffness[(i - 1) * (N + 1)] += k;
    m->stiffness[i * N + i - 1] -= k, m->stiffness[(i - 1) * N + i] -= k;
  }
  for (int i = 0; i < ALL; ++i) phi[i * (ALL + 1)] = 1;
  CHECK_MADE(interval_flow, f, interval_flow_new(m, &f));
  assert_int_equal(interval_flow_advance(f, NULL, t, ALL, phi), HC_OK);
  for (int q = 0; q < ALL; ++q) {
    double momentum = 0;
    for (int i = 0; i < N; ++i) momentum += m->mass[i * (N + 1)] * phi[i * ALL + q];
    CHECK_NEAR(momentum, m->mass[q % N * (N + 1)] * (q < N ? 1 : t), 1e-11 * t, "column %d", q);
  }
  interval_flow_free(f);
  model_free(m);
}

/* 99.2 turns in a period, by contacts alone: scene 36 of structures 7282801 of hbmcheck stress, whose multiplier was
 * 4.3e-8 off, and 7e-6 in other units. Velocities taken by 1 rad per unit time leave V with a condition of 1.6e5. */
static void contacts_alone_may_hold_it(CHECK_STATE)
{
  const double mass = 0.0758429706114796, damping = 4.01271438532319, kt = 1.4e9, t = TWO_PI / 1395.4382859060147;
  CHECK_MADE(model, m, model_new(1, 0, 1, 1, &m));
  m->mass[0] = mass, m->damping[0] = damping;
  m->contacts[0].law = (contact){.kt = kt, .mu = 1, .load = 1};
  m->contacts[0].tangent[0] = 1;
  CHECK_MADE(interval_flow, f, interval_flow_new(m, &f));
  const contact_interval stuck = {.state = CONTACT_STICK};
  double phi[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  assert_int_equal(interval_flow_advance(f, &(const contact_interval *){&stuck}, t, 2, phi), HC_OK);
  /* Products of entries about 1, of which each is off by the rounding of its angle, 623 rad. */
  CHECK_NEAR(phi[0] * phi[4] - phi[1] * phi[3], exp(-damping / mass * t), 700 * DBL_EPSILON, "their product");
  interval_flow_free(f);
  model_free(m);
}

CHECK_TESTS("hbm.structure_stability", 60, oscillators_side_by_side, a_free_body_has_no_eigenvectors,
            contacts_alone_may_hold_it, what_a_interval_leaves_has_all_the_multipliers, a_free_chain_keeps_its_momentum)
