/* test_exact_jacobian.c - dF/dX of event-located forces against differences of F, for one and two coordinates. While
 * the order of states stays what it is F is smooth in X, and central differences D of steps h, 2h, 4h, extrapolated
 * twice, are good to h^6. Where it changes between the outermost points F is once differentiable at best, and such
 * columns are left out, as are those where the two extrapolations disagree (a derivative near 0 at some transition
 * makes high derivatives large); fewer than 5 % are, which is asserted: the random motions are the same in every run.
 * Across a change of states, dF/dX is checked to be continuous. */
#include "tests/hbm/exact_scenes.h"

static const double STEP = 1e-4;

static bool same_states(const evaluation *a, const evaluation *b)
{
  if (a->n_intervals[0] != b->n_intervals[0] || a->report.regime != b->report.regime) return false;
  for (int i = 0; i < a->n_intervals[0]; ++i) {
    if (a->interval[i].state != b->interval[i].state) return false;
    bool touches = i && a->interval[i].from > a->interval[i - 1].to,
         touched = i && b->interval[i].from > b->interval[i - 1].to;
    if (touches != touched) return false;
  }
  return true;
}

/* Derivative of F along V, and how far its two extrapolations are apart; false if states change. */
static bool differences(int n_harm, int n_dof, const moving_contact *c, const double *X, const double *V,
                        const evaluation *at, double *S, double *apart)
{
  static evaluation plus, minus;
  static double D[3][EXACT_MAX_COEF], Y[EXACT_MAX_COEF];
  int m = n_dof * series_length(n_harm);
  for (int k = 0; k < 3; ++k) {
    double h = ldexp(STEP, k);
    for (int i = 0; i < m; ++i) Y[i] = X[i] + h * V[i];
    evaluate(n_harm, n_dof, 1, c, Y, &plus, NULL);
    for (int i = 0; i < m; ++i) Y[i] = X[i] - h * V[i];
    evaluate(n_harm, n_dof, 1, c, Y, &minus, NULL);
    if (!same_states(at, &plus) || !same_states(at, &minus)) return false;
    for (int i = 0; i < m; ++i) D[k][i] = (plus.F[i] - minus.F[i]) / (2 * h);
  }
  *apart = 0;
  for (int i = 0; i < m; ++i) {
    double fine = (4 * D[0][i] - D[1][i]) / 3, coarse = (4 * D[1][i] - D[2][i]) / 3;
    S[i] = (16 * fine - coarse) / 15;
    *apart = fmax(*apart, fabs(fine - coarse));
  }
  return true;
}

typedef struct tally {
  int compared, changed, disagree;
  double worst;
} tally;

/* J against differences along columns and two random directions. Tolerance: 1e-9 of the contact's stiffness, and
 * rounding of F over the step. */
static void check_jacobian(uint64_t *seed, int H, int n_dof, const moving_contact *c, const double *X, const char *what,
                           tally *count)
{
  static evaluation e;
  static double jac[EXACT_MAX_COEF * EXACT_MAX_COEF], V[EXACT_MAX_COEF], S[EXACT_MAX_COEF];
  int m = n_dof * series_length(H), columns = m < 12 ? m : 8;
  evaluate(H, n_dof, 1, c, X, &e, jac);
  const double scale = c->law.kt + c->law.kn;
  double apart, rounding = 3 * exact_rounding(H, n_dof, c, X) / STEP;
  for (int k = 0; k < columns + 2; ++k) {
    int column = columns == m ? k : (int)((0.5 + 0.4999 * random_signed(seed)) * m);
    for (int i = 0; i < m; ++i) V[i] = k < columns ? i == column : random_signed(seed) / (1 + i / n_dof);
    if (!differences(H, n_dof, c, X, V, &e, S, &apart)) {
      ++count->changed;
      continue;
    }
    if (!(apart <= 15e-9 * scale + rounding)) {
      ++count->disagree;
      continue;
    }
    ++count->compared;
    for (int i = 0; i < m; ++i) {
      double J = 0;
      for (int q = 0; q < m; ++q) J += jac[i + (size_t)m * q] * V[q];
      count->worst = fmax(count->worst, fabs(J - S[i]) / (1e-9 * scale + rounding));
      CHECK_NEAR(J, S[i], 1e-9 * scale + rounding, "%s H=%d dofs=%d, kt=%g kn=%g mu=%g gap=%g, direction %d, row %d",
                 what, H, n_dof, c->law.kt, c->law.kn, c->law.mu, c->law.gap, k < columns ? column : -1, i);
    }
  }
}

static void check_tally(const tally *t)
{
  const int all = t->compared + t->changed + t->disagree;
  print_message("%d directions, %d with changing states, %d too curved; worst %.2g of the tolerance\n", all, t->changed,
                t->disagree, t->worst);
  assert_true(t->compared > 0);
  CHECK_LE(t->changed, 0.02 * all, "directions left out");
  CHECK_LE(t->disagree, 0.03 * all, "directions left out");
}

static void random_motions(CHECK_STATE)
{
  static const int orders[] = {1, 2, 3, 5, 10, 20, 50};
  static double X[EXACT_MAX_COEF];
  uint64_t seed = 30;
  tally count = {0, 0, 0, 0};
  for (int o = 0; o < 7; ++o)
    for (int trial = 0; trial < (orders[o] < 20 ? 60 : 10); ++trial) {
      int H = orders[o], n = series_length(H), D = 1 + trial % 2;
      moving_contact c = random_contact(&seed, D);
      for (int d = 0; d < D; ++d) random_motion(&seed, H, 1, 1.5 + trial % 3 * 0.5, X + d * n);
      if (trial % 4 == 0) c.law.gap = fabs(c.law.gap) + 1.5; /* mostly never separates: sliders remember a period */
      char what[64];
      snprintf(what, sizeof what, "trial %d", trial);
      check_jacobian(&seed, H, D, &c, X, what, &count);
    }
  check_tally(&count);
}

