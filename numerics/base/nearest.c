/* nearest.c - see nearest.h. */
#include "numerics/base/nearest.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST = 40 }; /* letters of a word; a longer one is never near */

static int smallest(int a, int b) { return a < b ? a : b; }

/* Insertions, deletions, replacements and swaps of neighbours that turn a[n] into b (Damerau, optimal string
 * alignment). */
static int distance(const char *a, size_t n, const char *b)
{
  int row[3][LONGEST + 1]; /* the last two rows and the current one, [0..strlen(b)] */
  size_t m = strlen(b);
  if (n > LONGEST || m > LONGEST) return NEAREST_FAR;
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

int nearest_distance(const char *key, size_t length, const char *name)
{
  int d = distance(key, length, name), most = length < 6 ? 1 : 2;
  if (d <= most && (size_t)d < length) return d;
  bool starts_name = length >= 3 && length < strlen(name) && !memcmp(key, name, length);
  return starts_name ? 1 : NEAREST_FAR;
}

const char *nearest_word(const char *const *words, const char *key, size_t length)
{
  const char *best = NULL;
  int least = NEAREST_FAR;
  for (; *words; ++words) {
    int d = nearest_distance(key, length, *words);
    if (d < least) best = *words, least = d;
  }
  return best;
}

const char *nearest_hint(const char *const *words, const char *key, char hint[NEAREST_HINT])
{
  const char *near = nearest_word(words, key, strlen(key));
  *hint = '\0';
  if (near) snprintf(hint, NEAREST_HINT, ", did you mean '%s'?", near);
  return hint;
}
