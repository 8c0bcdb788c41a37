/* test_modal_stability.c - multipliers of large structures with circles, which are followed in modes (modal_flow.h):
 * against the monodromy matrix by intervals along the same orbits; special points of a small structure that fast modes
 * are added to; flutter of two fast modes; and a structure that has no modes to go by. */

#include "hbm/solver/hbm_solver_impl.h"
#include "tests/hbm/random_structures.h"
#include "tests/hbm/structure_cases.h"

enum { H = 5, LENGTH = 2 * H + 1, MOST_DOFS = 60, MOST = 1000 };

static const hbm_settings how = {.harmonics = H, .keep_mean = true, .tolerance = 1e-12, .accuracy = 1e-4};

/* ---- both ways along one orbit ---------------------------------------------------------------------------- */

/* C = a M + b K. */
static void damp(model *m, double a, double b)
{
  for (int i = 0; i < m->n * m->n; ++i) m->damping[i] = a * m->mass[i] + b * m->stiffness[i];
}

static int multipliers_by(const multiplier_method *method, const model *m, const contact_forces *orbit, double omega,
                          double complex *lambda, hbm_stability *st)
{
  const double complex *found;
  CHECK_MADE(monodromy, w, monodromy_new(m, method, &w));
  assert_int_equal(monodromy_stability(w, orbit, omega, st), HC_OK);
  const int n = monodromy_multipliers(w, &found);
  assert_true(n <= MOST);
  memcpy(lambda, found, (size_t)n * sizeof *lambda);
  monodromy_free(w);
  return n;
}

/* Each of a[] above 0.5 in size is one of b[]. How many. */
static int check_found(const char *name, int at, int n_a, const double complex *a, int n_b, const double complex *b)
{
  int large = 0;
  for (int i = 0; i < n_a; ++i) {
    double apart = INFINITY;
    if (cabs(a[i]) < 0.5) continue;
    for (int k = 0; k < n_b; ++k) apart = fmin(apart, cabs(a[i] - b[k]));
    CHECK_LE(apart, 1e-8 * fmax(1, cabs(a[i])), "%s, structure %d: %g%+gi", name, at, creal(a[i]), cimag(a[i]));
    ++large;
  }
  return large;
}

/* Motions are drawn: multipliers belong to any that the contacts are taken along. To 1e-8: steps are at most 0.3 rad of
 * every mode that keeps half of itself, of which Radau's method takes 1e-14 a step; of modes that keep less and are
 * shaken by contacts it takes more, which is 1.3e-9 at most here. */
static void multipliers_are_those_by_intervals(CHECK_STATE)
{
  static double x[LENGTH * MOST_DOFS], X[CASE_MAX_COEF];
  static double complex by_intervals[MOST], in_modes[MOST];
  uint64_t seed = 20260729;
  int large = 0;
  for (int k = 0; k < 20; k += check_long ? 1 : 5) { /* 5: one of each kind of k % 4 */
    const int n = 10 + k * 50 / 19;
    /* In every fourth structure no contact changes its state; in another fourth planar contacts slip all period. */
    const bool slips = k % 4 == 2;
    const double omega = 3 + 2 * random_unit(&seed), size = k % 4 == 3 ? 1e-6 : 0.5;
    /* With modes up to a hundred times the lowest one, half of its contacts circles. */
    const int contacts = 2 * random_int(&seed, 2, 4);
    model *m = random_structure(&seed, n, contacts);
    for (int i = 0; i < n; i += 3) m->stiffness[i * (n + 1)] *= pow(10, 3 * random_unit(&seed));
    for (int j = 0; j < n; ++j) /* it is but for rounding of larger terms */
      for (int i = 0; i < j; ++i) m->stiffness[i * n + j] = m->stiffness[j * n + i];
    damp(m, 0.05, 0.001);
    for (int j = 0; j < contacts; j += slips ? 2 : 4) {
      contact whole = {.kt = 10 + 50 * random_unit(&seed), .kn = 10 + 50 * random_unit(&seed), .mu = 0.2};
      whole.gap = random_unit(&seed) < 0.5 ? 0.3 : -0.05;
      for (int d = 0; d < 2; ++d) random_direction(&seed, n, m->contacts[j + d].tangent);
      random_direction(&seed, n, m->contacts[j].normal);
      for (int i = 0; i < n && slips; ++i) m->contacts[j].normal[i] = 0;
      if (slips) whole.kn = whole.gap = 0, whole.load = 0.05;
      make_circle(m, j, whole);
    }
    const contact_forces *orbit;
    hbm_stability a, b;
    CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
    for (int c = 0; c < LENGTH; ++c)
      for (int i = 0; i < n; ++i) x[c * n + i] = size * random_signed(&seed) / (1 + c * c);
    hbm_guess_of(s, x, X);
    CHECK_FILLED(contact_report, report, hbm_located_orbit(s, X, &orbit, &report));
    const int n_a = multipliers_by(&multipliers_by_intervals, m, orbit, omega, by_intervals, &a),
              n_b = multipliers_by(&multipliers_in_modes, m, orbit, omega, in_modes, &b);
    large += check_found("by intervals", k, n_a, by_intervals, n_b, in_modes);
    check_found("in modes", k, n_b, in_modes, n_a, by_intervals);
    CHECK_NEAR(b.multiplier, a.multiplier, 1e-8 * fmax(1, a.multiplier), "structure %d", k);
    assert_int_equal(a.pairs_outside, b.pairs_outside);
    hbm_solver_free(s);
    model_free(m);
  }
  assert_true(large > (check_long ? 100 : 20));
}

