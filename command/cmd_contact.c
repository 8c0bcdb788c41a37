/* cmd_contact.c - hbmcheck contact: Fourier coefficients of the contact force of a given motion. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "campaigns/scene_solvers.h"
#include "command/commands.h"
#include "command/files.h"
#include "command/plot/plot.h"
#include "hbm/aft.h"
#include "hbm/exact_force.h"
#include "numerics/series.h"

static const char help[] =
    "Fourier coefficients of CASE's contact force sum_j T_j cos(alpha_j) + (N_j - N0_j) sin(alpha_j) under the motion "
    "x = a0 + a1 cos + b1 sin + a2 cos 2 + ...: exact (or sampled at hbm.samples if hbm.force says so), and sampled "
    "at each N of --samples."
    "\vRow 0 is the mean. As many harmonics as the motion or hbm.harmonics has, whichever is more.\n"
    "example: hbmcheck contact cases/paper/case2.yaml --motion 0,8,0 --samples 64,512";

typedef struct contact_options {
  const char *motion; /* NULL: not given */
  number_list samples;
  const char *plot; /* NULL: no drawing */
} contact_options;

enum { KEY_MOTION = CLI_OWN_KEY, KEY_SAMPLES, KEY_PLOT };

static const struct argp_option options[] = {
    {"motion", KEY_MOTION, "a0,a1,b1,...", 0, "The motion's coefficients, an odd number of them", 1},
    {"samples", KEY_SAMPLES, "LIST", 0, "Also at these numbers of samples per period", 1},
    CLI_PLOT_OPTION(KEY_PLOT),
    {0},
};

static error_t read_option(int key, char *text, struct argp_state *state)
{
  contact_options *own = state->input;
  switch (key) {
  case KEY_MOTION: own->motion = text; return 0;
  case KEY_SAMPLES: cli_read_list(state, "samples", text, &own->samples); return 0;
  case KEY_PLOT: cli_read_plot(state, text, &own->plot); return 0;
  default: return ARGP_ERR_UNKNOWN;
  }
}

/* A set: the coefficients for one number of samples. */
enum { MAX_COEF = 2 * HBM_MAX_HARMONICS + 1, MAX_SETS = 17, EXACT = 0 };

/* X[MAX_COEF] from --motion; the number of harmonics, or -1 after the message. */
static int read_motion(const cli_common *common, const char *motion, double *X)
{
  int n = 0;
  if (!motion) {
    cli_message(common, "no motion given: --motion a0,a1,b1,...");
    return -1;
  }
  for (const char *at = motion;;) {
    size_t length = strcspn(at, ",");
    if (n == MAX_COEF) {
      cli_message(common, "--motion takes at most %d coefficients", MAX_COEF);
      return -1;
    }
    if (number_read(at, length, &X[n]) != NUMBER_FINE) {
      cli_message(common, "--motion: '%.*s' is not a finite number", (int)length, at);
      return -1;
    }
    ++n;
    if (!at[length]) break;
    at += length + 1;
  }
  if (n % 2 == 0) {
    cli_message(common, "--motion has %d coefficients; expected an odd number: a0,a1,b1,a2,b2,...", n);
    return -1;
  }
  return n / 2;
}

/* The exact coefficients, F[MAX_COEF]. */
static hc_status evaluate_exactly(const scene *sc, int n_harm, const double *X, double *F)
{
  exact_force *e = NULL;
  hc_status st = scene_exact(sc, n_harm, &e);
  if (st == HC_OK) st = exact_force_eval(e, X, F, NULL, NULL);
  exact_force_free(e);
  return st;
}

/* The pieces of the period in which each contact sticks or slips; in the rest it is separated. */
static hc_status note_pattern(table *t, const scene *sc, int n_harm, const double *X)
{
  static const char *const names[] = {"separated", "sticks", "slips forward", "slips backward"};
  enum { SHOWN = 16 };
  double F[MAX_COEF];
  exact_force *e = NULL;
  hc_status st = scene_exact(sc, n_harm, &e);
  if (st == HC_OK) st = exact_force_eval(e, X, F, NULL, NULL);
  for (int j = 0, n; j < sc->n_contacts && st == HC_OK; ++j) {
    const contact_piece *p = exact_force_pieces(e, j, &n);
    if (n == 0) table_note(t, "contact %d: separated all period", j);
    for (int i = 0; i < n && i < SHOWN; ++i)
      table_note(t, "contact %d: %s from %.12g to %.12g rad", j, names[p[i].state], p[i].from, p[i].to);
    if (n > SHOWN) table_note(t, "contact %d: and %d pieces more", j, n - SHOWN);
  }
  exact_force_free(e);
  return st;
}

/* Coefficients for each number of samples n_time[n_sets] (EXACT: exact forces) into F[n_sets][MAX_COEF]. 0 or the exit
 * code after the message. */
