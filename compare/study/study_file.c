/* study_file.c - a study file's title, base case, what is set and claimed; in this order whatever the file's: base or
 * case, set, --set, vary (study_axes.c), views, claims. The first mistake ends it. Claims are held in claims.c. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/study/study_reader.h"
#include "numerics/base/number.h"
#include "numerics/base/path.h"

enum { KEY_STUDY, KEY_BASE, KEY_CASE, KEY_RUN, KEY_SET, KEY_VARY, KEY_VIEWS, KEY_CLAIMS, KEY_MAY_FAIL, N_KEYS };
static const char *const keys[] = {"study", "base", "case", "run", "set", "vary", "views", "claims", "may_fail", NULL};

/* ---- claims ---- */

enum {
  CLAIM_SOURCE,
  CLAIM_SAYS,
  CLAIM_FOUND,
  CLAIM_HOLDS,
  CLAIM_EXPECT,
  CLAIM_SECONDS,
  CLAIM_PAPER,
  CLAIM_OURS,
  CLAIM_FIXED_STEP,
  N_CLAIM_KEYS
};
static const char *const claim_keys[] = {"source",  "says",  "found", "holds",      "expect",
                                         "seconds", "paper", "ours",  "fixed_step", NULL};
enum { ANSWER_FOUND, ANSWER_HOLDS, ANSWER_EXPECT, ANSWER_SECONDS, N_ANSWER_KEYS };
static const char *const answer_keys[] = {"found", "holds", "expect", "seconds", NULL};

/* Where the value of a key goes, and how it is read. */
typedef struct key_value {
  size_t offset;
  hc_status (*read)(study_reader *q, const char *key, const yaml_node_t *node, void *to);
} key_value;

static hc_status read_values(study_reader *q, const yaml_node_t *node, const char *where, const char *const *keys_there,
                             const key_value *values, void *to, case_place *seen)
{
  hc_status st = HC_OK;
  for (int i = 0; i < yaml_keys(node) && st == HC_OK; ++i) {
    const int k = study_key(q, yaml_key(&q->r, node, i), where, keys_there, seen);
    if (k < 0) return HC_BAD_INPUT;
    st = values[k].read(q, keys_there[k], yaml_value(&q->r, node, i), (char *)to + values[k].offset);
  }
  return st;
}

static hc_status read_expectation(study_reader *q, const char *key, const yaml_node_t *node, void *to)
{
  static const char *const words[] = {
      [STUDY_EXPECT_AGREE] = "agree", [STUDY_EXPECT_DISAGREE] = "disagree", [STUDY_EXPECT_UNSAID] = "unsaid"};
  const char *text = node->type == YAML_SCALAR_NODE ? yaml_node_text(node) : "";
  for (int e = STUDY_EXPECT_AGREE; e <= STUDY_EXPECT_UNSAID; ++e)
    if (!strcmp(text, words[e])) {
      *(study_expectation *)to = (study_expectation)e;
      return HC_OK;
    }
  return yaml_refuse(&q->r, node, "%s is not known, expected agree, disagree or unsaid", key);
}

static hc_status read_answer(study_reader *q, const char *key, const yaml_node_t *node, void *to)
{
  static const key_value values[] = {[ANSWER_FOUND] = {offsetof(study_answer, found), study_read_text},
                                     [ANSWER_HOLDS] = {offsetof(study_answer, holds), study_read_text},
                                     [ANSWER_EXPECT] = {offsetof(study_answer, expect), read_expectation},
                                     [ANSWER_SECONDS] = {offsetof(study_answer, seconds), study_read_text}};
  const study_answer *a = to;
  case_place seen[N_ANSWER_KEYS] = {{0}};
  if (node->type != YAML_MAPPING_NODE)
    return yaml_refuse(&q->r, node,
                       "%s is %s, expected {found: \"SELECT ...\", holds: \"SELECT ...\", seconds: \"SELECT ...\"}",
                       key, yaml_node_what(node));
  const hc_status st = read_values(q, node, "the answer to a claim", answer_keys, values, to, seen);
  if (st != HC_OK || a->holds.text || a->seconds.text) return st;
  return yaml_refuse(&q->r, node, "missing key `holds` in `%s`, expected an SQL query that gives 0 or 1", key);
}

