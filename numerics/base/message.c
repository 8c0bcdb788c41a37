/* message.c - see message.h. */
#include "numerics/base/message.h"

#include <stdio.h>
#include <string.h>

#include "numerics/base/utf8.h"

void message_start(message *m, char *text, size_t size)
{
  *m = (message){.text = text, .size = size};
  text[0] = '\0';
}

void message_add_list(message *m, const char *format, va_list args)
{
  if (m->full) return;
  int n = vsnprintf(m->text + m->used, m->size - m->used, format, args);
  if (n < 0) return;
  if ((size_t)n < m->size - m->used) {
    m->used += (size_t)n;
  } else {
    m->used = m->size - 1;
    /* End the text in "...", cut at the start of a character so that no part of one is left. */
    size_t end = m->used < m->size - 4 ? m->used : m->size - 4;
    while (end > 0 && ((unsigned char)m->text[end] & 0xC0) == 0x80) --end;
    memcpy(m->text + end, "...", 4);
    m->used = end + 3;
    m->full = true;
  }
}

void message_add(message *m, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  message_add_list(m, format, args);
  va_end(args);
}

void message_add_errno(message *m, int error)
{
  char words[128];
  if (strerror_r(error, words, sizeof words)) message_add(m, "error %d", error);
  else message_add(m, "%s", words);
}

void message_add_input(message *m, const char *text, size_t length, size_t limit)
{
  for (size_t i = 0; i < length && !m->full;) {
    if (i >= limit) {
      message_add(m, "...");
      return;
    }
    unsigned long code = 0;
    size_t n = utf8_character(text + i, length - i, &code);
    if (n == 0 || utf8_is_control(code)) message_add(m, "\\x%02X", (unsigned)(unsigned char)text[i++]);
    else message_add(m, "%.*s", (int)n, text + i), i += n;
  }
}

void message_add_quoted(message *m, const char *text, size_t length)
{
  message_add(m, "`");
  message_add_input(m, text, length, 60);
  message_add(m, "`");
}

const char *message_quote(const char *text, size_t length, char quote[MESSAGE_QUOTE])
{
  message m;
  message_start(&m, quote, MESSAGE_QUOTE);
  message_add_quoted(&m, text, length);
  return quote;
}
