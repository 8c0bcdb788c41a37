/* utf8.c - see utf8.h. */
#include "numerics/base/utf8.h"

#include <stdlib.h>
#include <string.h>

enum { REPLACEMENT = 0xfffd };

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

unsigned long utf8_next(const char **p)
{
  unsigned long code = REPLACEMENT;
  size_t n = utf8_character(*p, strnlen(*p, 4), &code);
  *p += n ? n : 1;
  return n ? code : REPLACEMENT;
}

int utf8_columns(unsigned long code)
{
  static const struct {
    unsigned from, to;
    int columns;
  } block[] = {
      {0x0300, 0x036f, 0},   {0x1100, 0x115f, 2},   {0x1ab0, 0x1aff, 0},   {0x1dc0, 0x1dff, 0}, {0x200b, 0x200f, 0},
      {0x20d0, 0x20ff, 0},   {0x2e80, 0x303e, 2},   {0x3041, 0xa4cf, 2},   {0xac00, 0xd7a3, 2}, {0xf900, 0xfaff, 2},
      {0xfe00, 0xfe0f, 0},   {0xfe20, 0xfe2f, 0},   {0xfe30, 0xfe6f, 2},   {0xff00, 0xff60, 2}, {0xffe0, 0xffe6, 2},
      {0x1f300, 0x1f64f, 2}, {0x1f900, 0x1f9ff, 2}, {0x20000, 0x3fffd, 2},
  };
  for (size_t i = 0; i < sizeof block / sizeof *block; ++i)
    if (code >= block[i].from && code <= block[i].to) return block[i].columns;
  return 1;
}

int utf8_width(const char *text)
{
  int width = 0;
  while (*text) width += utf8_columns(utf8_next(&text));
  return width;
}

size_t utf8_fit(const char *text, int columns, int *width)
{
  const char *p = text, *end = text;
  for (*width = 0; *p; end = p) {
    int more = utf8_columns(utf8_next(&p));
    if (*width + more > columns) break;
    *width += more;
  }
  return (size_t)(end - text);
}

char *utf8_clean(const char *text, bool one_line)
{
  char *clean = malloc(3 * strlen(text) + 1), *to = clean; /* at worst every byte becomes U+FFFD, 3 bytes */
  if (!clean) return NULL;
  while (*text) {
    const char *from = text;
    unsigned long code = utf8_next(&text);
    if (one_line && utf8_is_control(code)) {
      *to++ = ' ';
    } else if (code == REPLACEMENT) {
      memcpy(to, "\xef\xbf\xbd", 3);
      to += 3;
    } else {
      memcpy(to, from, (size_t)(text - from));
      to += text - from;
    }
  }
  while (one_line && to > clean && to[-1] == ' ') --to;
  *to = 0;
  return clean;
}
