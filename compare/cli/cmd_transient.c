/* cmd_transient.c - hbmcheck transient: the steady state by CVODE at given frequencies. */
#include <math.h>
#include <stdlib.h>

#include "compare/cli/cli.h"
#include "compare/measure/comparison.h"
#include "compare/measure/frequencies.h"
#include "compare/show/progress.h"

static const char doc[] =
    "The steady state of CASE by time integration (CVODE) at the omegas of --at. It starts where transient.start says: on each HBM solution's "
    "orbit (hbm), at rest, or swept from an end of the sweep, as on a shaker (up, down)."
    "\vColumns: closure = estimated distance to the periodic orbit relative to the amplitude, steps = CVODE's.\n"
    "exit: 0 all settled  2 case file wrong  3 one did not (which and why on stderr)  64 usage\n"
    "example: hbmcheck transient cases/paper/case2.yaml --at 8,9 --set transient.start=up";

static const struct argp_option options[] = {
    {"at", CLI_AT, "LIST", 0, "Omegas, rad per unit time [compare.omega of the case]", 1},
    {0},
};

static const table_column columns[] = {
    {"omega", TABLE_REAL},      {"verdict", TABLE_TEXT},    {"amplitude", TABLE_REAL},          {"max", TABLE_REAL},      {"min", TABLE_REAL},
    {"rms", TABLE_REAL},        {"mean", TABLE_REAL},       {"harmonic_1", TABLE_REAL},         {"periods", TABLE_INTEGER}, {"closure", TABLE_REAL},
    {"period_multiple", TABLE_INTEGER}, {"steps", TABLE_INTEGER}, {"contact", TABLE_TEXT}, {"start", TABLE_TEXT},
};

typedef struct job {
  const cli_options *o;
  const scene *sc;
  timeint *ti;
  hbm_solver *hbm;  /* NULL unless the start is on HBM orbits */
  hbm_curve curve;
  table *t;
  const hc_monitor *monitor;
  int code;
} job;

static void put_result(table *t, hc_status st, const timeint_result *r, const char *start)
{
  bool shown = st == HC_OK || st == HC_NOT_SETTLED;
  table_put_real(t, r->omega);
  char settled[24] = "settled";
  if (r->period_multiple > 1) snprintf(settled, sizeof settled, "period_%d", r->period_multiple);
  table_put_text(t, st == HC_OK ? settled : verdict_name(st == HC_NOT_SETTLED ? VERDICT_NOT_SETTLED : VERDICT_SOLVER_FAILED));
  const double values[] = {r->amplitude, r->max, r->min, r->rms, r->mean, r->harmonic_1};
  for (int i = 0; i < 6; ++i) table_put_real(t, shown ? values[i] : NAN);
  table_put_integer(t, r->periods);
  table_put_real(t, shown ? r->closure : NAN);
  table_put_integer(t, st == HC_OK ? r->period_multiple : 0);
  table_put_integer(t, r->steps);
  table_put_text(t, shown ? contact_regime_name(r->regime) : NULL);
  table_put_text(t, start);
}

/* To the steady state at omega from *state; false once interrupted. */
static bool settle(job *j, double omega, timeint_state *state, const char *start)
{
  timeint_result result = {.omega = omega};
  hc_status st = timeint_steady(j->ti, omega, state, j->monitor, &result);
  if (st == HC_INTERRUPTED) { j->code = cli_solver_failed(j->o, "time integration", st, omega); return false; }
  put_result(j->t, st, &result, start);
  if (st != HC_OK) j->code = cli_solver_failed(j->o, "time integration", st, omega);
  return true;
}

