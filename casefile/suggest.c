/* suggest.c - see suggest.h. */
#include "casefile/suggest.h"

#include <string.h>

#include "base/nearest.h"

enum { FAR = NEAREST_FAR };

static int field_nearness(const char *key, size_t length, const field *f)
{
  if (*f->symbol && strlen(f->symbol) == length && !memcmp(key, f->symbol, length)) return 0;
  return nearest_distance(key, length, f->name);
}

suggestion suggest_key(const char *section, const char *key, size_t length)
{
  suggestion best = {0};
  int best_cost = FAR;
  const field_section *s;
  for (int i = 1; (s = field_section_at(i)) != NULL; ++i) {
    int d = nearest_distance(key, length, s->name), cost = 2 * d + (*section != '\0');
    if (cost < best_cost && (!*section || d == 0)) best = (suggestion){.s = s}, best_cost = cost;
  }
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    bool here = !strcmp(f->section, section);
    if (!here && f->flags & FIELD_STRUCTURE) continue; /* few cases have one */
    int d = field_nearness(key, length, f), cost = 2 * d + !here;
    if (cost < best_cost && (here ? d : 2 * d) <= 2) best = (suggestion){.f = f}, best_cost = cost;
  }
  return best;
}

suggestion suggest_path(const char *path, size_t length)
{
  const char *point = memchr(path, '.', length); /* the first: structure.damping.modal */
  const size_t dot = point ? (size_t)(point - path) + 1 : 0;
  if (dot == 0) return suggest_key("", path, length);
  size_t stem = dot - 1;
  const char *index = memchr(path, '[', stem);
  if (index) stem = (size_t)(index - path);
  suggestion section = suggest_key("", path, stem);
  const char *name = section.s ? section.s->name : "";
  if (index && !strcmp(name, "forcing")) name = "forcing[]";
  const field *f = field_find(name, path + dot, length - dot);
  if (f) return (suggestion){.f = f};
  return suggest_key(name, path + dot, length - dot);
}
