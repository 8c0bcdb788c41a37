/* cmd_lab.c - hbmcheck lab: the page in which the library itself runs (interfaces/lab/), as a file, with a case in
 * it. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compare/output/output.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/report/html.h"
#include "model/casefile/matrices/text_file.h"
#include "numerics/base/message.h"

static const char help[] =
    "You teach or learn: writes the lab, one HTML page that solves cases of one degree of freedom itself, as fast as "
    "you move its sliders: response curve with exact and with sampled contact forces, time signal, spectrum, traction "
    "loop, errors, and a lesson in seven steps. It opens from disk and needs no network."
    "\vWithout --output the page is lab.html in the current folder. With --case it opens on that case; of it the page "
    "keeps what it has fields for: oscillator, forcing, contacts, sweep, and H, N, harmonic 0 and slider restart of "
    "hbm.\n"
    "exit: 0 written  2 case file wrong, or a structure  3 not written, or the page is not installed  64 usage\n"
    "example: hbmcheck lab --case cases/paper/case2.yaml --output lab.html";

typedef struct lab_options {
  const char *case_file; /* NULL: not given */
} lab_options;

enum { MOST_PAGE = 1 << 26 /* [byte] */ };

static const cli_option options[] = {
    {CLI_TEXT, "case", "CASE", "Open the page on this case, with --set", offsetof(lab_options, case_file),
     .file = "--case", .use = CLI_INPUT},
    {0},
};

enum { MOST_PATH = 4096 };

/* The page, to free: beside the program, or where it was to be installed. HC_IO: there is none. HC_NO_MEMORY. */
static hc_status read_page(char **text)
{
  static const char *const from_program[] = {"/../share/hbmcheck/lab.html", "/interfaces/lab/lab.html"};
  char folder[MOST_PATH], path[MOST_PATH + 64], why[256];
  size_t size;
  message m;
  hc_status st = HC_IO;
  const ssize_t length = readlink("/proc/self/exe", folder, MOST_PATH - 64);
  folder[length > 0 ? length : 0] = '\0';
  char *slash = strrchr(folder, '/');
  *(slash ? slash : folder) = '\0';
  for (int i = 0; i < 3 && st == HC_IO; ++i) {
    if (i < 2) snprintf(path, sizeof path, "%s%s", folder, from_program[i]);
    free(*text);
    message_start(&m, why, sizeof why);
    st = text_file_read(i < 2 ? path : HBMCHECK_LAB_PAGE, MOST_PAGE, text, &size, &m);
  }
  return st;
}

/* The page looks for a case here (interfaces/lab/page/main.js). */
static const char place[] = "<pre id=\"case-given\" hidden>";

/* The resolved case, if there is one, in the page's place for it. HC_BAD_INPUT: the page has none. */
static hc_status write_page(const char *page, const scene *sc, FILE *to)
{
  const char *at = sc ? strstr(page, place) : page;
  if (!at) return HC_BAD_INPUT;
  if (sc) at += strlen(place);
  fwrite(page, 1, (size_t)(at - page), to);
  const hc_status st = sc ? html_case(to, sc, html_text) : HC_OK;
  fputs(at, to);
  return st;
}

static int run_lab(cli_common *common, void *given, scene *sc)
{
  const lab_options *own = given;
  const char *path = common->output ? common->output : "lab.html";
  char *page = NULL;
  output *out = NULL;
  if (common->format != FORMAT_TABLE) return cli_failed(common, EXIT_USAGE, "the lab is HTML: --format does not apply");
  if (common->n_set && !own->case_file)
    return cli_failed(common, EXIT_USAGE, "--set changes a case: --case CASE was expected, too");
  int code = cli_check_files(common, !common->output, &(cli_file){"the page", path, CLI_OUTPUT});
  if (!code && own->case_file) code = cli_load_case(common, own->case_file, sc, &(case_error){{0}});
  if (!code && own->case_file && !scene_is_oscillator(sc))
    code = cli_failed(common, EXIT_BAD_CASE,
                      "%s: structure: the lab has one degree of freedom, an `oscillator` was expected", own->case_file);
  if (!code && own->case_file && scene_base_moves(sc))
    code = cli_failed(common, EXIT_BAD_CASE, "%s: base: the lab has a force, `forcing` was expected", own->case_file);
  if (code) return code;
  hc_status st = read_page(&page);
  if (st == HC_NO_MEMORY) code = cli_failed(common, EXIT_NO_SOLUTION, "%s", hc_status_text(st));
  else if (st != HC_OK)
    code = cli_failed(common, EXIT_NO_SOLUTION,
                      "the page is not installed: it is not at %s. A build makes it as interfaces/lab/lab.html, of the "
                      "module that HBMCHECK_LAB_MODULE names (interfaces/lab/README.md)",
                      HBMCHECK_LAB_PAGE);
  else {
    st = output_open(path, &out);
    if (st == HC_OK) st = output_finish(out, write_page(page, own->case_file ? sc : NULL, output_stream(out)));
    if (st != HC_OK) code = cli_file_failed(common, path, st);
    else if (!common->quiet) cli_message(common, "wrote %s", path);
  }
  free(page);
  return code;
}

CLI_COMMAND(lab, lab_options, "",
            "an HTML page that solves cases itself while you move sliders, with a lesson on aliasing",
            .starts_itself = true);
