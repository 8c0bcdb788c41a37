/* force.c - a benchmark, not a test: what one evaluation of the contact force with its Jacobian costs, exact against
 * sampled.
 * usage: bench_force [ROUNDS] [CASES_DIR]   (default 15 and cases/paper)
 * Motions are solutions, the largest response at three omegas each, of case 2 and gap1 (separation, then stick:
 * neither slips once it separates, since kt <= mu kn tan(alpha)) and of case B (stick, slip and separation: b10 of
 * the references); every call sees another of 64 slightly different motions. All configurations are timed in turn, a
 * batch of about a millisecond each, ROUNDS times; a figure is the median of its batches, a ratio the median of the
 * ratios within a round, with quartiles. The machine is shared: microseconds are for orientation, the ratios are the
 * result. Contacts 1..8 share the stiffness of one, and their gaps differ by a percent each. */
#include "study/scene_solvers.h"
#include "tests/bench/bench.h"
#include "tests/random.h"

enum { MAX_CONFIGS = 256, VARIANTS = 64, MAX_COEF = 2 * HBM_MAX_HARMONICS + 1, SCENES = 3, OMEGAS = 3, EXACT = 0 };

typedef struct bench_scene {
  const char *name, *file;
  double omega[OMEGAS];
} bench_scene;

static const bench_scene scenes[SCENES] = {
    {"case2", "case2.yaml", {5.8, 7, 9}},
    {"gap1", "fig09_gap_p1.yaml", {12.5, 16, 20}},
    {"b10", "case_b.yaml", {5.6, 6.5, 7.9}},
};
static const int harmonics[] = {1, 5, 10, 25, 50};
enum { N_HARMONICS = sizeof harmonics / sizeof *harmonics };

/* Motions of one scene with one H, perturbed. */
typedef struct motions {
  int n_harm, n_coef;
  double *X; /* [VARIANTS][n_coef] */
} motions;

typedef struct config {
  int scene, n_harm, n_time, n_contacts; /* n_time EXACT: exact forces */
  const motions *m;
  aft *sampled;
  exact_force *located;
  int batch, next;
  double pieces;                /* mean over the motions */
  double us[BENCH_MOST_ROUNDS]; /* [us] an evaluation */
} config;

static motions all_motions[SCENES][N_HARMONICS];
static config configs[MAX_CONFIGS];
static int n_configs, rounds = 15;
static double F[MAX_COEF], jac[MAX_COEF * MAX_COEF], sink;

/* The solution of largest amplitude at omega, of the curve's. */
static void largest_at(hbm_solver *s, const hbm_curve *curve, double omega, double *X)
{
  hbm_curve at = {0};
  double best = -1;
  hc_status st = hbm_curve_at(s, curve, omega, &at);
  for (int i = 0; i < at.n; ++i) {
    hbm_measures m;
    if (hbm_measure(s, at.X + (size_t)i * at.n_coef, &m) != HC_OK || m.amplitude <= best) continue;
    best = m.amplitude;
    memcpy(X, at.X + (size_t)i * at.n_coef, (size_t)at.n_coef * sizeof *X);
  }
  hbm_curve_free(&at);
  if (best < 0) must(st == HC_OK ? HC_NOT_CONVERGED : st, "no solution");
}

static void make_motions(const scene *sc, const bench_scene *b, int n_harm, motions *out)
{
  scene with = *sc;
  hbm_solver *s = NULL;
  hbm_curve curve = {0};
  with.hbm.harmonics = n_harm;
  with.hbm.force = HBM_FORCE_EXACT;
  hc_status st = scene_hbm_solver(&with, &s);
  if (st == HC_OK) st = hbm_trace(s, with.omega_from, with.omega_to, NULL, &curve);
  must(st, b->name);
  *out = (motions){n_harm, 2 * n_harm + 1, NULL};
  out->X = calloc((size_t)VARIANTS * out->n_coef, sizeof(double));
  if (!out->X) must(HC_NO_MEMORY, b->name);
  uint64_t seed = 1;
  for (int v = 0; v < VARIANTS; ++v) {
    double *X = out->X + (size_t)v * out->n_coef;
    if (v < OMEGAS) largest_at(s, &curve, b->omega[v], X);
    else memcpy(X, X - (size_t)OMEGAS * out->n_coef, (size_t)out->n_coef * sizeof *X);
    for (int k = 0; k < out->n_coef && v >= OMEGAS; ++k) X[k] *= 1 + 0.5e-5 * random_signed(&seed);
  }
  hbm_curve_free(&curve);
  hbm_solver_free(s);
}

