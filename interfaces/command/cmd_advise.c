/* cmd_advise.c - hbmcheck advise: how many harmonics and samples an error needs. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "compare/accuracy/sufficient.h"
#include "compare/output/progress.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"

static const char help[] =
    "You set up another program: the fewest harmonics with exact forces, and the cheapest harmonics and samples, that "
    "keep amplitude, harmonic 1, mean and waveform of CASE within E of the amplitude along the whole curve or at the "
    "frequencies of --at; and the same in words of other programs."
    "\vHeld against harmonic balance with exact forces and so many harmonics that its own predicted error is E/20 or "
    "less. Least means from here on: all greater settings tried keep E, too; a smaller one that does so by chance is "
    "in a remark. Samples are powers of two. Within E (at least 0.1 %, and of 50 half widths where those are "
    "less) of a turning point's frequency nothing is compared: few harmonics turn elsewhere.\n"
    "exit: 0 done  2 case file wrong  3 nothing keeps E, or it could not be found out  64 usage\n"
    "example: hbmcheck advise cases/paper/case2.yaml --error 1e-3";

typedef struct advise_options {
  double error;
  number_list at; /* n = 0: the whole curve */
  bool without_static;
  const char *response;
} advise_options;

static const cli_option options[] = {
    {CLI_POSITIVE, "error", "E", "Largest error, relative to the amplitude [1e-3]", offsetof(advise_options, error)},
    {CLI_LIST, "at", "LIST", "At these " CLI_FREQUENCIES " [the whole curve]", offsetof(advise_options, at)},
    {CLI_FLAG, "without-static", NULL, "Also without harmonic 0, as hbm.static: false",
     offsetof(advise_options, without_static)},
    CLI_RESPONSE_OPTION(advise_options),
    {0},
};

static const table_column columns[] = {
    TEXT("force"),    INTEGER("harmonics"), INTEGER("samples"), TEXT("static"),       REAL("error"),
    TEXT("quantity"), REAL("omega"),        REAL("frequency"),  TEXT("next_smaller"), REAL("next_smaller_error")};
static const char *const spare_columns[] = {"omega", "quantity", NULL};
static const table_column peer_columns[] = {TEXT("static"), TEXT("program"), TEXT("settings")};

/* Names: docs/advise.md, which has the sources. */
static const struct {
  const char *name, *settings; /* of harmonics, samples */
  int most_harmonics;          /* 0: any */
} programs[] = {{"NLvib", "H = %d; N = %d", 0},
                {"pyHarm", "'nh': %d, 'nti': %d", 0},
                {"tmdsimpy", "h = np.arange(%d + 1), Nt = %d", 0},
                {"Ansys", "HROPT,HBM,%d; HBMOPT,AFT for %d time points a period", 30}};

static const char *setting_text(const sufficient_row *r, int harmonics, int samples, char text[64])
{
  if (harmonics == 0) return NULL;
  if (r->sampled) snprintf(text, 64, "H = %d, N = %d", harmonics, samples);
  else snprintf(text, 64, "H = %d", harmonics);
  return text;
}

static void put_row(table *t, const scene *sc, const sufficient_row *r)
{
  char next[64];
  const bool found = r->harmonics > 0;
  TABLE_ROW(t, CELL(r->sampled ? "sampled" : "exact"), CELL_IF(found, r->harmonics),
            CELL_IF(r->samples > 0, r->samples), CELL(r->keep_mean ? "yes" : "no"), CELL(r->error),
            CELL(found ? r->quantity : NULL), CELL(r->omega),
            CELL_OF(sc->in_cycles, found ? scene_frequency(sc, r->omega) : NAN),
            CELL((char *)setting_text(r, r->next_harmonics, r->next_samples, next)),
            CELL(r->next_harmonics > 0 ? r->next_error : NAN));
  if (!found)
    table_note(t, "%s forces%s: nothing tried keeps it, up to H = %d", r->sampled ? "sampled" : "exact",
               r->keep_mean ? "" : " without harmonic 0", r->most_harmonics);
  else if (r->by_chance)
    table_note(t, "%s forces%s: least is from here on; %s = %d keeps it, too, by chance, and a greater one does not",
               r->sampled ? "sampled" : "exact", r->keep_mean ? "" : " without harmonic 0", r->sampled ? "N" : "H",
               r->by_chance);
}

