/* cmd_reduce.c - hbmcheck reduce: a case with large sparse matrices to one with a Craig-Bampton model of them. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "interfaces/command/call.h"
#include "interfaces/command/commands.h"
#include "model/reduce/reduced_case.h"
#include "numerics/base/constants.h"
#include "numerics/base/path.h"

static const char help[] =
    "You have large sparse matrices of a finite-element model: reduces them to the nodes that contacts, loads and "
    "responses of CASE name and to the lowest fixed-interface modes (Craig-Bampton), and writes the case on that "
    "model to FOLDER, with its matrices and the files that it names."
    "\vThe error is that of the receptance between contacts, loads and responses, of all modes left out, over the "
    "sweep and its harmonics 2 and 3 (these divided by 4 and 9), contacts apart and stuck. It goes into the case as "
    "structure.reduction, and compare counts it. Modes are added until it is E, unless N or a frequency is given.\n"
    "exit: 0 done  2 case file wrong  3 could not  64 usage\nexample: hbmcheck reduce blade.yaml -o reduced";

typedef struct reduce_options {
  int modes;
  double up_to, error;
} reduce_options;

static const reduce_options defaults = {.modes = -1, .error = 1e-3};
static const cli_option options[] = {
    {CLI_INTEGER, "modes", "N", "Keep N fixed-interface modes", offsetof(reduce_options, modes), 0, 1500},
    {CLI_POSITIVE, "up-to", "FREQUENCY", "Keep those up to FREQUENCY, in the unit of the sweep",
     offsetof(reduce_options, up_to)},
    {CLI_POSITIVE, "error", "E", "Keep as many as make the stated error E [1e-3]", offsetof(reduce_options, error)},
    {0}};

static const table_column columns[] = {INTEGER("rows"), INTEGER("kept"), INTEGER("modes"), REAL("highest_frequency"),
                                       REAL("error"),   REAL("at"),      TEXT("contacts")};

enum { FIRST_MODES = 12, MOST_ROWS = 2000 };

/* The fewest modes of cb whose stated error is at most `target`, if it falls with each; *stated: theirs. */
static int fewest_modes(receptance *r, int most, double target, receptance_error *stated)
{
  const receptance_error worst = *stated;
  int low = 0, high = most; /* high is enough */
  while (low < high) {
    const int middle = (low + high) / 2;
    if (receptance_compare(r, middle, &worst).error <= target) high = middle;
    else low = middle + 1;
  }
  for (;; ++high) { /* what is largest there need not be so everywhere */
    *stated = receptance_compare(r, high, NULL);
    if (high >= most || stated->error <= target) return high;
  }
}

/* Modes, and how many of them are kept. */
static hc_status find_modes(const reduce_options *o, const scene *sc, craig_bampton *cb, int *modes,
                            receptance_error *stated)
{
  const double last = o->up_to > 0 ? scene_omega(sc, o->up_to) : INFINITY;
  int more = o->modes >= 0 ? o->modes + 1 : FIRST_MODES;
  for (;;) {
    receptance *r;
    hc_status st = craig_bampton_more(cb, sc->structure, more);
    if (st == HC_OK) st = receptance_new(cb, sc, &r);
    if (st != HC_OK) return st;
    int n = 0; /* up to `last` */
    while (n < cb->n_modes && cb->lambda[n] <= last * last) ++n;
    bool enough = cb->whole || n < cb->n_modes;
    if (o->modes >= 0) n = o->modes < cb->n_modes ? o->modes : cb->n_modes, enough = true;
    *modes = n;
    *stated = receptance_compare(r, n, NULL);
    if (o->modes < 0 && o->up_to == 0) {
      enough = stated->error <= o->error || cb->whole || cb->n_kept + cb->n_modes >= MOST_ROWS;
      if (enough) *modes = fewest_modes(r, n, o->error, stated);
    }
    receptance_free(r);
    if (enough) return HC_OK;
    more = cb->n_modes;
  }
}

/* Signals that end the program wait until the folder is whole; those of a program that calls are its own. */
static void hold_signals(const cli_common *common, bool hold)
{
  sigset_t all;
  if (common->call) return;
  sigemptyset(&all);
  sigaddset(&all, SIGINT);
  sigaddset(&all, SIGTERM);
  sigaddset(&all, SIGHUP);
  sigprocmask(hold ? SIG_BLOCK : SIG_UNBLOCK, &all, NULL);
}

