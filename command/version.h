/* version.h - the versions of hbmcheck and of the libraries it runs with. */
#ifndef HC_CLI_VERSION_H
#define HC_CLI_VERSION_H

#include <stdio.h>

struct argp_state;

/* "hbmcheck 0.1.0" and the versions of the libraries it runs with. The signature argp wants for its --version. */
void cli_print_version(FILE *to, struct argp_state *state);

#endif