/* n contacts that together are the scene's one, nearly. */
static scene split(const scene *sc, int n)
{
  scene out = *sc;
  out.n_contacts = n;
  for (int j = 0; j < n; ++j) {
    scene_contact *c = &out.contacts[j];
    *c = sc->contacts[0];
    c->law.kt /= n;
    c->law.kn /= n;
    c->law.gap *= 1 + 0.01 * j;
  }
  return out;
}

static void evaluate(config *c)
{
  const double *X = c->m->X + (size_t)c->next * c->m->n_coef;
  c->next = (c->next + 1) % VARIANTS;
  hc_status st = c->located ? exact_force_eval(c->located, X, F, jac, NULL) : aft_eval(c->sampled, X, F, jac, NULL);
  must(st, "evaluation");
  sink += F[0] + jac[0];
}

static void add_config(const scene *sc, int scene_index, int h, int n_time, int n_contacts)
{
  if (n_configs == MAX_CONFIGS) must(HC_NO_MEMORY, "too many configurations");
  config *c = &configs[n_configs++];
  scene used = split(sc, n_contacts);
  *c = (config){.scene = scene_index,
                .n_harm = harmonics[h],
                .n_time = n_time,
                .n_contacts = n_contacts,
                .m = &all_motions[scene_index][h],
                .batch = 1};
  hc_status st = n_time ? scene_aft(&used, c->n_harm, n_time, &c->sampled) : scene_exact(&used, c->n_harm, &c->located);
  must(st, "workspace");
  for (int i = 0; i < 4; ++i) evaluate(c);
  double t = cpu_ms();
  for (int i = 0; i < 16; ++i) evaluate(c);
  t = (cpu_ms() - t) / 16;
  while (c->batch * t < 1) c->batch += OMEGAS; /* whole sets of omegas */
  if (c->located) {
    double sum = 0;
    for (int v = 0; v < VARIANTS; ++v) {
      evaluate(c);
      for (int j = 0; j < c->n_contacts; ++j) {
        int n;
        exact_force_intervals(c->located, j, &n);
        sum += n;
      }
    }
    c->pieces = sum / VARIANTS;
  }
}

static const config *find(int scene_index, int n_harm, int n_time, int n_contacts)
{
  for (int i = 0; i < n_configs; ++i)
    if (configs[i].scene == scene_index && configs[i].n_harm == n_harm && configs[i].n_time == n_time &&
        configs[i].n_contacts == n_contacts)
      return &configs[i];
  return NULL;
}

static void print_ratio(int k, int n_harm, int n_time)
{
  const config *a = find(k, n_harm, EXACT, 1), *b = find(k, n_harm, n_time, 1);
  double ratio[BENCH_MOST_ROUNDS];
  for (int r = 0; r < rounds; ++r) ratio[r] = a->us[r] / b->us[r];
  printf("%-6s exact(H=%d)/sampled(N=%d, H=%d) = %.3f  [%.3f, %.3f]\n", scenes[k].name, n_harm, n_time, n_harm,
         quantile(rounds, ratio, 0.5), quantile(rounds, ratio, 0.25), quantile(rounds, ratio, 0.75));
}

/* Least squares of log(time) against log(variable). */
typedef struct fit {
  double n, x, y, xx, xy;
} fit;

static void fit_add(fit *f, double at, const config *c)
{
  double x = log(at), y = log(quantile(rounds, c->us, 0.5));
  f->n += 1;
  f->x += x;
  f->y += y;
  f->xx += x * x;
  f->xy += x * y;
}

static double fit_exponent(const fit *f) { return (f->n * f->xy - f->x * f->y) / (f->n * f->xx - f->x * f->x); }

