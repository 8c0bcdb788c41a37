/* test_closed.c - the exact law in closed form (integrate_closed_form.c): against the oracle, against CVODE's
 * event-driven periods, its monodromy matrix against differences, the table of reference, what must not break it. */

#include "numerics/random.h"
#include "tests/timeint/exact_periods.h"
#include "tests/timeint/reference_rows.h"

static integrator *closed_of(const scaled_model *m)
{
  CHECK_MADE(integrator, in, integrate_new_closed_form(m->base, INTERVAL_MODES_STIFF, &in));
  return in;
}

static integrator *cvode_of(const scaled_model *m)
{
  CHECK_MADE(integrator, in, integrate_new_events(m->base, 1e-13, &in));
  return in;
}

/* The oracle adds up the roundings of 4000 small steps and leaves a slip's limit at a slack of 1e-13: 1e-11 a period,
 * of which the damping leaves 5 or fewer. By differences a period's roundings are seen. */
static const exact_way way = {.make = closed_of, .noise = 100 * DBL_EPSILON, .off = 5e-11};

static void they_follow_the_oracle(CHECK_STATE) { scenes_follow_the_oracle(&way); }
static void rest_stays_at_rest(CHECK_STATE) { check_rest(&way); }
static void monodromy_is_that_of_the_period(CHECK_STATE) { check_monodromies(&way); }
static void a_transition_at_the_end_of_the_period(CHECK_STATE) { check_transition_at_the_end(&way, 1e-13, 1e-9); }

/* Where kt cos is next to mu kn sin (to an eighth here) the X at which slip begins is the guard over a small slope,
 * and its rounding is many times X's. Found twice it would be two X, the second behind the one that the motion has
 * reached, and the period would never end. */
static void slip_that_begins_on_a_flat_guard(CHECK_STATE)
{
  scene sc = scene_linear(8.13, 0.88, 13.2, 23.2);
  scene_add(&sc, 20.35, 4.05, 0.46, 2.8, 0);
  scene_add(&sc, 12.98, 40.99, 0.47, 3.8, 30.5);
  for (int i = 0; i <= 20; ++i) follow_oracle(&way, "a flat guard", sc, 1.9 + 0.01 * i, 1, 15);
}

static scene random_scene(uint64_t *seed)
{
  static const double angles[] = {0, 15, 30, 45, 60, 80, 90};
  scene sc = scene_linear(1, pow(10, -2 + 2 * random_unit(seed)), 40, 100);
  const int n = random_int(seed, 1, 5);
  for (int j = 0; j < n; ++j) {
    const double kt = random_int(seed, 0, 9) ? 1000 * random_unit(seed) : 0;
    const double kn = random_int(seed, 0, 9) ? 1000 * random_unit(seed) : 0;
    const double mu = random_int(seed, 0, 9) ? random_unit(seed) : 0;
    const double gap = random_int(seed, 0, 9) ? 4 * random_signed(seed) : 0;
    scene_add(&sc, kt, kn, mu, gap, angles[random_int(seed, 0, 6)]);
  }
  return sc;
}

/* A random state whose sliders obey |T| <= mu N: a period from anywhere ends at one. */
static void random_state(const scaled_model *m, integrator *in, double *y, uint64_t *seed)
{
  for (int i = 0; i < m->n_states; ++i) y[i] = 2 * random_signed(seed);
  run(in, m, y, 1);
}

/* The intervals in which contacts keep their states, but those too short to be told: two integrations whose motions
 * differ by e see a guard g cross 0 or not where it turns less than e away, an interval of 2 sqrt(2 e/|g''|). With e
 * as below, 6e-10 of the motion, and g'' of the motion's size that is 7e-5. */
static const double brief = 1e-4; /* [rad] */

typedef struct interval_count {
  int n_contacts, intervals[SCENE_MAX_STATES];
  contact_state now[SCENE_MAX_STATES], counted[SCENE_MAX_STATES]; /* the last that lasted */
  double since[SCENE_MAX_STATES];
} interval_count;

