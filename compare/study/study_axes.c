/* study_axes.c - what varies: lists, ranges, fields that go together; values are checked before anything runs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/study/study_reader.h"
#include "numerics/base/number.h"

enum { RANGE_FROM, RANGE_TO, RANGE_COUNT, RANGE_SCALE, N_RANGE_KEYS };
static const char *const range_keys[] = {"from", "to", "count", "scale", NULL};

typedef struct range {
  double from, to;
  int count;
  bool log;
  case_place seen[N_RANGE_KEYS];
} range;

/* ---- ranges ---- */

/* Value i of the range. Powers of ten rather than of e, so that decades come out exactly. */
static double range_at(const range *g, int i)
{
  if (i == 0) return g->from;
  if (i == g->count - 1) return g->to;
  double part = (double)i / (g->count - 1);
  if (g->log) return pow(10, log10(g->from) + (log10(g->to) - log10(g->from)) * i / (g->count - 1));
  double x = g->from + (g->to - g->from) * i / (g->count - 1);
  return isfinite(x) ? x : (1 - part) * g->from + part * g->to;
}

static hc_status bad_entry(study_reader *q, const char *path, const char *key, const yaml_node_t *node,
                           const char *expected)
{
  const bool text = node->type == YAML_SCALAR_NODE && node->data.scalar.length > 0;
  return yaml_refuse(&q->r, node, "%s: `%s` is %s, expected %s", path, key,
                     text ? YAML_QUOTED(node) : yaml_node_what(node), expected);
}

static hc_status read_range_entry(study_reader *q, const char *path, int k, const yaml_node_t *node, range *g)
{
  bool scalar = node->type == YAML_SCALAR_NODE;
  field_item it = scalar ? yaml_node_item(node) : (field_item){.text = "", .quoted = true};
  switch (k) {
  case RANGE_FROM:
  case RANGE_TO:
    if (!it.quoted && number_read(it.text, it.length, k == RANGE_FROM ? &g->from : &g->to) == NUMBER_FINE) return HC_OK;
    return bad_entry(q, path, range_keys[k], node, "a number");
  case RANGE_COUNT:
    if (!it.quoted && number_read_integer(it.text, it.length, &g->count) == NUMBER_FINE && g->count >= 1 &&
        g->count <= STUDY_MOST_SCENES)
      return HC_OK;
    return bad_entry(q, path, range_keys[k], node, "an integer 1..1000000");
  default:
    g->log = it.length == 3 && !memcmp(it.text, "log", 3);
    if (g->log || (it.length == 6 && !memcmp(it.text, "linear", 6))) return HC_OK;
    return bad_entry(q, path, range_keys[k], node, "linear or log");
  }
}

/* What a whole range can be wrong about, or NULL. */
static const char *range_fault(const field *f, const range *g)
{
  if (f->kind != FIELD_REAL && f->kind != FIELD_INTEGER)
    return "is no number, expected a list [..., ...] of its values";
  for (int k = RANGE_FROM; k <= RANGE_COUNT; ++k)
    if (g->seen[k].line == 0) return "has an incomplete range, expected {from: A, to: B, count: N}, or with scale: log";
  if (g->log && !(g->from > 0 && g->to > 0))
    return "has a log range that does not stay above 0, expected from > 0 and to > 0";
  if (g->count == 1 && g->from != g->to)
    return "has a range of one value with two ends, expected count >= 2, or a list of one";
  return g->count > 1 && g->from == g->to ? "has a range whose ends are equal, expected from and to to differ" : NULL;
}

static hc_status read_range(study_reader *q, const char *path, const field *f, const yaml_node_t *node, range *g)
{
  char where[FIELD_PATH + 16];
  *g = (range){0};
  snprintf(where, sizeof where, "the range of `%s`", path);
  for (int i = 0; i < yaml_keys(node); ++i) {
    int k = study_key(q, yaml_key(&q->r, node, i), where, range_keys, g->seen);
    if (k < 0) return HC_BAD_INPUT;
    hc_status st = read_range_entry(q, path, k, yaml_value(&q->r, node, i), g);
    if (st != HC_OK) return st;
  }
  const char *fault = range_fault(f, g);
  if (!fault) return HC_OK;
  return yaml_refuse(&q->r, node, "`%s` %s", path, fault);
}

/* The field as if what it is in began with it: a value can be tried before there is anything to store it in. */
static field alone(const field *f)
{
  field own = *f;
  own.offset = own.in_cycles = 0;
  own.flags &= ~(unsigned)FIELD_OSCILLATOR;
  return own;
}

