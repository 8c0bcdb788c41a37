/* case_names.h - options that name a response, a contact, or the lists of the tables. */
#pragma once

#include "interfaces/command/cli.h"

/* The response called `name`, from 0: as the column `response` calls it, or with the DOFs of its direction in another
 * order; x of an oscillator. -1 after a message that lists them. */
int cli_response_named(const cli_common *common, const char *name);

/* A structure's response names into *out, to free; NULL of an oscillator. HC_NO_MEMORY. */
hc_status cli_response_names(const scene *sc, char (**out)[RESPONSE_NAME]);

/* The contact called `name`, or of that number from 0; -1 after a message that lists those there are. */
int cli_contact_named(const cli_common *common, const char *name);

/* Its name, or its number where it has none. In text[CLI_NAME], which is returned. */
enum { CLI_NAME = 512 };
const char *cli_contact_name(const cli_common *common, int j, char text[CLI_NAME]);

/* --response NAME in the commands that compute with it alone. */
/* clang-format off */
#define CLI_RESPONSE_OPTION(type) \
  {CLI_TEXT, "response", "NAME", "Only this response of the case, as the column `response` calls it", \
   offsetof(type, response)}
/* clang-format on */

/* Only that one of the case's responses stays; all of them for NULL. 0, or the exit code after the message. */
int cli_keep_response(const cli_common *common, scene *sc, const char *name);

/* --harmonics and --samples of the commands that have tables over truncation orders and samples; n = 0: the case's. */
typedef struct table_lists {
  number_list harmonics, samples;
} table_lists;

/* The lists that were given in the place of the scene's. 0, or the exit code after the message. */
int compare_lists(const cli_common *common, const table_lists *lists, scene *sc);