static void end_interval(interval_count *c, int j, double theta)
{
  const bool lasted = theta - c->since[j] > brief;
  if (lasted && (c->intervals[j] == 0 || c->counted[j] != c->now[j])) {
    ++c->intervals[j];
    c->counted[j] = c->now[j];
  }
  c->since[j] = theta;
}

static hc_status note_states(void *self, const integrator *in, double theta0, double theta1)
{
  interval_count *c = self;
  double y[SCENE_MAX_STATES];
  assert_int_equal(integrate_dense(in, theta1, 0, y), HC_OK);
  for (int j = 0; j < c->n_contacts; ++j) {
    const contact_state now = integrate_contact(in, j, y);
    if (theta0 > 0 && now != c->now[j]) end_interval(c, j, theta0);
    c->now[j] = now;
  }
  return HC_OK;
}

/* intervals[n_contacts] over one period from that state. */
static void lasting_intervals(integrator *in, const scaled_model *m, const double *from, int *intervals)
{
  interval_count c = {.n_contacts = m->n_contacts};
  double y[SCENE_MAX_STATES];
  memcpy(y, from, sizeof y);
  assert_int_equal(integrate_period(in, m, y, note_states, &c), HC_OK);
  for (int j = 0; j < m->n_contacts; ++j) end_interval(&c, j, TWO_PI);
  memcpy(intervals, c.intervals, sizeof *intervals * (size_t)m->n_contacts);
}

/* One period, and its matrix, against CVODE's: 200 steps of 1e-13 of the motion's size, which a stiff phase (rates 30)
 * may carry on 30 times larger. The matrix changes with the transitions' angles, whose error is that of X over P: 1e-10
 * where P is some 1e-3. Each contact passes through as many intervals. */
static void random_scenes_follow_cvode(CHECK_STATE)
{
  uint64_t seed = 19;
  double worst = 0, worst_matrix = 0;
  int transitions = 0;
  for (int trial = 0; trial < CHECK_LONG_TRIALS(1000); ++trial) {
    scaled_model m = exact_model(random_scene(&seed), 2 + 10 * random_unit(&seed), 1 + 4 * random_unit(&seed));
    integrator *in = closed_of(&m), *ref = cvode_of(&m);
    double y[SCENE_MAX_STATES], z[SCENE_MAX_STATES], fx[2][SCENE_MAX_STATES * SCENE_MAX_STATES], size = 1, apart = 0;
    const int n = m.n_states;
    random_state(&m, in, y, &seed);
    for (int i = 0; i < n; ++i) z[i] = y[i], size = fmax(size, fabs(y[i]));
    const long was = integrate_transitions(in);
    double from[SCENE_MAX_STATES];
    memcpy(from, y, sizeof from);
    assert_int_equal(integrate_monodromy(in, &m, y, fx[0]), HC_OK);
    assert_int_equal(integrate_monodromy(ref, &m, z, fx[1]), HC_OK);
    transitions += (int)(integrate_transitions(in) - was);
    for (int i = 0; i < n; ++i) apart = larger(apart, fabs(y[i] - z[i]) / size);
    worst = larger(worst, apart);
    CHECK_LE(apart, 200 * 1e-13 * 30, "trial %d", trial);
    double most = 1, off = 0;
    for (int i = 0; i < n * n; ++i) most = larger(most, fabs(fx[1][i])), off = larger(off, fabs(fx[0][i] - fx[1][i]));
    worst_matrix = larger(worst_matrix, off / most);
    CHECK_LE(off, 1e-7 * most, "matrix, trial %d", trial);
    int lasting[2][SCENE_MAX_STATES];
    lasting_intervals(in, &m, from, lasting[0]);
    lasting_intervals(ref, &m, from, lasting[1]);
    for (int j = 0; j < m.n_contacts; ++j)
      if (lasting[0][j] != lasting[1][j])
        fail_msg("trial %d, contact %d: %d intervals by CVODE, %d without", trial, j, lasting[1][j], lasting[0][j]);
    integrate_free(in);
    integrate_free(ref);
  }
  print_message("worst: %.2g, of the matrix %.2g; %d transitions\n", worst, worst_matrix, transitions);
}

