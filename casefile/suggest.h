/* suggest.h - which field or section was meant by a key that does not exist. */
#ifndef HC_SUGGEST_H
#define HC_SUGGEST_H

#include "casefile/fields.h"

typedef struct suggestion { /* at most one is not NULL */
  const field *f;
  const field_section *s;
} suggestion;

/* The likeliest meaning of `key` in `section` ("" at the top level): a typing mistake (edit distance 1, or 2 in
 * longer words), the symbol of docs/theory.md (kt, M, F0), the start of a name, or the right key of another section. */
suggestion suggest_key(const char *section, const char *key, size_t length);

/* The same for a whole path, "hbm.sample". */
suggestion suggest_path(const char *path, size_t length);

#endif
