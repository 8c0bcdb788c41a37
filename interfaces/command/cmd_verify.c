/* cmd_verify.c - hbmcheck verify: another code's curve, point by point, and the suspected cause. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/duration.h"
#include "compare/output/progress.h"
#include "compare/verify/verify.h"
#include "interfaces/command/call.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/cli.h"
#include "interfaces/command/commands.h"
#include "model/casefile/structure.h"
#include "numerics/base/number.h"

/* ---- which curves of the file ------------------------------------------------------------ */

/* Which curves of the file are judged: a column of values for each, and whose they are. Only what stands behind an @ is
 * read here: the rest of --columns is verify_columns_read's to judge. */
enum { VERIFY_MOST_CURVES = CLI_MOST_TEXTS, VERIFY_CURVE_TEXT = 1024 };

typedef struct verify_asked {
  const char *columns, *quantity; /* NULL: not given */
  cli_texts responses;            /* each --response */
} verify_asked;

typedef struct verify_curve {
  char columns[VERIFY_CURVE_TEXT]; /* for verify_columns_read; empty: by the header */
  int response;                    /* of the model, counted from 0 */
  char name[RESPONSE_NAME];        /* of the response, empty of an oscillator */
} verify_curve;

/* NAME=COLUMN or NAME@RESPONSE=COLUMN of the list. */
typedef struct entry {
  const char *text;
  size_t length, name; /* of all of it; of NAME alone */
  const char *at;      /* the @, NULL: none */
} entry;

static entry entry_at(const char *text)
{
  entry e = {.text = text, .length = strcspn(text, ",")};
  const size_t equals = strcspn(text, "=,");
  e.at = memchr(text, '@', equals);
  e.name = e.at ? (size_t)(e.at - text) : equals;
  return e;
}

static bool is_frequency(const entry *e)
{
  return (e->name == 5 && !memcmp(e->text, "omega", 5)) || (e->name == 9 && !memcmp(e->text, "frequency", 9));
}

static bool set_response(const cli_common *common, const char *name, verify_curve *out)
{
  const scene *sc = common->scene;
  out->response = name ? cli_response_named(common, name) : 0;
  if (out->response >= 0 && !scene_is_oscillator(sc))
    structure_response_name(sc->structure, out->response, out->name, sizeof out->name);
  return out->response >= 0;
}

/* The list again with no other values than those of entry `kept`, and that without its @. */
static bool keep_one(const cli_common *common, const char *list, const char *kept, verify_curve *out)
{
  size_t used = 0;
  out->columns[0] = 0;
  for (const char *text = list;; ++text) {
    const entry e = entry_at(text);
    const size_t behind = e.at ? strcspn(e.at, "=,") : 0;
    const bool wanted = is_frequency(&e) || text == kept;
    if (wanted && used + e.length + 2 > sizeof out->columns) return false;
    if (wanted) {
      const char *rest = e.at ? e.at + behind : e.text + e.name;
      used += (size_t)snprintf(out->columns + used, sizeof out->columns - used, "%s%.*s%.*s", used ? "," : "",
                               (int)e.name, e.text, (int)(e.length - (size_t)(rest - e.text)), rest);
    }
    if (text == kept && e.at) {
      char name[CLI_NAME];
      snprintf(name, sizeof name, "%.*s", (int)(behind - 1), e.at + 1);
      if (!set_response(common, name, out)) return false;
    }
    text += e.length;
    if (!*text) return true;
  }
}

/* One curve for each entry with an @. -1 after a message. */
static int curves_of_list(const cli_common *common, const verify_asked *asked, verify_curve *out)
{
  int n = 0;
  for (const char *text = asked->columns; text; ++text) {
    const entry e = entry_at(text);
    if (e.at && n == VERIFY_MOST_CURVES)
      return cli_failed(common, -1, "--columns: more than %d responses", VERIFY_MOST_CURVES);
    if (e.at && asked->responses.n)
      return cli_failed(common, -1, "--columns names a response behind @ and --response another way; give one of them");
    if (e.at && !keep_one(common, asked->columns, text, &out[n++])) return -1;
    text += e.length;
    if (!*text) break;
  }
  return n;
}