/* Watched, a period is cut at the turns too: the same but for roundings of it (1e-12 of the motion where P = 30).
 * Peaks, mean, first harmonic and wave against CVODE's dense output, good to some 1e-11 of the motion at 1e-13; sums
 * over 512 instants err by the motion's corners 512^-2 here, where the period does not close, so integrals are compared
 * with sums over the intervals: the trapezoidal rule with its end correction, h^4/720 of the third derivative's
 * jump. */
static void measures_are_those_of_the_motion(CHECK_STATE)
{
  uint64_t seed = 29;
  double worst = 0, worst_mean = 0;
  for (int trial = 0; trial < CHECK_TRIALS(200); ++trial) {
    scene sc = random_scene(&seed);
    scaled_model m = exact_model(sc, 3 + 9 * random_unit(&seed), 3);
    integrator *in = closed_of(&m), *ref = cvode_of(&m);
    double y[SCENE_MAX_STATES], z[SCENE_MAX_STATES], w[SCENE_MAX_STATES], rate[SCENE_MAX_STATES], size = 1;
    timeint_result got = {0}, want = {0};
    random_state(&m, in, y, &seed);
    memcpy(z, y, sizeof z);
    memcpy(w, y, sizeof w);
    scaled_rhs(&m, 0, y, rate);
    const double x0 = y[SCALED_X], p0 = y[SCALED_P];
    run(in, &m, w, 1);
    scene_measured_period(&sc, &m, 1, in, y, &got);
    scene_measured_period(&sc, &m, 1, ref, z, &want);
    for (int i = 0; i < m.n_states; ++i) size = fmax(size, fabs(y[i]));
    size = fmax(size, fmax(got.max, -got.min));
    for (int i = 0; i < m.n_states; ++i) CHECK_NEAR(y[i], w[i], 1e-12 * size, "watched or not, trial %d", trial);
    const double bound = 200 * 1e-13 * 30 * size;
    CHECK_NEAR(got.max, want.max, bound, "max, trial %d", trial);
    CHECK_NEAR(got.min, want.min, bound, "min, trial %d", trial);
    CHECK_NEAR(got.rms, want.rms, bound, "rms, trial %d", trial);
    assert_int_equal(got.regime, want.regime);
    for (int i = 0; i < TIMEINT_WAVE; ++i) {
      worst = fmax(worst, fabs(got.wave[i] - want.wave[i]) / size);
      CHECK_NEAR(got.wave[i], want.wave[i], bound, "wave[%d], trial %d", i, trial);
    }
    const double h = 2 * PI / TIMEINT_WAVE, n = TIMEINT_WAVE;
    double sum = 0, co = 0, si = 0;
    for (int i = 0; i < TIMEINT_WAVE; ++i) {
      sum += got.wave[i], co += got.wave[i] * cos(i * h), si += got.wave[i] * sin(i * h);
    }
    const double jump = y[SCALED_X] - x0, turn = y[SCALED_P] - p0; /* trapezoid: half of each end; minus h^2/12 [f'] */
    sum += 0.5 * jump - h / 12 * turn;
    co += 0.5 * jump - h / 12 * turn;
    si += -h / 12 * jump; /* f' = X cos + P sin */
    double stiff = scene_k(&m);
    for (int j = 0; j < m.n_contacts; ++j) {
      const scaled_contact *c = &m.contact[j];
      stiff += c->law.kt * scene_cosine(&m, c) * scene_cosine(&m, c) +
               c->law.kn * (scene_sine(&m, c) + c->law.mu * scene_cosine(&m, c)) * scene_sine(&m, c);
    }
    /* of each of the force's corners, and of the ends, at most h^4/384 of a third derivative's jump, stiff * P */
    const double error = pow(h, 4) / 384 * 2 * (1 + pow(stiff, 1.5)) * size / (2 * PI) + 1e-13 * size;
    worst_mean = fmax(worst_mean, fabs(got.mean - sum / n) / error);
    CHECK_NEAR(got.mean, sum / n, error, "mean, trial %d", trial);
    CHECK_NEAR(got.a1, 2 * co / n, 2 * error, "a1, trial %d", trial);
    CHECK_NEAR(got.b1, 2 * si / n, 2 * error, "b1, trial %d", trial);
    integrate_free(in);
    integrate_free(ref);
  }
  print_message("worst: wave %.2g, mean %.2g of its bound\n", worst, worst_mean);
}

