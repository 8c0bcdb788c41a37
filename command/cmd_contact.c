/* cmd_contact.c - hbmcheck contact: Fourier coefficients of the contact force of a given motion. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "command/case_names.h"
#include "command/commands.h"
#include "command/contact_force.h"
#include "command/files.h"
#include "command/plot/plot.h"
#include "numerics/series.h"
#include "study/scene_solvers.h"

static const char help[] =
    "Fourier coefficients of CASE's contact force sum_j T_j cos(alpha_j) + (N_j - N0_j) sin(alpha_j) under the motion "
    "x = a0 + a1 cos + b1 sin + a2 cos 2 + ... of --motion; or of one contact's tangential force T and normal force N "
    "under its own u and v, of --motion-u and --motion-v: exact (or sampled at hbm.samples if hbm.force says so), and "
    "sampled at each N of --samples. Of two tangents --motion-u2 moves the second."
    "\vRow 0 is the mean. As many harmonics as the motion or hbm.harmonics has, whichever is more. With --contact a "
    "column `force`: first the rows of `tangential`, of two tangents of `tangential_2`, then those of `normal`, N0 "
    "included.\n"
    "example: hbmcheck contact cases/paper/case2.yaml --motion 0,8,0 --samples 64,512\n"
    "example: hbmcheck contact cases/structures/chain3.yaml --contact ground --motion-u 0,0.1,0";

enum {
  KEY_CONTACT = CLI_OWN_KEY,
  KEY_MOTION /* and CONTACT_MOTIONS - 1 more */,
  KEY_SLIDER = KEY_MOTION + CONTACT_MOTIONS,
  KEY_SAMPLES,
  KEY_PLOT
};

static const struct argp_option options[] = {
    {"motion", KEY_MOTION + CONTACT_X, "a0,a1,b1,...", 0,
     "The motion's coefficients, an odd number of them; of one DOF", 1},
    {"contact", KEY_CONTACT, "NAME", 0, "One contact, by its name or its number from 0", 1},
    {"motion-u", KEY_MOTION + CONTACT_U, "a0,a1,b1,...", 0, "Its tangential motion [none]", 1},
    {"motion-u2", KEY_MOTION + CONTACT_U2, "a0,a1,b1,...", 0, "The same along its second tangent [none]", 1},
    {"motion-v", KEY_MOTION + CONTACT_V, "a0,a1,b1,...", 0, "Its normal motion [none]", 1},
    {"slider", KEY_SLIDER, "W", 0,
     "Where its slider starts (of two tangents W1,W2), if it never separates and the start decides [0]", 1},
    {"samples", KEY_SAMPLES, "LIST", 0, "Also at these numbers of samples per period", 1},
    CLI_PLOT_OPTION(KEY_PLOT),
    {0},
};

static error_t read_option(int key, char *text, struct argp_state *state)
{
  contact_options *own = state->input;
  switch (key) {
  case KEY_CONTACT: own->contact = text; return 0;
  case KEY_MOTION + CONTACT_X:
  case KEY_MOTION + CONTACT_U:
  case KEY_MOTION + CONTACT_U2:
  case KEY_MOTION + CONTACT_V: own->motion[key - KEY_MOTION] = text; return 0;
  case KEY_SLIDER: own->slider = text; return 0;
  case KEY_SAMPLES: cli_read_list(state, "samples", text, &own->samples); return 0;
  case KEY_PLOT: cli_read_plot(state, text, &own->plot); return 0;
  default: return ARGP_ERR_UNKNOWN;
  }
}

/* A set: the coefficients for one number of samples. */
enum { MAX_SETS = 17, MOST_NUMBERS = CONTACT_MOST_DOF * CONTACT_MOST_COEF };

/* ---- its forces ----------------------------------------------------------------------------------- */

/* Coefficients for each number of samples n_time[n_sets] into F[n_sets][MOST_NUMBERS]. 0 or the exit code after the
 * message. */
static int evaluate(const cli_common *common, const contact_motion *m, const int *n_time, int n_sets,
                    double (*F)[MOST_NUMBERS])
{
  for (int i = 0; i < n_sets; ++i) {
    hc_status st = contact_force_of(m, common->scene->hbm.restart, n_time[i], F[i]);
    if (st == HC_BAD_INPUT) {
      cli_message(common, "%d samples are too few for %d harmonics; expected at least %d", n_time[i], m->n_harm,
                  2 * m->n_harm + 1);
      return EXIT_USAGE;
    }
    if (st != HC_OK) return cli_solver_failed(common, CLI_HBM, "the contact force", st, 0);
  }
  return 0;
}

/* ---- the table ------------------------------------------------------------------------------------ */