/* "omega=1,rms@tip=2,rms@root=3" is two curves; without @ one of each --response, or the first. 0 after a message. */
static int verify_curves_of(const cli_common *common, const verify_asked *asked, verify_curve *out)
{
  memset(out, 0, VERIFY_MOST_CURVES * sizeof *out);
  int n = curves_of_list(common, asked, out);
  if (n != 0) return n < 0 ? 0 : n;
  if (asked->columns && strlen(asked->columns) >= sizeof out->columns)
    return cli_failed(common, 0, "--columns: longer than %zu letters", sizeof out->columns - 1);
  n = asked->responses.n ? asked->responses.n : 1;
  for (int i = 0; i < n; ++i) {
    if (!set_response(common, asked->responses.n ? asked->responses.text[i] : NULL, &out[i])) return 0;
    if (asked->columns) snprintf(out[i].columns, sizeof out->columns, "%s", asked->columns);
  }
  return n;
}

static const char help[] =
    "You have a curve of another program or a measurement, a file of columns: compares it with harmonic balance with "
    "exact forces and many harmonics, itself compared with time integration; a verdict for every point, and where "
    "they differ the suspected cause."
    "\vFILE: fields separated by comma, semicolon, tab or blanks; # starts a remark; any order, several branches. "
    "Without --columns the header says what is what: omega or frequency, and a quantity. COLUMN is a number from 1 "
    "or a name in the header. omega is in rad per unit time, frequency in cycles per unit time.\n"
    "QUANTITY: amplitude = (max - min)/2 of x, double_amplitude, peak = max |x|, max, min, mean, rms, norm = "
    "sqrt(X0^2 + sum (a_k^2 + b_k^2)), norm_over_root_2 (NLvib's rms), harmonic_K = |a_K + i b_K|, velocity and "
    "acceleration = (max - min)/2 of x' and x'', velocity_harmonic_K, acceleration_harmonic_K; dB_ before any: 20 "
    "log10 of it. docs/verify.md has the formulas and all causes.\n"
    "A point matches within the case's gate.amplitude, gate.harmonic_1 or gate.mean. Where a slider never slips the "
    "mean is open, and what contains it is not compared. With --noise S, points match that are within the gate and 4 "
    "S, and on the average of m neighbours, up to 25, within the gate and 4 S/sqrt(m). With csv only the points, the "
    "cause in the remarks.\n"
    "exit: 0 every point matches  1 some do not, or run along the wrong branch  2 a file is wrong  3 could not be "
    "judged  64 usage\n"
    "example: hbmcheck verify cases/verify/case2.yaml --against cases/verify/no_static.csv --columns "
    "omega=1,harmonic_1=2";

typedef struct verify_options {
  const char *against, *noise, *patience; /* NULL: not given */
  verify_asked asked;
} verify_options;

static const cli_option options[] = {
    {CLI_TEXT, "against", "FILE", "The curve to hold against ours", offsetof(verify_options, against),
     .file = "the curve", .use = CLI_INPUT},
    {CLI_TEXT, "columns", "NAME=COLUMN,...",
     "Where its columns are: omega or frequency, value or QUANTITY (@RESPONSE: of several) [the header's names]",
     offsetof(verify_options, asked.columns)},
    {CLI_TEXT, "quantity", "QUANTITY", "What the column named value is, or which is meant",
     offsetof(verify_options, asked.quantity)},
    {CLI_TEXTS, "response", "NAME", "Of a structure: whose values [the first]",
     offsetof(verify_options, asked.responses)},
    {CLI_TEXT, "noise", "S", "A measured curve: standard deviation of its values relative to the amplitude [0]",
     offsetof(verify_options, noise)},
    {CLI_TEXT, "patience", "SECONDS", "Processor time of the search for a cause [30]",
     offsetof(verify_options, patience)},
    CLI_PLOT_OPTION,
    {0},
};

