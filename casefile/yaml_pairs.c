/* yaml_pairs.c - an entry of contacts with `pairs`: a contact for each pair of nodes, see yaml_structure.h.
 *
 *     - {pairs: pairs.csv, axes: {normal: [1, 0, 0], tangent: [0, 1, 0]}, tangential_stiffness: 4e9, ...}
 *
 * Of nodes a and b with motions x_a and x_b in space: u = tangent . (x_a - x_b), v = normal . (x_a - x_b); stiffnesses
 * are per area. What comes out are contacts like any others. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "casefile/matrices/matrix_text.h"
#include "casefile/matrices/text_file.h"
#include "casefile/yaml_structure.h"

typedef enum pair_column { PAIR_NODE_A, PAIR_NODE_B, PAIR_GAP, PAIR_PRELOAD, PAIR_AREA, PAIR_COLUMNS } pair_column;

enum { PAIR_GROUND = -1 };

typedef struct pair_row {
  int a, b;                  /* nodes; b may be PAIR_GROUND */
  double gap, preload, area; /* 0, 0 and 1 where there is no such column */
} pair_row;

typedef struct pair_rows {
  case_reader *r;
  yaml_document_t *doc;
  const yaml_node_t *list; /* of rows in the case; NULL: a file */
  char *path, *bytes;      /* of the file */
  matrix_text text;
  int next;                   /* row of the list */
  int columns;                /* in a row */
  int column[PAIR_COLUMNS];   /* where each stands in a row; -1: nowhere */
  const yaml_node_t *current; /* row of the list, or NULL */
} pair_rows;

/* ---- the rows of `pairs`, which nodes touch, from a csv file or from the case itself ----
 *
 *     node_a,node_b[,gap][,preload][,area]      node_b may be `ground`
 *
 * The first row names the columns, in any order; in the case it may be left out where there are but the two nodes. */

static const size_t most_bytes = (size_t)16 << 20;
static const char *const names[PAIR_COLUMNS] = {"node_a", "node_b", "gap", "preload", "area"};
static const char expected_columns[] = "node_a,node_b[,gap][,preload][,area]";

static int word_count(const pair_rows *p) { return p->list ? yaml_length(p->current) : p->text.n_words; }

static matrix_word word_at(const pair_rows *p, int i)
{
  if (!p->list) return p->text.words[i];
  const yaml_node_t *node = yaml_entry(p->doc, p->current, i);
  return (matrix_word){yaml_node_text(node), node->data.scalar.length};
}

static message *blame_word(pair_rows *p, int i)
{
  if (p->list) return case_blame(p->r, case_place_of(p->r, yaml_entry(p->doc, p->current, i)->start_mark));
  return matrix_text_blame(&p->text, p->text.words[i].text);
}

static message *blame_row(pair_rows *p)
{
  if (p->list) return case_blame(p->r, case_place_of(p->r, p->current->start_mark));
  return matrix_text_blame(&p->text, p->text.line_text);
}

/* Start the message with the place of a column in the row read last; a column that there is. */
static message *pair_rows_blame(pair_rows *p, pair_column c) { return blame_word(p, p->column[c]); }

/* Word i and what was expected. */
static hc_status wrong_word(pair_rows *p, int i, const char *expected)
{
  const matrix_word w = word_at(p, i);
  message *m = blame_word(p, i);
  message_add_quoted(m, w.text, w.length);
  message_add(m, ", expected %s", expected);
  return HC_BAD_INPUT;
}

/* Go to the next row; false at the end. A row of the case is a list of single values. */
static bool next_row(pair_rows *p, hc_status *st)
{
  *st = HC_OK;
  if (!p->list) return matrix_text_next(&p->text);
  if (p->next == yaml_length(p->list)) return false;
  p->current = yaml_entry(p->doc, p->list, p->next++);
  bool whole = p->current->type == YAML_SEQUENCE_NODE && yaml_length(p->current) > 0;
  for (int i = 0; whole && i < yaml_length(p->current); ++i)
    whole = yaml_entry(p->doc, p->current, i)->type == YAML_SCALAR_NODE;
  if (whole) return true;
  message_add(blame_row(p), "%s stands where a row of pairs should, expected a list of %s", yaml_node_what(p->current),
              expected_columns);
  *st = HC_BAD_INPUT;
  return false;
}

