/* version.c - the version of the library a program runs with. */
#include "hbmcheck.h"

const char *hbmcheck_version(void) { return HBMCHECK_VERSION; }