/* The folder, which is read again before it gets its name. */
static int write_folder(cli_common *common, const scene *sc, case_source *source, const craig_bampton *cb, int modes,
                        const receptance_error *stated)
{
  const char *name = strcmp(common->arguments[0], "-") ? path_name(common->arguments[0], NULL) : "case.yaml";
  size_t end = strlen(common->output);
  while (end > 1 && common->output[end - 1] == '/') --end;
  const size_t size = end + strlen(name) + 8;
  char *folder = strndup(common->output, end), *part = malloc(size), *path = malloc(size);
  int code = folder && part && path ? 0 : cli_failed(common, EXIT_NO_SOLUTION, "%s", hc_status_text(HC_NO_MEMORY));
  if (!code) {
    scene again = {.structure = NULL};
    case_error err = {{0}};
    snprintf(part, size, "%s.part", folder);
    snprintf(path, size, "%s/%s", part, name);
    hold_signals(common, true);
    hc_status st = reduced_case_write(part, name, source, sc, cb, modes, stated);
    if (st != HC_OK) code = cli_file_failed(common, folder, st);
    if (!code && (st = case_read(path, 0, NULL, &again, &err)) != HC_OK) {
      cli_message(common, "the reduced case is refused:");
      code = cli_not_read(common, st, &err);
    }
    case_clear(&again);
    if (!code && !reduced_case_place(part, folder)) code = cli_file_failed(common, folder, HC_IO);
    if (code) reduced_case_remove(part);
    hold_signals(common, false);
  }
  free(folder);
  free(part);
  free(path);
  return code;
}

static int reduce(cli_common *common, const reduce_options *o, const scene *sc, case_source *source)
{
  int *kept = NULL, n_kept, modes = 0, code = 0;
  craig_bampton *cb = NULL;
  receptance_error stated = {0};
  hc_status st = reduced_case_rows(sc->structure, source, &n_kept, &kept);
  if (st == HC_OK && n_kept > MOST_ROWS) {
    cli_say(common, "%s: contacts, loads and responses name %d degrees of freedom, expected at most %d",
            common->arguments[0], n_kept, (int)MOST_ROWS);
    code = EXIT_BAD_CASE;
  } else if (st == HC_OK) {
    st = craig_bampton_new(sc->structure, n_kept, kept, &cb);
    if (st == HC_SINGULAR) {
      const case_place at = sc->structure->stiffness.place;
      cli_say(common,
              "%s:%zu:%zu: structure.stiffness does not hold a motion that leaves contacts, loads and responses at "
              "rest, and nothing else does, expected a spring or a contact against it",
              common->arguments[0], at.line, at.column);
      code = EXIT_BAD_CASE;
    }
  }
  if (!code && st == HC_OK) st = find_modes(o, sc, cb, &modes, &stated);
  if (!code) cli_ended(common, st);
  if (!code && st != HC_OK) code = cli_failed(common, EXIT_NO_SOLUTION, "no reduced model: %s", hc_status_text(st));
  if (!code) code = write_folder(common, sc, source, cb, modes, &stated);
  if (!code) {
    table *t = table_new("Reduction", CLI_COLUMNS(columns));
    const double highest = modes > 0 ? sqrt(fmax(cb->lambda[modes - 1], 0)) : NAN;
    TABLE_ROW(t, CELL(sc->structure->n), CELL(n_kept), CELL(modes), CELL(highest / TWO_PI), CELL(stated.error),
              CELL(scene_frequency(sc, stated.omega)), CELL(stated.stuck ? "stuck" : "open"));
    if (o->modes < 0 && o->up_to == 0 && !(stated.error <= o->error))
      table_note(t, "the error asked for, %g, is not reached", o->error);
    common->output = NULL;
    code = cli_write_all(common, 1, &t);
  }
  craig_bampton_free(cb);
  free(kept);
  return code;
}

static int run_reduce(cli_common *common, void *own, scene *sc)
{
  case_source source;
  case_error err = {{0}};
  if (!common->output) return cli_failed(common, EXIT_USAGE, "no -o FOLDER given");
  if (common->call && common->call->text)
    return cli_failed(common, EXIT_USAGE, "a case from memory is not reduced, expected a case file");
  if (common->n_set > 0)
    return cli_failed(common, EXIT_USAGE,
                      "--set does not go into the reduced case; write it into CASE, or --set it there");
  common->scene = sc;
  const hc_status st = case_read_sparse(common->arguments[0], 0, NULL, 0, sc, &source, &err);
  int code = st == HC_OK ? 0 : cli_not_read(common, st, &err);
  if (!code && scene_is_oscillator(sc)) {
    cli_say(common, "%s: an oscillator, expected `structure`, which can be reduced", common->arguments[0]);
    code = EXIT_BAD_CASE;
  }
  if (!code && sc->structure->base)
    code = cli_failed(common, EXIT_BAD_CASE, "%s: base: a reduced case does not carry it, expected `forcing`",
                      common->arguments[0]);
  if (!code) cli_say_notes(common, sc);
  if (!code) code = reduce(common, own, sc, &source);
  case_source_free(&source);
  return code;
}

const cli_command cmd_reduce = {.name = "reduce",
                                .summary = "a small model of large sparse matrices, and its error",
                                .arguments = "CASE",
                                .help = help,
                                .options = options,
                                .own_size = sizeof(reduce_options),
                                .defaults = &defaults,
                                .starts_itself = true,
                                .run = run_reduce};
