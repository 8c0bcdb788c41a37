/* cmd_verify.c - hbmcheck verify: another code's response curve, point by point, and the suspected cause where it is
 * off. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "command/commands.h"
#include "command/files.h"
#include "command/plot/plot.h"
#include "compare/verify/verify.h"
#include "output/progress.h"

static const char help[] =
    "Hold another code's response curve of CASE, a file of columns, against harmonic balance with exact forces and "
    "many harmonics, itself held "
    "against time integration; a verdict for every point, and the suspected cause where they differ, found by making "
    "the mistake ourselves."
    "\vFILE: fields separated by comma, semicolon, tab or blanks; # starts a remark; any order, several branches. "
    "Without --columns the header says what is what: omega or frequency, and a quantity. "
    "COLUMN is a number from 1 or a name in the header. omega is in rad per unit time, frequency in cycles per unit "
    "time.\n"
    "QUANTITY: amplitude = (max - min)/2 of x, double_amplitude, peak = max |x|, max, min, mean, rms, norm = "
    "sqrt(X0^2 + sum (a_k^2 + b_k^2)), norm_over_root_2 (NLvib's rms), harmonic_K = |a_K + i b_K|, "
    "velocity and acceleration = (max - min)/2 of x' and x'', velocity_harmonic_K, acceleration_harmonic_K; dB_ before "
    "any: 20 log10 of it. docs/verify.md has the "
    "formulas and all causes.\n"
    "A point matches within the case's gate.amplitude, gate.harmonic_1 or gate.mean. Where a slider never slips the "
    "mean is open, and what contains it is not compared. With --noise S, points match that are within the gate "
    "and 4 S, and on the average of m neighbours, up to 25, within the gate and 4 S/sqrt(m). With csv "
    "only the points are written, with the cause in the remarks before them.\n"
    "exit: 0 every point matches  1 some do not, or run along the wrong branch  2 a file is wrong  3 could not be "
    "judged  64 usage\n"
    "example: hbmcheck verify cases/verify/case2.yaml --against cases/verify/no_static.csv --columns "
    "omega=1,harmonic_1=2";

typedef struct verify_options {
  const char *against, *columns, *quantity, *noise, *plot; /* NULL: not given */
} verify_options;

enum { KEY_AGAINST = CLI_OWN_KEY, KEY_COLUMNS, KEY_QUANTITY, KEY_NOISE, KEY_PLOT };

static const struct argp_option options[] = {
    {"against", KEY_AGAINST, "FILE", 0, "The curve to hold against ours", 1},
    {"columns", KEY_COLUMNS, "NAME=COLUMN,...", 0,
     "Where its columns are: omega or frequency, and value or a QUANTITY [as the header names them]", 1},
    {"quantity", KEY_QUANTITY, "QUANTITY", 0, "What the column named value is, or which column is meant", 1},
    {"noise", KEY_NOISE, "S", 0,
     "A measured curve: its values scatter by S, a standard deviation relative to the amplitude, such as 1e-2 [0]", 1},
    CLI_PLOT_OPTION(KEY_PLOT),
    {0},
};

/* NOLINTNEXTLINE(readability-non-const-parameter): the signature is argp's */
static error_t read_option(int key, char *text, struct argp_state *state)
{
  verify_options *own = state->input;
  switch (key) {
  case KEY_AGAINST: own->against = text; return 0;
  case KEY_COLUMNS: own->columns = text; return 0;
  case KEY_QUANTITY: own->quantity = text; return 0;
  case KEY_NOISE: own->noise = text; return 0;
  case KEY_PLOT: cli_read_plot(state, text, &own->plot); return 0;
  default: return ARGP_ERR_UNKNOWN;
  }
}

