/* gnuplot.h - a script drawn by gnuplot as a child process, without a shell: script and drawing are temporary files,
 * so no pipe can fill up or break. */
#ifndef HC_PLOT_GNUPLOT_H
#define HC_PLOT_GNUPLOT_H

#include <stddef.h>
#include <stdio.h>

#include "base/status.h"

/* What the script writes to its standard output goes into `drawing`. HC_IO with why[size] saying what went wrong:
 * gnuplot is not installed, or its own words; HC_NO_MEMORY. */
hc_status gnuplot_run(const char *script, size_t length, FILE *drawing, char *why, size_t size);

#endif
