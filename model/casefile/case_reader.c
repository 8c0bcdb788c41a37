/* case_reader.c - what every part of the case reader uses: messages with their place, nodes of the document. */
#include "model/casefile/case_reader.h"

#include "numerics/base/growing.h"
#include "numerics/base/path.h"

message *case_blame(case_reader *r, case_place place)
{
  message *m = &r->msg;
  message_start(m, m->text, m->size);
  if (place.set > 0 && r->set) {
    message_add(m, "--set ");
    message_add_input(m, r->set[place.set - 1], strlen(r->set[place.set - 1]), 120);
    message_add(m, ": ");
  } else {
    message_add_input(m, r->name, strlen(r->name), 240);
    if (place.line > 0) message_add(m, ":%zu:%zu", place.line, place.column);
    message_add(m, ": ");
  }
  return m;
}

hc_status case_refuse(case_reader *r, case_place place, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  message_add_list(case_blame(r, place), format, args);
  va_end(args);
  return HC_BAD_INPUT;
}

hc_status yaml_mention(case_reader *r, const yaml_node_t *node, int dof, const char *file)
{
  case_source *s = r->source;
  if (!s || r->set_now > 0) return HC_OK;
  char *own = file ? strdup(file) : NULL;
  if ((file && !own) || !GROW(s->mentions, s->n_mentions)) return free(own), HC_NO_MEMORY;
  s->mentions[s->n_mentions++] = (case_mention){node->start_mark.index, node->end_mark.index, dof, own};
  return HC_OK;
}

char *yaml_file_beside(case_reader *r, const yaml_node_t *node)
{
  char *path = path_beside(r->name, yaml_node_text(node), node->data.scalar.length);
  if (!path || yaml_mention(r, node, -1, path) == HC_OK) return path;
  free(path);
  return NULL;
}

hc_status yaml_file_failed(case_reader *r, const yaml_node_t *node, const char *what, const char *path,
                           const char *expected)
{
  char words[160];
  snprintf(words, sizeof words, "%s", r->msg.text);
  message *m = yaml_blame(r, node);
  message_add(m, "%s: ", what);
  message_add_input(m, path, strlen(path), 160);
  message_add(m, " %s, expected %s", words, expected);
  return HC_BAD_INPUT;
}

bool case_suggest(message *m, suggestion s, const char *section, int j)
{
  char path[FIELD_PATH];
  if (s.f)
    message_add(m, ", did you mean `%s`?",
                section && !strcmp(section, s.f->section) ? s.f->name : field_path(s.f, j, path));
  if (s.s) message_add(m, ", did you mean `%s`%s?", s.s->name, section && *section ? " at the top level" : "");
  return s.f || s.s;
}

hc_status case_out_of_memory(case_reader *r)
{
  message_add(case_blame(r, (case_place){0}), "out of memory");
  return HC_NO_MEMORY;
}

const char *yaml_node_what(const yaml_node_t *n)
{
  if (n->type == YAML_MAPPING_NODE) return "a mapping";
  return n->type == YAML_SEQUENCE_NODE ? "a list" : n->data.scalar.length > 0 ? "a single value" : "empty";
}

bool yaml_node_is(const yaml_node_t *n, const char *word)
{
  return n->type == YAML_SCALAR_NODE && n->data.scalar.length == strlen(word) && !strcmp(yaml_node_text(n), word);
}

bool yaml_node_is_axis(const yaml_node_t *n)
{
  return n->type == YAML_SCALAR_NODE && n->data.scalar.length == 1 && structure_is_axis(*yaml_node_text(n));
}

const yaml_node_t *yaml_find(case_reader *r, const yaml_node_t *mapping, const char *key)
{
  for (int i = 0; i < yaml_keys(mapping); ++i)
    if (yaml_node_is(yaml_key(r, mapping, i), key)) return yaml_value(r, mapping, i);
  return NULL;
}

hc_status yaml_check_key(case_reader *r, const yaml_node_t *key)
{
  if (key->type == YAML_SCALAR_NODE) return HC_OK;
  return yaml_refuse(r, key, "%s stands where a key should, expected `key: value`", yaml_node_what(key));
}