/* Value i as text, held against its field. Integers forgive the rounding of a log range. */
static hc_status range_value(study_reader *q, const study_field *sf, const range *g, int i, const yaml_node_t *node,
                             study_value *out)
{
  char text[NUMBER_TEXT], words[256];
  number_list tried; /* room for any value */
  const field f = alone(sf->f);
  message why;
  int bad;
  double x = range_at(g, i);
  if (sf->f->kind == FIELD_INTEGER && fabs(x - rint(x)) <= 1e-9 * fabs(x)) x = rint(x);
  number_write(x, text);
  field_value v = {.n = 1, .item[0] = {.text = text, .length = strlen(text)}};
  message_start(&why, words, sizeof words);
  if (!field_store(&f, &tried, &v, &why, &bad))
    return yaml_refuse(&q->r, node, "%s%s (value %d of %d of the range)", sf->path, why.text, i + 1, g->count);
  *out = (study_value){strdup(text), node->start_mark.line + 1, node->start_mark.column + 1};
  return out->text ? HC_OK : case_out_of_memory(&q->r);
}

/* ---- lists ---- */

/* The value as --set takes it, numbers in their shortest form. It has been accepted before. */
static char *canonical(study_reader *q, const field *f, const yaml_node_t *node)
{
  field_value v;
  message m;
  yaml_node_value(&q->r, node, &v);
  size_t size = 64;
  for (int i = 0; i < v.n; ++i) size += v.item[i].length + NUMBER_TEXT + 2;
  char *text = malloc(size);
  if (!text) return NULL;
  message_start(&m, text, size);
  if (v.list) message_add(&m, "[");
  for (int i = 0; i < v.n; ++i) {
    if (i) message_add(&m, ", ");
    char shortest[NUMBER_TEXT];
    double x;
    bool number = f->kind != FIELD_CHOICE && f->kind != FIELD_FLAG && f->kind != FIELD_TEXT;
    if (number && number_read(v.item[i].text, v.item[i].length, &x) == NUMBER_FINE)
      message_add(&m, "%s", number_write(x, shortest));
    else message_add(&m, "%.*s", (int)v.item[i].length, v.item[i].text);
  }
  if (v.list) message_add(&m, "]");
  return text;
}

static hc_status list_value(study_reader *q, const study_field *sf, const yaml_node_t *node, study_value *out)
{
  number_list tried; /* room for any value */
  const field f = alone(sf->f);
  hc_status st = yaml_scene_value(&q->r, &f, sf->contact, &tried, node);
  if (st != HC_OK) return st;
  *out = (study_value){canonical(q, sf->f, node), node->start_mark.line + 1, node->start_mark.column + 1};
  return out->text ? HC_OK : case_out_of_memory(&q->r);
}

/* ---- axes ---- */

/* How many values the node gives, and the range if it is one. */
static hc_status count_values(study_reader *q, const study_field *sf, const yaml_node_t *node, range *g, int *n)
{
  if (node->type == YAML_MAPPING_NODE) {
    hc_status st = read_range(q, sf->path, sf->f, node, g);
    *n = g->count;
    return st;
  }
  long count = node->type == YAML_SEQUENCE_NODE ? yaml_length(node) : 0;
  *n = (int)count;
  if (count > 0) return HC_OK;
  return yaml_refuse(&q->r, node, "`%s` varies over %s, expected a list of values or {from: A, to: B, count: N}",
                     sf->path, node->type == YAML_SEQUENCE_NODE ? "an empty list" : yaml_node_what(node));
}

static hc_status read_values(study_reader *q, study_axis *a, study_field *sf, const yaml_node_t *node)
{
  range g;
  int n;
  hc_status st = count_values(q, sf, node, &g, &n);
  if (st == HC_OK && sf != a->fields && n != a->n)
    st = yaml_refuse(&q->r, node, "`%s` has %d values but `%s` on the same axis has %d, expected as many", sf->path, n,
                     a->fields[0].path, a->n);
  if (st != HC_OK || n < 1) return st; /* a list of none has been refused */
  a->n = n;
  if (!(sf->values = calloc((size_t)n, sizeof *sf->values))) return case_out_of_memory(&q->r);
  for (int i = 0; i < n && st == HC_OK; ++i)
    st = node->type == YAML_MAPPING_NODE ? range_value(q, sf, &g, i, node, &sf->values[i])
                                         : list_value(q, sf, yaml_entry(&q->r, node, (int)i), &sf->values[i]);
  return st;
}

