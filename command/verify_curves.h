/* verify_curves.h - which curves of a file verify is to judge: a column of values for each, and whose they are. */
#ifndef HC_VERIFY_CURVES_H
#define HC_VERIFY_CURVES_H

#include "command/cli.h"

enum { VERIFY_MOST_CURVES = 16, VERIFY_CURVE_TEXT = 1024 };

/* What --columns, --response and --quantity say. */
typedef struct verify_asked {
  const char *columns, *quantity; /* NULL: not given */
  int n_responses;
  const char *responses[VERIFY_MOST_CURVES]; /* of --response, each time it was given */
} verify_asked;

/* One of the curves. */
typedef struct verify_curve {
  char columns[VERIFY_CURVE_TEXT]; /* for verify_columns_read; empty: by the header */
  int response;                    /* of the model, counted from 0 */
  char name[RESPONSE_NAME];        /* of the response, empty of an oscillator */
} verify_curve;

/* "omega=1,rms@tip=2,rms@root=3" is two curves; without @ it is one of each --response, or of the first. How many, into
 * out[VERIFY_MOST_CURVES]; 0 after a message. */
int verify_curves_of(const cli_common *common, const verify_asked *asked, verify_curve *out);

#endif
