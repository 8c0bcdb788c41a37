/* test_exact.c - event-located contact force harmonics: closed forms, symmetries, and the limit of sampling. */
#include "tests/hbm/exact_scenes.h"

/* Series of k max(g + A cos th, 0), A > 0; docs/theory.md section 11. */
static void spring_series(double k, double A, double g, int n_harm, double *F)
{
  memset(F, 0, (size_t)series_length(n_harm) * sizeof *F);
  if (g <= -A) return;
  if (g >= A) {
    F[0] = k * g;
    F[1] = k * A;
    return;
  }
  double p = atan2(sqrt((A - g) * (A + g)), -g); /* arccos(-g/A), exact where it grazes */
  F[0] = k / PI * (g * p + A * sin(p));
  for (int h = 1; h <= n_harm; ++h) {
    double before = h == 1 ? p : sin((h - 1) * p) / (h - 1);
    F[2 * h - 1] = 2 * k / PI * (g * sin(h * p) / h + A / 2 * (sin((h + 1) * p) / (h + 1) + before));
  }
}

/* Series of a Jenkins element of stiffness k and limit f under A cos th, A > f/k. */
static void jenkins_series(double k, double f, double A, int n_harm, double *F)
{
  memset(F, 0, (size_t)series_length(n_harm) * sizeof *F);
  double p = acos(1 - 2 * f / (k * A)), r = k * A;
  for (int h = 1; h <= n_harm; h += 2) {
    double sine = sin(h * p) / h, cosine = (1 - cos(h * p)) / h;
    double even = 0.5 * ((h == 1 ? p : sin((h - 1) * p) / (h - 1)) + sin((h + 1) * p) / (h + 1));
    double odd = 0.5 * ((h == 1 ? 0 : (1 - cos((h - 1) * p)) / (h - 1)) + (1 - cos((h + 1) * p)) / (h + 1));
    F[2 * h - 1] = 2 / PI * ((f - r) * sine + r * even + f * sine);
    F[2 * h] = 2 / PI * ((f - r) * cosine + r * odd - f * (cos(h * p) + 1) / h);
  }
}

static void check_series(int n, const double *F, const double *expected, double tol, const char *what)
{
  for (int i = 0; i < n; ++i) CHECK_NEAR(F[i], expected[i], tol, "%s, coefficient %d", what, i);
}

static void closed_forms_themselves(CHECK_STATE)
{
  double F[7];
  spring_series(1, 1, -0.37, 3, F);
  CHECK_NEAR(F[0], 0.155357649636024, 1e-15, "theory.md, 11");
  CHECK_NEAR(F[1], 0.269941284761418, 1e-15, "theory.md, 11");
  jenkins_series(1, 0.4, 1, 3, F);
  CHECK_NEAR(F[1], 0.373530039052331, 1e-15, "theory.md, 11");
  CHECK_NEAR(F[2], -0.305577490736439, 1e-15, "theory.md, 11");
  CHECK_NEAR(F[5], 0.0399204762231642, 1e-15, "theory.md, 11");
  CHECK_NEAR(F[6], 0.093710430492508, 1e-15, "theory.md, 11");
}

/* 1e-13 of k A: some eps for each of up to 50 terms. */
static void unilateral_spring(CHECK_STATE)
{
  static const double gaps[] = {-2,     -1 - 1e-9, -1,        -1 + 1e-15, -1 + 1e-12, -1 + 1e-9, -1 + 1e-6,
                                -0.999, -0.5,      -0.37,     -1e-9,      0,          1e-9,      0.37,
                                0.999,  1 - 1e-9,  1 - 1e-12, 1 - 1e-15,  1,          1 + 1e-9,  2};
  static const int orders[] = {1, 2, 3, 5, 10, 20, 50};
  static evaluation e;
  double X[101], expected[101], turned[101];
  uint64_t seed = 3;
  for (int o = 0; o < 7; ++o)
    for (size_t i = 0; i < sizeof gaps / sizeof *gaps; ++i)
      for (int trial = 0; trial < 4; ++trial) {
        int H = orders[o], n = series_length(H);
        double k = pow(10, 3 * random_signed(&seed)), A = pow(10, 3 * random_signed(&seed)),
               shift = trial ? PI * random_signed(&seed) : 0;
        moving_contact c = contact_at((contact){trial == 3 ? 0 : 7, k, trial == 2 ? 0 : 0.3, gaps[i] * A}, 90);
        memset(X, 0, sizeof X);
        X[1] = A;
        spring_series(k, A, c.law.gap, H, expected);
        expected[0] -= contact_preload(&c.law);
        shift_motion(H, expected, shift, turned);
        shift_motion(H, X, shift, expected);
        evaluate(H, 1, 1, &c, expected, &e, NULL);
        check_series(n, e.F, turned, 1e-13 * k * A, "unilateral spring");
        contact_regime regime = gaps[i] < -1 - 1e-10  ? CONTACT_LINEAR
                                : gaps[i] > 1 + 1e-10 ? CONTACT_STUCK
                                                      : CONTACT_SEPARATES;
        if (fabs(fabs(gaps[i]) - 1) > 1e-13 && trial < 2 && gaps[i] < 1) assert_int_equal(e.report.regime, regime);
      }
}

