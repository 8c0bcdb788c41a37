/* trace.c - see trace.h. */
#include "numerics/base/trace.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "numerics/base/nearest.h"

unsigned trace_wanted;

#define NAME(name, text) #name,
static const char *const names[] = {TRACE_PARTS(NAME) "all", NULL};
#undef NAME

static int part_named(const char *word, size_t length)
{
  int i = 0;
  while (names[i] && (strlen(names[i]) != length || strncmp(names[i], word, length))) ++i;
  return i;
}

hc_status trace_start(const char *list, message *msg)
{
  unsigned wanted = 0;
  for (const char *word = list; word && *word;) {
    const size_t length = strcspn(word, ",");
    const int part = part_named(word, length);
    if (!names[part]) {
      const char *near = nearest_word(names, word, length);
      message_add(msg, "HBMCHECK_TRACE: ");
      message_add_quoted(msg, word, length);
      if (near) message_add(msg, ", did you mean `%s`?", near);
      else
        for (int i = 0; names[i]; ++i) message_add(msg, "%s %s", i > 0 ? "," : ", expected a list of", names[i]);
      return HC_BAD_INPUT;
    }
    wanted |= part == TRACE_COUNT ? (1u << TRACE_COUNT) - 1 : 1u << part;
    word += length + (word[length] == ',');
  }
  trace_wanted = wanted;
  return HC_OK;
}

void trace_line(trace_part part, const char *format, ...)
{
  char line[512];
  va_list args;
  int n = snprintf(line, sizeof line, "%-6s  ", names[part]);
  va_start(args, format);
  n += vsnprintf(line + n, sizeof line - 1 - (size_t)n, format, args);
  va_end(args);
  if (n > (int)sizeof line - 2) n = (int)sizeof line - 2;
  line[n] = '\n';
  fwrite(line, 1, (size_t)n + 1, stderr);
}
