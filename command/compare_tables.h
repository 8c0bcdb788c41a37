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

/* The table of (H, N) and the one of orders into out[], which the caller frees; with what was found, whatever the
 * status. What they are made of into *a, to free with accuracy_clear in any case. */
hc_status compare_tables(const compare_setup *setup, const comparison *c, const hc_monitor *monitor, table *out[2],
                         accuracy *a);

#endif