static void print_exponents(int k)
{
  for (int h = 0; h < N_HARMONICS; ++h) {
    fit all = {0}, high = {0};
    for (int n = 64; n <= 16384; n *= 2) {
      const config *c = find(k, harmonics[h], n, 1);
      if (!c) continue;
      fit_add(&all, n, c);
      if (n >= 1024) fit_add(&high, n, c);
    }
    printf("%-6s sampled, H = %-2d: time ~ N^%.2f, from N = 1024 N^%.2f\n", scenes[k].name, harmonics[h],
           fit_exponent(&all), fit_exponent(&high));
  }
  for (int n = 0; n <= 1024; n += 1024) {
    fit all = {0}, high = {0};
    for (int h = 0; h < N_HARMONICS; ++h) {
      fit_add(&all, harmonics[h], find(k, harmonics[h], n, 1));
      if (harmonics[h] >= 10) fit_add(&high, harmonics[h], find(k, harmonics[h], n, 1));
    }
    printf("%-6s %s: time ~ H^%.2f, from H = 10 H^%.2f\n", scenes[k].name, n ? "sampled, N = 1024" : "exact",
           fit_exponent(&all), fit_exponent(&high));
  }
  for (int n = 0; n <= 256; n += 256) {
    fit f = {0};
    for (int j = 1; j <= 8; ++j) fit_add(&f, j, find(k, 5, n, j));
    printf("%-6s %s, H = 5: time ~ contacts^%.2f (1 %.2f us, 8 %.2f us)\n", scenes[k].name,
           n ? "sampled, N = 256" : "exact", fit_exponent(&f), quantile(rounds, find(k, 5, n, 1)->us, 0.5),
           quantile(rounds, find(k, 5, n, 8)->us, 0.5));
  }
}

static void print_machine(void)
{
  char line[256] = "";
  FILE *f = fopen("/proc/cpuinfo", "r");
  const char *chip = "unknown";
  while (f && fgets(line, sizeof line, f))
    if (!strncmp(line, "model name", 10) && strchr(line, ':')) {
      line[strcspn(line, "\n")] = 0;
      chip = strchr(line, ':') + 2;
      break;
    }
  if (f) fclose(f);
#if defined __clang__
  printf("compiler %s", __VERSION__);
#else
  printf("compiler gcc %s", __VERSION__);
#endif
#ifdef __OPTIMIZE__
  printf(", optimised; ");
#else
  printf(", NOT OPTIMISED; ");
#endif
  printf("CPU %s; %d rounds\n", chip, rounds);
}

int main(int argc, char **argv)
{
  const char *dir = argc > 2 ? argv[2] : "cases/paper";
  rounds = count_argument(argc, argv, 1, 15, BENCH_MOST_ROUNDS, "[ROUNDS [CASES_DIR]]");
  print_machine();
  for (int k = 0; k < SCENES; ++k) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", dir, scenes[k].file);
    const scene sc = read_case(path, 0, NULL);
    for (int h = 0; h < N_HARMONICS; ++h) {
      make_motions(&sc, &scenes[k], harmonics[h], &all_motions[k][h]);
      add_config(&sc, k, h, EXACT, 1);
      for (int n = 64; n <= 16384; n *= 2)
        if (n > 2 * harmonics[h]) add_config(&sc, k, h, n, 1);
    }
    for (int n = 2; n <= 8; ++n) {
      add_config(&sc, k, 1, EXACT, n);
      add_config(&sc, k, 1, 256, n);
    }
  }
  for (int r = 0; r < rounds; ++r)
    for (int i = 0; i < n_configs; ++i) {
      config *c = &configs[i];
      evaluate(c); /* warm its memory */
      const double from = cpu_ms();
      for (int k = 0; k < c->batch; ++k) evaluate(c);
      c->us[r] = 1e3 * (cpu_ms() - from) / c->batch;
    }
  for (int k = 0; k < SCENES; ++k) {
    printf("\n%s, one contact: microseconds an evaluation with Jacobian, median [quartiles]\n%8s", scenes[k].name, "");
    for (int h = 0; h < N_HARMONICS; ++h) printf("%24s%2d", "H = ", harmonics[h]);
    printf("\n%8s", "exact");
    for (int n = 0; n <= 16384; n = n ? 2 * n : 64) {
      if (n) printf("\nN =%5d", n);
      for (int h = 0; h < N_HARMONICS; ++h) {
        const config *c = find(k, harmonics[h], n, 1);
        if (c)
          printf("%10.2f [%6.2f,%6.2f]", quantile(rounds, c->us, 0.5), quantile(rounds, c->us, 0.25),
                 quantile(rounds, c->us, 0.75));
        else printf("%26s", "-");
      }
    }
    printf("\n%8s", "pieces");
    for (int h = 0; h < N_HARMONICS; ++h) printf("%26.1f", find(k, harmonics[h], EXACT, 1)->pieces);
    printf("\n\n");
    print_ratio(k, 5, 256);
    print_ratio(k, 10, 512);
    print_exponents(k);
  }
  for (int i = 0; i < n_configs; ++i) {
    aft_free(configs[i].sampled);
    exact_force_free(configs[i].located);
  }
  for (int k = 0; k < SCENES; ++k)
    for (int h = 0; h < N_HARMONICS; ++h) free(all_motions[k][h].X);
  return sink == sink ? 0 : 1;
}
