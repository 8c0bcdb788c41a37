/* cmd_lab.c - hbmcheck lab: the page in which the library itself runs (lab/README.md), as a file, with a case in it. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/message.h"
#include "casefile/matrices/text_file.h"
#include "command/commands.h"
#include "command/report/html.h"
#include "output/output.h"

static const char help[] =
    "Write the lab: one HTML page that solves cases of one degree of freedom itself, as fast as you move its sliders. "
    "Response curve with exact and with sampled contact forces, time signal, spectrum with what folds where, traction "
    "loop, error over samples and harmonics, and a lesson in seven steps. It opens from disk and needs no network."
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

/* ---- the page as it is installed ---- */

/* Where it may be: beside the program as installed, or as built; then where it was to be installed. */
static const char *const from_program[] = {"/../share/hbmcheck/lab.html", "/lab/lab.html"};
enum { N_FROM_PROGRAM = 2, MOST_PATH = 4096 };

/* The page at `path`, to free in any case. HC_IO: there is none. HC_NO_MEMORY. */
static hc_status read_page_at(const char *path, char **text)
{
  char why[256];
  size_t length;
  message m;
  message_start(&m, why, sizeof why);
  return text_file_read(path, MOST_PAGE, text, &length, &m);
}

/* The same wherever it is. */
static hc_status read_page(char **text)
{
  char folder[MOST_PATH], path[MOST_PATH + 64];
  hc_status st = HC_IO;
  /* The program's folder, "" if unknown; MOST_PATH bytes. */
  const ssize_t length = readlink("/proc/self/exe", folder, MOST_PATH - 64);
  folder[length > 0 ? length : 0] = '\0';
  char *slash = strrchr(folder, '/');
  *(slash ? slash : folder) = '\0';
  for (int i = 0; i < N_FROM_PROGRAM && st == HC_IO; ++i) {
    snprintf(path, sizeof path, "%s%s", folder, from_program[i]);
    free(*text);
    st = read_page_at(path, text);
  }
  if (st != HC_IO) return st;
  free(*text);
  return read_page_at(HBMCHECK_LAB_PAGE, text);
}

/* ---- the page as it is written ---- */

/* The page looks for a case here (lab/page/main.js). */
static const char place[] = "<pre id=\"case-given\" hidden>";

/* The resolved case in the page's place for it. HC_BAD_INPUT: the page has none. */
static hc_status write_with_case(const char *page, const scene *sc, FILE *to)
{
  char *text = NULL;
  size_t size = 0;
  const char *at = strstr(page, place);
  if (!at) return HC_BAD_INPUT;
  at += strlen(place);
  FILE *echo = open_memstream(&text, &size);
  if (!echo) return HC_NO_MEMORY;
  hc_status st = case_echo(sc, echo);
  if (fclose(echo) != 0 && st == HC_OK) st = HC_NO_MEMORY;
  if (st == HC_OK) {
    fwrite(page, 1, (size_t)(at - page), to);
    html_text(to, text);
    fputs(at, to);
  }
  free(text);
  return st;
}

/* sc may be NULL. */
static int write_page(const cli_common *common, const char *page, const scene *sc, const char *path)
{
  output *out = NULL;
  hc_status st = output_open(path, &out);
  if (st == HC_OK) {
    if (sc) st = write_with_case(page, sc, output_stream(out));
    else fputs(page, output_stream(out));
    st = output_finish(out, st);
  }
  if (st != HC_OK) return cli_file_failed(common, path, st);
  if (!common->quiet) cli_message(common, "wrote %s", path);
  return 0;
}

static int no_page(const cli_common *common, hc_status st)
{
  if (st == HC_NO_MEMORY) cli_message(common, "%s", hc_status_text(st));
  else
    cli_message(common,
                "the page is not installed: it is not at %s. It is made with `cmake --preset lab` and `cmake --build "
                "--preset lab` (lab/README.md), as build/lab/lab/lab.html",
                HBMCHECK_LAB_PAGE);
  return EXIT_NO_SOLUTION;
}

/* 0, or the exit code after the message. */
static int load_oscillator(cli_common *common, const char *case_file, scene *sc)
{
  int code = cli_load_case(common, case_file, sc);
  if (code || !sc->structure) return code;
  return cli_failed(common, EXIT_BAD_CASE,
                    "%s: structure: the lab has one degree of freedom, an `oscillator` was expected", case_file);
}

static int check_usage(const cli_common *common, const char *case_file)
{
  if (common->format != FORMAT_TABLE) return cli_failed(common, EXIT_USAGE, "the lab is HTML: --format does not apply");
  if (common->n_set && !case_file)
    return cli_failed(common, EXIT_USAGE, "--set changes a case: --case CASE was expected, too");
  return 0;
}

static int run_lab(cli_common *common, void *given, scene *sc)
{
  const lab_options *own = given;
  char *page = NULL;
  const char *const case_file = own->case_file;
  const char *path = common->output ? common->output : "lab.html";
  int code = check_usage(common, case_file);
  if (!code) code = cli_check_files(common, !common->output, &(cli_file){"the page", path, CLI_OUTPUT});
  if (!code && case_file) code = load_oscillator(common, case_file, sc);
  const hc_status st = code ? HC_OK : read_page(&page);
  if (st != HC_OK) code = no_page(common, st);
  else if (!code) code = write_page(common, page, case_file ? sc : NULL, path);
  free(page);
  return code;
}

CLI_COMMAND(lab, lab_options, "",
            "an HTML page that solves cases itself while you move sliders, with a lesson on aliasing",
            .starts_itself = true);
