/* cmd_transient.c - hbmcheck transient: the steady state by CVODE at given frequencies. */
#include "command/cli.h"
#include "command/plot/plot.h"
#include "compare/steady_states.h"
#include "output/progress.h"

static const char doc[] =
    "The steady state of CASE by time integration (CVODE) at the omegas of --at. It starts where transient.start "
    "says: on each HBM solution's "
    "orbit (hbm), at rest, or swept from an end of the sweep, as on a shaker (up, down)."
    "\vColumns: closure = estimated distance to the periodic orbit relative to the amplitude, steps = CVODE's.\n"
    "exit: 0 all settled  2 case file wrong  3 one did not (which and why on stderr)  64 usage\n"
    "example: hbmcheck transient cases/paper/case2.yaml --at 8,9 --set transient.start=up";

static const struct argp_option options[] = {
    {"at", CLI_AT, "LIST", 0, "Omegas, rad per unit time [compare.omega of the case]", 1},
    CLI_PLOT_OPTION,
    {0},
};

static void show(const cli_options *o, const steady_row *r, table *t, int *code)
{
  static const char *const stages[] = {[STEADY_TRANSIENT] = "time integration",
                                       [STEADY_SWEEP] = "the frequency sweep",
                                       [STEADY_HBM] = "harmonic balance"};
  row_cell cells[ROWS_MOST];
  if (r->without_hbm != HC_OK && !o->quiet)
    cli_say(o, "no HBM solution at omega = %.10g (%s): starting at rest", r->result.omega,
            hc_status_text(r->without_hbm));
  if (r->status == HC_INTERRUPTED) return;
  if (r->stage == STEADY_TRANSIENT) {
    rows_transient(r, cells);
    cli_put_row(t, ROWS_TRANSIENT, cells);
  }
  if (r->status != HC_OK && r->status != HC_APERIODIC)
    *code = cli_solver_failed(o, stages[r->stage], r->status, r->result.omega);
}

int cmd_transient(int argc, char **argv)
{
  cli_options o;
  scene sc;
  cli_parse(argc, argv, "transient", "CASE", doc, options, true, &o);
  int code = cli_load_case(&o, &sc), n_columns;
  if (code) return code;
  if (o.at.n) sc.compare.omega = o.at;
  if (sc.compare.omega.n == 0) {
    cli_say(&o, "at which omega? give --at LIST, or compare.omega in the case");
    return EXIT_USAGE;
  }
  progress *bar = progress_start("time integration", o.quiet);
  hc_monitor monitor = progress_monitor(bar);
  steady_states found = {0};
  compare_setup setup;
  hc_status st = scene_setup(&sc, &setup);
  if (st == HC_OK) st = steady_states_run(&setup, &monitor, &found);
  scene_setup_clear(&setup);
  progress_end(bar);
  const table_column *columns = rows_columns(ROWS_TRANSIENT, &n_columns);
  table *t = table_new("Steady states", n_columns, columns);
  for (int i = 0; i < found.n; ++i) show(&o, &found.rows[i], t, &code);
  if (st != HC_OK) {
    table_note(t, "INCOMPLETE: %s", hc_status_text(st));
    code = cli_solver_failed(&o, "time integration", st, 0);
  }
  int written = st == HC_OK || found.n ? cli_write(&o, 1, &t) : 0;
  plot_order drawing = {.path = o.plot};
  if (o.plot && found.n && !written) written = cli_plotted(&o, plot_transient(&drawing, &sc, &found), drawing.why);
  table_free(t);
  steady_states_clear(&found);
  return code ? code : written;
}
