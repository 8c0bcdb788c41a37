/* circles.c - a benchmark, not a test: what one evaluation of a contact with two tangents under the law of the circle
 * costs, located, with its Jacobian, against the located one of one tangent with the same kind of motion.
 * usage: bench_circles [H] [ROUNDS]   (default 5 and 15)
 * Motions are random, the h-th harmonic of size 1/h or 1/h^2, 64 of each kind: both contacts in the same regime, under
 * the same law, with the same u_1 and v. Kinds: stuck from the first pass, slips, separates. All kinds are timed in
 * turn, ROUNDS times; a time is the least of processor time, a ratio that of one round's two, its median. */
#include "hbm/contact/exact_force.h"
#include "hbm/planar/planar_force.h"
#include "tests/bench/bench.h"
#include "tests/random.h"

enum { MOTIONS = 64, KINDS = 3, DECAYS = 2, MOST_H = 25, MAX_COEF = 3 * (2 * MOST_H + 1) };

/* One motion under its law, of both contacts. */
typedef struct pair {
  double X[MAX_COEF], line[MAX_COEF];
  planar_force *circle;
  exact_force *one;
} pair;

typedef struct kind {
  const char *name;
  contact_regime regime;
  int n;
  pair *scene; /* [MOTIONS] */
  double us[2][BENCH_MOST_ROUNDS], ratio[BENCH_MOST_ROUNDS];
  int pieces, panels;
} kind;

static kind kinds[DECAYS][KINDS];
static double F[MAX_COEF], jac[MAX_COEF * MAX_COEF], sink;
static int H = 5, rounds = 15;

static void random_series(uint64_t *seed, double decay, double *X)
{
  X[0] = 0.5 * random_signed(seed);
  for (int h = 1; h <= H; ++h)
    for (int k = 2 * h - 1; k <= 2 * h; ++k) X[k] = random_signed(seed) * pow(h, -decay);
}

static void drop(pair *s)
{
  planar_force_free(s->circle);
  exact_force_free(s->one);
}

static contact_regime evaluate(pair *s, bool circle)
{
  contact_report report;
  must(circle ? planar_force_eval(s->circle, s->X, F, jac, &report)
              : exact_force_eval(s->one, s->line, F, jac, &report),
       "bench_circles");
  sink += F[0] + jac[0];
  return report.regime;
}

static void keep(kind *k, const pair *s)
{
  const planar_cycle *c = planar_force_cycle(s->circle);
  k->scene[k->n++] = *s;
  k->pieces += c->n;
  k->panels += c->slip.n;
}

static void fill_kinds(double decay, kind *k)
{
  const size_t L = (size_t)series_length(H);
  uint64_t seed = 7;
  for (int missing = KINDS * MOTIONS; missing > 0;) {
    pair s;
    const double size = pow(10, random_signed(&seed));
    const contact law = (contact){
        .kt = size, .kn = size * pow(10, 0.7 * random_signed(&seed)), .mu = 0.4, .gap = 3 * random_signed(&seed)};
    for (size_t d = 0; d < 3; ++d) random_series(&seed, decay, s.X + d * L);
    memcpy(s.line, s.X, L * sizeof *s.X);
    memcpy(s.line + L, s.X + 2 * L, L * sizeof *s.X);
    const contact half = {law.kt, law.kn / 2, 2 * law.mu, law.gap, law.load / 2};
    const moving_contact on_line = {.law = law, .cu = {1, 0}, .cv = {0, 1}};
    must(planar_force_new(H, 3, &half, &s.circle), "bench_circles");
    must(exact_force_new(H, 2, 1, &on_line, &s.one), "bench_circles");
    const contact_regime regime = evaluate(&s, true);
    bool kept = regime == evaluate(&s, false);
    int i = 0;
    while (i < KINDS && k[i].regime != regime) ++i;
    kept = kept && i < KINDS && k[i].n < MOTIONS;
    if (kept) keep(&k[i], &s), --missing;
    else drop(&s);
  }
}

static double time_all(kind *k, bool circle)
{
  const int repeated = circle ? 4 : 40;
  const double from = cpu_ms();
  for (int r = 0; r < repeated; ++r)
    for (int i = 0; i < MOTIONS; ++i) evaluate(&k->scene[i], circle);
  return 1e3 * (cpu_ms() - from) / (MOTIONS * repeated);
}

int main(int argc, char **argv)
{
  H = count_argument(argc, argv, 1, 5, MOST_H, "[H [ROUNDS]]");
  rounds = count_argument(argc, argv, 2, 15, BENCH_MOST_ROUNDS, "[H [ROUNDS]]");
  const char *const names[KINDS] = {"stuck", "slips", "separates"};
  const contact_regime regimes[KINDS] = {CONTACT_STUCK, CONTACT_SLIPS, CONTACT_SEPARATES};
  for (int d = 0; d < DECAYS; ++d) {
    for (int i = 0; i < KINDS; ++i) {
      kinds[d][i] = (kind){.name = names[i], .regime = regimes[i], .scene = calloc(MOTIONS, sizeof(pair))};
      if (!kinds[d][i].scene) must(HC_NO_MEMORY, "bench_circles");
    }
    fill_kinds(d + 1, kinds[d]);
  }
  for (int r = 0; r < rounds; ++r)
    for (int d = 0; d < DECAYS; ++d)
      for (int i = 0; i < KINDS; ++i) {
        kind *k = &kinds[d][i];
        for (int circle = 0; circle < 2; ++circle) k->us[circle][r] = time_all(k, circle);
        k->ratio[r] = k->us[1][r] / k->us[0][r];
      }
  printf("H = %d, microseconds an evaluation with Jacobian\n", H);
  printf("size   kind         circle  one line   ratio  pieces  panels\n");
  for (int d = 0; d < DECAYS; ++d)
    for (int i = 0; i < KINDS; ++i) {
      printf("1/h^%d  %-9s  %8.2f  %8.2f  %6.1f [%.1f, %.1f]  %5.1f  %6.1f\n", (d + 1), kinds[d][i].name,
             quantile(rounds, kinds[d][i].us[1], 0), quantile(rounds, kinds[d][i].us[0], 0),
             quantile(rounds, kinds[d][i].ratio, 0.5), quantile(rounds, kinds[d][i].ratio, 0.25),
             quantile(rounds, kinds[d][i].ratio, 0.75), (double)kinds[d][i].pieces / MOTIONS,
             (double)kinds[d][i].panels / MOTIONS);
      for (int s = 0; s < MOTIONS; ++s) drop(&kinds[d][i].scene[s]);
      free(kinds[d][i].scene);
    }
  return sink == sink ? 0 : 1;
}