/* Angle 0: constant normal force, limit f = mu kn gap. The mean of x does nothing. */
static void jenkins_element(CHECK_STATE)
{
  static const double ratios[] = {1e-6, 1e-3, 0.1, 0.4, 0.5, 0.9, 0.999, 1 - 1e-6, 1 - 1e-9, 1 - 1e-12};
  static const int orders[] = {1, 3, 5, 10, 50};
  static evaluation e;
  double X[101], expected[101], turned[101];
  uint64_t seed = 4;
  for (int o = 0; o < 5; ++o)
    for (int i = 0; i < 10; ++i)
      for (int trial = 0; trial < 4; ++trial) {
        int H = orders[o], n = series_length(H);
        double k = pow(10, 2 * random_signed(&seed)), A = pow(10, 2 * random_signed(&seed)), f = ratios[i] * k * A,
               shift = trial ? PI * random_signed(&seed) : 0;
        contact law = {k, 3, 0.3, f / 0.9};
        f = law.mu * law.kn * law.gap;
        moving_contact c = contact_at(law, 0);
        memset(X, 0, sizeof X);
        X[1] = A;
        X[0] = trial == 3 ? 0.7 * A : 0;
        jenkins_series(k, f, A, H, expected);
        shift_motion(H, expected, shift, turned);
        shift_motion(H, X, shift, expected);
        evaluate(H, 1, 1, &c, expected, &e, NULL);
        check_series(n, e.F, turned, 1e-13 * k * A, "Jenkins");
        double loss = PI * (expected[2] * e.F[1] - expected[1] * e.F[2]); /* of the integral of F dx over a period */
        CHECK_NEAR(loss, 4 * f * (A - f / k), 1e-12 * k * A * A, "loss per cycle, f/kA=%g", ratios[i]);
        assert_int_equal(e.report.regime, CONTACT_SLIPS);
      }
}

/* kt cos <= mu kn sin, and separating: exactly bilinear, for any motion. Equality included, as it comes out of
 * rounding, one ulp to either side. The other side of the comparison is one contact at 90 degrees, which has been
 * compared with its closed form. */
static void never_slipping_is_bilinear(CHECK_STATE)
{
  static evaluation e, spring;
  double X[101];
  uint64_t seed = 6;
  int checked = 0;
  for (int trial = 0; trial < 400; ++trial) {
    int H = 1 + trial % 50, n = series_length(H);
    double angle = trial % 4 ? 45 + 44 * random_signed(&seed) : 45;
    contact law = {0, pow(10, 2 * random_signed(&seed)), 0.5 + 0.4 * random_signed(&seed), 0};
    moving_contact c = contact_at(law, angle);
    double equal = law.mu * law.kn * c.cv[0] / c.cu[0];
    c.law.kt = trial % 5 == 0   ? equal
               : trial % 5 == 1 ? nextafter(equal, 0)
               : trial % 5 == 2 ? nextafter(equal, INFINITY)
                                : equal * (0.5 + 0.5 * random_signed(&seed));
    random_motion(&seed, H, 1, 1 + trial % 3 * 0.5, X);
    double high, low;
    series_extrema(H, X, &high, &low);
    c.law.gap = -c.cv[0] * (low + (0.03 + 0.95 * fabs(random_signed(&seed))) * (high - low));
    double k = c.law.kt * c.cu[0] * c.cu[0] + c.law.kn * c.cv[0] * c.cv[0];
    moving_contact whole = contact_at((contact){0, k, 0, c.law.gap / c.cv[0]}, 90);
    evaluate(H, 1, 1, &c, X, &e, NULL);
    evaluate(H, 1, 1, &whole, X, &spring, NULL);
    spring.F[0] += contact_preload(&whole.law) - c.cv[0] * contact_preload(&c.law);
    check_series(n, e.F, spring.F, exact_rounding(H, 1, &c, X) + exact_rounding(H, 1, &whole, X), "bilinear");
    for (int i = 0; i < e.n_intervals[0]; ++i) {
      bool slips = contact_slip_sign(e.interval[i].state) != 0;
      if (slips && trial % 5 > 2) fail_msg("trial %d: slips", trial);
    }
    ++checked;
  }
  assert_int_equal(checked, 400);
}