static hc_status read_seconds(study_reader *q, const char *key, const yaml_node_t *node, void *to)
{
  study_claim *c = to;
  hc_status st = study_read_text(q, key, node, &c->reported);
  if (st != HC_OK) return st;
  const size_t length = strlen(c->reported.text);
  if (number_read(c->reported.text, length, &c->seconds) == NUMBER_FINE && c->seconds >= 0) return HC_OK;
  return yaml_refuse(&q->r, node, "seconds is %s, expected how many the source reports, a number >= 0",
                     QUOTED(c->reported.text, length));
}

static hc_status read_claim(study_reader *q, const yaml_node_t *node, study_claim *c)
{
#define ANSWER(which) offsetof(study_claim, answers) + (which) * sizeof(study_answer)
  static const key_value values[] = {
      [CLAIM_SOURCE] = {offsetof(study_claim, source), study_read_text},
      [CLAIM_SAYS] = {offsetof(study_claim, says), study_read_text},
      [CLAIM_FOUND] = {ANSWER(STUDY_PLAIN) + offsetof(study_answer, found), study_read_text},
      [CLAIM_HOLDS] = {ANSWER(STUDY_PLAIN) + offsetof(study_answer, holds), study_read_text},
      [CLAIM_EXPECT] = {ANSWER(STUDY_PLAIN) + offsetof(study_answer, expect), read_expectation},
      [CLAIM_SECONDS] = {0, read_seconds},
      [CLAIM_PAPER] = {ANSWER(STUDY_PAPER), read_answer},
      [CLAIM_OURS] = {ANSWER(STUDY_OURS), read_answer},
      [CLAIM_FIXED_STEP] = {ANSWER(STUDY_FIXED_STEP), read_answer}};
  case_place seen[N_CLAIM_KEYS] = {{0}};
  c->seconds = NAN;
  if (node->type != YAML_MAPPING_NODE)
    return yaml_refuse(&q->r, node,
                       "a claim is %s, expected {source: ..., says: ..., found: \"SELECT ...\", holds: \"SELECT ...\"}",
                       yaml_node_what(node));
  const hc_status st = read_values(q, node, "a claim", claim_keys, values, c, seen);
  if (st != HC_OK) return st;
  /* What a whole claim can lack, or have too much of. */
  bool plain = c->answers[STUDY_PLAIN].holds.text != NULL,
       sided = seen[CLAIM_PAPER].line > 0 || seen[CLAIM_OURS].line > 0 || seen[CLAIM_FIXED_STEP].line > 0;
  const char *lacks = !c->says.text ? "says" : !plain && !sided ? "holds" : NULL;
  if (lacks)
    return yaml_refuse(&q->r, node, "missing key `%s` in a claim, expected %s", lacks,
                       c->says.text ? "an SQL query that gives 0 or 1" : "what is claimed, in words");
  if (!sided) return HC_OK;
  for (int k = CLAIM_FOUND; k <= CLAIM_EXPECT; ++k) {
    if (seen[k].line == 0) continue;
    return case_refuse(&q->r, seen[k], "`%s` beside `paper`, `ours` or `fixed_step`, expected it within them",
                       claim_keys[k]);
  }
  return HC_OK;
}

static hc_status read_claims(study_reader *q, const yaml_node_t *node)
{
  if (node->type != YAML_SEQUENCE_NODE)
    return yaml_refuse(&q->r, node, "claims is %s, expected a list of {source: ..., says: ..., found: ..., holds: ...}",
                       yaml_node_what(node));
  size_t n = (size_t)yaml_length(node);
  if (!(q->s->claims = calloc(n + 1, sizeof *q->s->claims))) return case_out_of_memory(&q->r);
  hc_status st = HC_OK;
  for (size_t i = 0; i < n && st == HC_OK; ++i) {
    q->s->n_claims = (int)i + 1;
    st = read_claim(q, yaml_entry(&q->r, node, (int)i), &q->s->claims[i]);
  }
  return st;
}