static hc_status read_names(pair_rows *p)
{
  p->columns = word_count(p);
  for (int i = 0; i < p->columns && i < MATRIX_WORDS; ++i) {
    const matrix_word w = word_at(p, i);
    int c = 0;
    while (c < PAIR_COLUMNS && (strlen(names[c]) != w.length || memcmp(names[c], w.text, w.length) != 0)) ++c;
    if (c == PAIR_COLUMNS) return wrong_word(p, i, expected_columns);
    if (p->column[c] >= 0) return wrong_word(p, i, "each column once");
    p->column[c] = i;
  }
  if (p->column[PAIR_NODE_A] >= 0 && p->column[PAIR_NODE_B] >= 0) return HC_OK;
  message_add(blame_row(p), "no column %s, expected %s", names[p->column[PAIR_NODE_A] >= 0 ? PAIR_NODE_B : PAIR_NODE_A],
              expected_columns);
  return HC_BAD_INPUT;
}

static hc_status open_file(pair_rows *p, const yaml_node_t *node)
{
  char words[160];
  size_t length = 0;
  message told;
  message_start(&told, words, sizeof words);
  if (!(p->path = text_file_path(p->r->name, yaml_node_text(node), node->data.scalar.length)))
    return case_out_of_memory(p->r);
  hc_status st = text_file_read(p->path, most_bytes, &p->bytes, &length, &told);
  if (st == HC_NO_MEMORY) return case_out_of_memory(p->r);
  if (st != HC_OK) {
    message *m = case_blame(p->r, case_place_of(p->r, node->start_mark));
    message_add(m, "pairs: ");
    message_add_input(m, p->path, strlen(p->path), 160);
    message_add(m, " %s, expected a csv file %s", words, expected_columns);
    return HC_BAD_INPUT;
  }
  p->text = matrix_text_start(p->path, p->bytes, length, 0, &p->r->msg);
  if (matrix_text_next(&p->text)) return read_names(p);
  message_add(matrix_text_blame_end(&p->text), "nothing here, expected the line %s and one a pair", expected_columns);
  return HC_BAD_INPUT;
}

/* Rows of two nodes need no names. */
static hc_status open_list(pair_rows *p, const yaml_node_t *node)
{
  hc_status st;
  int number;
  p->list = node;
  if (!next_row(p, &st))
    return st == HC_OK ? yaml_refuse(p->r, node, "pairs is an empty list, expected rows of %s", expected_columns) : st;
  const matrix_word first = word_at(p, 0);
  if (number_read_integer(first.text, first.length, &number) != NUMBER_FINE) return read_names(p);
  p->columns = 2;
  p->column[PAIR_NODE_A] = 0, p->column[PAIR_NODE_B] = 1;
  p->next = 0;
  return HC_OK;
}

/* Open what the node of `pairs` names or holds, up to the names of the columns. pair_rows_close takes it however this
 * ended. */
static hc_status pair_rows_open(pair_rows *p, case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  *p = (pair_rows){.r = r, .doc = doc};
  for (int c = 0; c < PAIR_COLUMNS; ++c) p->column[c] = -1;
  if (node->type == YAML_SEQUENCE_NODE) return open_list(p, node);
  if (node->type == YAML_SCALAR_NODE && node->data.scalar.length > 0) return open_file(p, node);
  return yaml_refuse(r, node, "pairs is %s, expected a csv file %s, or such rows", yaml_node_what(node),
                     expected_columns);
}

static void pair_rows_close(pair_rows *p)
{
  free(p->path);
  free(p->bytes);
}

static hc_status read_node(pair_rows *p, pair_column c, int *node)
{
  const matrix_word w = word_at(p, p->column[c]);
  if (c == PAIR_NODE_B && w.length == 6 && !memcmp(w.text, "ground", 6)) {
    *node = PAIR_GROUND;
    return HC_OK;
  }
  if (number_read_integer(w.text, w.length, node) == NUMBER_FINE && *node >= 0) return HC_OK;
  return wrong_word(p, p->column[c], c == PAIR_NODE_B ? "the number of a node, or ground" : "the number of a node");
}

static hc_status read_real(pair_rows *p, pair_column c, double low, const char *expected, double *value)
{
  if (p->column[c] < 0) return HC_OK;
  const matrix_word w = word_at(p, p->column[c]);
  double x;
  if (number_read(w.text, w.length, &x) != NUMBER_FINE || !(x >= low) || (c == PAIR_AREA && !(x > 0)))
    return wrong_word(p, p->column[c], expected);
  *value = x + 0.0; /* -0 is 0 */
  return HC_OK;
}

