/* study_claims.c - reading what a study claims, and the views its queries share. Holding them against results:
 * claims.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "study/study_reader.h"

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

static hc_status read_expectation(study_reader *q, const yaml_node_t *node, study_answer *a)
{
  const char *text = node->type == YAML_SCALAR_NODE ? yaml_node_text(node) : "";
  a->expect = !strcmp(text, "agree")      ? STUDY_EXPECT_AGREE
              : !strcmp(text, "disagree") ? STUDY_EXPECT_DISAGREE
              : !strcmp(text, "unsaid")   ? STUDY_EXPECT_UNSAID
                                          : STUDY_EXPECT_NOTHING;
  if (a->expect != STUDY_EXPECT_NOTHING) return HC_OK;
  message_add(study_blame(q, node), "expect is not known, expected agree, disagree or unsaid");
  return HC_BAD_INPUT;
}

static hc_status read_answer(study_reader *q, const char *name, const yaml_node_t *node, study_answer *a)
{
  case_place seen[N_ANSWER_KEYS] = {{0}};
  if (node->type != YAML_MAPPING_NODE) {
    message_add(study_blame(q, node),
                "%s is %s, expected {found: \"SELECT ...\", holds: \"SELECT ...\", seconds: \"SELECT ...\"}", name,
                yaml_node_what(node));
    return HC_BAD_INPUT;
  }
  hc_status st = HC_OK;
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top && st == HC_OK; ++p) {
    int k = study_key(q, study_node(q, p->key), "the answer to a claim", answer_keys, seen);
    const yaml_node_t *value = study_node(q, p->value);
    if (k < 0) return HC_BAD_INPUT;
    if (k == ANSWER_EXPECT) st = read_expectation(q, value, a);
    else
      st = study_read_text(q, answer_keys[k], value,
                           k == ANSWER_FOUND   ? &a->found
                           : k == ANSWER_HOLDS ? &a->holds
                                               : &a->seconds);
  }
  if (st != HC_OK || a->holds.text || a->seconds.text) return st;
  message_add(study_blame(q, node), "missing key `holds` in `%s`, expected an SQL query that gives 0 or 1", name);
  return HC_BAD_INPUT;
}

static hc_status read_seconds(study_reader *q, const yaml_node_t *node, study_claim *c)
{
  hc_status st = study_read_text(q, "seconds", node, &c->reported);
  if (st != HC_OK) return st;
  if (number_read(c->reported.text, strlen(c->reported.text), &c->seconds) == NUMBER_FINE && c->seconds >= 0)
    return HC_OK;
  message_add(study_blame(q, node), "seconds is `");
  message_add_input(&q->r.msg, c->reported.text, strlen(c->reported.text), 60);
  message_add(&q->r.msg, "`, expected how many the source reports, a number >= 0");
  return HC_BAD_INPUT;
}

static hc_status read_entry(study_reader *q, int k, const yaml_node_t *value, study_claim *c)
{
  study_answer *plain = &c->answers[STUDY_PLAIN];
  switch (k) {
  case CLAIM_SOURCE: return study_read_text(q, claim_keys[k], value, &c->source);
  case CLAIM_SAYS: return study_read_text(q, claim_keys[k], value, &c->says);
  case CLAIM_FOUND: return study_read_text(q, claim_keys[k], value, &plain->found);
  case CLAIM_HOLDS: return study_read_text(q, claim_keys[k], value, &plain->holds);
  case CLAIM_EXPECT: return read_expectation(q, value, plain);
  case CLAIM_SECONDS: return read_seconds(q, value, c);
  case CLAIM_PAPER: return read_answer(q, claim_keys[k], value, &c->answers[STUDY_PAPER]);
  case CLAIM_OURS: return read_answer(q, claim_keys[k], value, &c->answers[STUDY_OURS]);
  default: return read_answer(q, claim_keys[k], value, &c->answers[STUDY_FIXED_STEP]);
  }
}

/* What a whole claim can lack, or have too much of. */
static hc_status check_claim(study_reader *q, const yaml_node_t *node, const study_claim *c,
                             const case_place seen[N_CLAIM_KEYS])
{
  bool plain = c->answers[STUDY_PLAIN].holds.text != NULL,
       sided = seen[CLAIM_PAPER].line > 0 || seen[CLAIM_OURS].line > 0 || seen[CLAIM_FIXED_STEP].line > 0;
  const char *lacks = !c->says.text ? "says" : !plain && !sided ? "holds" : NULL;
  if (lacks) {
    message_add(study_blame(q, node), "missing key `%s` in a claim, expected %s", lacks,
                c->says.text ? "an SQL query that gives 0 or 1" : "what is claimed, in words");
    return HC_BAD_INPUT;
  }
  if (!sided) return HC_OK;
  for (int k = CLAIM_FOUND; k <= CLAIM_EXPECT; ++k) {
    if (seen[k].line == 0) continue;
    return case_refuse(&q->r, seen[k], "`%s` beside `paper`, `ours` or `fixed_step`, expected it within them",
                       claim_keys[k]);
  }
  return HC_OK;
}