static const table_column columns[] = {
    {"omega", TABLE_REAL},   {"frequency", TABLE_REAL}, {"value", TABLE_REAL},
    {"nearest", TABLE_REAL}, {"branch", TABLE_INTEGER}, {"stable", TABLE_TEXT},
    {"error", TABLE_REAL},   {"verdict", TABLE_TEXT},   {"line", TABLE_INTEGER},
};
static const table_column hypothesis_columns[] = {
    {"cause", TABLE_TEXT},          {"distance", TABLE_REAL},     {"truth_distance", TABLE_REAL},
    {"harmonics", TABLE_INTEGER},   {"static", TABLE_TEXT},       {"samples", TABLE_INTEGER},
    {"slider_restart", TABLE_TEXT}, {"omega_factor", TABLE_REAL}, {"value_factor", TABLE_REAL},
    {"quantity", TABLE_TEXT},
};
static const table_column summary_columns[] = {
    {"cause", TABLE_TEXT},          {"nearest_guess", TABLE_TEXT},   {"quantity", TABLE_TEXT},
    {"points", TABLE_INTEGER},      {"match", TABLE_INTEGER},        {"differs", TABLE_INTEGER},
    {"unstable", TABLE_INTEGER},    {"other_branch", TABLE_INTEGER}, {"solver_failed", TABLE_INTEGER},
    {"skipped", TABLE_INTEGER},     {"left_out", TABLE_INTEGER},     {"reversals", TABLE_INTEGER},
    {"truth_distance", TABLE_REAL}, {"noise", TABLE_REAL},           {"sentence", TABLE_TEXT},
};
static const char *const spare_hypothesis_columns[] = {"slider_restart", "omega_factor",   "value_factor",
                                                       "static",         "truth_distance", "quantity",
                                                       "samples",        "harmonics",      NULL};
enum {
  N_SUMMARY_COLUMNS = sizeof summary_columns / sizeof *summary_columns,
  N_COLUMNS = sizeof columns / sizeof *columns,
  N_HYPOTHESIS_COLUMNS = sizeof hypothesis_columns / sizeof *hypothesis_columns
};

static void put_row(table *t, const scene *sc, const verify_quantity *q, const verify_row *r)
{
  table_put_real(t, r->omega);
  if (sc->in_cycles) table_put_real(t, scene_frequency(sc, r->omega));
  table_put_real(t, verify_quantity_to_column(q, r->value));
  table_put_real(t, verify_quantity_to_column(q, r->nearest));
  if (r->branch >= 0) table_put_integer(t, r->branch);
  else table_put_missing(t);
  table_put_text(t, r->branch < 0 ? NULL : r->stable > 0 ? "yes" : r->stable < 0 ? "no" : "unknown");
  table_put_real(t, r->error);
  table_put_text(t, r->skipped ? "skipped" : verdict_name(r->verdict));
  table_put_integer(t, r->line);
}

static void put_hypothesis(table *t, const verify_hypothesis *h, double truth)
{
  char words[VERIFY_TEXT], name[VERIFY_QUANTITY_TEXT];
  const verify_equations *e = &h->equations;
  const bool linear = e->change == CHANGE_NO_CONTACT || e->change == CHANGE_STUCK;
  table_put_text(t, verify_cause_words(h->causes, words));
  table_put_real(t, h->distance);
  table_put_real(t, truth);
  if (linear) table_put_missing(t);
  else table_put_integer(t, e->harmonics);
  table_put_text(t, linear ? NULL : e->keep_mean ? "true" : "false");
  if (e->samples) table_put_integer(t, e->samples);
  else table_put_missing(t);
  table_put_text(t, !e->samples ? NULL : e->restart == HBM_RESTART_SAMPLE ? "sample" : "interpolated");
  table_put_real(t, h->omega_factor);
  table_put_real(t, h->value_factor);
  table_put_text(t, verify_quantity_name(&h->quantity, name));
}