/* ---- fast modes beside a small structure ---------------------------------------------------------------------- */

/* m with `more` masses on springs, their frequencies from omega_low to omega_high, each held to x[0] by a spring of
 * 1e-4 of the geometric mean, and a circle on three of them that never touches. Damping b K. */
static model *padded(const model *m, int more, double omega_low, double omega_high, double b)
{
  const int n = m->n + more;
  CHECK_MADE(model, p, model_new(n, m->n_loads, m->n_contacts + 2, m->n_responses, &p));
  for (int j = 0; j < m->n; ++j)
    for (int i = 0; i < m->n; ++i) {
      p->mass[j * n + i] = m->mass[j * m->n + i];
      p->stiffness[j * n + i] = m->stiffness[j * m->n + i];
    }
  for (int i = m->n; i < n; ++i) {
    const double part = (i - m->n) / (more - 1.0), omega = omega_low * pow(omega_high / omega_low, part);
    p->mass[i * (n + 1)] = 1;
    p->stiffness[i * (n + 1)] = omega * omega;
    p->stiffness[i] = p->stiffness[i * n] = -1e-4 * omega * sqrt(m->stiffness[0]);
  }
  damp(p, 0, b);
  for (int l = 0; l < m->n_loads; ++l) {
    p->loads[l].harmonic = m->loads[l].harmonic;
    memcpy(p->loads[l].cosine, m->loads[l].cosine, (size_t)m->n * sizeof(double));
    memcpy(p->loads[l].sine, m->loads[l].sine, (size_t)m->n * sizeof(double));
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    p->contacts[j].law = m->contacts[j].law;
    memcpy(p->contacts[j].tangent, m->contacts[j].tangent, (size_t)m->n * sizeof(double));
    memcpy(p->contacts[j].normal, m->contacts[j].normal, (size_t)m->n * sizeof(double));
  }
  for (int r = 0; r < m->n_responses; ++r)
    memcpy(p->responses + (size_t)r * (size_t)n, m->responses + (size_t)r * (size_t)m->n,
           (size_t)m->n * sizeof(double));
  for (int d = 0; d < 2; ++d) p->contacts[m->n_contacts + d].tangent[m->n + 10 + d] = 1;
  p->contacts[m->n_contacts].normal[m->n + 12] = 1;
  make_circle(p, m->n_contacts, (contact){.kt = 1, .kn = 1, .mu = 0.3, .gap = -100});
  return p;
}

/* From the survivors of a part of the period, and from all 890 states. What is lost of the map is 1e-13 of it, and the
 * largest multiplier is a simple one. With a hundredth of the damping 400 columns do not hold all that survives. */