static hc_status read_field(study_reader *q, study_axis *a, const yaml_node_t *key, const yaml_node_t *value)
{
  case_target t;
  study_field *sf = &a->fields[a->n_fields];
  int contacts = scene_contact_count(&q->r.sc);
  hc_status st = study_give(q, key, &t, sf->path);
  if (st != HC_OK) return st;
  const bool part = t.f && t.f->kind == FIELD_PART;
  if (!t.f || part || (t.list == CASE_CONTACTS && t.index >= contacts))
    return yaml_refuse(&q->r, key, "`%s` cannot vary, expected %s", sf->path,
                       part ? "a number, a choice or a flag, such as structure.damping.modal"
                            : "a field of a contact that the base case has, such as contacts[0].gap");
  sf->f = t.f;
  sf->contact = t.index, sf->whole = t.whole;
  sf->line = key->start_mark.line + 1;
  sf->column = key->start_mark.column + 1;
  ++a->n_fields;
  return read_values(q, a, sf, value);
}

/* For sorting the values of an axis, each with all its fields. */
typedef struct entry {
  const study_axis *axis;
  int i;
} entry;

static int by_value(const void *pa, const void *pb)
{
  const entry *a = pa, *b = pb;
  for (int k = 0; k < a->axis->n_fields; ++k) {
    int d = strcmp(a->axis->fields[k].values[a->i].text, b->axis->fields[k].values[b->i].text);
    if (d) return d;
  }
  return 0;
}

/* A value listed twice would be the same scene twice. */
static hc_status check_repeats(study_reader *q, const study_axis *a)
{
  entry *all = malloc(((size_t)a->n + 1) * sizeof *all); /* one more: never of 0 bytes */
  if (!all) return case_out_of_memory(&q->r);
  for (int i = 0; i < a->n; ++i) all[i] = (entry){a, i};
  qsort(all, (size_t)a->n, sizeof *all, by_value);
  int again = -1;
  for (int i = 1; i < a->n && again < 0; ++i)
    if (by_value(&all[i - 1], &all[i]) == 0) again = all[i].i > all[i - 1].i ? all[i].i : all[i - 1].i;
  free(all);
  if (again < 0) return HC_OK;
  const study_value *v = &a->fields[0].values[again];
  message *m = case_blame(&q->r, (case_place){.line = v->line, .column = v->column});
  message_add(m, "`%s` has the value `", a->fields[0].path);
  message_add_input(m, v->text, strlen(v->text), 60);
  message_add(m, "` twice%s, expected different values", a->n_fields > 1 ? " with the same companions" : "");
  return HC_BAD_INPUT;
}

static hc_status read_axis(study_reader *q, study_axis *a, const yaml_node_t *node)
{
  bool mapping = node->type == YAML_MAPPING_NODE;
  const int n = mapping ? yaml_keys(node) : 0;
  if (n == 0)
    return yaml_refuse(&q->r, node, "an axis is %s, expected {FIELD: [VALUE, ...]}",
                       mapping ? "empty" : yaml_node_what(node));
  if (!(a->fields = calloc((size_t)n, sizeof *a->fields))) return case_out_of_memory(&q->r);
  hc_status st = HC_OK;
  for (int i = 0; i < n && st == HC_OK; ++i)
    st = read_field(q, a, yaml_key(&q->r, node, i), yaml_value(&q->r, node, i));
  if (st == HC_OK) st = check_repeats(q, a);
  if (st != HC_OK) return st;
  q->s->n_scenes *= a->n;
  if (q->s->n_scenes <= STUDY_MOST_SCENES) return HC_OK;
  return yaml_refuse(&q->r, node, "the grid has %ld scenes up to here, expected at most %d", q->s->n_scenes,
                     STUDY_MOST_SCENES);
}

hc_status study_read_axes(study_reader *q, const yaml_node_t *node)
{
  size_t n = node->type == YAML_SEQUENCE_NODE ? (size_t)yaml_length(node) : 0;
  if (n == 0)
    return yaml_refuse(&q->r, node, "vary is %s, expected a list of axes such as [{hbm.samples: [32, 128]}]",
                       node->type == YAML_SEQUENCE_NODE ? "an empty list" : yaml_node_what(node));
  if (!(q->s->axes = calloc(n, sizeof *q->s->axes))) return case_out_of_memory(&q->r);
  q->s->n_scenes = 1;
  hc_status st = HC_OK;
  for (size_t i = 0; i < n && st == HC_OK; ++i) {
    q->s->n_axes = (int)i + 1;
    st = read_axis(q, &q->s->axes[i], yaml_entry(&q->r, node, (int)i));
  }
  return st;
}