/* ---- views ---- */

/* A word that needs no quotes in SQL, and no table of ours. */
static bool good_name(const char *text)
{
  static const char *const taken[] = {"study", "scene", "row"};
  for (size_t i = 0; i < sizeof taken / sizeof *taken; ++i)
    if (!strcmp(text, taken[i])) return false;
  return !(*text >= '0' && *text <= '9') && text[strspn(text, "abcdefghijklmnopqrstuvwxyz_0123456789")] == 0;
}

static hc_status read_view(study_reader *q, const yaml_node_t *key, const yaml_node_t *value, int i)
{
  study_view *v = &q->s->views[i];
  q->s->n_views = i + 1;
  hc_status st = yaml_check_key(&q->r, key);
  if (st == HC_OK) st = study_read_text(q, "the name of a view", key, &v->name);
  if (st != HC_OK) return st;
  bool twice = false;
  for (int k = 0; k < i; ++k) twice |= !strcmp(q->s->views[k].name.text, v->name.text);
  if (!twice && good_name(v->name.text)) return study_read_text(q, "a view", value, &v->query);
  return yaml_refuse(&q->r, key, "a view is called %s, expected %s", YAML_QUOTED(key),
                     twice ? "a name of its own"
                           : "lower-case letters, digits and _, and neither study, scene nor row");
}

static hc_status read_views(study_reader *q, const yaml_node_t *node)
{
  if (node->type != YAML_MAPPING_NODE)
    return yaml_refuse(&q->r, node,
                       "views is %s, expected a mapping such as {exact: \"SELECT * FROM scene WHERE ...\"}",
                       yaml_node_what(node));
  const int n = yaml_keys(node);
  if (!(q->s->views = calloc((size_t)n + 1, sizeof *q->s->views))) return case_out_of_memory(&q->r);
  hc_status st = HC_OK;
  for (int i = 0; i < n && st == HC_OK; ++i) st = read_view(q, yaml_key(&q->r, node, i), yaml_value(&q->r, node, i), i);
  return st;
}

/* ---- the base case and what is set for all scenes ---- */

static hc_status read_set(study_reader *q, const yaml_node_t *node)
{
  if (node->type != YAML_MAPPING_NODE)
    return yaml_refuse(&q->r, node, "set is %s, expected a mapping such as {hbm.harmonics: 10}", yaml_node_what(node));
  hc_status st = HC_OK;
  for (int i = 0; i < yaml_keys(node) && st == HC_OK; ++i) {
    case_target t;
    char path[FIELD_PATH];
    st = study_give(q, yaml_key(&q->r, node, i), &t, path);
    if (st != HC_OK) break;
    do st = case_target_read(&q->r, t, yaml_value(&q->r, node, i));
    while (st == HC_OK && case_target_next(&q->r, &t));
  }
  return st;
}

static hc_status read_base(study_reader *q, const yaml_node_t *node)
{
  study_value name = {0};
  case_error inner = {{0}};
  hc_status st = study_read_text(q, "base", node, &name);
  if (st != HC_OK) return st;
  char *path = q->s->base_name = path_beside(q->r.name, name.text, strlen(name.text));
  free(name.text);
  if (!path) return case_out_of_memory(&q->r);
  st = case_read(path, 0, NULL, &q->r.sc, &inner);
  q->r.owns_structure = st == HC_OK;
  if (st == HC_IO) message_add(yaml_blame(&q->r, node), "the base case: %s", inner.message);
  else if (st != HC_OK) {
    message_start(&q->r.msg, q->r.msg.text, q->r.msg.size);
    message_add(&q->r.msg, "%s", inner.message); /* its own file, line and column */
  } else memset(q->r.contact_has, 0xff, sizeof q->r.contact_has);
  return st;
}

static hc_status read_case(study_reader *q, const yaml_node_t *node)
{
  hc_status st = yaml_scene_read(&q->r, node);
  if (st == HC_OK && !*q->r.sc.title)
    snprintf(q->r.sc.title, sizeof q->r.sc.title, "%.*s", (int)sizeof q->r.sc.title - 1, q->s->title);
  return st;
}

