/* search.h - which of our own equations, and which reading of the columns, the points lie on; private to
 * compare/verify/. */
#ifndef HC_VERIFY_SEARCH_H
#define HC_VERIFY_SEARCH_H

#include "compare/verify/truth/report.h"

enum { VERIFY_LEAST_DIFFERING = 3 }; /* fewer points are met by many hypotheses, and tell none from another */

/* out->rows are judged already; fills out->hypotheses, best first, and truth_distance. */
hc_status verify_search(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor,
                        verify_report *out);

/* Does the best hypothesis explain the points? */
bool verify_fits(const verify_report *r);

/* Does hypothesis i fit as well as the best, and say something else? */
bool verify_rival(const verify_report *r, int i);

/* The best says what the contacts do, as nothing at all: does hypothesis i say why? */
bool verify_reason(const verify_report *r, int i);

#endif