static void survivors_have_the_multipliers_of_all(CHECK_STATE)
{
  static double X[CASE_MAX_COEF];
  static double complex few[MOST], all[MOST];
  structure_case small = structure_case_named("stop2", 21);
  model *m = padded(small.model, 440, 20, 4000, 0.003);
  hbm_stability a, b;
  const contact_forces *orbit;
  const double omega = 0.5 * (small.from + small.to);
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &small.how, &s));
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
  CHECK_FILLED(contact_report, report, hbm_located_orbit(s, X, &orbit, &report));
  assert_true(report.regime == CONTACT_SEPARATES);
  const int n_few = multipliers_by(&multipliers_in_modes, m, orbit, omega, few, &a),
            n_all = multipliers_by(&multipliers_from_all_states, m, orbit, omega, all, &b);
  assert_true(n_few < 400 && check_found("all", 0, n_all, all, n_few, few) > 0);
  CHECK_NEAR(a.multiplier, b.multiplier, 1e-10 * b.multiplier, "of 442 masses");
  damp(m, 0, 0.00003);
  assert_true(multipliers_by(&multipliers_in_modes, m, orbit, omega, few, &a) > 400);
  hbm_solver_free(s);
  model_free(m);
  model_free(small.model);
}

enum { ROOM = 32 };

static int specials_of(const structure_case *c, hbm_special *kept_ones)
{
  hbm_special *special;
  hbm_curve curve = {0};
  int n = 0, kept = 0;
  CHECK_MADE(hbm_solver, s, hbm_solver_new(c->model, &c->how, &s));
  assert_int_equal(hbm_trace(s, c->from, c->to, NULL, &curve), HC_OK);
  assert_int_equal(hbm_specials(s, &curve, &special, &n), HC_OK);
  for (int i = 0; i < n; ++i)
    if (special[i].kind != HBM_CONTACT_CHANGE && kept < ROOM) kept_ones[kept++] = special[i];
  free(special);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return kept;
}

/* Springs to the added masses take x[0]'s stiffness down by (1e-4)^2 of it each: 5e-7 in all, and omega of a special
 * point by that times how it depends on the stiffness, which is less than 10. */
static void special_points_stay_where_they_are(CHECK_STATE)
{
  structure_case small = structure_case_named("stop2", 21), large = small;
  hbm_special alone[ROOM], beside[ROOM];
  int of_kind[4] = {0};
  large.model = padded(small.model, 52, 20, 400, 0.03);
  const int n = specials_of(&small, alone);
  assert_int_equal(specials_of(&large, beside), n);
  for (int i = 0; i < n; ++i) {
    assert_int_equal(beside[i].kind, alone[i].kind);
    CHECK_NEAR(beside[i].omega, alone[i].omega, 5e-6 * alone[i].omega, "special point %d, kind %d", i,
               (int)alone[i].kind);
    ++of_kind[alone[i].kind];
  }
  assert_true(of_kind[HBM_TURNING_POINT] && of_kind[HBM_PERIOD_DOUBLING] && of_kind[HBM_NEIMARK_SACKER]);
  model_free(small.model);
  model_free(large.model);
}

/* Time integration has the multiplier 0.9638 at 138 Hz (tests/timeint/test_large.c holds it against differences of the
 * period map). Harmonic balance tends to it: 0.9615, 0.9622, 0.9636 with 7, 15, 31 harmonics. */
static void plates_multiplier_is_that_of_time_integration(CHECK_STATE)
{
  static double X[CASE_MAX_COEF];
  structure_case c = structure_case_named("plates", 7);
  hbm_solver *s = structure_solver(&c);
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, TWO_PI * 138, NULL, X, &point));
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, TWO_PI * 138, X, &st));
  CHECK_NEAR(st.multiplier, 0.9638, 3e-3, "of 7 harmonics");
  CHECK_NEAR(st.im, 0, 1e-12, "a real one");
  assert_int_equal(hbm_stability_verdict(&st), 1);
  hbm_solver_free(s);
  model_free(c.model);
}

/* ---- flutter --------------------------------------------------------------------------------------------- */

/* A mass dragged to and fro under a load of its own, rubbing on a contact whose tangential and normal motion are also
 * those of two masses at 300 times its frequency, f_1 in t and 1/2 f_1 + sqrt(3)/2 f_2 in n. While it slips backwards,
 * kn = 0.02 of their stiffness k adds
 *     kn [ -mu/2 + 1/4     sqrt(3)/4 (1 - 2 mu) ]
 *        [   sqrt(3)/4            3/4           ],       mu = 1,
 * whose diagonal the masses' own springs make equal: omega^2 = k +- i sqrt(3)/4 kn, growth 0.0043 omega against zeta
 * omega. A circle that rubs along t_1 has the same terms. */
