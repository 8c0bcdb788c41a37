/* commands.h - every command, in the order of hbmcheck --help; declares them and fills main's table. A new command is a
 * new name here and const cli_command cmd_NAME in cmd_NAME.c (README.md goes through it step by step). */
#pragma once

#include "interfaces/command/cli.h"

/* clang-format off */
#define COMMANDS(X) \
  X(compare) X(frf) X(modes) X(reduce) X(transient) X(survey) X(study) X(bench) X(advise) X(gate) X(verify) X(prove) \
  X(suite) X(stress) X(report) X(lab) X(contact) X(describe)
/* clang-format on */

#define COMMANDS_DECLARE(name) extern const cli_command cmd_##name;
COMMANDS(COMMANDS_DECLARE)
#undef COMMANDS_DECLARE