/* Touching, leaving or slipping by so little that the step must be small against it: 50 steps deep and more. */
static void grazing_motions(CHECK_STATE)
{
  static const double depths[] = {0.05, 0.02, 0.01, -0.01, -0.02, -0.05};
  static double X[EXACT_MAX_COEF];
  uint64_t seed = 31;
  tally count = {0, 0, 0, 0};
  for (int trial = 0; trial < 180; ++trial) {
    int H = 1 + trial % 5 * (trial % 5), n = series_length(H), D = 1 + trial % 2, kind = trial / 2 % 3;
    moving_contact c = random_contact(&seed, D);
    if (D == 1 && c.cv[0] == 0 && kind < 2) continue;
    if (D == 1 && kind == 2) c = contact_at(c.law, 0);
    for (int d = 0; d < D; ++d) random_motion(&seed, H, 1, 2, X + d * n);
    if (D == 2 && kind == 2) memset(X + n, 0, (size_t)n * sizeof *X);
    static contact_motion m;
    contact_motion_of(H, D, &c, X, &m);
    make_graze(&c, &m, H, kind, depths[trial % 6]);
    char what[64];
    snprintf(what, sizeof what, "trial %d kind %d depth %g", trial, kind, depths[trial % 6]);
    check_jacobian(&seed, H, D, &c, X, what, &count);
  }
  check_tally(&count);
}

/* Passing the onset of contact (kind 0, from apart) or of separation (kind 1, kt = 0, from always touching) F is
 * once differentiable: at a depth d of cos th, whose f'' is 1, there is one interval more of width 2 sqrt(2 d), in
 * which T' and N' are at most (kt + (1 + mu) kn) and a slider's memory is as much again: 1/pi of it times the width,
 * doubled by harmonics' 2/2pi, held with a factor of 2. No jump and no NaN, down to rounding and beyond. The onset
 * of slip is not like that: dissipation 4 f (A - f/k) starts with a kink, and the mean of u no longer counts. */
static void onsets_are_smooth(CHECK_STATE)
{
  static evaluation e;
  static double before[EXACT_MAX_COEF * EXACT_MAX_COEF], jac[EXACT_MAX_COEF * EXACT_MAX_COEF], X[EXACT_MAX_COEF];
  static const int orders[] = {1, 3, 10, 50};
  static const double depths[] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15, 1e-16, 0};
  X[1] = 1;
  for (int o = 0; o < 4; ++o)
    for (int kind = 0; kind < 2; ++kind)
      for (int sticky = 0; sticky <= 1; ++sticky)
        for (int d = 0; d < 9; ++d)
          for (int sign = -1; sign <= 1; sign += 2) {
            int H = orders[o], n = series_length(H);
            moving_contact c = {{kind ? 0 : 3, 5, sticky ? 3 : 0.3, 0}, {0.6, 0}, {0.8, 0}};
            static contact_motion m;
            contact_motion_of(H, 1, &c, X, &m);
            make_graze(&c, &m, H, kind, kind ? 0.01 : -0.01);
            evaluate(H, 1, 1, &c, X, &e, before);
            make_graze(&c, &m, H, kind, sign * depths[d]);
            evaluate(H, 1, 1, &c, X, &e, jac);
            double width = 2 * sqrt(2 * (depths[d] + 1e-14) / 0.8),
                   stiffness = 2 * (c.law.kt + (1 + c.law.mu) * c.law.kn);
            for (int i = 0; i < n * n; ++i)
              CHECK_NEAR(jac[i], before[i], 2 / PI * stiffness * width, "kind %d mu=%g H=%d depth %g, entry %d", kind,
                         c.law.mu, H, sign * depths[d], i);
          }
}

/* Contacts add up, and the Jacobian does not depend on whether the report or it is asked for. */
static void several_contacts(CHECK_STATE)
{
  static evaluation e, one;
  static double X[EXACT_MAX_COEF], jac[EXACT_MAX_COEF * EXACT_MAX_COEF], sum[EXACT_MAX_COEF * EXACT_MAX_COEF];
  uint64_t seed = 33;
  for (int trial = 0; trial < 60; ++trial) {
    int H = 1 + trial % 20, n = series_length(H), D = 1 + trial % 2, m = D * n;
    moving_contact c[4];
    double tol = 0;
    for (int d = 0; d < D; ++d) random_motion(&seed, H, 1, 1, X + d * n);
    memset(sum, 0, sizeof sum);
    for (int j = 0; j < 4; ++j) {
      c[j] = random_contact(&seed, D);
      evaluate(H, D, 1, &c[j], X, &one, jac);
      for (int i = 0; i < m * m; ++i) sum[i] += jac[i];
      /* entries by size: stiffness, with a slider's rate kt (cu + |u'/v'| cv) instead, bounded by its own largest
       * entry */
      for (int i = 0; i < m * m; ++i) tol = fmax(tol, 1e-13 * fabs(jac[i]));
    }
    evaluate(H, D, 4, c, X, &e, jac);
    for (int i = 0; i < m * m; ++i) CHECK_NEAR(jac[i], sum[i], tol, "trial %d, H=%d, entry %d", trial, H, i);
    evaluate(H, D, 4, c, X, &one, NULL);
    for (int i = 0; i < m; ++i) assert_true(e.F[i] == one.F[i]);
  }
}

CHECK_TESTS("hbm.exact_jacobian", 120, random_motions, grazing_motions, onsets_are_smooth, several_contacts)