/* On the orbit X = A cos(theta - phi) of a contact that sticks, or is separated, the end of that state is put at A, and
 * some roundings to either side: crossed or not, nothing may change by more than a slip or touch of sqrt(eps) rad
 * does, (1e-8)^3. So for 3 periods. */
static void ends_at_a_turn(CHECK_STATE)
{
  for (int trial = 0; trial < CHECK_LONG_TRIALS(300); ++trial) {
    const bool apart = trial % 2;
    const double angle = apart ? 45 : 0;
    scaled_model m = exact_model(one(100, 100 + trial, 200, 0.3, 0.5, angle), 5 + 0.03 * trial, 1);
    scaled_contact *c = &m.contact[0];
    const double k = scene_k(&m) + (apart ? 0 : c->law.kt);
    const double complex X = linear_response(1, scene_c(&m), k, scene_f(&m), 1);
    const double gap = apart ? -scene_sine(&m, c) * cabs(X) : c->law.kt * cabs(X) / (c->law.mu * c->law.kn);
    integrator *in = closed_of(&m);
    for (int off = -40; off <= 40; ++off) {
      c->law.gap = gap * (1 + 0.25 * off * DBL_EPSILON);
      c->preload = apart ? 0 : c->law.kn * c->law.gap;
      double y[3] = {creal(X), -cimag(X), apart ? scene_cosine(&m, c) * creal(X) : 0}, watched[3];
      memcpy(watched, y, sizeof y);
      run(in, &m, y, 3);
      scene sc = one(100, 100 + trial, 200, 0.3, 0.5, angle);
      timeint_result r = {0};
      for (int i = 0; i < 3; ++i) scene_measured_period(&sc, &m, 1, in, watched, &r);
      CHECK_NEAR(y[0], creal(X), 1e-12 * cabs(X), "X, trial %d, %d roundings", trial, off);
      CHECK_NEAR(y[1], -cimag(X), 1e-12 * cabs(X), "P, trial %d, %d roundings", trial, off);
      CHECK_NEAR(watched[0], creal(X), 1e-12 * cabs(X), "X watched, trial %d, %d roundings", trial, off);
      CHECK_NEAR(watched[1], -cimag(X), 1e-12 * cabs(X), "P watched, trial %d, %d roundings", trial, off);
      CHECK_NEAR(r.amplitude, cabs(X), 1e-12 * cabs(X), "amplitude, trial %d, %d roundings", trial, off);
      CHECK_NEAR(r.harmonic_1, cabs(X), 1e-12 * cabs(X), "harmonic_1, trial %d, %d roundings", trial, off);
    }
    integrate_free(in);
  }
}

/* The table's numbers as far as they are printed, and 1e-12 of the amplitude: ours, at transient.tolerance 1e-12. */
static void every_row_of_the_reference(CHECK_STATE)
{
  double worst = 0;
  for (int i = 0; i < N_REFERENCE_SCENES; ++i) {
    scene sc = scene_reference(reference_scenes[i].name);
    sc.transient.law = TRANSIENT_LAW_EXACT;
    sc.transient.method = TRANSIENT_METHOD_CLOSED_FORM;
    sc.transient.start = TRANSIENT_START_UP;
    sc.transient.tolerance = 1e-12;
    worst = fmax(worst, follow_reference(reference_scenes[i].name, sc, 1e-12, 1e-12));
  }
  print_message("worst: %.2f of the table's digits and 1e-12\n", worst);
}