/* The next row; *more = false at the end. */
static hc_status pair_rows_next(pair_rows *p, pair_row *row, bool *more)
{
  hc_status st;
  *row = (pair_row){.area = 1};
  *more = next_row(p, &st);
  if (!*more) return st;
  if (word_count(p) != p->columns) {
    message_add(blame_row(p), "%d values in a row of pairs, expected %d", word_count(p), p->columns);
    return HC_BAD_INPUT;
  }
  st = read_node(p, PAIR_NODE_A, &row->a);
  if (st == HC_OK) st = read_node(p, PAIR_NODE_B, &row->b);
  if (st == HC_OK) st = read_real(p, PAIR_GAP, -INFINITY, "a number, the gap", &row->gap);
  if (st == HC_OK) st = read_real(p, PAIR_PRELOAD, 0, "a number >= 0, the preload", &row->preload);
  if (st == HC_OK) st = read_real(p, PAIR_AREA, 0, "a number > 0, the area", &row->area);
  if (st != HC_OK || row->a != row->b) return st;
  message_add(blame_row(p), "node %d against itself, expected two nodes", row->a);
  return HC_BAD_INPUT;
}

typedef enum axis { NORMAL, TANGENT, TANGENT_2, AXES } axis;

static const char *const axis_names[AXES] = {"normal", "tangent", "tangent_2"};

typedef struct pairs_entry {
  scene_contact given; /* of every contact, stiffnesses per area */
  case_place place;
  int first; /* of its contacts */
  double axes[AXES][3];
  bool has[AXES];
} pairs_entry;

static const field *part(const char *name) { return field_find("contacts", name, strlen(name)); }

/* ---- axes ---- */

static hc_status read_vector(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, axis k, double *to)
{
  char path[FIELD_PATH];
  const bool list = node->type == YAML_SEQUENCE_NODE;
  snprintf(path, sizeof path, "axes.%s", axis_names[k]);
  if (!list || yaml_length(node) != 3)
    return yaml_refuse(r, node, "%s is no direction in space, expected [X, Y, Z]", path);
  hc_status st = HC_OK;
  for (int d = 0; d < 3 && st == HC_OK; ++d) st = yaml_number(r, yaml_entry(doc, node, d), path, &to[d]);
  return st;
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Unit vectors across each other, to the digits that people write. */
static hc_status check_orthonormal(case_reader *r, const yaml_node_t *node, const pairs_entry *e)
{
  const double near = 1e-6;
  char text[NUMBER_TEXT];
  for (int i = 0; i < AXES; ++i)
    for (int k = 0; k <= i; ++k) {
      if (!e->has[i] || !e->has[k]) continue;
      const double product = dot(e->axes[i], e->axes[k]);
      if (fabs(product - (i == k)) <= near) continue;
      message *m = case_blame(r, case_place_of(r, node->start_mark));
      if (i == k)
        message_add(m, "axes.%s has the length %s, expected 1", axis_names[i], number_write(sqrt(product), text));
      else
        message_add(m, "axes.%s is not across axes.%s, their product is %s, expected 0", axis_names[i], axis_names[k],
                    number_write(product, text));
      return HC_BAD_INPUT;
    }
  return HC_OK;
}

/* tangent_2 = normal x tangent */
static void complete(pairs_entry *e)
{
  const double *n = e->axes[NORMAL], *t = e->axes[TANGENT];
  double *s = e->axes[TANGENT_2];
  s[0] = n[1] * t[2] - n[2] * t[1];
  s[1] = n[2] * t[0] - n[0] * t[2];
  s[2] = n[0] * t[1] - n[1] * t[0];
  e->has[TANGENT_2] = true;
}

static hc_status read_axes(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, pairs_entry *e)
{
  bool seen[AXES] = {false};
  if (node->type != YAML_MAPPING_NODE)
    return yaml_refuse(r, node, "axes is %s, expected %s", yaml_node_what(node), part("axes")->expects);
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key), *value = yaml_document_get_node(doc, p->value);
    int k = 0;
    if (!yaml_check_key(r, key)) return HC_BAD_INPUT;
    while (k < AXES && !yaml_node_is(key, axis_names[k])) ++k;
    if (k == AXES || seen[k])
      return yaml_refuse(r, key, "%s in axes, expected normal, tangent and tangent_2, each once",
                         k == AXES ? "another key" : "a key again");
    seen[k] = true;
    if (k == TANGENT_2 && yaml_node_is(value, "none")) continue;
    const hc_status st = read_vector(r, doc, value, (axis)k, e->axes[k]);
    if (st != HC_OK) return st;
    e->has[k] = true;
  }
  const bool alone = !e->has[TANGENT] && (e->has[TANGENT_2] || !e->has[NORMAL]);
  if (alone)
    return yaml_refuse(r, node, "axes without a tangent%s, expected %s",
                       e->has[TANGENT_2] ? ", but with a tangent_2" : " and without a normal", part("axes")->expects);
  const hc_status st = check_orthonormal(r, node, e);
  if (st == HC_OK && e->has[NORMAL] && e->has[TANGENT] && !seen[TANGENT_2]) complete(e);
  return st;
}