hc_status yaml_unknown_key(case_reader *r, const yaml_node_t *key, const char *section)
{
  const char *text = yaml_node_text(key);
  const size_t length = key->data.scalar.length;
  message *m = yaml_blame(r, key);
  char path[FIELD_PATH];
  const int written = snprintf(path, sizeof path, "%s.%.*s", section, (int)length, text);
  if (written < FIELD_PATH && field_was_removed(m, path, (size_t)written)) return HC_BAD_INPUT;
  message_add(m, "unknown key %s", YAML_QUOTED(key));
  message_add(m, *section ? " in `%s`" : "%s", section);
  if (case_suggest(m, suggest_key(section, text, length), section, -1)) return HC_BAD_INPUT;
  message_add(m, ", expected one of");
  const field_section *s;
  int n = 0;
  for (int i = 0; i < field_count(); ++i)
    if (!strcmp(field_at(i)->section, section) && !strchr(field_at(i)->name, '.'))
      message_add(m, "%s %s", n++ ? "," : "", field_at(i)->name);
  for (int i = 1; !*section && (s = field_section_at(i)) != NULL; ++i)
    if (!strchr(s->name, '[')) message_add(m, ", %s", s->name);
  if (*text >= '0' && *text <= '9') message_add(m, " (a comma ends a value: the decimal sign is a point)");
  return HC_BAD_INPUT;
}

hc_status yaml_duplicate_key(case_reader *r, const yaml_node_t *key, case_place first)
{
  return yaml_refuse(r, key, "duplicate key %s, expected it once (first on line %zu)", YAML_QUOTED(key), first.line);
}

const field *yaml_key_field(case_reader *r, const yaml_node_t *key, const char *section)
{
  if (yaml_check_key(r, key) != HC_OK) return NULL;
  const field *f = field_find(section, yaml_node_text(key), key->data.scalar.length);
  if (!f) yaml_unknown_key(r, key, section);
  return f;
}

field_item yaml_node_item(const yaml_node_t *n)
{
  return (field_item){.text = yaml_node_text(n),
                      .length = n->data.scalar.length,
                      .quoted = n->data.scalar.style != YAML_PLAIN_SCALAR_STYLE,
                      .line = n->start_mark.line + 1,
                      .column = n->start_mark.column + 1};
}

const yaml_node_t *yaml_node_value(case_reader *r, const yaml_node_t *node, field_value *v)
{
  v->list = node->type == YAML_SEQUENCE_NODE;
  v->n = 1;
  if (node->type == YAML_MAPPING_NODE) return node;
  if (node->type == YAML_SCALAR_NODE) v->item[0] = yaml_node_item(node);
  if (node->type == YAML_SCALAR_NODE) return NULL;
  v->n = yaml_length(node);
  for (int i = 0; i < v->n && i < NUMBER_LIST_MAX; ++i) {
    const yaml_node_t *entry = yaml_entry(r, node, i);
    if (entry->type != YAML_SCALAR_NODE) return entry;
    v->item[i] = yaml_node_item(entry);
  }
  return NULL;
}

hc_status yaml_scene_value(case_reader *r, const field *f, int j, void *base, const yaml_node_t *node)
{
  char path[FIELD_PATH], why_text[512];
  field_value v;
  message why;
  int bad = -1;
  const yaml_node_t *misfit = yaml_node_value(r, node, &v);
  message_start(&why, why_text, sizeof why_text);
  if (!misfit && field_store(f, base, &v, &why, &bad)) return HC_OK;
  if (misfit) {
    message_add(&why, misfit == node ? " is %s, expected " : " has %s inside, expected ", yaml_node_what(misfit));
    field_expected(f, &why);
  }
  case_place at = yaml_place(r, misfit ? misfit : node);
  if (bad >= 0) at.line = v.item[bad].line, at.column = v.item[bad].column;
  return case_refuse(r, at, "%s%s", field_path(f, j, path), why.text);
}

const field *yaml_given_rival(const case_reader *r, const field *f)
{
  const field *rival;
  for (int i = 0; (rival = field_rival(f, i)) != NULL; ++i)
    if (case_given(r, rival)) return rival;
  return NULL;
}

hc_status yaml_give(case_reader *r, const field *f, const yaml_node_t *key, const yaml_node_t *value)
{
  const field *rival = yaml_given_rival(r, f);
  if (case_given(r, f)) return yaml_duplicate_key(r, key, r->at[field_index(f)]);
  if (rival)
    return yaml_refuse(r, key, "both `%s` (line %zu) and `%s` in `%s`, expected one of them", rival->name,
                       r->at[field_index(rival)].line, f->name, f->section);
  r->at[field_index(f)] = yaml_place(r, value);
  return HC_OK;
}

void yaml_forget_fields(case_reader *r, unsigned of)
{
  for (int i = 0; i < field_count(); ++i)
    if (field_at(i)->flags & of) r->at[i] = (case_place){0};
}

hc_status case_mesh_read(case_reader *r, const yaml_node_t *node)
{
  const char *path = r->sc.structure->mesh;
  if (r->mesh || !path) return HC_OK;
  const hc_status st = mesh_read(path, &r->mesh, &r->msg);
  if (st == HC_NO_MEMORY) return case_out_of_memory(r);
  return st == HC_IO ? yaml_file_failed(r, node, "structure.mesh", path, "a mesh of CalculiX or Abaqus (.inp)") : st;
}
