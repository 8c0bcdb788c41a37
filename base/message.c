/* message.c - see message.h. */
#include "base/message.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void message_start(message *m, char *text, size_t size)
{
  *m = (message){.text = text, .size = size};
  text[0] = '\0';
}

/* Cut on the start of a character, so that half of one is never shown. */
static void close_full(message *m)
{
  size_t end = m->used < m->size - 4 ? m->used : m->size - 4;
  while (end > 0 && ((unsigned char)m->text[end] & 0xC0) == 0x80) --end;
  memcpy(m->text + end, "...", 4);
  m->used = end + 3;
  m->full = true;
}

void message_add(message *m, const char *format, ...)
{
  if (m->full) return;
  va_list args;
  va_start(args, format);
  int n = vsnprintf(m->text + m->used, m->size - m->used, format, args);
  va_end(args);
  if (n < 0) return;
  if ((size_t)n < m->size - m->used) {
    m->used += (size_t)n;
  } else {
    m->used = m->size - 1;
    close_full(m);
  }
}

size_t utf8_character(const char *text, size_t length, unsigned long *code)
{
  static const unsigned long smallest[] = {0, 0, 0x80, 0x800, 0x10000}; /* a shorter form would do: not UTF-8 */
  unsigned char first = (unsigned char)text[0];
  size_t n = first < 0x80 ? 1 : first < 0xC0 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF8 ? 4 : 0;
  if (n == 0 || n > length) return 0;
  *code = n == 1 ? first : first & (0x7Fu >> n);
  for (size_t i = 1; i < n; ++i) {
    unsigned char c = (unsigned char)text[i];
    if ((c & 0xC0) != 0x80) return 0;
    *code = *code << 6 | (c & 0x3F);
  }
  bool surrogate = *code >= 0xD800 && *code <= 0xDFFF;
  return *code < smallest[n] || surrogate || *code > 0x10FFFF ? 0 : n;
}

bool utf8_is_control(unsigned long code)
{
  return code < 0x20 || (code >= 0x7F && code <= 0x9F) || (code >= 0x202A && code <= 0x202E) /* directions */
         || code == 0x2028 || code == 0x2029 /* line ends */ || (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF ||
         code == 0xFFFE || code == 0xFFFF;
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
