/* message.h - building one line of text that never overflows and never carries a control character of the input. */
#ifndef HC_MESSAGE_H
#define HC_MESSAGE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct message {
  char *text; /* [size] always terminated */
  size_t size, used;
  bool full; /* something did not fit: the text ends in "..." and takes no more */
} message;

void message_start(message *m, char *text, size_t size); /* size >= 8 */

/* Adds text of the program, printf-style. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void message_add(message *m, const char *format, ...);

/* Adds text of the input, text[length]: at most `limit` bytes of it and then "..."; a control character or a byte that
 * is not UTF-8 becomes \xNN. */
void message_add_input(message *m, const char *text, size_t length, size_t limit);

#endif
