/* utf8.h - characters of UTF-8 text and the terminal columns they take, independent of the locale. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* Number of bytes of the UTF-8 character at the start of text[length], length >= 1: 1..4, or 0 if invalid. *code: its
 * code point. */
size_t utf8_character(const char *text, size_t length, unsigned long *code);

/* True for characters that a terminal may interpret instead of showing, tab and line ends included. */
bool utf8_is_control(unsigned long code);

/* The code point at *p, which is advanced past it. An invalid byte counts as U+FFFD. **p must not be 0. */
unsigned long utf8_next(const char **p);

/* Terminal columns of a code point: 0 combining, 2 east Asian wide and emoji, else 1; by Unicode blocks, so wrong for a
 * few characters. */
int utf8_columns(unsigned long code);

/* Terminal columns of a text; control characters count as one space. */
int utf8_width(const char *text);

/* Number of bytes of the longest start of `text` that fits into `columns`; *width: columns used. */
size_t utf8_fit(const char *text, int columns, int *width);

/* A copy in valid UTF-8 (U+FFFD for invalid bytes), to be freed. one_line: control characters become spaces, and
 * trailing spaces are removed. NULL: out of memory. */
char *utf8_clean(const char *text, bool one_line);