static int write_table(const cli_common *common, const contact_motion *m, const int *n_time, int n_sets,
                       double (*F)[MOST_NUMBERS])
{
  static const char *const forces[] = {"tangential", "tangential_2", "normal"};
  const scene *sc = common->scene;
  const bool single = m->one >= 0;
  table_column columns[2 + 2 * MAX_SETS] = {
      {"force", TABLE_TEXT}, {"harmonic", TABLE_INTEGER}, {"cos", TABLE_REAL}, {"sin", TABLE_REAL}};
  char names[2 * MAX_SETS][24];
  for (int i = 1; i < n_sets; ++i)
    for (int part = 0; part < 2; ++part) {
      snprintf(names[2 * i + part], sizeof names[0], "%s_%d", part ? "sin" : "cos", n_time[i]);
      columns[2 + 2 * i + part] = (table_column){names[2 * i + part], TABLE_REAL};
    }
  table *t = table_new("Contact force", 1 + single + 2 * n_sets, columns + !single);
  for (int d = 0; d < m->n_dof; ++d)
    for (int h = 0; h <= m->n_harm; ++h) {
      if (single) table_put_text(t, forces[d == m->n_dof - 1 ? 2 : d]);
      table_put_integer(t, h);
      for (int i = 0; i < n_sets; ++i) {
        const double *f = F[i] + d * series_length(m->n_harm);
        table_put_real(t, h ? f[2 * h - 1] : f[0]);
        table_put_real(t, h ? f[2 * h] : 0);
      }
    }
  if (n_time[0] == CONTACT_EXACT) table_note(t, "%s: cos and sin exact", sc->title);
  else table_note(t, "%s: cos and sin by sampling, N = %d", sc->title, n_time[0]);
  hc_status st = contact_force_note(t, common, m);
  int code =
      st == HC_NO_MEMORY ? cli_solver_failed(common, CLI_HBM, "the contact force", st, 0) : cli_write(common, 1, &t);
  table_free(t);
  return code;
}

/* The numbers of samples, the first one of the case. How many, or -1 after the message. */
static int list_sets(const cli_common *common, const contact_options *own, int n_time[MAX_SETS])
{
  const scene *sc = common->scene;
  static const double most = 1 << 24;
  int n_sets = 0;
  n_time[n_sets++] = sc->hbm.force == HBM_FORCE_EXACT ? CONTACT_EXACT : sc->hbm.samples;
  for (int i = 0; i < own->samples.n; ++i) {
    double n = own->samples.v[i];
    if (n_sets == MAX_SETS) cli_message(common, "--samples takes at most %d numbers", MAX_SETS - 1);
    else if (n != floor(n) || n > most) cli_message(common, "--samples: %.15g is not a whole number 3..%.0f", n, most);
    if (n_sets == MAX_SETS || n != floor(n) || n > most) return -1;
    n_time[n_sets++] = (int)n;
  }
  return n_sets;
}

static int draw(const cli_common *common, const char *path, const contact_motion *m)
{
  plot_order drawing = {.path = path};
  const plot_motion motion = {.first = m->one < 0 ? 0 : m->one,
                              .circle = m->circle,
                              .slider = {m->slider[0], m->slider[1]},
                              .n_harm = m->n_harm,
                              .n_dof = m->n_dof,
                              .n_contacts = m->n_contacts,
                              .contacts = m->contacts,
                              .X = m->X};
  const hc_status st =
      m->pair ? plot_contact_plane(&drawing, common->scene, &motion) : plot_contact(&drawing, common->scene, &motion);
  return cli_plotted(common, st, drawing.why);
}

/* The forces of the given motion. */
static int put_forces(const cli_common *common, const contact_options *own, const contact_motion *m)
{
  const scene *sc = common->scene;
  int n_time[MAX_SETS];
  if (sc->hbm.force == HBM_FORCE_SAMPLED && sc->hbm.samples == HBM_AUTO) {
    cli_message(common, "hbm.samples: auto chooses along a response curve, and there is none here; try --set "
                        "hbm.samples=N, or --set hbm.force=exact");
    return EXIT_NO_SOLUTION;
  }
  const int n_sets = list_sets(common, own, n_time);
  if (n_sets < 0) return EXIT_USAGE;
  double(*F)[MOST_NUMBERS] = calloc(MAX_SETS, sizeof *F);
  if (!F) return cli_solver_failed(common, CLI_HBM, "the contact force", HC_NO_MEMORY, 0);
  int code = evaluate(common, m, n_time, n_sets, F);
  if (!code) code = write_table(common, m, n_time, n_sets, F);
  if (!code && own->plot) code = draw(common, own->plot, m);
  free(F);
  return code;
}

static int run_contact(int argc, char **argv)
{
  cli_common common;
  contact_options own = {0};
  contact_motion motion = {0};
  scene sc = {.structure = NULL};
  cli_parse(&cmd_contact, argc, argv, &own, &common);
  cli_check_plot(&common, own.plot, false);
  int code = cli_check_files(&common, 1, &(cli_file){"--plot", own.plot, CLI_OUTPUT});
  if (!code) code = cli_load_case(&common, common.arguments[0], &sc);
  if (!code) code = contact_motion_find(&common, &own, &motion);
  if (!code) code = put_forces(&common, &own, &motion);
  contact_motion_clear(&motion);
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
