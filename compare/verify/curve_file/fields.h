/* fields.h - a line of text into fields; private to compare/verify/. Separated by semicolons, tabs, commas or blanks,
 * whichever of these the first line has outside quotes, in that order. A field may stand in double quotes, with
 * separators inside, and "" for one quote (RFC 4180). */
#ifndef HC_VERIFY_FIELDS_H
#define HC_VERIFY_FIELDS_H

#include <stdbool.h>
#include <stddef.h>

enum { VERIFY_MOST_FIELDS = 256 };

typedef struct field {
  const char *text; /* in the line; trimmed, without its quotes */
  size_t length;
  int column; /* in characters from 1, as editors count */
} field;

typedef enum fields_fault { FIELDS_FINE, FIELDS_TOO_MANY, FIELDS_OPEN_QUOTE, FIELDS_AFTER_QUOTE } fields_fault;

char fields_separator(const char *text, size_t length); /* ' ' is any blanks */

/* fields[VERIFY_MOST_FIELDS], *n of them; *column is where the fault is. */
fields_fault fields_split(const char *text, size_t length, char separator, field *fields, int *n, int *column);

bool field_is(const field *f, const char *word);

#endif