static hc_status read_claim(study_reader *q, const yaml_node_t *node, study_claim *c)
{
  case_place seen[N_CLAIM_KEYS] = {{0}};
  c->seconds = NAN;
  if (node->type != YAML_MAPPING_NODE) {
    message_add(study_blame(q, node),
                "a claim is %s, expected {source: ..., says: ..., found: \"SELECT ...\", holds: \"SELECT ...\"}",
                yaml_node_what(node));
    return HC_BAD_INPUT;
  }
  hc_status st = HC_OK;
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top && st == HC_OK; ++p) {
    int k = study_key(q, study_node(q, p->key), "a claim", claim_keys, seen);
    if (k < 0) return HC_BAD_INPUT;
    st = read_entry(q, k, study_node(q, p->value), c);
  }
  return st == HC_OK ? check_claim(q, node, c, seen) : st;
}

hc_status study_read_claims(study_reader *q, const yaml_node_t *node)
{
  if (node->type != YAML_SEQUENCE_NODE) {
    message_add(study_blame(q, node),
                "claims is %s, expected a list of {source: ..., says: ..., found: ..., holds: ...}",
                yaml_node_what(node));
    return HC_BAD_INPUT;
  }
  size_t n = (size_t)(node->data.sequence.items.top - node->data.sequence.items.start);
  if (!(q->s->claims = calloc(n + 1, sizeof *q->s->claims))) return study_no_memory(q);
  hc_status st = HC_OK;
  for (size_t i = 0; i < n && st == HC_OK; ++i) {
    q->s->n_claims = (int)i + 1;
    st = read_claim(q, study_node(q, node->data.sequence.items.start[i]), &q->s->claims[i]);
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

static hc_status read_view(study_reader *q, const yaml_node_pair_t *pair, int i)
{
  yaml_node_t *key = study_node(q, pair->key);
  if (!yaml_check_key(&q->r, key)) return HC_BAD_INPUT;
  study_view *v = &q->s->views[i];
  q->s->n_views = i + 1;
  hc_status st = study_read_text(q, "the name of a view", key, &v->name);
  if (st != HC_OK) return st;
  bool twice = false;
  for (int k = 0; k < i; ++k) twice |= !strcmp(q->s->views[k].name.text, v->name.text);
  if (!twice && good_name(v->name.text)) return study_read_text(q, "a view", study_node(q, pair->value), &v->query);
  message_add(study_blame(q, key), "a view is called `");
  message_add_input(&q->r.msg, v->name.text, strlen(v->name.text), 60);
  message_add(&q->r.msg, "`, expected %s",
              twice ? "a name of its own" : "lower-case letters, digits and _, and neither study, scene nor row");
  return HC_BAD_INPUT;
}

hc_status study_read_views(study_reader *q, const yaml_node_t *node)
{
  if (node->type != YAML_MAPPING_NODE) {
    message_add(study_blame(q, node),
                "views is %s, expected a mapping such as {exact: \"SELECT * FROM scene WHERE ...\"}",
                yaml_node_what(node));
    return HC_BAD_INPUT;
  }
  size_t n = (size_t)(node->data.mapping.pairs.top - node->data.mapping.pairs.start);
  if (!(q->s->views = calloc(n + 1, sizeof *q->s->views))) return study_no_memory(q);
  hc_status st = HC_OK;
  for (size_t i = 0; i < n && st == HC_OK; ++i) st = read_view(q, &node->data.mapping.pairs.start[i], (int)i);
  return st;
}