static void note_truth(table *t, const scene *sc, const verify_data *data, const verify_report *r)
{
  char name[VERIFY_QUANTITY_TEXT];
  table_note(t, "%s", sc->title);
  table_note(t, "truth: H = %d, exact forces, harmonic 0 kept; gate: %s %g", r->harmonics,
             verify_quantity_name(&data->quantity, name), r->gate);
  if (r->checked)
    table_note(t, "truth held against time integration at %d points: %.1e off at most", r->checked, r->checked_error);
  if (r->unchecked) table_note(t, "at %d points time integration found no orbit next to the truth", r->unchecked);
  if (r->checked && r->checked_error > 0.1 * r->gate) table_note(t, "the truth is NOT known to a tenth of the gate");
  if (r->curve_end != HC_OK)
    table_note(t, "the truth's curve STOPPED at omega = %.10g: %s", r->curve_omega, hc_status_text(r->curve_end));
}

static const char *meaning_for_point(verdict v)
{
  switch (v) {
  case VERDICT_MATCH: return "on a stable solution, within the gate";
  case VERDICT_DIFFERS: return "no solution within the gate";
  case VERDICT_UNSTABLE: return "on a solution that is unstable: no motion stays there";
  case VERDICT_OTHER_BRANCH: return "on a stable solution, but not on the branch of its neighbours";
  case VERDICT_SOLVER_FAILED: return "no solution was found there to hold it against";
  default: return verdict_meaning(v);
  }
}

static void note_what_was_not_compared(table *t, const verify_report *r)
{
  if (r->skipped)
    table_note(t, "%d points not compared: the mean is free where a slider never slips, and the quantity contains it",
               r->skipped);
  if (r->left_out) table_note(t, "%d points at omega <= 0 left out", r->left_out);
  if (r->noise_said > 0 && !isnan(r->noise))
    table_note(t, "the points scatter around the truth by %.1e; said: %g", r->noise, r->noise_said);
  if (r->reversals > VERIFY_USUAL_REVERSALS)
    table_note(t, "the curve reverses %d times: its program wandered; each point is judged by itself", r->reversals);
}

static void note_verification(table *t, const scene *sc, const verify_data *data, const verify_report *r)
{
  char text[VERIFY_TEXT];
  note_truth(t, sc, data, r);
  for (int v = 0; v < VERDICT_COUNT; ++v)
    if (r->count[v]) table_note(t, "%d %s: %s", r->count[v], verdict_name((verdict)v), meaning_for_point((verdict)v));
  note_what_was_not_compared(t, r);
  table_note(t, "%s", verify_sentence(r, text));
  table_note(t, "cause: %s", verify_word(r, text));
  if (r->nearest_guess) table_note(t, "nearest guess: %s", verify_cause_words(r->nearest_guess, text));
}

static void put_summary(table *t, const verify_data *data, const verify_report *r)
{
  char text[VERIFY_TEXT], name[VERIFY_QUANTITY_TEXT];
  table_put_text(t, verify_word(r, text));
  table_put_text(t, r->nearest_guess ? verify_cause_words(r->nearest_guess, text) : NULL);
  table_put_text(t, verify_quantity_name(&data->quantity, name));
  table_put_integer(t, r->n_rows);
  table_put_integer(t, r->count[VERDICT_MATCH]);
  table_put_integer(t, r->count[VERDICT_DIFFERS]);
  table_put_integer(t, r->count[VERDICT_UNSTABLE]);
  table_put_integer(t, r->count[VERDICT_OTHER_BRANCH]);
  table_put_integer(t, r->count[VERDICT_SOLVER_FAILED]);
  table_put_integer(t, r->skipped);
  table_put_integer(t, r->left_out);
  table_put_integer(t, r->reversals);
  table_put_real(t, r->truth_distance);
  table_put_real(t, r->noise);
  table_put_text(t, verify_sentence(r, text));
}