/* ---- the entry ---- */

/* A key that is for one contact alone. */
static hc_status not_of_pairs(case_reader *r, const yaml_node_t *key)
{
  message *m = case_blame(r, case_place_of(r, key->start_mark));
  message_add_input(m, yaml_node_text(key), key->data.scalar.length, 60);
  message_add(m, " beside `pairs`, expected `axes`: directions in space, of all pairs");
  return HC_BAD_INPUT;
}

static hc_status read_keys(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, pairs_entry *e,
                           const yaml_node_t **rows, const yaml_node_t **axes)
{
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key), *value = yaml_document_get_node(doc, p->value);
    if (!yaml_check_key(r, key)) return HC_BAD_INPUT;
    const field *f = field_find("contacts", yaml_node_text(key), key->data.scalar.length);
    if (!f) return yaml_unknown_key(r, key, "contacts");
    const yaml_node_t **to = f == part("pairs") ? rows : f == part("axes") ? axes : NULL;
    if (!to && (f->kind == FIELD_PART || f == part("angle_deg"))) return not_of_pairs(r, key);
    if (to && *to) return yaml_duplicate_key(r, key, r->at[field_index(f)]);
    const hc_status st = to ? HC_OK : yaml_scene_field(r, doc, f, e->first, &e->given, p);
    if (st != HC_OK) return st;
    if (to) *to = value, r->at[field_index(f)] = case_place_of(r, value->start_mark);
  }
  return HC_OK;
}

/* What the entry's contacts need, given the axes and the columns that there are. */
static hc_status check_entry(case_reader *r, const pairs_entry *e, const pair_rows *rows)
{
  const struct {
    const char *name;
    bool needed, useful;
  } all[] = {{"tangential_stiffness", e->has[TANGENT], e->has[TANGENT]},
             {"friction", e->has[TANGENT], e->has[TANGENT]},
             {"normal_stiffness", e->has[NORMAL], e->has[NORMAL]},
             {"preload", !e->has[NORMAL] && rows->column[PAIR_PRELOAD] < 0, true},
             {"gap", false, e->has[NORMAL]},
             {"limit", false, e->has[TANGENT_2]}};
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    const field *f = part(all[i].name);
    const bool given = case_given(r, f);
    if (given ? all[i].useful : !all[i].needed) continue;
    message *m = case_blame(r, given ? r->at[field_index(f)] : e->place);
    if (given) message_add(m, "%s beside axes that have no use for it, expected none", f->name);
    else {
      message_add(m, "missing key `%s` beside `pairs`, expected ", f->name);
      field_expected(f, m);
    }
    return HC_BAD_INPUT;
  }
  const bool gap = case_given(r, part("gap")) || rows->column[PAIR_GAP] >= 0;
  const bool preload = case_given(r, part("preload")) || rows->column[PAIR_PRELOAD] >= 0;
  if (!(gap && preload) && !(rows->column[PAIR_GAP] >= 0 && !e->has[NORMAL])) return HC_OK;
  return case_refuse(r, e->place,
                     gap && preload ? "both a gap and a preload of pairs, expected one: preload = normal_stiffness "
                                      "area gap"
                                    : "a column of gaps beside axes without a normal, expected none");
}

/* ---- its contacts ---- */

/* sign axis . x of a node, added to direction[n]. */
static hc_status add_motion(pair_rows *rows, const scene_structure *s, pair_column c, int node, const double *along,
                            double sign, double *direction)
{
  for (int d = 0; d < 3; ++d) {
    const int dof = along[d] != 0 ? structure_node_dof(s, node, "xyz"[d]) : -1;
    if (dof >= 0) direction[dof] += sign * along[d];
    if (dof >= 0 || along[d] == 0) continue;
    message_add(pair_rows_blame(rows, c), "no DOF of node %d in direction %c, expected one of structure.nodes%s", node,
                "xyz"[d], s -> n_nodes == 0 ? ", which is not given" : "");
    return HC_BAD_INPUT;
  }
  return HC_OK;
}

