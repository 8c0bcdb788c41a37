/* compare_tables.h - the tables of hbmcheck compare over samples and truncation order, as they are written. */
#ifndef HC_COMPARE_TABLES_H
#define HC_COMPARE_TABLES_H

#include "command/cli.h"

/* --harmonics and --samples in the place of the scene's. 0, or the exit code after saying why. */
int compare_lists(const cli_options *o, scene *sc);

/* The table of (H, N) and the one of orders into out[], which the caller frees; with what was found, whatever the
 * status. What they are made of into *a, to free with accuracy_clear in any case. */
hc_status compare_tables(const compare_setup *setup, const comparison *c, const hc_monitor *monitor, table *out[2],
                         accuracy *a);

#endif