static int evaluate(const cli_common *common, const scene *sc, int n_harm, const double *X, const int *n_time,
                    int n_sets, double (*F)[MAX_COEF])
{
  for (int i = 0; i < n_sets; ++i) {
    aft *a = NULL;
    hc_status st = n_time[i] == EXACT ? evaluate_exactly(sc, n_harm, X, F[i]) : scene_aft(sc, n_harm, n_time[i], &a);
    if (st == HC_BAD_INPUT) {
      cli_message(common, "%d samples are too few for %d harmonics; expected at least %d", n_time[i], n_harm,
                  2 * n_harm + 1);
      return EXIT_USAGE;
    }
    if (st == HC_OK && a) st = aft_eval(a, X, F[i], NULL, NULL);
    aft_free(a);
    if (st != HC_OK) return cli_solver_failed(common, CLI_HBM, "the contact force", st, 0);
  }
  return 0;
}

static int write_table(const cli_common *common, const scene *sc, int n_harm, const double *X, const int *n_time,
                       int n_sets, double (*F)[MAX_COEF])
{
  table_column columns[1 + 2 * MAX_SETS] = {{"harmonic", TABLE_INTEGER}, {"cos", TABLE_REAL}, {"sin", TABLE_REAL}};
  char names[2 * MAX_SETS][24];
  for (int i = 1; i < n_sets; ++i)
    for (int part = 0; part < 2; ++part) {
      snprintf(names[2 * i + part], sizeof names[0], "%s_%d", part ? "sin" : "cos", n_time[i]);
      columns[1 + 2 * i + part] = (table_column){names[2 * i + part], TABLE_REAL};
    }
  table *t = table_new("Contact force", 1 + 2 * n_sets, columns);
  for (int h = 0; h <= n_harm; ++h) {
    table_put_integer(t, h);
    for (int i = 0; i < n_sets; ++i) {
      table_put_real(t, h ? F[i][2 * h - 1] : F[i][0]);
      table_put_real(t, h ? F[i][2 * h] : 0);
    }
  }
  if (n_time[0] == EXACT) table_note(t, "%s: cos and sin exact", sc->title);
  else table_note(t, "%s: cos and sin by sampling, N = %d", sc->title, n_time[0]);
  hc_status st = note_pattern(t, sc, n_harm, X);
  int code =
      st == HC_NO_MEMORY ? cli_solver_failed(common, CLI_HBM, "the contact force", st, 0) : cli_write(common, 1, &t);
  table_free(t);
  return code;
}

/* The forces of the given motion, once the case is read. */
static int put_forces(const cli_common *common, const contact_options *own, const scene *sc)
{
  double X[MAX_COEF] = {0};
  int code;
  int n_harm = read_motion(common, own->motion, X);
  if (n_harm < 0) return EXIT_USAGE;
  if (sc->hbm.force == HBM_FORCE_SAMPLED && sc->hbm.samples == HBM_AUTO) {
    cli_message(common, "hbm.samples: auto chooses along a response curve, and there is none here; try --set "
                        "hbm.samples=N, or --set hbm.force=exact");
    return EXIT_NO_SOLUTION;
  }
  if (n_harm < sc->hbm.harmonics) n_harm = sc->hbm.harmonics; /* auto is 0: the motion's own */
  if (n_harm < 1) n_harm = 1;
  int n_time[MAX_SETS] = {sc->hbm.force == HBM_FORCE_EXACT ? EXACT : sc->hbm.samples}, n_sets = 1;
  for (int i = 0; i < own->samples.n; ++i) {
    static const double most = 1 << 24;
    double n = own->samples.v[i];
    if (n_sets == MAX_SETS) cli_message(common, "--samples takes at most %d numbers", MAX_SETS - 1);
    else if (n != floor(n) || n > most) cli_message(common, "--samples: %.15g is not a whole number 3..%.0f", n, most);
    if (n_sets == MAX_SETS || n != floor(n) || n > most) return EXIT_USAGE;
    n_time[n_sets++] = (int)n;
  }
  double(*F)[MAX_COEF] = calloc(MAX_SETS, sizeof *F);
  if (!F) return cli_solver_failed(common, CLI_HBM, "the contact force", HC_NO_MEMORY, 0);
  code = evaluate(common, sc, n_harm, X, n_time, n_sets, F);
  if (!code) code = write_table(common, sc, n_harm, X, n_time, n_sets, F);
  plot_order drawing = {.path = own->plot};
  if (!code && own->plot) code = cli_plotted(common, plot_contact(&drawing, sc, n_harm, X), drawing.why);
  free(F);
  return code;
}

static int run_contact(int argc, char **argv)
{
  cli_common common;
  contact_options own = {0};
  scene sc = {.structure = NULL};
  cli_parse(&cmd_contact, argc, argv, &own, &common);
  cli_check_plot(&common, own.plot, false);
  int code = cli_check_files(&common, 1, &(cli_file){"--plot", own.plot, CLI_OUTPUT});
  if (!code) code = cli_load_case(&common, common.arguments[0], &sc);
  if (!code) code = put_forces(&common, &own, &sc);
  case_clear(&sc);
  return code;
}

const cli_command cmd_contact = {
    .name = "contact",
    .summary = "Fourier coefficients of the contact force of a given motion",
    .arguments = "CASE",
    .help = help,
    .options = options,
    .read_option = read_option,
    .run = run_contact,
};
