/* call.c - see call.h. Proof: tests/library. */
#include "interfaces/command/call.h"

#include <stdlib.h>
#include <string.h>

#include "numerics/base/nearest.h"

/* ---- options, without argp, which is for one thread and ends programs ---- */

static const char *const common_names[] = {"set", "output", "quiet"}; /* that a call may have, too */
enum { COMMON_SET, COMMON_OUTPUT, COMMON_QUIET, N_COMMON };

/* Says which one was meant. */
static int say_unknown(const cli_common *common, const char *name)
{
  const char *names[CLI_MOST_OPTIONS + N_COMMON + 1] = {NULL};
  char hint[NEAREST_HINT];
  int n = 0;
  for (; n < N_COMMON; ++n) names[n] = common_names[n];
  for (const cli_option *o = common->command->options; o && o->name; ++o) names[n++] = o->name;
  return cli_failed(common, EXIT_USAGE, "unrecognized option '--%s'%s", name, nearest_hint(names, name, hint));
}

/* Option NAME with its value, NULL: none; *taken: the value was used. 0 or the exit code after the message. */
static int take_option(cli_common *common, const char *name, const char *value, bool *taken)
{
  int k = 0;
  const cli_option *o = common->command->options;
  while (k < N_COMMON && strcmp(common_names[k], name) != 0) ++k;
  while (o && o->name && strcmp(o->name, name) != 0) ++o;
  const bool is_own = o && o->name && o->kind != CLI_PLOT;
  if (!is_own && k == N_COMMON) return say_unknown(common, name);
  *taken = is_own ? o->kind != CLI_FLAG : k != COMMON_QUIET;
  if (*taken && !value) return cli_failed(common, EXIT_USAGE, "--%s: a value is missing", name);
  if (is_own) {
    char why[CASE_MESSAGE];
    return cli_read_value(common, o, value, why) ? 0 : cli_failed(common, EXIT_USAGE, "%s", why);
  }
  if (k == COMMON_SET && common->n_set == CLI_MAX_SET)
    return cli_failed(common, EXIT_USAGE, "--set may be given at most %d times", CLI_MAX_SET);
  if (k == COMMON_SET) common->set[common->n_set++] = value;
  else if (k == COMMON_OUTPUT) common->output = value;
  else common->quiet = true;
  return 0;
}

static int take_options(cli_common *common, int n, const char *const *options)
{
  int code = 0;
  for (int i = 0; i < n && !code; ++i) {
    char name[64];
    const char *const equals = strchr(options[i], '=');
    bool taken = false;
    if (strncmp(options[i], "--", 2) != 0)
      return cli_failed(common, EXIT_USAGE, "'%s' is no option, expected --NAME or --NAME=VALUE", options[i]);
    const int length = equals ? (int)(equals - options[i]) - 2 : (int)strlen(options[i]) - 2;
    snprintf(name, sizeof name, "%.*s", length, options[i] + 2);
    code = take_option(common, name, equals ? equals + 1 : i + 1 < n ? options[i + 1] : NULL, &taken);
    if (!code && equals && !taken) return cli_failed(common, EXIT_USAGE, "--%s takes no value", name);
    i += taken && !equals;
  }
  return code;
}

int cli_call_command(const cli_command *self, cli_call *call, int n, const char *const *options)
{
  cli_common *common = calloc(1, sizeof *common);
  int code = EXIT_NO_SOLUTION;
  call->status = HC_NO_MEMORY;
  if (!common) return code;
  *common = (cli_common){.command = self, .call = call, .format = FORMAT_JSON, .wide = true};
  common->arguments[common->n_arguments++] = call->name;
  common->argument_is = call->text ? NULL : "the case file";
  common->own = cli_own_options(self);
  if (common->own) {
    call->status = HC_OK;
    code = call->n_set <= CLI_MAX_SET ? 0
                                      : cli_failed(common, EXIT_USAGE, "more than %d fields are set", (int)CLI_MAX_SET);
    for (int i = 0; i < call->n_set && !code; ++i) common->set[common->n_set++] = call->set[i];
    if (!code) code = take_options(common, n, options);
    if (!code) code = cli_run_parsed(common);
  }
  free(common->own);
  free(common);
  return code;
}