/* NAME-1, NAME-2, ...; without a name the nodes: 17-117. */
static bool name_contact(const pairs_entry *e, int k, const pair_row *row, char name[SCENE_NAME])
{
  const char *own = e->given.name;
  int length;
  if (*own) length = snprintf(name, SCENE_NAME, "%s-%d", own, k + 1);
  else if (row->b == PAIR_GROUND) length = snprintf(name, SCENE_NAME, "%d-ground", row->a);
  else length = snprintf(name, SCENE_NAME, "%d-%d", row->a, row->b);
  return length < SCENE_NAME;
}

static hc_status add_contact(pair_rows *rows, const pairs_entry *e, int k, const pair_row *row)
{
  case_reader *r = rows->r;
  scene_structure *s = r->sc.structure;
  structure_contact *c = structure_add_contact(s);
  if (!c) return case_out_of_memory(r);
  c->given = e->given;
  c->place = e->place;
  c->given.law.kt *= row->area;
  c->given.law.kn *= row->area;
  if (rows->column[PAIR_GAP] >= 0) c->given.law.gap = row->gap;
  if (rows->column[PAIR_PRELOAD] >= 0) c->given.preload = row->preload;
  memset(c->given.name, 0, sizeof c->given.name);
  if (!name_contact(e, k, row, c->given.name) || !isfinite(c->given.law.kt) || !isfinite(c->given.law.kn)) {
    message_add(pair_rows_blame(rows, PAIR_NODE_A),
                "a pair whose name or stiffness becomes too large, expected a shorter name or a smaller area");
    return HC_BAD_INPUT;
  }
  double *const to[AXES] = {[NORMAL] = c->normal, [TANGENT] = c->tangent, [TANGENT_2] = c->tangent_2};
  hc_status st = HC_OK;
  for (int i = 0; i < AXES && st == HC_OK; ++i) {
    if (!e->has[i]) continue;
    st = add_motion(rows, s, PAIR_NODE_A, row->a, e->axes[i], 1, to[i]);
    if (st == HC_OK && row->b != PAIR_GROUND) st = add_motion(rows, s, PAIR_NODE_B, row->b, e->axes[i], -1, to[i]);
  }
  return st;
}

/* Has an earlier row the same two nodes? */
static bool is_there(const pair_row *all, int n, const pair_row *row)
{
  for (int i = 0; i < n; ++i)
    if ((all[i].a == row->a && all[i].b == row->b) || (all[i].a == row->b && all[i].b == row->a)) return true;
  return false;
}

static hc_status read_rows(pair_rows *rows, const pairs_entry *e, pair_row *all)
{
  bool more = true;
  hc_status st = HC_OK;
  for (int k = 0; st == HC_OK; ++k) {
    pair_row row;
    st = pair_rows_next(rows, &row, &more);
    if (st != HC_OK || !more) return st;
    if (k == MATRIX_MOST_ROWS || is_there(all, k, &row)) {
      message *m = pair_rows_blame(rows, PAIR_NODE_A);
      if (k == MATRIX_MOST_ROWS) message_add(m, "another pair, expected at most %d", (int)MATRIX_MOST_ROWS);
      else message_add(m, "the same two nodes again, expected each pair once");
      return HC_BAD_INPUT;
    }
    all[k] = row;
    st = add_contact(rows, e, k, &row);
  }
  return st;
}

hc_status yaml_pairs_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  static const char *const needed[] = {"pairs", "axes"};
  const yaml_node_t *given[2] = {NULL, NULL};
  pairs_entry e = {.place = case_place_of(r, node->start_mark), .first = r->sc.structure->n_contacts};
  pair_rows rows;
  yaml_forget_fields(r, FIELD_IN_CONTACT);
  field_contact_defaults(&e.given);
  hc_status st = read_keys(r, doc, node, &e, &given[0], &given[1]);
  for (int i = 0; i < 2 && st == HC_OK; ++i) {
    if (given[i]) continue;
    return case_refuse(r, e.place, "missing key `%s` beside `%s`, expected %s", needed[i], needed[1 - i],
                       part(needed[i])->expects);
  }
  if (st == HC_OK) st = read_axes(r, doc, given[1], &e);
  if (st != HC_OK) return st;
  st = pair_rows_open(&rows, r, doc, given[0]);
  if (st == HC_OK) st = check_entry(r, &e, &rows);
  pair_row *all = st == HC_OK ? malloc(MATRIX_MOST_ROWS * sizeof *all) : NULL;
  if (st == HC_OK) st = all ? read_rows(&rows, &e, all) : case_out_of_memory(r);
  free(all);
  pair_rows_close(&rows);
  return st;
}
