/* skips.c - a benchmark, not a test: what each shortcut of hbm/ saves. usage: bench_skips [REPEATS] For each of
 * three scenes, groups of ways to trace the same curve; the ways of a group take turns, REPEATS times, in one run,
 * and the first of a group is what the others' ratios refer to. Columns: force evaluations, Newton iterations,
 * points, milliseconds (median, and the quartiles around it), ratio. */
#include "study/scene_solvers.h"
#include "tests/bench/bench.h"
#include "tests/reference_scenes.h"

enum { MAX_WAYS = 4, N_GROUPS = 4 };

typedef struct way {
  const char *name;
  int harmonics, samples, continuation;
  bool skip_linear;
} way;
typedef struct group {
  const char *name;
  int n;
  way ways[MAX_WAYS];
} group;

/* samples -1: exact forces. Auto: accuracy 1e-3 for harmonics and samples alike. */
static const group groups[N_GROUPS] = {
    {"skip_linear", 2, {{"on", 10, -1, HBM_CONTINUATION_AUTO, true}, {"off", 10, -1, HBM_CONTINUATION_AUTO, false}}},
    {"continuation",
     2,
     {{"auto", 10, -1, HBM_CONTINUATION_AUTO, false}, {"arclength", 10, -1, HBM_CONTINUATION_ARCLENGTH, false}}},
    {"harmonics",
     4,
     {{"auto", HBM_AUTO, -1, HBM_CONTINUATION_AUTO, true},
      {"10", 10, -1, HBM_CONTINUATION_AUTO, true},
      {"20", 20, -1, HBM_CONTINUATION_AUTO, true},
      {"40", 40, -1, HBM_CONTINUATION_AUTO, true}}},
    {"samples",
     3,
     {{"auto", 5, HBM_AUTO, HBM_CONTINUATION_AUTO, true},
      {"1024", 5, 1024, HBM_CONTINUATION_AUTO, true},
      {"4096", 5, 4096, HBM_CONTINUATION_AUTO, true}}}};

static scene with(scene sc, const way *w)
{
  sc.hbm = (hbm_settings){.harmonics = w->harmonics,
                          .keep_mean = true,
                          .force = w->samples < 0 ? HBM_FORCE_EXACT : HBM_FORCE_SAMPLED,
                          .samples = w->samples < 0 ? 1024 : w->samples,
                          .restart = HBM_RESTART_INTERPOLATED,
                          .continuation = w->continuation,
                          .tolerance = 1e-10,
                          .accuracy = 1e-3,
                          .skip_linear = w->skip_linear};
  return sc;
}

typedef struct result {
  double ms[BENCH_MOST_ROUNDS];
  long evaluations, iterations;
  int points, harmonics, samples;
  hc_status status;
} result;

static void run_group(const char *name, const scene *base, const group *g, int repeats)
{
  static result results[MAX_WAYS];
  for (int i = 0; i < repeats; ++i)
    for (int w = 0; w < g->n; ++w) {
      scene sc = with(*base, &g->ways[w]);
      hbm_solver *s = NULL;
      hbm_curve c = {0};
      double t = cpu_ms();
      results[w].status = scene_hbm_solver(&sc, &s);
      if (results[w].status == HC_OK) results[w].status = hbm_trace(s, sc.omega_from, sc.omega_to, NULL, &c);
      results[w].ms[i] = cpu_ms() - t;
      results[w].evaluations = c.evaluations;
      results[w].iterations = c.iterations;
      results[w].points = c.n;
      if (s) results[w].harmonics = hbm_n_harmonics(s);
      if (s) results[w].samples = hbm_n_samples(s);
      hbm_curve_free(&c);
      hbm_solver_free(s);
    }
  for (int w = 0; w < g->n; ++w) {
    const result *r = &results[w];
    printf("%-4s %-13s %-10s %3d %5d %5d %7ld %6ld %8.3f %8.3f %8.3f %6.2f", name, g->name, g->ways[w].name,
           r->harmonics, r->samples, r->points, r->evaluations, r->iterations, quantile(repeats, r->ms, 0.5),
           quantile(repeats, r->ms, 0.25), quantile(repeats, r->ms, 0.75),
           quantile(repeats, r->ms, 0.5) / quantile(repeats, results[0].ms, 0.5));
    if (r->status != HC_OK) printf("  %s", hc_status_text(r->status));
    printf("\n");
  }
}

int main(int argc, char **argv)
{
  const int repeats = count_argument(argc, argv, 1, 21, BENCH_MOST_ROUNDS, "[REPEATS]");
  static const char *const names[] = {"c2", "a10", "r2"};
  printf("%-4s %-13s %-10s %3s %5s %5s %7s %6s %8s %8s %8s %6s\n", "case", "switch", "setting", "H", "N", "pts",
         "evals", "iter", "ms", "quarter", "3/4", "ratio");
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
    const reference_scene *r = reference_scene_named(names[i]);
    scene sc = {.mass = r->mass,
                .damping = r->damping,
                .stiffness = r->stiffness,
                .force = r->force,
                .n_contacts = 1,
                .omega_from = r->omega_from,
                .omega_to = r->omega_to};
    sc.contacts[0] = (scene_contact){.law = {.kt = r->kt, .kn = r->kn, .mu = REFERENCE_FRICTION, .gap = r->gap},
                                     .angle_deg = REFERENCE_ANGLE};
    for (int g = 0; g < N_GROUPS; ++g) run_group(r->name, &sc, &groups[g], repeats);
  }
  return 0;
}
