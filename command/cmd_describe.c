/* cmd_describe.c - hbmcheck describe: what a case file may say, from the table of fields. */
#include <stdio.h>

#include "cases/case_file.h"
#include "command/commands.h"
#include "output/output.h"

static const char help[] =
    "What a case file may say: every field, or one FIELD or section, with unit, default, range and meaning."
    "\vexample: hbmcheck describe hbm.samples";

static int run_describe(int argc, char **argv)
{
  cli_common common;
  case_error err = {{0}};
  output *out = NULL;
  cli_parse(&cmd_describe, argc, argv, NULL, &common);
  hc_status st = output_open(common.output, &out);
  if (st == HC_OK) {
    st = case_describe(common.arguments[0], output_stream(out), &err);
    if (st == HC_OK) st = output_commit(out);
    else output_abandon(out);
  }
  if (st == HC_OK) return 0;
  cli_message(&common, "%s", err.message[0] ? err.message : hc_status_text(st));
  return st == HC_BAD_INPUT ? EXIT_USAGE : EXIT_NO_SOLUTION;
}

const cli_command cmd_describe = {
    .name = "describe",
    .summary = "what a case file may say",
    .arguments = "[FIELD]",
    .help = help,
    .run = run_describe,
};
