/* study_file.c - reading a study file: title, base case, what is set for all scenes. What varies: study_axes.c; what
 * is claimed: study_claims.c. In this order whatever the file's: base or case, set, --set, vary. The first mistake
 * ends it. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/study_reader.h"

#include "base/nearest.h"

enum { KEY_STUDY, KEY_BASE, KEY_CASE, KEY_RUN, KEY_SET, KEY_VARY, KEY_VIEWS, KEY_CLAIMS, KEY_MAY_FAIL, N_KEYS };
static const char *const keys[] = {"study", "base", "case", "run", "set", "vary", "views", "claims", "may_fail", NULL};

message *study_blame(study_reader *q, const yaml_node_t *node)
{
  return case_blame(&q->r, case_place_of(&q->r, node->start_mark));
}

hc_status study_no_memory(study_reader *q)
{
  message_add(case_blame(&q->r, (case_place){0}), "out of memory");
  return HC_NO_MEMORY;
}

static void unknown_key(study_reader *q, const yaml_node_t *key, const char *where, const char *const *words)
{
  const char *text = yaml_node_text(key);
  size_t length = key->data.scalar.length;
  message *m = study_blame(q, key);
  message_add(m, "unknown key `");
  message_add_input(m, text, length, 60);
  message_add(m, "` in %s", where);
  const char *guess = nearest_word(words, text, length);
  size_t stem = strcspn(text, ".[");
  if (guess) {
    message_add(m, ", did you mean `%s`?", guess);
    return;
  }
  if (words == keys && field_find_section(text, stem)) {
    message_add(m, ", expected fields of the case in `case`, `set` or `vary`");
    return;
  }
  message_add(m, ", expected one of");
  for (int i = 0; words[i]; ++i) message_add(m, "%s %s", i ? "," : "", words[i]);
}

int study_key(study_reader *q, const yaml_node_t *key, const char *where, const char *const *words, case_place *seen)
{
  if (!yaml_check_key(&q->r, key)) return -1;
  for (int i = 0; words[i]; ++i) {
    if (strlen(words[i]) != key->data.scalar.length || memcmp(words[i], yaml_node_text(key), key->data.scalar.length))
      continue;
    if (seen[i].line > 0) {
      yaml_duplicate_key(&q->r, key, seen[i]);
      return -1;
    }
    seen[i] = case_place_of(&q->r, key->start_mark);
    return i;
  }
  unknown_key(q, key, where, words);
  return -1;
}

hc_status study_read_text(study_reader *q, const char *what, const yaml_node_t *node, study_value *out)
{
  if (node->type != YAML_SCALAR_NODE || node->data.scalar.length == 0) {
    message_add(study_blame(q, node), "%s is %s, expected text", what, yaml_node_what(node));
    return HC_BAD_INPUT;
  }
  if (strlen(yaml_node_text(node)) != node->data.scalar.length) {
    message_add(study_blame(q, node), "%s has a zero character, expected text", what);
    return HC_BAD_INPUT;
  }
  *out = (study_value){strdup(yaml_node_text(node)), node->start_mark.line + 1, node->start_mark.column + 1};
  return out->text ? HC_OK : study_no_memory(q);
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

static hc_status note_given(study_reader *q, const char *path, case_place at)
{
  if (q->n_given == STUDY_MOST_FIELDS)
    return case_refuse(&q->r, at, "one field too many, expected at most %d set or varied", STUDY_MOST_FIELDS);
  snprintf(q->given[q->n_given].path, FIELD_PATH, "%s", path);
  q->given[q->n_given++].at = at;
  return HC_OK;
}

hc_status study_give(study_reader *q, const yaml_node_t *key, case_target *t, char path[FIELD_PATH])
{
  if (!yaml_check_key(&q->r, key)) return HC_BAD_INPUT;
  q->r.here = case_place_of(&q->r, key->start_mark);
  hc_status st = case_find_target(&q->r, yaml_node_text(key), key->data.scalar.length, t);
  if (st != HC_OK) return st;
  const char *list = t->list == CASE_LOADS ? "forcing" : "contacts";
  if (t->f) field_path(t->f, t->index, path);
  else snprintf(path, FIELD_PATH, t->index < 0 ? "%s" : "%s[%d]", list, t->index);
  for (int i = 0; i < q->n_given; ++i) {
    if (!(t->f ? clashes(q->given[i].path, t->f, path) : !strcmp(q->given[i].path, path))) continue;
    message *m = case_blame(&q->r, q->r.here);
    message_add(m, "`%s` is given twice, expected it once (also `%s` ", path, q->given[i].path);
    if (q->given[i].at.set) message_add(m, "by --set)");
    else message_add(m, "on line %zu)", q->given[i].at.line);
    return HC_BAD_INPUT;
  }
  return note_given(q, path, q->r.here);
}

/* One entry of `set`. */
static hc_status set_one(study_reader *q, const yaml_node_pair_t *pair)
{
  case_target t;
  char path[FIELD_PATH];
  yaml_node_t *value = study_node(q, pair->value);
  hc_status st = study_give(q, study_node(q, pair->key), &t, path);
  return st == HC_OK ? case_target_read(&q->r, &q->doc, t, value) : st;
}