static bool from_hbm_orbits(job *j, double omega)
{
  hbm_curve at = {0};
  bool go_on = true;
  hc_status st = hbm_curve_at(j->hbm, &j->curve, omega, &at);
  if (st != HC_OK || at.n == 0) {
    if (!j->o->quiet) cli_say(j->o, "no HBM solution at omega = %.10g (%s): starting at rest", omega, hc_status_text(st != HC_OK ? st : j->curve.end));
    timeint_state state = timeint_rest(j->ti);
    go_on = settle(j, omega, &state, "rest");
  }
  for (int k = 0; k < at.n && go_on; ++k) {
    hbm_measures m;
    const double *X = at.X + (size_t)k * at.n_coef;
    char start[32];
    if ((st = hbm_measure(j->hbm, X, &m)) != HC_OK) { j->code = cli_solver_failed(j->o, "harmonic balance", st, omega); continue; }
    timeint_state state = comparison_orbit_start(&m, hbm_n_harmonics(j->hbm), X, omega);
    snprintf(start, sizeof start, "hbm branch %d", at.points[k].branch);
    go_on = settle(j, omega, &state, start);
  }
  hbm_curve_free(&at);
  return go_on;
}

/* The asked omegas in the order a sweep meets them, from the sweep's end, the state carried along. */
static void swept(job *j, const scene_list *at, bool up)
{
  double here = up ? fmin(j->sc->omega_from, j->sc->omega_to) : fmax(j->sc->omega_from, j->sc->omega_to);
  timeint_state state = timeint_rest(j->ti);
  for (int i = 0; i < at->n; ++i) {
    double omega = at->v[up ? i : at->n - 1 - i];
    hc_status st = timeint_sweep(j->ti, here, omega, &state, j->monitor);
    if (st != HC_OK) { j->code = cli_solver_failed(j->o, "the frequency sweep", st, omega); return; }
    if (!settle(j, omega, &state, up ? "up" : "down")) return;
    here = omega;
  }
}

static hc_status run(job *j, const scene_list *asked)
{
  int start = j->sc->transient.start;
  hc_status st = timeint_new(j->sc, &j->ti);
  if (st != HC_OK) return st;
  if (start == TRANSIENT_START_UP || start == TRANSIENT_START_DOWN) { swept(j, asked, start == TRANSIENT_START_UP); return HC_OK; }
  if (start == TRANSIENT_START_HBM) {
    double from, to;
    comparison_sweep(j->sc, asked, &from, &to);
    if ((st = hbm_solver_new(j->sc, &j->hbm)) != HC_OK) return st;
    if ((st = hbm_trace(j->hbm, from, to, j->monitor, &j->curve)) == HC_INTERRUPTED) return st;
  }
  for (int i = 0; i < asked->n; ++i) {
    timeint_state state = timeint_rest(j->ti);
    if (!(j->hbm ? from_hbm_orbits(j, asked->v[i]) : settle(j, asked->v[i], &state, "rest"))) break;
  }
  return HC_OK;
}

int cmd_transient(int argc, char **argv)
{
  cli_options o;
  scene sc;
  cli_parse(argc, argv, "transient", "CASE", doc, options, true, &o);
  int code = cli_load_case(&o, &sc);
  if (code) return code;
  if (o.at.n) sc.compare.omega = o.at;
  scene_list asked;
  if (sc.compare.omega.n == 0) { cli_say(&o, "at which omega? give --at LIST, or compare.omega in the case"); return EXIT_USAGE; }
  comparison_frequencies(&sc, NULL, &(hbm_curve){0}, &asked);
  progress *bar = progress_start("time integration", o.quiet);
  hc_monitor monitor = progress_monitor(bar);
  job j = {.o = &o, .sc = &sc, .monitor = &monitor};
  j.t = table_new("Steady states", sizeof columns / sizeof *columns, columns);
  hc_status st = run(&j, &asked);
  progress_end(bar);
  if (st != HC_OK) j.code = cli_solver_failed(&o, "time integration", st, 0);
  code = j.ti ? cli_write(&o, 1, &j.t) : 0;
  table_free(j.t);
  hbm_curve_free(&j.curve);
  hbm_solver_free(j.hbm);
  timeint_free(j.ti);
  return j.code ? j.code : code;
}