static const table_column columns[] = {REAL("omega"),     REAL("frequency"), REAL("value"),  REAL("nearest"),
                                       INTEGER("branch"), TEXT("response"),  TEXT("stable"), REAL("error"),
                                       TEXT("verdict"),   INTEGER("line")};
static const table_column hypothesis_columns[] = {TEXT("response"),       TEXT("cause"),          REAL("distance"),
                                                  REAL("truth_distance"), INTEGER("harmonics"),   TEXT("static"),
                                                  INTEGER("samples"),     TEXT("slider_restart"), REAL("omega_factor"),
                                                  REAL("value_factor"),   TEXT("quantity")};
static const table_column summary_columns[] = {
    TEXT("response"),   TEXT("cause"),        TEXT("nearest_guess"), TEXT("quantity"),        INTEGER("points"),
    INTEGER("match"),   INTEGER("differs"),   INTEGER("unstable"),   INTEGER("other_branch"), INTEGER("solver_failed"),
    INTEGER("skipped"), INTEGER("left_out"),  INTEGER("reversals"),  REAL("truth_distance"),  REAL("noise"),
    TEXT("sentence"),   INTEGER("harmonics"), INTEGER("checked"),    INTEGER("unchecked"),    REAL("checked_error"),
    REAL("gate")};
enum { N_SUMMARY = CLI_LENGTH(summary_columns), FOR_PROGRAMS = 5 /* the last of them */ };
static const char *const spare_hypothesis_columns[] = {"slider_restart", "omega_factor",   "value_factor",
                                                       "static",         "truth_distance", "quantity",
                                                       "samples",        "harmonics",      NULL};

/* The curves of the file, and what came of them. */
typedef struct verify_call {
  cli_common *common;
  const verify_options *own;
  scene *sc;
  int n;                                   /* curves */
  verify_curve curves[VERIFY_MOST_CURVES]; /* [n] */
  verify_data data[VERIFY_MOST_CURVES];    /* [n] */
  verify_report *reports;                  /* [n] */
  verify_effort effort;
} verify_call;

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

static void note_verification(table *t, const scene *sc, const verify_data *data, const verify_report *r)
{
  char text[VERIFY_TEXT];
  char name[VERIFY_QUANTITY_TEXT];
  table_note(t, "truth: H = %d, exact forces, harmonic 0 kept; gate: %s %g", r->harmonics,
             verify_quantity_name(&data->quantity, name), r->gate);
  if (r->checked)
    table_note(t, "truth held against time integration at %d points: %.1e off at most", r->checked, r->checked_error);
  if (r->unchecked) table_note(t, "at %d points time integration found no orbit next to the truth", r->unchecked);
  if (r->checked && r->checked_error > 0.1 * r->gate) table_note(t, "the truth is NOT known to a tenth of the gate");
  if (r->on_orbits) table_note(t, "%d points are on the orbits of time integration themselves", r->on_orbits);
  if (r->curve_end != HC_OK)
    table_note(t, "the truth's curve STOPPED at omega = %.10g: %s", r->curve_omega, hc_status_text(r->curve_end));
  for (int v = 0; v < VERDICT_COUNT; ++v)
    if (r->count[v]) table_note(t, "%d %s: %s", r->count[v], verdict_name((verdict)v), meaning_for_point((verdict)v));
  if (r->skipped)
    table_note(t, "%d points not compared: the mean is free where a slider never slips, and the quantity contains it",
               r->skipped);
  int open = 0;
  for (int i = 0; i < r->n_rows; ++i) open += r->rows[i].free_sliders && r->rows[i].verdict == VERDICT_DIFFERS;
  if (open && !scene_is_oscillator(sc))
    table_note(t,
               "%d points that differ are where a slider never slips: where it rests is a matter of history, and with "
               "several contacts or a varying normal force so is the motion; ours starts from w = 0",
               open);
  if (r->left_out) table_note(t, "%d points at omega <= 0 left out", r->left_out);
  if (r->noise_said > 0 && !isnan(r->noise))
    table_note(t, "the points scatter around the truth by %.1e; said: %g", r->noise, r->noise_said);
  if (r->reversals > VERIFY_USUAL_REVERSALS)
    table_note(t, "the curve reverses %d times: its program wandered; each point is judged by itself", r->reversals);
  table_note(t, "%s", verify_sentence(r, text));
  table_note(t, "cause: %s", verify_word(r, text));
  if (r->nearest_guess) table_note(t, "nearest guess: %s", verify_cause_words(r->nearest_guess, text));
  const verify_causes unsolved = r->unsolved & ~(r->causes | r->nearest_guess);
  if (unsolved) table_note(t, "not judged, since solutions are missing: %s", verify_cause_words(unsolved, text));
  if (!r->causes && *r->tried) table_note(t, "tried: %s", r->tried);
  if (*r->not_tried) table_note(t, "NOT tried, out of patience (--patience): %s", r->not_tried);
}