static hc_status read_set(study_reader *q, const yaml_node_t *node)
{
  if (node->type != YAML_MAPPING_NODE) {
    message_add(study_blame(q, node), "set is %s, expected a mapping such as {hbm.harmonics: 10}",
                yaml_node_what(node));
    return HC_BAD_INPUT;
  }
  hc_status st = HC_OK;
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top && st == HC_OK; ++p)
    st = set_one(q, p);
  return st;
}

/* The assignments of the command line; they may repeat what the file sets, but not what it varies. */
static hc_status apply_options(study_reader *q, int n_set)
{
  hc_status st = HC_OK;
  for (int k = 1; k <= n_set && st == HC_OK; ++k) {
    case_target t;
    char path[FIELD_PATH];
    const char *text = q->r.set[k - 1];
    if ((st = case_set_apply(&q->r, k)) != HC_OK) break;
    while (*text == ' ') ++text;
    if (case_find_target(&q->r, text, strcspn(text, "= "), &t) == HC_OK && t.f)
      st = note_given(q, field_path(t.f, t.index, path), (case_place){.set = k, .line = 1, .column = 1});
  }
  q->r.set_now = 0;
  return st;
}

/* `name` as seen from the study file's folder, to free. */
static char *beside(const char *file, const char *name)
{
  const char *slash = strrchr(file, '/');
  size_t folder = slash && *name != '/' ? (size_t)(slash - file) + 1 : 0;
  size_t length = strlen(name) + 1;
  char *path = malloc(folder + length);
  if (!path) return NULL;
  memcpy(path, file, folder);
  memcpy(path + folder, name, length);
  return path;
}

static hc_status read_base(study_reader *q, const yaml_node_t *node)
{
  study_value name = {0};
  case_error inner = {{0}};
  hc_status st = study_read_text(q, "base", node, &name);
  if (st != HC_OK) return st;
  char *path = q->s->base_name = beside(q->r.name, name.text);
  st = path ? case_read(path, 0, NULL, &q->r.sc, &inner) : study_no_memory(q);
  q->r.owns_structure = path && st == HC_OK;
  if (path && st == HC_IO) message_add(study_blame(q, node), "the base case: %s", inner.message);
  else if (path && st != HC_OK) {
    message_start(&q->r.msg, q->r.msg.text, q->r.msg.size);
    message_add(&q->r.msg, "%s", inner.message); /* its own file, line and column */
  }
  if (st == HC_OK) memset(q->r.contact_has, 0xff, sizeof q->r.contact_has);
  free(name.text);
  return st;
}

static hc_status read_case(study_reader *q, const yaml_node_t *node)
{
  hc_status st = yaml_scene_read(&q->r, &q->doc, node);
  if (st == HC_OK && !*q->r.sc.title)
    snprintf(q->r.sc.title, sizeof q->r.sc.title, "%.*s", (int)sizeof q->r.sc.title - 1, q->s->title);
  return st;
}

static hc_status read_title(study_reader *q, const yaml_node_t *node)
{
  study_value title = {0};
  hc_status st = study_read_text(q, "study", node, &title);
  if (st != HC_OK) return st;
  size_t length = strlen(title.text);
  if (length >= STUDY_TEXT || strpbrk(title.text, "\n\r")) {
    message_add(study_blame(q, node), "the title is longer than a line, expected at most %d bytes", STUDY_TEXT - 1);
    st = HC_BAD_INPUT;
  } else memcpy(q->s->title, title.text, length + 1);
  free(title.text);
  return st;
}

static hc_status read_kind(study_reader *q, const yaml_node_t *node)
{
  const char *text = node->type == YAML_SCALAR_NODE ? yaml_node_text(node) : "";
  for (int k = STUDY_FRF; k <= STUDY_COMPARE; ++k)
    if (!strcmp(text, study_kind_name((study_kind)k))) {
      q->s->kind = (study_kind)k;
      return HC_OK;
    }
  message_add(study_blame(q, node), "run is ");
  if (*text) {
    message_add(&q->r.msg, "`");
    message_add_input(&q->r.msg, text, node->data.scalar.length, 60);
    message_add(&q->r.msg, "`");
  } else message_add(&q->r.msg, "%s", yaml_node_what(node));
  message_add(&q->r.msg, ", expected frf, transient or compare");
  return HC_BAD_INPUT;
}

static hc_status read_may_fail(study_reader *q, const yaml_node_t *node)
{
  const char *text = node->type == YAML_SCALAR_NODE ? yaml_node_text(node) : "";
  q->s->may_fail = !strcmp(text, "true");
  if (q->s->may_fail || !strcmp(text, "false")) return HC_OK;
  message_add(study_blame(q, node), "may_fail is not known, expected true or false");
  return HC_BAD_INPUT;
}