/* Points and what came out; the table on a screen has no summary, since the remarks say it, csv the points alone. */
static int write_tables(const cli_common *common, const scene *sc, const verify_data *data, const verify_report *r)
{
  table_column own[N_COLUMNS];
  const int n_columns = cli_columns(cli_extra_columns(sc), N_COLUMNS, columns, own);
  table *points = table_new("Points", n_columns, own),
        *hypotheses = table_new("Hypotheses", N_HYPOTHESIS_COLUMNS, hypothesis_columns),
        *summary = table_new("Summary", N_SUMMARY_COLUMNS, summary_columns), *tables[3] = {points};
  int n = 1;
  for (int i = 0; i < r->n_rows; ++i) put_row(points, sc, &data->quantity, &r->rows[i]);
  for (int i = 0; i < r->n_hypotheses && i < VERIFY_SHOWN; ++i)
    put_hypothesis(hypotheses, &r->hypotheses[i], r->truth_distance);
  table_spare(hypotheses, spare_hypothesis_columns);
  put_summary(summary, data, r);
  note_verification(points, sc, data, r);
  if (r->n_hypotheses && common->format != FORMAT_CSV) tables[n++] = hypotheses;
  if (common->format == FORMAT_JSON) tables[n++] = summary;
  int code = cli_write(common, n, tables);
  table_free(points);
  table_free(hypotheses);
  table_free(summary);
  return code;
}

/* The curve of --against, read as --columns and --quantity say. 0 or the exit code after the message. */
static int read_curve(const cli_common *common, const verify_options *own, verify_data *data)
{
  verify_columns where;
  char words[VERIFY_TEXT];
  if (!own->against) {
    cli_message(common, "no --against given, expected --against FILE");
    return EXIT_USAGE;
  }
  if (verify_columns_read(own->columns, own->quantity, &where, words) != HC_OK) {
    cli_message(common, "%s", words);
    return EXIT_USAGE;
  }
  double noise = 0;
  if (own->noise &&
      (number_read(own->noise, strlen(own->noise), &noise) != NUMBER_FINE || !(noise >= 0) || noise > 1)) {
    cli_message(common, "--noise: '%.40s' is no scatter, expected a number from 0 to 1 such as 1e-2", own->noise);
    return EXIT_USAGE;
  }
  hc_status st = verify_data_read(own->against, &where, data, words);
  data->noise = noise;
  if (st == HC_OK) return 0;
  fprintf(stderr, "%s\n", words);
  return st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
}

static int run_verify(int argc, char **argv)
{
  cli_common common;
  verify_options own = {0};
  scene sc = {.structure = NULL};
  verify_data data = {0};
  verify_report report = {0};
  int written = 0;
  cli_parse(&cmd_verify, argc, argv, &own, &common);
  cli_check_plot(&common, own.plot, false);
  const cli_file files[] = {{"the curve", own.against, CLI_INPUT}, {"--plot", own.plot, CLI_OUTPUT}};
  int code = cli_check_files(&common, 2, files);
  if (!code) code = cli_load_case(&common, common.arguments[0], &sc);
  if (!code) code = read_curve(&common, &own, &data);
  if (!code) {
    progress *bar = progress_start("verifying", common.quiet);
    hc_monitor monitor = progress_monitor(bar);
    compare_setup setup;
    data.with_line = own.plot;
    hc_status st = scene_setup(&sc, &setup);
    if (st == HC_OK) st = verify_run(&setup, &data, &monitor, &report);
    scene_setup_clear(&setup);
    progress_end(bar);
    code = st == HC_OK ? verify_exit_code(&report) : cli_solver_failed(&common, CLI_BOTH, "the verification", st, 0);
    if (code == EXIT_NO_SOLUTION && st == HC_OK)
      cli_message(&common, "some points could not be judged; the notes of the table say why");
    written = report.n_rows ? write_tables(&common, &sc, &data, &report) : 0;
    plot_order drawing = {.path = own.plot};
    if (own.plot && st != HC_NO_MEMORY && !written)
      written = cli_plotted(&common, plot_verify(&drawing, &sc, &data, &report), drawing.why);
  }
  verify_clear(&report);
  verify_data_clear(&data);
  case_clear(&sc);
  return code ? code : written;
}

const cli_command cmd_verify = {
    .name = "verify",
    .summary = "another code's response curve held against both, and the suspected cause where it is off",
    .arguments = "CASE",
    .help = help,
    .options = options,
    .read_option = read_option,
    .run = run_verify,
};
