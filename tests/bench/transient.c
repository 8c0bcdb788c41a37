/* transient.c - a benchmark, not a test: what one steady state by time integration costs, by every way this program
 * has.
 * usage: bench_transient [ROUNDS [CASE]]       (default 5, all) the table of costs, and the periods that two asked
 * figures take
 *        bench_transient start                 x v of case 2's HBM orbit (H = 5) at omega = 9, and its reference
 *                                              amplitude
 *        bench_transient once                  case 2 at omega = 9 from there to 1e-8: "processor seconds,
 *                                              amplitude"
 * c2 at 9 (upper branch), b10 at 7, r2 at 708.5, each from the HBM orbit (H = 5, exact forces), to four accuracies
 * of the amplitude. Errors are relative, against the exact law by shooting at tolerance 1e-13. transient.tolerance
 * is the accuracy asked, or a tenth of it where that misses; the regularisation is the largest of half decades 10^-1
 * .. 10^-8 that meets the accuracy with it, by shooting; where shooting fails, marching gets 0.1 sqrt(accuracy).
 * Ways take turns, ROUNDS times; a time is the median of its rounds [ms
 * of processor], a ratio the median of ratios within a round to the way that is cheapest among those that met the
 * accuracy. The handle is made beforehand: one serves a whole sweep. */
#include "tests/bench/orbits.h"

enum { WAYS = 4, ACCURACIES = 4, CASES = 3, HALF_DECADES = 15 };

typedef struct way {
  const char *name;
  int law, steady;
} way;
static const way ways[WAYS] = {{"exact, shooting", TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_SHOOTING},
                               {"exact, marching", TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_MARCH},
                               {"regularised, shooting", TRANSIENT_LAW_REGULARISED, TRANSIENT_STEADY_SHOOTING},
                               {"regularised, marching", TRANSIENT_LAW_REGULARISED, TRANSIENT_STEADY_MARCH}};
static const double accuracies[ACCURACIES] = {1e-4, 1e-6, 1e-8, 1e-10};

static const double longest_shot = 1e3, longest_march = 3e4; /* [ms] after which a way has failed */

typedef struct bench_case {
  const char *name;
  scene sc;
  double omega;
  scene_state start;
  double amplitude;
} bench_case;

/* One way to one accuracy. */
typedef struct trial {
  scene sc;
  timeint *ti;
  hc_status status;
  timeint_result r;
  double error, ms[BENCH_MOST_ROUNDS];
} trial;

static bool tick(void *until, double done)
{
  (void)done;
  return cpu_ms() < *(const double *)until;
}

static void run(trial *t, const bench_case *c, int round)
{
  scene_state y = c->start;
  double began = cpu_ms(),
         until = began + (t->sc.transient.steady == TRANSIENT_STEADY_MARCH ? longest_march : longest_shot);
  hc_monitor monitor = {tick, &until};
  t->status = timeint_steady(t->ti, c->omega, y.all, &monitor, &t->r);
  t->ms[round] = cpu_ms() - began;
  t->error = t->status == HC_OK ? fabs(t->r.amplitude / c->amplitude - 1) : NAN;
}

/* With these settings, once. */
static bool attempt(trial *t, const bench_case *c, const way *w, double tolerance, double regularisation,
                    double accuracy)
{
  timeint_free(t->ti);
  t->sc = c->sc;
  t->sc.transient = (transient_settings){.law = w->law,
                                         .steady = w->steady,
                                         .regularisation = regularisation,
                                         .tolerance = tolerance,
                                         .start = TRANSIENT_START_HBM,
                                         .max_periods = 200000};
  must(scene_timeint(&t->sc, &t->ti), w->name);
  run(t, c, 0);
  return t->error <= accuracy;
}