/* Stuck for good while |T| <= mu N everywhere from w = 0: F = kt c u + kn s v, X times a number. Apart for good: 0.
 * Nothing to push: 0. */
static void stuck_apart_and_degenerate(CHECK_STATE)
{
  static evaluation e, other;
  double X[101], expected[101];
  uint64_t seed = 8;
  for (int trial = 0; trial < 200; ++trial) {
    int H = 1 + trial % 50, n = series_length(H);
    double angle = 45 + 44 * random_signed(&seed);
    moving_contact c = contact_at((contact){3, 5, 0.3, 1}, angle);
    random_motion(&seed, H, 1, 1, X);
    double size = sum_abs(n, X), room = 0.3 * 5 / (3 * c.cu[0] + 0.3 * 5 * c.cv[0]); /* kt c x <= mu kn (gap - s x) */
    for (int i = 0; i < n; ++i) X[i] *= 0.999 * room / size;
    double tol = exact_rounding(H, 1, &c, X);
    evaluate(H, 1, 1, &c, X, &e, NULL);
    for (int i = 0; i < n; ++i) expected[i] = (3 * c.cu[0] * c.cu[0] + 5 * c.cv[0] * c.cv[0]) * X[i];
    check_series(n, e.F, expected, tol, "stuck");
    assert_int_equal(e.report.regime, CONTACT_STUCK);
    memset(expected, 0, sizeof expected);
    moving_contact apart = c, soft = contact_at((contact){3, 0, 0.3, 1}, angle),
                   beside = contact_at((contact){3, 5, 0.3, -0.01}, 0), flush = contact_at((contact){3, 5, 0.3, 0}, 0);
    apart.law.gap = -c.cv[0] * room;
    const moving_contact *const nothing[] = {&apart, &soft, &beside, &flush};
    for (int i = 0; i < 4; ++i) {
      evaluate(H, 1, 1, nothing[i], X, &e, NULL);
      check_series(n, e.F, expected, 0, "nothing to push");
      assert_int_equal(e.report.regime, CONTACT_LINEAR);
    }
    /* no friction by mu = 0, by kt = 0, or both; gap 0 now and then: the normal force alone */
    random_motion(&seed, H, 1, 1, X);
    double gap = trial % 3 ? 0.5 * random_signed(&seed) : 0;
    moving_contact smooth = contact_at((contact){3, 5, 0, gap}, angle),
                   loose = contact_at((contact){0, 5, 0.3, gap}, angle);
    moving_contact normal = contact_at((contact){0, 5 * c.cv[0] * c.cv[0], 0, gap / c.cv[0]}, 90);
    evaluate(H, 1, 1, &normal, X, &other, NULL);
    evaluate(H, 1, 1, &smooth, X, &e, NULL);
    check_series(n, e.F, other.F, 2 * exact_rounding(H, 1, &c, X), "mu = 0");
    evaluate(H, 1, 1, &loose, X, &e, NULL);
    check_series(n, e.F, other.F, 2 * exact_rounding(H, 1, &c, X), "kt = 0");
  }
}

/* Never separating, one slider that never stops for good: w depends on where the history began, F with it. Not
 * compared under shifts. */
static bool stuck_for_good(const evaluation *e)
{
  return e->n_intervals[0] == 1 && e->interval[0].state == CONTACT_STICK && e->report.regime == CONTACT_STUCK;
}

