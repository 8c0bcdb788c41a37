/* utf8.h - characters of UTF-8 text and the terminal columns they take, whatever locale a host program has set. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* Bytes of the UTF-8 character that starts text[length], length >= 1: 1..4, or 0 if there is none. *code: its code
 * point. */
size_t utf8_character(const char *text, size_t length, unsigned long *code);

/* Characters a terminal may act on instead of showing, tab and line ends included. */
bool utf8_is_control(unsigned long code);

/* The code point at *p, which is moved past it. A byte that starts no valid sequence counts alone, as U+FFFD. **p
 * must not be 0. */
unsigned long utf8_next(const char **p);

/* Terminal columns of a code point: 0 combining, 2 east Asian wide and emoji, else 1, by blocks of the code: a few
 * characters have another width. */
int utf8_columns(unsigned long code);

/* Columns of a whole text; control characters count as the space they are shown as. */
int utf8_width(const char *text);

/* Bytes of the longest start of `text` that fits into `columns`; *width is how many it takes. */
size_t utf8_fit(const char *text, int columns, int *width);

/* A copy, valid UTF-8 whatever came in (U+FFFD for what was not); free() it. one_line: control characters become
 * spaces, and spaces at the end go. NULL when out of memory. */
char *utf8_clean(const char *text, bool one_line);