/* Points and what came out; the table on a screen has no summary, since the remarks say it, csv the points alone. */
static int write_tables(const verify_call *call)
{
  const scene *sc = call->sc;
  const bool of_structure = !scene_is_oscillator(sc), more = call->common->call != NULL;
  const unsigned extra = cli_extra_columns(sc);
  char words[VERIFY_TEXT], guess[VERIFY_TEXT], sentence[VERIFY_TEXT], name[VERIFY_QUANTITY_TEXT];
  table *points = cli_own_table("Points", extra, CLI_COLUMNS(columns)),
        *hypotheses = cli_own_table("Hypotheses", extra, CLI_COLUMNS(hypothesis_columns)),
        *summary =
            cli_own_table("Summary", extra, N_SUMMARY - (call->common->call ? 0 : FOR_PROGRAMS), summary_columns),
        *tables[3] = {points};
  int n = 1, n_hypotheses = 0;
  table_note(points, "%s", sc->title);
  for (int k = 0; k < call->n; ++k) {
    const verify_report *r = &call->reports[k];
    const verify_data *data = &call->data[k];
    const char *response = call->curves[k].name;
    for (int i = 0; i < r->n_rows; ++i) {
      const verify_row *row = &r->rows[i];
      const verify_quantity *q = &data->quantity;
      const char *stable = row->stable > 0 ? "yes" : row->stable < 0 ? "no" : "unknown";
      TABLE_ROW(points, CELL(row->omega), CELL_OF(sc->in_cycles, scene_frequency(sc, row->omega)),
                CELL(verify_quantity_to_column(q, row->value)), CELL(verify_quantity_to_column(q, row->nearest)),
                CELL_IF(row->branch >= 0, row->branch), CELL_OF(of_structure, response),
                CELL_IF(row->branch >= 0, stable), CELL(row->error),
                CELL(row->skipped ? "skipped" : verdict_name(row->verdict)), CELL(row->line));
    }
    for (int i = 0; i < r->n_hypotheses && (i < VERIFY_SHOWN || call->common->call); ++i) {
      const verify_hypothesis *h = &r->hypotheses[i];
      const verify_equations *e = &h->equations;
      const bool linear = verify_equations_linear(e);
      TABLE_ROW(hypotheses, CELL_OF(of_structure, response), CELL(verify_cause_words(h->causes, words)),
                CELL(h->distance), CELL(r->truth_distance), CELL_IF(!linear, e->harmonics),
                CELL_IF(!linear, e->keep_mean ? "true" : "false"), CELL_IF(e->samples > 0, e->samples),
                CELL_IF(e->samples > 0, e->restart == HBM_RESTART_SAMPLE ? "sample" : "interpolated"),
                CELL(h->omega_factor), CELL(h->value_factor), CELL(verify_quantity_name(&h->quantity, name)));
    }
    n_hypotheses += r->n_hypotheses;
    TABLE_ROW(summary, CELL_OF(of_structure, response), CELL(verify_word(r, words)),
              CELL(r->nearest_guess ? verify_cause_words(r->nearest_guess, guess) : NULL),
              CELL(verify_quantity_name(&data->quantity, name)), CELL(r->n_rows), CELL(r->count[VERDICT_MATCH]),
              CELL(r->count[VERDICT_DIFFERS]), CELL(r->count[VERDICT_UNSTABLE]), CELL(r->count[VERDICT_OTHER_BRANCH]),
              CELL(r->count[VERDICT_SOLVER_FAILED]), CELL(r->skipped), CELL(r->left_out), CELL(r->reversals),
              CELL(r->truth_distance), CELL(r->noise), CELL(verify_sentence(r, sentence)), CELL_OF(more, r->harmonics),
              CELL_OF(more, r->checked), CELL_OF(more, r->unchecked), CELL_OF(more, r->checked_error),
              CELL_OF(more, r->gate));
    if (!scene_is_oscillator(sc)) table_note(points, "response %s", response);
    note_verification(points, sc, data, r);
  }
  table_spare(hypotheses, spare_hypothesis_columns);
  if (n_hypotheses && call->common->format != FORMAT_CSV) tables[n++] = hypotheses;
  if (call->common->format == FORMAT_JSON) tables[n++] = summary;
  int code = cli_write(call->common, n, tables);
  table_free(points);
  table_free(hypotheses);
  table_free(summary);
  return code;
}

