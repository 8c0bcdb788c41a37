/* mistyped.c - see mistyped.h. */
#include "command/mistyped.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/nearest.h"

typedef struct option_lists {
  const struct argp_option *of[3];
} option_lists;

static const struct argp_option by_argp[] = {
    {"help", '?', 0, 0, 0, 0}, {"usage", 0, 0, 0, 0, 0}, {"version", 'V', 0, 0, 0, 0}, {0}};

/* The option that name[length] is or begins: getopt takes both. */
static const struct argp_option *known_option(const option_lists *lists, const char *name, size_t length)
{
  for (int i = 0; i < 3; ++i)
    for (const struct argp_option *o = lists->of[i]; o && o->name; ++o)
      if (!strncmp(o->name, name, length)) return o;
  return NULL;
}

static const char *nearest_option(const option_lists *lists, const char *name, size_t length)
{
  const char *best = NULL;
  int least = NEAREST_FAR;
  for (int i = 0; i < 3; ++i)
    for (const struct argp_option *o = lists->of[i]; o && o->name; ++o) {
      int d = nearest_distance(name, length, o->name);
      if (d < least) best = o->name, least = d;
    }
  return best;
}

/* -o FILE, -qo FILE: is what comes next the value of these short options? */
static bool value_follows(const option_lists *lists, const char *letters)
{
  for (; *letters; ++letters)
    for (int i = 0; i < 3; ++i)
      for (const struct argp_option *o = lists->of[i]; o && o->name; ++o)
        if (o->key == *letters && o->arg) return !letters[1];
  return false;
}

const char *mistyped_option(int argc, char *const *argv, const struct argp_option *own,
                            const struct argp_option *common, int *length, const char **meant)
{
  const option_lists lists = {{own, common, by_argp}};
  for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; ++i) {
    if (argv[i][0] != '-') continue;
    if (argv[i][1] != '-') {
      i += value_follows(&lists, argv[i] + 1);
      continue;
    }
    const char *name = argv[i] + 2;
    const size_t n = strcspn(name, "=");
    const struct argp_option *o = known_option(&lists, name, n);
    if (o) i += o->arg && !name[n];
    else if ((*meant = nearest_option(&lists, name, n)) != NULL) {
      *length = (int)n;
      return name;
    }
  }
  return NULL;
}
