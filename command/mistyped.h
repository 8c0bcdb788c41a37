/* mistyped.h - long options that a command does not have, with the one that was meant. */
#ifndef HC_MISTYPED_H
#define HC_MISTYPED_H

#include <argp.h>

/* The first of argv[1..argc-1] that is a long option in neither list, nor the start of one, but near to one of them:
 * returns its name without the dashes, of *length letters, and the one meant in *meant. NULL if there is none; what is
 * near to nothing is left to argp. The lists end in {0} and may be NULL. */
const char *mistyped_option(int argc, char *const *argv, const struct argp_option *own,
                            const struct argp_option *common, int *length, const char **meant);

#endif