/* Curve k of --against, read as --columns and --quantity say. 0 or the exit code after the message. */
static int read_curve(verify_call *call, double noise, int k)
{
  const cli_common *common = call->common;
  const verify_curve *curve = &call->curves[k];
  verify_data *data = &call->data[k];
  verify_columns where;
  char words[VERIFY_TEXT];
  if (verify_columns_read(*curve->columns ? curve->columns : NULL, call->own->asked.quantity, &where, words) != HC_OK)
    return cli_failed(common, EXIT_USAGE, "%s", words);
  where.response = !scene_is_oscillator(call->sc) ? curve->name : NULL;
  const cli_call *from = common->call;
  hc_status st = from && from->points ? verify_data_of(call->own->asked.quantity, noise, from->n_points, from->points,
                                                       from->points + from->n_points, data, words)
                                      : verify_data_read(call->own->against, &where, data, words);
  data->noise = noise;
  data->response = curve->response;
  data->with_line = common->drawing.path;
  if (st != HC_OK) {
    cli_ended(common, st);
    cli_say(common, "%s", words);
    return st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
  }
  const char *refused = !scene_is_oscillator(call->sc) ? verify_quantity_refused_of_structure(&data->quantity) : NULL;
  if (refused) return cli_failed(common, EXIT_BAD_CASE, "%s", refused);
  if (call->own->asked.responses.n > 1 && !data->by_response)
    return cli_failed(common, EXIT_USAGE,
                      "several --response, and %s has no column `response`; expected one, or --columns with "
                      "QUANTITY@RESPONSE for each",
                      call->own->against);
  return 0;
}

/* What is heard of a search that takes longer. */
static void say_so_far(void *self, const verify_report *r)
{
  const verify_call *call = self;
  char text[VERIFY_TEXT];
  const verify_causes found = r->causes | r->nearest_guess;
  progress_erase();
  cli_message(call->common, "so far: %s; the search goes on (--patience)",
              found ? verify_cause_words(found, text) : "no cause fits");
}

