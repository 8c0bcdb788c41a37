/* suggest.c - see suggest.h. */
#include "cases/suggest.h"

#include <string.h>

enum { LONGEST = 40, FAR = 1000 };

static int smallest(int a, int b) { return a < b ? a : b; }

/* Insertions, deletions, replacements and swaps of neighbours that turn a[n] into b (Damerau, optimal string alignment). */
static int distance(const char *a, size_t n, const char *b)
{
  int row[3][LONGEST + 1]; /* the last two rows and the current one, [0..strlen(b)] */
  size_t m = strlen(b);
  if (n > LONGEST || m > LONGEST) return FAR;
  int *before = row[0], *last = row[1], *now = row[2];
  for (size_t j = 0; j <= m; ++j) last[j] = before[j] = (int)j;
  for (size_t i = 1; i <= n; ++i) {
    now[0] = (int)i;
    for (size_t j = 1; j <= m; ++j) {
      now[j] = smallest(smallest(last[j], now[j - 1]) + 1, last[j - 1] + (a[i - 1] != b[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = smallest(now[j], before[j - 2] + 1);
    }
    int *spare = before;
    before = last, last = now, now = spare;
  }
  return last[m];
}

/* How far key is from name, 0..2, or FAR. Short words must be nearer: every two of them are close. */
static int nearness(const char *key, size_t length, const char *name)
{
  int d = distance(key, length, name), most = length < 6 ? 1 : 2;
  if (d <= most && (size_t)d < length) return d;
  bool start = length >= 3 && length < strlen(name) && !memcmp(key, name, length);
  return start ? 1 : FAR;
}

static int field_nearness(const char *key, size_t length, const field *f)
{
  if (*f->symbol && strlen(f->symbol) == length && !memcmp(key, f->symbol, length)) return 0;
  return nearness(key, length, f->name);
}

suggestion suggest_key(const char *section, const char *key, size_t length)
{
  suggestion best = {0};
  int best_cost = FAR;
  const field_section *s;
  for (int i = 1; (s = field_section_at(i)) != NULL; ++i) {
    int d = nearness(key, length, s->name), cost = 2 * d + (*section != '\0');
    if (cost < best_cost && (!*section || d == 0)) best = (suggestion){.s = s}, best_cost = cost;
  }
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    bool here = !strcmp(f->section, section);
    int d = field_nearness(key, length, f), cost = 2 * d + !here;
    if (cost < best_cost && (here ? d : 2 * d) <= 2) best = (suggestion){.f = f}, best_cost = cost;
  }
  return best;
}

suggestion suggest_path(const char *path, size_t length)
{
  size_t dot = length;
  while (dot > 0 && path[dot - 1] != '.') --dot;
  if (dot == 0) return suggest_key("", path, length);
  size_t stem = dot - 1;
  const char *index = memchr(path, '[', stem);
  if (index) stem = (size_t)(index - path);
  suggestion section = suggest_key("", path, stem);
  const char *name = section.s ? section.s->name : "";
  const field *f = field_find(name, path + dot, length - dot);
  if (f) return (suggestion){.f = f};
  return suggest_key(name, path + dot, length - dot);
}

const char *suggest_word(const char *const *words, const char *key, size_t length)
{
  const char *best = NULL;
  int least = FAR;
  for (; *words; ++words) {
    int d = nearness(key, length, *words);
    if (d < least) best = *words, least = d;
  }
  return best;
}
