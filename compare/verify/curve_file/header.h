/* header.h - which columns of a file are meant when nobody says: those whose names are plain; private to
 * compare/verify/. */
#ifndef HC_VERIFY_HEADER_H
#define HC_VERIFY_HEADER_H

#include "base/message.h"
#include "compare/verify/curve_file/csv.h"
#include "compare/verify/curve_file/fields.h"

/* "omega", "w", "Frequency [Hz]", "|X1|", "Amplitude (mm)", ...: case, blanks, _ - | and a unit behind it do not count.
 * From the header's fields: columns->omega, ->value by number, ->cycles and ->quantity. quantity_given: which quantity
 * is wanted. False with what was seen, and what to do, added to *m. */
bool header_recognise(int n, const field *fields, bool quantity_given, verify_columns *columns, message *m);

#endif