/* Sum of contacts; a shift in time; a scale of lengths (bit for bit if it is a power of two). 1 and 2 coordinates. */
static void symmetries(CHECK_STATE)
{
  static evaluation e, one, moved;
  static double X[EXACT_MAX_COEF], Y[EXACT_MAX_COEF], sum[EXACT_MAX_COEF], turned[EXACT_MAX_COEF];
  uint64_t seed = 10;
  int shifted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    int H = 1 + trial % 50, n = series_length(H), D = 1 + trial / 50 % 2;
    moving_contact c[3];
    double tol = 0;
    for (int d = 0; d < D; ++d) random_motion(&seed, H, 1, 1 + trial % 3 * 0.5, X + d * n);
    memset(sum, 0, sizeof sum);
    for (int j = 0; j < 3; ++j) {
      c[j] = random_contact(&seed, D);
      tol += exact_rounding(H, D, &c[j], X);
      evaluate(H, D, 1, &c[j], X, &one, NULL);
      for (int i = 0; i < D * n; ++i) sum[i] += one.F[i];
    }
    evaluate(H, D, 3, c, X, &e, NULL);
    check_series(D * n, e.F, sum, tol, "sum of contacts");

    tol = 4 * exact_rounding(H, D, &c[0], X);
    evaluate(H, D, 1, c, X, &one, NULL);
    double shift = trial % 5 ? PI * random_signed(&seed) : PI / 16 * (trial % 32);
    for (int d = 0; d < D; ++d) {
      shift_motion(H, X + d * n, shift, Y + d * n);
      shift_motion(H, one.F + d * n, shift, turned + d * n);
    }
    evaluate(H, D, 1, c, Y, &moved, NULL);
    if (!stuck_for_good(&one) && !stuck_for_good(&moved)) {
      char what[80];
      snprintf(what, sizeof what, "shift %.17g, trial %d, H=%d", shift, trial, H);
      check_series(D * n, moved.F, turned, tol, what);
      ++shifted;
    }

    double scale = trial % 2 ? ldexp(1, (int)(40 * random_signed(&seed))) : pow(10, 6 * random_signed(&seed));
    moving_contact scaled = c[0];
    scaled.law.gap *= scale;
    for (int i = 0; i < D * n; ++i) {
      Y[i] = scale * X[i];
      turned[i] = scale * one.F[i];
    }
    evaluate(H, D, 1, &scaled, Y, &moved, NULL);
    check_series(D * n, moved.F, turned, trial % 2 ? 0 : scale * tol, "scale");
  }
  print_message("%d of 300 shifted\n", shifted);
  assert_true(shifted > 200);
}

/* The intervals and the report belong together: ascending, apart or touching, each at least as long as nothing;
 * regimes by what the intervals are. A contact with a preload no motion lifts never separates, however many
 * intervals its period has. */
static void intervals_and_report(CHECK_STATE)
{
  static evaluation e;
  static double X[EXACT_MAX_COEF];
  uint64_t seed = 12;
  int most = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    int H = 1 + trial % 50, n = series_length(H), D = 1 + trial / 50 % 2;
    moving_contact c = random_contact(&seed, D);
    for (int d = 0; d < D; ++d) random_motion(&seed, H, 1, trial % 4 * 0.5, X + d * n);
    static contact_motion m;
    contact_motion_of(H, D, &c, X, &m);
    bool closed = trial % 3 == 0;
    if (closed) {
      c.law.gap = 1.001 * m.V[0] + 0.1;
      c.law.mu *= 0.1;
    }
    evaluate(H, D, 1, &c, X, &e, NULL);
    bool slips = false, gaps = false;
    int changes = 0, last = e.n_intervals[0] - 1;
    for (int i = 0; i < e.n_intervals[0]; ++i) {
      const contact_interval *p = &e.interval[i];
      assert_true(p->from < p->to && p->to <= e.interval[0].from + 2 * PI + 1e-12 && p->state != CONTACT_SEPARATED);
      if (i) assert_true(p->from >= p[-1].to);
      for (int turn = -1; turn <= 1 && p->to - p->from > 1e-9; ++turn)
        assert_ptr_equal(contact_interval_at(last + 1, e.interval, 0.5 * (p->from + p->to) + turn * 2 * PI), p);
      slips |= contact_slip_sign(p->state) != 0;
      gaps |= i && p->from > p[-1].to;
      if (i) changes += p->from > p[-1].to ? 2 : p->state != p[-1].state; /* separated in between: two */
    }
    most = e.n_intervals[0] > most ? e.n_intervals[0] : most;
    /* round the period's end */
    if (last >= 0) changes += e.report.regime == CONTACT_SEPARATES ? 2 : e.interval[0].state != e.interval[last].state;
    assert_int_equal(e.report.transitions, changes);
    if (closed) {
      if (e.report.regime != (slips && c.law.mu * c.law.kt > 0 ? CONTACT_SLIPS : CONTACT_STUCK) &&
          c.law.mu * c.law.kt > 0)
        fail_msg("trial %d, %d intervals, closed: %s", trial, e.n_intervals[0], contact_regime_name(e.report.regime));
      assert_false(gaps);
      assert_true(e.interval[0].from == 0 && e.interval[e.n_intervals[0] - 1].to == 2 * PI);
    } else if (gaps) {
      assert_int_equal(e.report.regime, CONTACT_SEPARATES);
    }
  }
  print_message("up to %d intervals\n", most);
}