/* No spring of the mass's own; damping up to 1e4 times critical: soft and resonant phases, roots far apart. */
static void soft_and_overdamped_scenes_follow_cvode(CHECK_STATE)
{
  const double damping[] = {0, 1e-3, 4, 100, 1e4}, stiffness[] = {0, 1e-6, 49, 49.01};
  long most = 0;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j) {
      scene sc = one(100, 300, 200, 0.3, -0.5, 45);
      *sc.structure->damping.v = damping[i], *sc.structure->stiffness.v = stiffness[j];
      scaled_model m = exact_model(sc, 7, 100 / (49 + 7 * damping[i]));
      integrator *in = closed_of(&m), *ref = cvode_of(&m);
      double y[SCENE_MAX_STATES] = {0}, z[SCENE_MAX_STATES] = {0};
      for (int p = 0; p < 5; ++p) {
        const long before = integrate_rhs(in);
        run(in, &m, y, 1);
        run(ref, &m, z, 1);
        most = integrate_rhs(in) - before > most ? integrate_rhs(in) - before : most;
        const double size = 1 + fabs(y[0]) + fabs(y[1]);
        for (int s = 0; s < m.n_states; ++s)
          CHECK_NEAR(y[s], z[s], 200 * 1e-12 * (p + 1) * size, "y%d, damping %g stiffness %g period %d", s, damping[i],
                     stiffness[j], p);
      }
      integrate_free(in);
      integrate_free(ref);
    }
  print_message("at most %ld evaluations a period\n", most);
  CHECK_LE((double)most, 20000, "evaluations");
}

static void failures_are_reported(CHECK_STATE)
{
  scaled_model m = exact_model(scene_c2(), 7, 10);
  integrator *in = closed_of(&m);
  const double bad[] = {NAN, INFINITY, -INFINITY, DBL_MAX};
  double monodromy[9];
  for (int i = 0; i < 4; ++i) {
    double y[SCENE_MAX_STATES] = {0.5, 0, 0.3};
    scaled_model broken = m;
    broken.by_load = bad[i];
    if (i < 3) {
      assert_int_equal(integrate_period(in, &broken, y, NULL, NULL), HC_NOT_FINITE);
      assert_int_equal(integrate_monodromy(in, &broken, y, monodromy), HC_NOT_FINITE);
      assert_true(y[0] == 0.5 && y[1] == 0 && y[2] == 0.3); /* the state stays */
    }
    for (int s = 0; s < 3; ++s) {
      double z[SCENE_MAX_STATES] = {0.5, 0, 0.3};
      z[s] = bad[i];
      const hc_status st = integrate_period(in, &m, z, NULL, NULL);
      if (i < 3) assert_int_equal(st, HC_NOT_FINITE);
      assert_true(st == HC_NOT_FINITE || isfinite(z[0] + z[1] + z[2]));
    }
    assert_int_equal(integrate_period(in, &m, y, NULL, NULL), HC_OK); /* and works again */
  }
  scaled_model other = exact_model(three_contacts(), 7, 2);
  double y[SCENE_MAX_STATES] = {0};
  assert_int_equal(integrate_period(in, &other, y, NULL, NULL), HC_BUG);
  integrate_free(in);
}

CHECK_TESTS_AND_LONG_WITH("timeint.closed", 120, read_steady_references, NULL,
                          (random_scenes_follow_cvode, ends_at_a_turn, they_follow_the_oracle,
                           slip_that_begins_on_a_flat_guard, soft_and_overdamped_scenes_follow_cvode,
                           measures_are_those_of_the_motion, a_transition_at_the_end_of_the_period,
                           monodromy_is_that_of_the_period, every_row_of_the_reference, rest_stays_at_rest,
                           failures_are_reported),
                          (random_scenes_follow_cvode, ends_at_a_turn))
