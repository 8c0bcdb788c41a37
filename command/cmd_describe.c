/* cmd_describe.c - hbmcheck describe: what a case file may say, from the table of fields. */
#include <stdio.h>

#include "cases/case_file.h"
#include "command/cli.h"
#include "output/output.h"

static const char doc[] =
    "What a case file may say: every field, or one FIELD or section, with unit, default, range and meaning."
    "\vexample: hbmcheck describe hbm.samples";

int cmd_describe(int argc, char **argv)
{
  cli_options o;
  case_error err = {{0}};
  output *out = NULL;
  cli_parse(argc, argv, "describe", "[FIELD]", doc, NULL, false, &o);
  hc_status st = output_open(o.output, &out);
  if (st == HC_OK) {
    st = case_describe(o.argument, output_stream(out), &err);
    if (st == HC_OK) st = output_commit(out);
    else output_abandon(out);
  }
  if (st == HC_OK) return 0;
  cli_say(&o, "%s", err.message[0] ? err.message : hc_status_text(st));
  return st == HC_BAD_INPUT ? EXIT_USAGE : EXIT_NO_SOLUTION;
}
