/* cmd_prove.c - hbmcheck prove: next to each solution, is there a periodic orbit of the exact law, and where? */
#include <errno.h>
#include <jansson.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "compare/output/output.h"
#include "compare/output/progress.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/proofs.h"
#include "model/casefile/structure.h"
#include "numerics/base/number.h"
#include "numerics/base/path.h"

static const char help[] =
    "You need certainty, not agreement: proves, next to each HBM solution of CASE, that the exact contact law has a "
    "periodic orbit, its contact states, its stability, and bounds of its amplitude, mean and first harmonic, and so "
    "of the error of HBM. hbmcheck-proof decides, in ball arithmetic. With -o FOLDER the certificates are written "
    "there, a file each; the table goes to standard output."
    "\vColumns: error = hbm's amplitude minus the orbit's; radius = how near the orbit is to the certificate's "
    "numbers, of its scales. A row that is unproven has a reason; it does not say that there is no orbit.\n"
    "exit: 0 done (with --strict: all proven)  2 case file wrong  3 could not, or unproven with --strict  64 usage\n"
    "example: hbmcheck prove cases/paper/case2.yaml --at 8,9";

enum { PATH_ROOM = 4096 };

typedef struct prove_options {
  number_list at;       /* n = 0: the case's */
  const char *response; /* NULL: the first one */
  bool strict;
} prove_options;

static const cli_option options[] = {
    {CLI_LIST, "at", "LIST", "At these " CLI_FREQUENCIES " [those of compare]", offsetof(prove_options, at)},
    CLI_RESPONSE_OPTION(prove_options),
    {CLI_FLAG, "strict", NULL, "Exit 3 if a row is unproven", offsetof(prove_options, strict)},
    {0},
};

/* Where certificates go, and what has been found of it. */
typedef struct certificate_folder {
  const cli_common *common;
  const char *path; /* NULL: nowhere */
  double omega;     /* of the last row, and how many there were at that without a branch */
  int beside;
  bool failed;
} certificate_folder;

/* For prove_run: the certificate as CASE_OMEGA_BRANCH.json. */
static hc_status keep_certificate(void *self, proof_row *row, const json_t *certificate)
{
  certificate_folder *f = self;
  char path[PATH_ROOM], number[NUMBER_TEXT], branch[24];
  int stem;
  const char *name = path_name(f->common->arguments[0], &stem);
  if (row->omega != f->omega) f->beside = 0;
  f->omega = row->omega;
  if (!certificate || !f->path) return HC_OK;
  if (row->branch >= 0) snprintf(branch, sizeof branch, "%d", row->branch);
  else snprintf(branch, sizeof branch, "steady%d", ++f->beside);
  number_write(scene_frequency(f->common->scene, row->omega), number);
  const int longest = (int)sizeof row->certificate - 40;
  snprintf(row->certificate, sizeof row->certificate, "%.*s_%s_%s.json", stem < longest ? stem : longest, name, number,
           branch);
  snprintf(path, sizeof path, "%s/%s", f->path, row->certificate);
  output *out = NULL;
  hc_status st = output_open(path, &out);
  if (st == HC_OK) {
    const bool written = json_dumpf(certificate, output_stream(out), JSON_INDENT(1)) == 0;
    fputc('\n', output_stream(out));
    st = output_finish(out, written ? HC_OK : HC_IO);
  }
  f->failed = st != HC_OK && cli_file_failed(f->common, path, st) != 0;
  return st == HC_IO ? HC_INTERRUPTED : st;
}

