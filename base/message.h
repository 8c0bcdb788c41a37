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

/* Our own words, printf-style. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void message_add(message *m, const char *format, ...);

/* Words of the input, at most `limit` bytes of them and then "...": control characters and whatever is not UTF-8
 * come out as \xNN. */
void message_add_input(message *m, const char *text, size_t length, size_t limit);

/* Bytes of the UTF-8 character that starts text[length], length >= 1: 1..4, or 0 if there is none. *code gets its
 * number. */
size_t utf8_character(const char *text, size_t length, unsigned long *code);

/* Characters a terminal may act on instead of showing, tab and line ends included. */
bool utf8_is_control(unsigned long code);

#endif