static hc_status missing(study_reader *q, const yaml_node_t *root, const char *what, const char *expected)
{
  message_add(study_blame(q, root), "missing key `%s`, expected %s", what, expected);
  return HC_BAD_INPUT;
}

/* value[key] is NULL where a key is not given. */
static hc_status find_keys(study_reader *q, const yaml_node_t *root, const yaml_node_t *value[N_KEYS])
{
  case_place seen[N_KEYS] = {{0}};
  if (root->type != YAML_MAPPING_NODE) {
    message_add(study_blame(q, root), "the study is %s, expected a mapping with %s", yaml_node_what(root),
                q->r.required);
    return HC_BAD_INPUT;
  }
  for (yaml_node_pair_t *p = root->data.mapping.pairs.start; p < root->data.mapping.pairs.top; ++p) {
    const yaml_node_t *key = study_node(q, p->key);
    int k = study_key(q, key, "a study", keys, seen);
    if (k < 0) return HC_BAD_INPUT;
    value[k] = study_node(q, p->value);
    if ((k != KEY_BASE && k != KEY_CASE) || !value[KEY_BASE] || !value[KEY_CASE]) continue;
    message_add(study_blame(q, key), "both `base` and `case`, expected one of them");
    return HC_BAD_INPUT;
  }
  if (!value[KEY_STUDY]) return missing(q, root, "study", "the study's title");
  if (!value[KEY_BASE] && !value[KEY_CASE])
    return missing(q, root, "base", "the name of a case file, or `case: {...}`");
  return value[KEY_VARY] ? HC_OK : missing(q, root, "vary", "a list such as [{hbm.samples: [32, 128]}]");
}

static hc_status read_study(study_reader *q, const yaml_node_t *root, int n_set)
{
  const yaml_node_t *value[N_KEYS] = {NULL};
  q->s->kind = STUDY_COMPARE;
  hc_status st = find_keys(q, root, value);
  if (st == HC_OK) st = read_title(q, value[KEY_STUDY]);
  if (st == HC_OK && value[KEY_RUN]) st = read_kind(q, value[KEY_RUN]);
  if (st == HC_OK && value[KEY_MAY_FAIL]) st = read_may_fail(q, value[KEY_MAY_FAIL]);
  if (st == HC_OK) st = value[KEY_BASE] ? read_base(q, value[KEY_BASE]) : read_case(q, value[KEY_CASE]);
  if (st == HC_OK && value[KEY_SET]) st = read_set(q, value[KEY_SET]);
  if (st == HC_OK) st = apply_options(q, n_set);
  if (st == HC_OK) st = study_read_axes(q, value[KEY_VARY]);
  if (st == HC_OK && value[KEY_VIEWS]) st = study_read_views(q, value[KEY_VIEWS]);
  if (st == HC_OK && value[KEY_CLAIMS]) st = study_read_claims(q, value[KEY_CLAIMS]);
  q->s->base = q->r.sc; /* and its structure, in any case */
  return st == HC_OK ? study_take_fingerprint(q->s) : st;
}

/* YAML's own trap: in braces a bracket begins a list, in the middle of a word too. */
static void hint_at_brackets(study_reader *q, const char *text, size_t length)
{
  static const char *const words[] = {"contacts[", "forcing["};
  for (size_t i = 0; i + strlen(words[0]) < length; ++i) {
    if (memcmp(text + i, words[0], strlen(words[0])) && memcmp(text + i, words[1], strlen(words[1]))) continue;
    message_add(&q->r.msg, " (in braces quote an indexed name: {\"contacts[0].gap\": ...})");
    return;
  }
}

static hc_status read_document(study_reader *q, int n_set)
{
  char *text = NULL;
  size_t length = 0;
  hc_status st = case_reader_slurp(&q->r, &text, &length);
  bool read = st == HC_OK;
  if (read) st = yaml_text_load(&q->r, text, length, &q->doc);
  if (read && st != HC_OK) hint_at_brackets(q, text, length);
  if (st == HC_OK) {
    st = read_study(q, yaml_document_get_root_node(&q->doc), n_set);
    yaml_document_delete(&q->doc);
  }
  free(text);
  return st;
}

hc_status study_read(const char *path, int n_set, const char *const *set, study **out, case_error *err)
{
  *out = NULL;
  const char *name = !strcmp(path, "-") ? "<stdin>" : path;
  study_reader *q = calloc(1, sizeof *q);
  if (!q) return HC_NO_MEMORY;
  case_reader_start(&q->r, name, set, err);
  q->r.noun = "study";
  q->r.required = "`study`, `base` or `case`, and `vary`";
  q->s = calloc(1, sizeof *q->s);
  hc_status st = q->s && (q->s->name = strdup(name)) ? read_document(q, n_set) : HC_NO_MEMORY;
  if (st == HC_OK) *out = q->s;
  else study_free(q->s);
  free(q);
  return st;
}