static void put_notes(table *t, const scene *sc, const advise_options *own, const sufficient *s)
{
  char at[SCENE_WHERE];
  table_note(t, "%s%serror %g; %d solutions at %d frequencies, %d of them linear", sc->title, *sc->title ? ": " : "",
             own->error, s->solutions, s->frequencies, s->linear);
  table_note(t, "compared with %d harmonics, exact forces, whose own predicted error is %.2g at most", s->harmonics,
             s->predicted);
  if (s->lost)
    table_note(t, "%d solution%s left out: of few harmonics alone, or not known to E with %d", s->lost,
               s->lost == 1 ? "" : "s", s->harmonics);
  for (int i = 0; i < s->n_folds; ++i)
    table_note(t, "left out: within %g of the turning point at %s", s->strip, scene_where(sc, s->folds[i], at));
  if (s->solutions == s->linear) table_note(t, "nothing nonlinear happens there: one harmonic is as good as many");
  if (s->end != HC_OK) table_note(t, "the curve STOPPED early: %s", hc_status_text(s->end));
}

static int write_advice(const cli_common *common, const scene *sc, const advise_options *own, const sufficient *s,
                        hc_status st)
{
  table *tables[2] = {cli_own_table("Sufficient settings", cli_extra_columns(sc), CLI_COLUMNS(columns)),
                      cli_own_table("In other programs", 0, CLI_COLUMNS(peer_columns))};
  table_spare(tables[0], spare_columns + !sc->in_cycles);
  for (int i = 0; i < s->n; ++i) {
    const sufficient_row *r = &s->rows[i];
    put_row(tables[0], sc, r);
    for (size_t k = 0; k < sizeof programs / sizeof *programs && r->samples > 0; ++k) {
      char text[96];
      if (programs[k].most_harmonics && r->harmonics > programs[k].most_harmonics)
        snprintf(text, sizeof text, "not possible: %d harmonics are the most", programs[k].most_harmonics);
      else snprintf(text, sizeof text, programs[k].settings, r->harmonics, r->samples);
      table *t = tables[1];
      TABLE_ROW(t, CELL(r->keep_mean ? "yes" : "no"), CELL(programs[k].name), CELL((char *)text));
    }
  }
  put_notes(tables[0], sc, own, s);
  if (st != HC_OK) table_note(tables[0], "INCOMPLETE: %s", hc_status_text(st));
  return cli_write_all(common, 2, tables);
}

static int run_advise(cli_common *common, void *given, scene *sc)
{
  const advise_options *own = given;
  compare_setup setup;
  sufficient found = {0};
  int code = cli_keep_response(common, sc, own->response);
  if (!own->at.n) sc->compare.omega.n = 0;
  if (!code) code = cli_take_frequencies(common, &own->at, true, sc);
  if (code) return code;
  progress *bar = cli_progress(common, "trying settings");
  hc_monitor monitor = progress_monitor(bar);
  hc_status st = scene_setup(sc, &setup);
  if (st == HC_OK) st = sufficient_run(&setup, own->error, own->without_static, &monitor, &found);
  scene_setup_clear(&setup);
  progress_end(bar);
  cli_ended(common, st);
  if (st != HC_OK) code = cli_solver_failed(common, CLI_HBM, "harmonic balance", st, 0);
  const int written = found.n ? write_advice(common, sc, own, &found, st) : 0;
  for (int i = 0; i < found.n; ++i)
    if (st == HC_OK && found.rows[i].keep_mean && found.rows[i].harmonics == 0)
      code = cli_failed(common, EXIT_NO_SOLUTION, "%s forces: nothing tried keeps an error of %g",
                        found.rows[i].sampled ? "sampled" : "exact", own->error);
  return code ? code : written;
}

CLI_COMMAND(advise, advise_options, "CASE", "how many harmonics and samples keep harmonic balance within an error",
            .defaults = &(const advise_options){.error = 1e-3});