static void table_of(const bench_case *c, double accuracy, int rounds)
{
  static trial trials[WAYS];
  const trial *best = NULL;
  double least = INFINITY;
  /* The settings of a way, looked for with shooting: waiting finds the same orbits. */
  for (int w = 0; w < WAYS; ++w) {
    way shot = ways[w];
    double found[2] = {accuracy, 0.1 * sqrt(accuracy)}; /* tolerance, regularisation; a guess where shooting finds
                                                           nothing */
    bool met = false;
    shot.steady = TRANSIENT_STEADY_SHOOTING;
    for (int fine = 0; fine < 2 && !met; ++fine)
      for (int k = 0; k < (ways[w].law == TRANSIENT_LAW_EXACT ? 1 : HALF_DECADES) && !met; ++k) {
        double settings[2] = {fine ? accuracy / 10 : accuracy, pow(10, -1 - 0.5 * k)};
        met = attempt(&trials[w], c, &shot, settings[0], settings[1], accuracy);
        if (met) memcpy(found, settings, sizeof found);
      }
    if (ways[w].steady == TRANSIENT_STEADY_MARCH && !attempt(&trials[w], c, &ways[w], found[0], found[1], accuracy))
      attempt(&trials[w], c, &ways[w], found[0] / 10, found[1], accuracy);
  }
  for (int i = 0; i < rounds; ++i)
    for (int w = 0; w < WAYS; ++w) {
      if (trials[w].status == HC_OK) run(&trials[w], c, i);
      else trials[w].ms[i] = trials[w].ms[0];
    }
  for (int w = 0; w < WAYS; ++w) {
    const double m = quantile(rounds, trials[w].ms, 0.5);
    if (trials[w].error <= accuracy && m < least) least = m, best = &trials[w];
  }
  for (int w = 0; w < WAYS; ++w) {
    double ratio[BENCH_MOST_ROUNDS];
    char rho[16] = "-";
    for (int i = 0; i < rounds; ++i) ratio[i] = best ? trials[w].ms[i] / best->ms[i] : NAN;
    if (ways[w].law == TRANSIENT_LAW_REGULARISED)
      snprintf(rho, sizeof rho, "%.1e", trials[w].sc.transient.regularisation);
    printf("| %-3s | %.0e | %-23s | %7s | %.0e | %8.1e | %7d | %9ld | %9.3f | ", c->name, accuracy, ways[w].name, rho,
           trials[w].sc.transient.tolerance, trials[w].error, trials[w].r.periods, trials[w].r.steps,
           quantile(rounds, trials[w].ms, 0.5));
    if (trials[w].error <= accuracy) printf("%7.1f |\n", quantile(rounds, ratio, 0.5));
    else
      printf("%s |\n", trials[w].status == HC_OK            ? "not met"
                       : trials[w].status == HC_INTERRUPTED ? "took too long"
                                                            : hc_status_text(trials[w].status));
    fflush(stdout);
    timeint_free(trials[w].ti);
    trials[w].ti = NULL;
  }
}

/* The two figures asked for: with transient.steady_state: auto, to transient.tolerance 1e-9. */
static void print_periods(const bench_case *c, int law, int most)
{
  scene sc = c->sc;
  timeint *ti = NULL;
  scene_state y = c->start;
  timeint_result r;
  sc.transient = (transient_settings){
      .law = law, .regularisation = 1e-4, .tolerance = 1e-9, .start = TRANSIENT_START_HBM, .max_periods = 20000};
  must(scene_timeint(&sc, &ti), c->name);
  must(timeint_steady(ti, c->omega, y.all, NULL, &r), c->name);
  printf(
      "%s at %g from the HBM orbit (H = 5) to 1e-9, %s law: %d periods integrated by %s (asked: at most %d), closure "
      "%.1e\n",
      c->name, c->omega, law == TRANSIENT_LAW_EXACT ? "exact" : "regularised", r.periods, timeint_method_name(r.method),
      most, r.closure);
  timeint_free(ti);
}

static bench_case start_case(const char *name, scene sc, double omega, double from, double to)
{
  bench_case c = {.name = name, .sc = with_hbm(sc, 5, from, to), .omega = omega, .amplitude = NAN};
  c.start = hbm_start(&c.sc, omega);
  return c;
}

static bench_case make_case(const char *name, scene sc, double omega, double from, double to)
{
  bench_case c = start_case(name, sc, omega, from, to);
  c.amplitude = reference_orbit(c.sc, omega, c.start).amplitude;
  return c;
}

static int start(void)
{
  bench_case c = make_case("c2", scene_c2(), 9, 3, 20);
  printf("%.17g %.17g %.17g\n", c.start.x, c.start.v, c.amplitude);
  return 0;
}

int main(int argc, char **argv)
{
  if (argc > 1 && !strcmp(argv[1], "start")) return start();
  if (argc > 1 && !strcmp(argv[1], "once")) {
    bench_case c = start_case("c2", scene_c2(), 9, 3, 20);
    trial t = {0};
    attempt(&t, &c, &ways[0], 1e-8, 1e-4, 1e-8); /* the first touches memory; the second is timed */
    run(&t, &c, 0);
    printf("%.9g %.15g\n", 1e-3 * t.ms[0], t.r.amplitude);
    timeint_free(t.ti);
    return t.status == HC_OK ? 0 : 3;
  }
  const int rounds = count_argument(argc, argv, 1, 5, BENCH_MOST_ROUNDS, "[ROUNDS, [c2|b10|r2] | start | once]");
  const bench_case cases[CASES] = {make_case("c2", scene_c2(), 9, 3, 20), make_case("b10", scene_b10(), 7, 3, 20),
                                   make_case("r2", scene_r2(), 708.5, 600, 850)};
  for (int law = TRANSIENT_LAW_REGULARISED; law <= TRANSIENT_LAW_EXACT; ++law) {
    print_periods(&cases[2], law, 60);
    print_periods(&cases[0], law, 20);
  }
  fflush(stdout);
  printf("\n| case | accuracy | way | regularisation | tolerance | error | periods | steps | ms | ratio "
         "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (int k = 0; k < CASES; ++k)
    for (int a = 0; a < ACCURACIES; ++a)
      if (argc < 3 || !strcmp(argv[2], cases[k].name)) table_of(&cases[k], accuracies[a], rounds);
  return 0;
}