static hc_status read_title(study_reader *q, const yaml_node_t *node)
{
  study_value title = {0};
  hc_status st = study_read_text(q, "study", node, &title);
  if (st != HC_OK) return st;
  if (strlen(title.text) >= STUDY_TEXT || strpbrk(title.text, "\n\r"))
    st = yaml_refuse(&q->r, node, "the title is longer than a line, expected at most %d bytes", STUDY_TEXT - 1);
  else snprintf(q->s->title, sizeof q->s->title, "%s", title.text);
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
  return yaml_refuse(&q->r, node, "run is %s, expected frf, transient or compare",
                     *text ? YAML_QUOTED(node) : yaml_node_what(node));
}

static hc_status read_may_fail(study_reader *q, const yaml_node_t *node)
{
  const char *text = node->type == YAML_SCALAR_NODE ? yaml_node_text(node) : "";
  q->s->may_fail = !strcmp(text, "true");
  if (q->s->may_fail || !strcmp(text, "false")) return HC_OK;
  return yaml_refuse(&q->r, node, "may_fail is not known, expected true or false");
}

/* value[key] is NULL where a key is not given. */
static hc_status find_keys(study_reader *q, const yaml_node_t *root, const yaml_node_t *value[N_KEYS])
{
  case_place seen[N_KEYS] = {{0}};
  if (root->type != YAML_MAPPING_NODE)
    return yaml_refuse(&q->r, root, "the study is %s, expected a mapping with %s", yaml_node_what(root), q->r.required);
  for (int i = 0; i < yaml_keys(root); ++i) {
    const yaml_node_t *key = yaml_key(&q->r, root, i);
    const int k = study_key(q, key, "a study", keys, seen);
    if (k < 0) return HC_BAD_INPUT;
    value[k] = yaml_value(&q->r, root, i);
    if ((k == KEY_BASE || k == KEY_CASE) && value[KEY_BASE] && value[KEY_CASE])
      return yaml_refuse(&q->r, key, "both `base` and `case`, expected one of them");
  }
  if (!value[KEY_STUDY]) return yaml_refuse(&q->r, root, "missing key `study`, expected the study's title");
  if (!value[KEY_BASE] && !value[KEY_CASE])
    return yaml_refuse(&q->r, root, "missing key `base`, expected the name of a case file, or `case: {...}`");
  if (value[KEY_VARY]) return HC_OK;
  return yaml_refuse(&q->r, root, "missing key `vary`, expected a list such as [{hbm.samples: [32, 128]}]");
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
  /* The assignments of the command line; they may repeat what the file sets, but not what it varies. */
  if (st == HC_OK) {
    st = HC_OK;
    for (int k = 1; k <= n_set && st == HC_OK; ++k) {
      case_target t;
      char path[FIELD_PATH];
      const char *text = q->r.set[k - 1];
      if ((st = case_set_apply(&q->r, k)) != HC_OK) break;
      while (*text == ' ') ++text;
      if (case_find_target(&q->r, text, strcspn(text, "= "), &t) == HC_OK && t.f)
        st = study_note_given(q, field_path(t.f, t.index, path), (case_place){.set = k, .line = 1, .column = 1});
    }
    q->r.set_now = 0;
  }
  if (st == HC_OK) st = study_read_axes(q, value[KEY_VARY]);
  if (st == HC_OK && value[KEY_VIEWS]) st = read_views(q, value[KEY_VIEWS]);
  if (st == HC_OK && value[KEY_CLAIMS]) st = read_claims(q, value[KEY_CLAIMS]);
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
  if (read) st = yaml_text_load(&q->r, text, length);
  if (read && st != HC_OK) hint_at_brackets(q, text, length);
  if (st == HC_OK) {
    st = read_study(q, yaml_document_get_root_node(&q->r.doc), n_set);
    yaml_document_delete(&q->r.doc);
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
  mesh_free(q->r.mesh);
  free(q);
  return st;
}
