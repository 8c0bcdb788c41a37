/* message.h - building one line of text that never overflows and never carries a control character of the input. */
#pragma once

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct message {
  char *text; /* [size] always terminated */
  size_t size, used;
  bool full; /* a text did not fit: the message ends in "...", and further additions are ignored */
} message;

void message_start(message *m, char *text, size_t size); /* size >= 8 */

/* Adds text of the program, printf-style. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void message_add(message *m, const char *format, ...);
void message_add_list(message *m, const char *format, va_list args);

/* Adds the system's words for an errno. */
void message_add_errno(message *m, int error);

/* Adds text of the input, text[length]: at most `limit` bytes of it and then "..."; a control character or a byte that
 * is not UTF-8 becomes \xNN. */
void message_add_input(message *m, const char *text, size_t length, size_t limit);

/* The same between backquotes, 60 bytes of it: `text`. */
void message_add_quoted(message *m, const char *text, size_t length);

/* The same in a separate text, as an argument of %s. Returns quote. */
enum { MESSAGE_QUOTE = 256 /* 60 bytes as \xNN, backquotes and "..." */ };
const char *message_quote(const char *text, size_t length, char quote[MESSAGE_QUOTE]);
#define QUOTED(text, length) message_quote(text, length, (char[MESSAGE_QUOTE]){0}) /* valid in the enclosing block */