/* All of them. 0 or the exit code after the message. */
static int read_curves(verify_call *call)
{
  const char *said = call->own->noise, *patience = call->own->patience;
  double noise = 0;
  const bool handed_in = call->common->call && call->common->call->points;
  if (!call->own->against && !handed_in)
    return cli_failed(call->common, EXIT_USAGE, "no --against given, expected --against FILE");
  const int n = verify_curves_of(call->common, &call->own->asked, call->curves);
  if (n == 0) return EXIT_USAGE;
  if (n > 1 && call->common->drawing.path)
    return cli_failed(call->common, EXIT_USAGE, "--plot draws one response, and there are %d; name one", n);
  if (said && (number_read(said, strlen(said), &noise) != NUMBER_FINE || !(noise >= 0) || noise > 1))
    return cli_failed(call->common, EXIT_USAGE,
                      "--noise: '%.40s' is no scatter, expected a number from 0 to 1 such as 1e-2", said);
  double *seconds = &call->effort.patience;
  if (patience && (number_read(patience, strlen(patience), seconds) != NUMBER_FINE || !(*seconds > 0)))
    return cli_failed(call->common, EXIT_USAGE, "--patience: '%.40s' is no time, expected seconds > 0 such as 30",
                      patience);
  if (cli_foretells(call->common)) call->effort.say = say_so_far, call->effort.self = call;
  if (!(call->reports = calloc((size_t)n, sizeof *call->reports)))
    return cli_solver_failed(call->common, CLI_BOTH, "the verification", HC_NO_MEMORY, 0);
  for (int code; call->n < n; ++call->n)
    if ((code = read_curve(call, noise, call->n)) != 0) return ++call->n, code;
  return 0;
}

/* The worse of two exit codes: what differs is worse than what could not be judged. */
static int worse(int a, int b)
{
  if (a == EXIT_DISAGREED || b == EXIT_DISAGREED) return EXIT_DISAGREED;
  return a ? a : b;
}

/* The exit code, after a message where one is due; *st of the last curve that was begun. */
static int verify_curves(verify_call *call, hc_status *st)
{
  compare_setup setup;
  int code = 0;
  *st = scene_setup(call->sc, &setup);
  if (*st == HC_OK && cli_foretells(call->common)) { /* one model for all curves of the file */
    duration_units u;
    double seconds = 0;
    int points = 0;
    duration_measure(&setup, &u);
    for (int k = 0; k < call->n; ++k) {
      seconds += duration_of_verification(&u, call->data[k].n);
      points += call->data[k].n;
    }
    cli_foretell_time(call->common, seconds, points, setup.model);
  }
  progress *bar = cli_progress(call->common, "verifying");
  hc_monitor monitor = progress_monitor(bar);
  if (*st == HC_OK) *st = verify_run(&setup, call->n, call->data, &call->effort, &monitor, call->reports);
  for (int k = 0; k < call->n && *st == HC_OK; ++k) code = worse(code, verify_exit_code(&call->reports[k]));
  scene_setup_clear(&setup);
  progress_end(bar);
  cli_ended(call->common, *st);
  if (*st != HC_OK) return cli_solver_failed(call->common, CLI_BOTH, "the verification", *st, 0);
  if (code == EXIT_NO_SOLUTION)
    cli_message(call->common, "some points could not be judged; the notes of the table say why");
  return code;
}

static int run_verify(cli_common *common, void *own, scene *sc)
{
  verify_call *call = calloc(1, sizeof *call);
  if (!call) return cli_solver_failed(common, CLI_BOTH, "the verification", HC_NO_MEMORY, 0);
  call->common = common, call->own = own, call->sc = sc;
  int written = 0, code = read_curves(call);
  if (!code) {
    hc_status st;
    code = verify_curves(call, &st);
    written = call->reports->n_rows ? write_tables(call) : 0;
    if (common->drawing.path && st != HC_NO_MEMORY && !written)
      written = cli_plotted(common, plot_verify(&common->drawing, sc, call->data, call->reports));
  }
  for (int k = 0; k < call->n; ++k) {
    if (call->reports) verify_clear(&call->reports[k]);
    verify_data_clear(&call->data[k]);
  }
  free(call->reports);
  free(call);
  return code ? code : written;
}

CLI_COMMAND(verify, verify_options, "CASE",
            "the curve of another program or a measurement, and the suspected cause where it is wrong");
