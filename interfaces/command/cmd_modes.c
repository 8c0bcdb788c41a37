/* cmd_modes.c - hbmcheck modes: natural frequencies and damping, contacts apart and stuck, and the preloads. */
#include <math.h>
#include <stdlib.h>

#include "compare/study/scene_solvers.h"
#include "interfaces/command/commands.h"
#include "model/modes.h"
#include "model/reduce/lowest_modes.h"
#include "numerics/base/constants.h"

static const char help[] =
    "You have a new model and want to see whether it is the right one: natural frequencies and damping ratios of CASE "
    "with all contacts apart and all stuck, side by side, and each contact at rest under the static loads."
    "\vContact stiffnesses are chosen so that the stuck frequencies are those of the bonded structure, as measured or "
    "from a finite-element model. A damping ratio is that of the mode's own shape, phi' C phi/(2 omega) with "
    "phi' M phi = 1; where the damping couples modes this is an estimate. The symmetric part of the stiffness "
    "counts. Of a structure of more than 2000 degrees of freedom, kept sparse, the lowest modes.\n"
    "exit: 0 done  2 case file wrong  3 could not  64 usage\nexample: hbmcheck modes cases/paper/case2.yaml";

static const table_column mode_columns[] = {INTEGER("mode"),      REAL("omega_open"),  REAL("frequency_open"),
                                            REAL("damping_open"), REAL("omega_stuck"), REAL("frequency_stuck"),
                                            REAL("damping_stuck")};
static const table_column contact_columns[] = {INTEGER("contact"), TEXT("name"), TEXT("at_rest"), REAL("preload"),
                                               REAL("friction_limit")};

/* A mode that is driven away has no frequency; one with 0 to rounding is free. */
#define MODE_CELLS(mode) CELL((mode).omega), CELL((mode).omega / TWO_PI), CELL((mode).damping)

typedef struct modes_options {
  int count;
} modes_options;

static const cli_option options[] = {{CLI_INTEGER, "count", "N",
                                      "The N lowest modes alone [all; of more than 2000 degrees of freedom 20]",
                                      offsetof(modes_options, count), 1, 2000},
                                     {0}};

/* The lowest modes of a structure whose matrices are kept sparse, by ARPACK. */
static int run_large(cli_common *common, int count, const scene *sc)
{
  enum { DEFAULT = 20 };
  int found[2] = {0, 0};
  if (count == 0) count = DEFAULT;
  table *t = table_new("Modes", CLI_COLUMNS(mode_columns));
  model_mode *modes = calloc(2 * (size_t)count, sizeof *modes);
  hc_status st = modes ? HC_OK : HC_NO_MEMORY;
  for (int stuck = 0; stuck < 2 && st == HC_OK; ++stuck)
    st = lowest_of_structure(sc->structure, stuck, count, modes + count * stuck, &found[stuck]);
  for (int i = 0; i < found[0] && i < found[1] && st == HC_OK; ++i)
    TABLE_ROW(t, CELL(i + 1), MODE_CELLS(modes[i]), MODE_CELLS(modes[count + i]));
  table_note(t, "the lowest of %d degrees of freedom; contacts at rest: after `hbmcheck reduce`", sc->structure->n);
  cli_ended(common, st);
  const int code =
      st == HC_OK ? cli_write(common, 1, &t) : cli_failed(common, EXIT_NO_SOLUTION, "no modes: %s", hc_status_text(st));
  table_free(t);
  free(modes);
  return code;
}

static int run_modes(cli_common *common, void *own, scene *sc)
{
  const int count = ((const modes_options *)own)->count;
  model *m = NULL;
  int code = cli_check_files(common, 0, NULL);
  if (!code) code = cli_load_sparse_case(common, sc);
  if (code) return code;
  if (sc->structure->is_sparse) return run_large(common, count, sc);
  table *tables[] = {table_new("Modes", CLI_COLUMNS(mode_columns)),
                     table_new("Contacts at rest", CLI_COLUMNS(contact_columns))};
  hc_status st = scene_model(sc, &m);
  if (st == HC_OK) {
    table *t = tables[0];
    model_mode *open = calloc(2 * (size_t)m->n, sizeof *open), *stuck = open ? open + m->n : NULL;
    st = open ? model_mode_list(m, false, open) : HC_NO_MEMORY;
    if (st == HC_OK) st = model_mode_list(m, true, stuck);
    for (int i = 0; i < m->n && (count == 0 || i < count) && st == HC_OK; ++i)
      TABLE_ROW(t, CELL(i + 1), MODE_CELLS(open[i]), MODE_CELLS(stuck[i]));
    if (st == HC_OK && isnan(open[0].omega))
      table_note(t, "mode 1 is driven away with the contacts open: no frequency");
    if (sc->structure->reduction_error > 0)
      table_note(t, "a reduced model: the relative error of its receptance is %.2g, at %g (structure.reduction)",
                 sc->structure->reduction_error, sc->structure->reduction_at);
    free(open);
  }
  if (st == HC_OK) {
    table *t = tables[1];
    double *N = calloc((size_t)m->n_contacts + 1, sizeof *N);
    hbm_solver *s = NULL;
    st = N ? scene_hbm_solver(sc, &s) : HC_NO_MEMORY;
    if (st == HC_OK) st = hbm_preloads(s, N);
    for (int j = 0; j < scene_contact_count(sc) && st == HC_OK; ++j) {
      const char *name = scene_contact_at(sc, j)->name;
      const int first = scene_model_contact(sc, j), end = scene_model_contact(sc, j + 1);
      double whole = 0;
      for (int i = first; i < end; ++i) whole += N[i];
      /* of a pair each half has the limit of the whole */
      TABLE_ROW(t, CELL(j), CELL_IF(*name, name), CELL(whole > 0 ? "closed" : "open"), CELL(whole),
                CELL(m->contacts[first].law.mu * N[first]));
    }
    hbm_solver_free(s);
    free(N);
  }
  cli_ended(common, st);
  code = st != HC_OK ? cli_solver_failed(common, CLI_HBM, "modes", st, 0)
                     : cli_write(common, m->n_contacts ? 2 : 1, tables);
  for (int i = 0; i < 2; ++i) table_free(tables[i]);
  model_free(m);
  return code;
}

const cli_command cmd_modes = {
    .name = "modes",
    .summary = "natural frequencies and damping, contacts open and stuck, and the preloads",
    .arguments = "CASE",
    .help = help,
    .options = options,
    .own_size = sizeof(modes_options),
    .starts_itself = true,
    .run = run_modes,
};
