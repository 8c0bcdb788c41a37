/* version.c - see cli.h: the versions of what the command runs with. A file of its own: the library does without. */
#include <fftw3.h>
#include <gsl/gsl_version.h>
#include <jansson.h>
#include <sqlite3.h>
#include <sundials/sundials_version.h>
#include <yaml.h>

#include "interfaces/command/cli.h"

void (*argp_program_version_hook)(FILE *, struct argp_state *) = cli_print_version;

void cli_print_version(FILE *to, struct argp_state *state)
{
  char sundials[32] = "unknown";
  (void)state;
  SUNDIALSGetVersion(sundials, (int)sizeof sundials);
  fprintf(to, "hbmcheck %s\nSUNDIALS %s, %s, GSL %s, libyaml %s, jansson %s, SQLite %s\n", HBMCHECK_VERSION, sundials,
          fftw_version, gsl_version, yaml_get_version_string(), jansson_version_str(), sqlite3_libversion());
}
