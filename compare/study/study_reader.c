/* study_reader.c - see study_reader.h. */
#include "compare/study/study_reader.h"

#include "numerics/base/nearest.h"

int study_key(study_reader *q, const yaml_node_t *key, const char *where, const char *const *words, case_place *seen)
{
  if (yaml_check_key(&q->r, key) != HC_OK) return -1;
  int k = 0;
  while (words[k] && !yaml_node_is(key, words[k])) ++k;
  if (!words[k]) {
    const char *text = yaml_node_text(key), *guess = nearest_word(words, text, key->data.scalar.length);
    message *m = yaml_blame(&q->r, key);
    message_add(m, "unknown key %s in %s", YAML_QUOTED(key), where);
    if (guess) message_add(m, ", did you mean `%s`?", guess);
    else if (field_find_section(text, strcspn(text, ".[")))
      message_add(m, ", expected fields of the case in `case`, `set` or `vary`");
    else {
      message_add(m, ", expected one of");
      for (int i = 0; words[i]; ++i) message_add(m, "%s %s", i ? "," : "", words[i]);
    }
  } else if (seen[k].line > 0) yaml_duplicate_key(&q->r, key, seen[k]);
  else {
    seen[k] = yaml_place(&q->r, key);
    return k;
  }
  return -1;
}

hc_status study_read_text(study_reader *q, const char *what, const yaml_node_t *node, void *out)
{
  if (node->type != YAML_SCALAR_NODE || node->data.scalar.length == 0)
    return yaml_refuse(&q->r, node, "%s is %s, expected text", what, yaml_node_what(node));
  if (strlen(yaml_node_text(node)) != node->data.scalar.length)
    return yaml_refuse(&q->r, node, "%s has a zero character, expected text", what);
  study_value *v = out;
  *v = (study_value){strdup(yaml_node_text(node)), node->start_mark.line + 1, node->start_mark.column + 1};
  return v->text ? HC_OK : case_out_of_memory(&q->r);
}

/* Is this the field, or another way to say the same? */
static bool clashes(const char *path, const field *f, const char *own)
{
  const field *rival;
  char other[FIELD_PATH];
  for (int i = 0; (rival = field_rival(f, i)) != NULL; ++i)
    if (!strcmp(path, field_path(rival, -1, other))) return true;
  return !strcmp(path, own);
}

hc_status study_note_given(study_reader *q, const char *path, case_place at)
{
  if (q->n_given == STUDY_MOST_FIELDS)
    return case_refuse(&q->r, at, "one field too many, expected at most %d set or varied", STUDY_MOST_FIELDS);
  snprintf(q->given[q->n_given].path, FIELD_PATH, "%s", path);
  q->given[q->n_given++].at = at;
  return HC_OK;
}

hc_status study_give(study_reader *q, const yaml_node_t *key, case_target *t, char path[FIELD_PATH])
{
  q->r.here = yaml_place(&q->r, key);
  hc_status st = yaml_check_key(&q->r, key);
  if (st == HC_OK) st = case_find_target(&q->r, yaml_node_text(key), key->data.scalar.length, t);
  if (st != HC_OK) return st;
  const char *list = t->list == CASE_LOADS ? "forcing" : "contacts";
  if (t->whole) snprintf(path, FIELD_PATH, "%.*s", (int)key->data.scalar.length, yaml_node_text(key));
  else if (t->f) field_path(t->f, t->index, path);
  else snprintf(path, FIELD_PATH, t->index < 0 ? "%s" : "%s[%d]", list, t->index);
  for (int i = 0; i < q->n_given; ++i) {
    if (!(t->f ? clashes(q->given[i].path, t->f, path) : !strcmp(q->given[i].path, path))) continue;
    message *m = case_blame(&q->r, q->r.here);
    message_add(m, "`%s` is given twice, expected it once (also `%s` ", path, q->given[i].path);
    if (q->given[i].at.set) message_add(m, "by --set)");
    else message_add(m, "on line %zu)", q->given[i].at.line);
    return HC_BAD_INPUT;
  }
  return study_note_given(q, path, q->r.here);
}