table *proofs_table(const cli_common *common, const proofs *p, hc_status st)
{
  const char *title = common->scene->title;
  int proven = 0, for_reason[PROOF_N_REASONS] = {0}, moved = 0, led = 0, members = 0;
  char of[RESPONSE_NAME], at[SCENE_WHERE];
  table *t = cli_table(common, "Proofs", ROWS_PROVE);
  for (int i = 0; i < p->n; ++i) {
    const proof_row *r = &p->rows[i];
    cli_put_row(common, t, ROWS_PROVE, r);
    proven += r->proven;
    moved += r->moved;
    members += r->proven && r->free_sliders > 0;
    led += r->proven && (r->harmonics > 0 || r->by_events);
    if (r->proven) continue;
    ++for_reason[r->reason];
    if (*r->detail && !common->quiet)
      cli_message(common, "at %s, branch %s: unproven, %s", scene_where(common->scene, r->omega, at),
                  r->branch >= 0 ? number_write(r->branch, (char[NUMBER_TEXT]){0}) : "none", r->detail);
  }
  table_note(t, "%s%s%d of %d proven", title, *title ? ": " : "", proven, p->n);
  for (int k = 0; k < PROOF_N_REASONS; ++k)
    if (for_reason[k])
      table_note(t, "%d unproven, %s: %s", for_reason[k], proof_reasons[k].words, proof_reasons[k].meaning);
  if (led)
    table_note(
        t,
        "in %d row%s no orbit is next to the solution: it is the one that harmonic balance from there on leads to, "
        "from more harmonics and with the mean, or Newton from the contacts' changes along its motion",
        led, led == 1 ? "" : "s");
  if (members)
    table_note(t,
               "in %d row%s a slider never slips: the orbit is one of a family, and the only one near it whose sliders "
               "rest where the certificate says",
               members, members == 1 ? "" : "s");
  if (moved)
    table_note(
        t,
        "in %d row%s a slider that never slips was on the verge of it, and rests 2 %% of its room or more farther "
        "in: the mean is another's, and where the amplitude is too, HBM's error is left out",
        moved, moved == 1 ? "" : "s");
  if (!scene_is_oscillator(common->scene))
    table_note(t, "by the response %s", structure_response_name(common->scene->structure, 0, of, sizeof of));
  if (st != HC_OK) table_note(t, "INCOMPLETE: %s", hc_status_text(st));
  return t;
}

int proofs_ended(const cli_common *common, hc_status curve_end, hc_status st, int error)
{
  if (st == HC_IO)
    return cli_failed(common, EXIT_NO_SOLUTION,
                      "hbmcheck-proof, which decides about certificates: %s; it is looked for beside hbmcheck and in "
                      "PATH, or HBMCHECK_PROOF names it",
                      error ? strerror(error) : "it ended");
  if (st != HC_OK) return cli_solver_failed(common, CLI_BOTH, "proving", st, 0);
  return curve_end == HC_OK ? 0 : cli_solver_failed(common, CLI_HBM, "the HBM response curve", curve_end, 0);
}

static int run_prove(cli_common *common, void *given, scene *sc)
{
  const prove_options *own = given;
  certificate_folder folder = {.common = common, .path = common->output};
  common->output = NULL;
  int code = cli_keep_response(common, sc, own->response);
  if (!code) code = cli_take_frequencies(common, &own->at, true, sc);
  if (!code) code = cli_make_folder(common, folder.path);
  if (code) return code;
  compare_setup setup;
  proofs found = {0};
  progress *bar = cli_progress(common, "proving");
  hc_monitor monitor = progress_monitor(bar);
  hc_status st = scene_setup(sc, &setup);
  if (st == HC_OK) st = prove_run(sc, &setup, &monitor, keep_certificate, &folder, &found);
  const int error = errno;
  progress_end(bar);
  cli_ended(common, st);
  code = folder.failed ? EXIT_NO_SOLUTION : proofs_ended(common, found.curve_end, st, error);
  table *t = proofs_table(common, &found, st);
  int written = found.n ? cli_write(common, 1, &t) : 0, unproven = 0;
  for (int i = 0; i < found.n; ++i) unproven += !found.rows[i].proven;
  if (!code && own->strict && (unproven || !found.n)) code = EXIT_NO_SOLUTION;
  table_free(t);
  proofs_clear(&found);
  scene_setup_clear(&setup);
  return code ? code : written;
}

CLI_COMMAND(prove, prove_options, "CASE",
            "periodic orbits of the exact law, proven, and certain bounds of the error of HBM");