/* aft_eval tends to it like 1/N^2 (bound: exact_scenes.h), for random contacts and motions of one coordinate. */
static void sampling_tends_to_it(CHECK_STATE)
{
  static evaluation e;
  double X[101], F[101];
  uint64_t seed = 14;
  double orders = 0;
  int n_orders = 0;
  for (int trial = 0; trial < 120; ++trial) {
    int H = 1 + (trial * 7) % 50, n = series_length(H);
    static const double angles[] = {0, 30, 45, 90, 80, 5};
    const moving_contact c = contact_at(random_law(&seed), angles[trial % 6]);
    random_motion(&seed, H, 1, 1 + trial % 3, X);
    evaluate(H, 1, 1, &c, X, &e, NULL);
    double error[17] = {0};
    for (int p = 10; p <= 16; p += 3) {
      double w;
      sampled(H, 1, &c, X, 1 << p, F, &w);
      for (int i = 0; i < n; ++i) error[p] = larger(error[p], fabs(F[i] - e.F[i]));
      CHECK_LE(error[p], sampled_error(H, 1, &c, X, 1 << p, &e), "trial %d H=%d N=2^%d kt=%g kn=%g mu=%g gap=%g", trial,
               H, p, c.law.kt, c.law.kn, c.law.mu, c.law.gap);
    }
    if (error[13] > 100 * exact_rounding(H, 1, &c, X)) {
      orders += log2(error[10] / error[13]) / 3;
      ++n_orders;
    }
  }
  print_message("order %.3f over %d motions\n", orders / n_orders, n_orders);
  assert_true(n_orders > 30);
  CHECK_NEAR(orders / n_orders, 2, 0.15, "mean order of %d", n_orders);
}

/* The same for independent u and v, and for motions that graze: touching by so little,
 * leaving by so little, slipping by so little. The slider at th = 0 is compared where it is stuck, and known: a
 * sample's distance of its rate, as the touch may be missed. */
static void independent_u_and_v(CHECK_STATE)
{
  static evaluation e;
  static double X[EXACT_MAX_COEF], F[EXACT_MAX_COEF];
  static const double depths[] = {1e-2, 1e-4, 1e-6, 1e-9, 1e-12, 0, -1e-12, -1e-9, -1e-6, -1e-4, -1e-2};
  uint64_t seed = 16;
  double worst = 0;
  for (int trial = 0; trial < 110; ++trial) {
    int H = trial % 5 ? 1 + (trial * 3) % 12 : 20 + trial % 31, n = series_length(H), D = 1 + trial % 2,
        kind = trial / 2 % 4;
    moving_contact c = random_contact(&seed, D);
    if (D == 1 && kind == 2) c = contact_at(c.law, 0);
    for (int d = 0; d < D; ++d) random_motion(&seed, H, 1, 1 + trial % 3 * 0.5, X + d * n);
    if (D == 2 && kind == 2) memset(X + n, 0, (size_t)n * sizeof *X);
    static contact_motion m;
    contact_motion_of(H, D, &c, X, &m);
    double depth = depths[trial % 11];
    if (kind < 3 && !(D == 1 && kind < 2 && c.cv[0] == 0)) make_graze(&c, &m, H, kind, depth);
    int n_time = trial % 22 ? 1 << 13 : 1 << 18;
    double w = NAN, bound;
    evaluate(H, D, 1, &c, X, &e, NULL);
    sampled(H, D, &c, X, n_time, F, &w);
    if (kind == 2 && depth <= 0) continue; /* stuck for good or at its very limit: w from the history */
    bound = sampled_error(H, D, &c, X, n_time, &e);
    for (int i = 0; i < D * n; ++i) {
      worst = fmax(worst, fabs(F[i] - e.F[i]) / bound);
      CHECK_NEAR(F[i], e.F[i], bound,
                 "trial %d H=%d dofs=%d kind %d depth %g N=%d kt=%g kn=%g mu=%g gap=%g, coefficient %d", trial, H, D,
                 kind, depth, n_time, c.law.kt, c.law.kn, c.law.mu, c.law.gap, i);
    }
    double rate = 2 * PI / n_time * (m.U[1] + (c.law.kt > 0 ? c.law.mu * c.law.kn / c.law.kt : 0) * m.V[1]);
    bool known = c.law.kt > 0 && !stuck_for_good(&e);
    if (known) CHECK_NEAR(e.w[0], w, 4 * rate, "slider, trial %d, H=%d kind %d depth %g", trial, H, kind, depth);
  }
  print_message("worst %.2g of the bound\n", worst);
}

