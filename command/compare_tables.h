/* compare_tables.h - the tables of hbmcheck compare over samples and truncation order, as they are written. */
#ifndef HC_COMPARE_TABLES_H
#define HC_COMPARE_TABLES_H

#include "command/cli.h"

/* --harmonics and --samples of the commands that have these tables; n = 0: the case's. */
typedef struct table_lists {
  number_list harmonics, samples;
} table_lists;

/* The lists that were given in the place of the scene's. 0, or the exit code after the message. */
int compare_lists(const cli_common *common, const table_lists *lists, scene *sc);

/* The table over (H, N) and the one of observed orders into out[], which the caller frees; on failure they have the
 * rows found before. *a gets what they were made from, to be freed with accuracy_clear in any case. */
hc_status compare_tables(const cli_common *common, const compare_setup *setup, const comparison *c,
                         const hc_monitor *monitor, table *out[2], accuracy *a);

#endif
