/* stress_files.h - the files of hbmcheck stress: none in two roles, and a folder for the findings. */
#ifndef HC_STRESS_FILES_H
#define HC_STRESS_FILES_H

#include "command/cli.h"
#include "stress/stress.h"

/* --results, --output and what may be written to the folder of --findings (NULL: none), held against each other before
 * anything is opened. 0, or the exit code after the message. */
int stress_check_files(const cli_common *common, const stress_plan *plan, const char *findings);

/* The folder of --findings (NULL: none), made if it is not there. 0, or the exit code after the message. */
int stress_make_folder(const cli_common *common, const char *findings);

#endif