static model *fluttering(double zeta, bool circle)
{
  const int n = 54, contacts = circle ? 2 : 4;
  const double fast = 300, k = fast * fast, kn = 0.02 * k;
  CHECK_MADE(model, m, model_new(n, 1, contacts, 1, &m));
  for (int i = 0; i < n; ++i) {
    const double omega = i < 2 ? 2 : i < 4 ? fast : 400 + 20 * i;
    m->mass[i * (n + 1)] = 1;
    m->stiffness[i * (n + 1)] = omega * omega;
    if (i == 2) m->stiffness[i * (n + 1)] += kn; /* 3/4 - (1/4 - 1/2) */
    m->damping[i * (n + 1)] = 2 * (i < 2 ? 0.05 : i < 4 ? zeta : 0.02) * sqrt(m->stiffness[i * (n + 1)]);
  }
  m->loads[0].harmonic = 1;
  m->loads[0].cosine[0] = 50;
  m->responses[0] = 1;
  const contact whole = {.kt = 50, .kn = kn, .mu = 1, .gap = 1 / kn};
  for (int j = 0; j < contacts; j += 2) {
    double *t = m->contacts[j].tangent, *normal = m->contacts[j].normal;
    if (j == 0) t[0] = t[2] = 1, normal[2] = 0.5, normal[3] = sqrt(0.75);
    else t[10] = normal[12] = 1;
    m->contacts[j + 1].tangent[j == 0 ? 1 : 11] = 1;
    if (circle || j > 0) make_circle(m, j, j > 0 ? (contact){.kt = 1, .kn = 1, .mu = 0.3, .gap = -100} : whole);
    else m->contacts[j].law = whole, m->contacts[j + 1].law = (contact){.kn = 0};
  }
  return m;
}

/* In steps of 3 rad of the fast modes Radau's method takes (5! 4!/(9! 10!)) 3^10 = 1.3e-4 of an oscillation; at 2 pi
 * 300/3 of them a period that is 8 % of the multiplier, where the exact one is known. */
static void flutter_of_fast_modes_is_seen(CHECK_STATE)
{
  static double X[CASE_MAX_COEF];
  static double complex by_intervals[MOST], in_modes[MOST];
  for (int circle = 0; circle < 2; ++circle)
    for (int heavy = 0; heavy < 2; ++heavy) {
      model *m = fluttering(heavy ? 0.01 : 0.001, circle);
      hbm_stability a, b;
      const contact_forces *orbit;
      CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
      CHECK_FILLED(hbm_point, point, hbm_first_solution(s, 1, NULL, X, &point));
      assert_int_equal(hbm_stability_at(s, 1, X, &b), HC_OK);
      assert_int_equal(hbm_stability_verdict(&b), heavy ? 1 : -1);
      CHECK_FILLED(contact_report, report, hbm_located_orbit(s, X, &orbit, &report));
      if (!circle) { /* by intervals a circle's slip would take minutes */
        multipliers_by(&multipliers_by_intervals, m, orbit, 1, by_intervals, &a);
        multipliers_by(&multipliers_in_modes, m, orbit, 1, in_modes, &b);
        assert_true((a.multiplier > 1) == !heavy);
        CHECK_NEAR(b.multiplier, a.multiplier, 0.1 * a.multiplier, "zeta of the pair: %g", heavy ? 0.01 : 0.001);
      }
      hbm_solver_free(s);
      model_free(m);
    }
}

/* ---- what has no modes ----------------------------------------------------------------------------------- */

static void damping_that_modes_do_not_share_is_unknown(CHECK_STATE)
{
  static double X[CASE_MAX_COEF];
  model *m = fluttering(0.01, true);
  m->damping[1] += 0.01, m->damping[m->n] += 0.01;
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, 1, NULL, X, &point));
  assert_false(hbm_stability_is_unknown(s));
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, 1, X, &st));
  assert_true(hbm_stability_is_unknown(s));
  assert_true(isnan(st.multiplier));
  assert_int_equal(hbm_stability_verdict(&st), 0);
  hbm_solver_free(s);
  model_free(m);
}

CHECK_TESTS_AND_LONG("hbm.modal_stability", 240,
                     (multipliers_are_those_by_intervals, special_points_stay_where_they_are,
                      plates_multiplier_is_that_of_time_integration, flutter_of_fast_modes_is_seen,
                      damping_that_modes_do_not_share_is_unknown),
                     (multipliers_are_those_by_intervals, survivors_have_the_multipliers_of_all))
