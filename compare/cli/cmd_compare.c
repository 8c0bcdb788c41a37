/* cmd_compare.c - hbmcheck compare: the main job. */
#include <math.h>
#include <stdio.h>

#include "compare/cli/cli.h"
#include "compare/measure/comparison.h"
#include "compare/show/progress.h"

static const char doc[] =
    "Solve CASE by harmonic balance and by time integration at the same frequencies; report how far apart they are, and a verdict for every "
    "frequency and branch."
    "\vAn error is |hbm - transient| / the transient's amplitude; the limits are the case's gate.\n"
    "exit: 0 agreed  1 a transient differs from every HBM solution  2 case file wrong  3 something could not be compared  64 usage\n"
    "example: hbmcheck compare cases/paper/case2.yaml --set hbm.static=false";

static const struct argp_option options[] = {
    {"at", CLI_AT, "LIST", 0, "Omegas, rad per unit time [compare.omega, else compare.points over the sweep]", 1},
    {0},
};

static const table_column columns[] = {
    {"omega", TABLE_REAL},           {"branch", TABLE_INTEGER},       {"verdict", TABLE_TEXT},
    {"hbm_amplitude", TABLE_REAL},   {"transient_amplitude", TABLE_REAL}, {"amplitude_error", TABLE_REAL},
    {"harmonic_1_error", TABLE_REAL}, {"mean_error", TABLE_REAL},     {"waveform_error", TABLE_REAL},
    {"hbm_harmonic_1", TABLE_REAL},  {"transient_harmonic_1", TABLE_REAL}, {"periods", TABLE_INTEGER},
};

static void put_row(table *t, const comparison_row *r)
{
  bool has_transient = r->transient_status == HC_OK || r->transient_status == HC_NOT_SETTLED;
  table_put_real(t, r->omega);
  if (r->branch >= 0) table_put_integer(t, r->branch);
  else table_put_missing(t);
  char verdict_text[24];
  table_put_text(t, comparison_verdict_text(r, verdict_text));
  table_put_real(t, r->branch >= 0 && r->hbm_status == HC_OK ? r->hbm.amplitude : NAN);
  table_put_real(t, has_transient ? r->transient.amplitude : NAN);
  const double errors[] = {r->errors.amplitude, r->errors.harmonic_1, r->errors.mean, r->errors.waveform};
  for (int i = 0; i < 4; ++i) table_put_real(t, errors[i]);
  table_put_real(t, r->branch >= 0 && r->hbm_status == HC_OK ? r->hbm.harmonic_1 : NAN);
  table_put_real(t, has_transient ? r->transient.harmonic_1 : NAN);
  if (has_transient) table_put_integer(t, r->transient.periods);
  else table_put_missing(t);
}

static void put_notes(table *t, const scene *sc, const comparison *c)
{
  table_note(t, "%s", sc->title);
  char how[128];
  table_note(t, "HBM: %s. Transient: regularised law, %g, closure %g", cli_hbm_settings(sc, c->harmonics, c->samples, how, sizeof how), sc->transient.regularisation,
             sc->transient.tolerance);
  table_note(t, "gate: amplitude %g, harmonic_1 %g, mean %g, waveform %g of the transient's amplitude", sc->gate.amplitude, sc->gate.harmonic_1,
             sc->gate.mean, sc->gate.waveform);
  if (c->curve.end != HC_OK && c->curve.n)
    table_note(t, "the HBM curve STOPPED at omega = %.10g: %s", c->curve.points[c->curve.n - 1].omega, hc_status_text(c->curve.end));
  int unaccounted = 0;
  for (int i = 0; i < c->n_rows; ++i)
    unaccounted += c->rows[i].transient_status == HC_OK && c->rows[i].hbm_status == HC_OK && !c->rows[i].accounted;
  if (unaccounted) table_note(t, "%d transient%s NO HBM solution of this curve within the gate", unaccounted, unaccounted == 1 ? " matches" : "s match");
  for (int v = 0; v < VERDICT_COUNT; ++v)
    if (c->count[v]) table_note(t, "%d %s: %s", c->count[v], verdict_name((verdict)v), verdict_meaning((verdict)v));
}

static void say_failures(const cli_options *o, const comparison *c)
{
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    if (r->hbm_status != HC_OK) cli_solver_failed(o, "harmonic balance", r->hbm_status, r->omega);
    else if (r->transient_status != HC_OK) cli_solver_failed(o, "time integration", r->transient_status, r->omega);
  }
  if (c->curve.end != HC_OK && c->curve.n)
    cli_solver_failed(o, "the HBM response curve", c->curve.end, c->curve.points[c->curve.n - 1].omega);
}

int cmd_compare(int argc, char **argv)
{
  cli_options o;
  scene sc;
  comparison c;
  cli_parse(argc, argv, "compare", "CASE", doc, options, true, &o);
  int code = cli_load_case(&o, &sc);
  if (code) return code;
  if (o.at.n) sc.compare.omega = o.at;
  progress *bar = progress_start("comparing", o.quiet);
  hc_monitor monitor = progress_monitor(bar);
  hc_status st = comparison_run(&sc, &monitor, &c);
  progress_end(bar);
  if (st != HC_OK) code = cli_solver_failed(&o, "the comparison", st, 0);
  else code = comparison_exit_code(&c);
  table *t = table_new("HBM against time integration", sizeof columns / sizeof *columns, columns);
  for (int i = 0; i < c.n_rows; ++i) put_row(t, &c.rows[i]);
  put_notes(t, &sc, &c);
  say_failures(&o, &c);
  int written = c.n_rows ? cli_write(&o, 1, &t) : 0;
  table_free(t);
  comparison_clear(&c);
  return code ? code : written;
}