/* Lifting off by rounding: T, N and their rates are 0 together at one angle, and every guard is rounding there. Also
 * a tangential spring so stiff that stick lasts no longer than rounding. The force is found, and is that of a
 * lift-off 1e-7 higher, but for what that changes: a contact time of sqrt(1e-7) at most. */
static void lift_off_by_rounding(CHECK_STATE)
{
  static evaluation e, above;
  static double X[EXACT_MAX_COEF];
  static const double depths[] = {0, 1e-16, -1e-16, 1e-15, -1e-15, 1e-14, -1e-14, 1e-13, -1e-13, 1e-12, -1e-12};
  uint64_t seed = 18;
  for (int trial = 0; trial < 11000; ++trial) {
    int H = 1 + trial % 7 * (trial % 7), n = series_length(H), D = 1 + trial / 11 % 2;
    moving_contact c = random_contact(&seed, D);
    for (int d = 0; d < D; ++d) random_motion(&seed, H, 1, trial % 5 * 0.75, X + d * n);
    if (trial % 10 == 9) {
      c.law.kt = 1e12;
      evaluate(H, D, 1, &c, X, &e, NULL); /* HC_OK is all */
      continue;
    }
    static contact_motion m;
    contact_motion_of(H, D, &c, X, &m);
    make_graze(&c, &m, H, 1, depths[trial % 11]);
    evaluate(H, D, 1, &c, X, &e, NULL);
    make_graze(&c, &m, H, 1, -1e-7);
    evaluate(H, D, 1, &c, X, &above, NULL);
    for (int i = 0; i < D * n; ++i)
      CHECK_NEAR(e.F[i], above.F[i], sqrt(1e-7) * force_size(&c, &m, 1), "trial %d H=%d dofs=%d depth %g", trial, H, D,
                 depths[trial % 11]);
  }
}

/* Bad input and odd sizes. */
static void refusals(CHECK_STATE)
{
  exact_force *e;
  moving_contact c = contact_at((contact){1, 1, 0.3, 0}, 45);
  assert_int_equal(exact_force_new(0, 1, 1, &c, &e), HC_BAD_INPUT);
  assert_int_equal(exact_force_new(HBM_MAX_HARMONICS + 1, 1, 1, &c, &e), HC_BAD_INPUT);
  assert_int_equal(exact_force_new(3, 0, 1, &c, &e), HC_BAD_INPUT);
  assert_int_equal(exact_force_new(3, SERIES_MAX_DIM + 1, 1, &c, &e), HC_BAD_INPUT);
  assert_int_equal(exact_force_new(3, 1, -1, &c, &e), HC_BAD_INPUT);
  exact_force_free(NULL);
  static const double bad[] = {NAN, INFINITY, -INFINITY};
  assert_int_equal(exact_force_new(3, 1, 1, &c, &e), HC_OK);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 7; ++k) {
      double X[7] = {1, 2, 3, 0, 0, 0, 0}, F[7], J[49];
      X[k] = bad[i];
      assert_int_equal(exact_force_eval(e, X, F, J, NULL), HC_NOT_FINITE);
    }
  double zero[7] = {0}, F[7] = {1, 1, 1, 1, 1, 1, 1}, J[49];
  assert_int_equal(exact_force_eval(e, zero, F, J, NULL), HC_OK);
  for (int i = 0; i < 7; ++i) assert_true(F[i] == 0);
  exact_force_free(e);
  assert_int_equal(exact_force_new(3, 1, 0, NULL, &e), HC_OK);
  CHECK_FILLED(contact_report, report, exact_force_eval(e, zero, F, J, &report));
  assert_int_equal(report.regime, CONTACT_LINEAR);
  exact_force_free(e);
}

CHECK_TESTS("hbm.exact", 120, closed_forms_themselves, unilateral_spring, jenkins_element, never_slipping_is_bilinear,
            stuck_apart_and_degenerate, symmetries, intervals_and_report, sampling_tends_to_it, independent_u_and_v,
            lift_off_by_rounding, refusals)
