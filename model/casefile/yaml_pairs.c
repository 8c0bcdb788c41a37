/* yaml_pairs.c - an entry of contacts with `pairs`: a contact for each pair of nodes, see case_reader.h.
 *
 *     - {pairs: pairs.csv, axes: {normal: [1, 0, 0], tangent: [0, 1, 0]}, tangential_stiffness: 4e9, ...}
 *     - {pairs: {between: [SET, nodes.csv], within: 1e-4}, tangential_stiffness: 4e9, ...}
 *
 * Of nodes a and b with motions x_a and x_b in space: u = tangent . (x_a - x_b), v = normal . (x_a - x_b); stiffnesses
 * are per area. What comes out are contacts like any others. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/casefile/case_reader.h"
#include "model/casefile/matrices/matrix_text.h"
#include "model/casefile/matrices/text_file.h"
#include "model/casefile/mesh/pairing.h"
#include "numerics/base/number.h"
#include "numerics/norm.h"

typedef enum axis { NORMAL, TANGENT, TANGENT_2, AXES } axis;

static const char *const axis_names[AXES] = {"normal", "tangent", "tangent_2"};

typedef struct pairs_entry {
  scene_contact given; /* of every contact, stiffnesses per area */
  case_place place;
  int first; /* of its contacts */
  double axes[AXES][3];
  bool has[AXES];
  bool normal_given; /* else each pair has its own */
} pairs_entry;

/* ---- the rows of `pairs`, which nodes touch, from a csv file, from the case itself, or found by position ----
 *
 *     node_a,node_b[,gap][,preload][,area]      node_b may be `ground`
 *
 * The first row names the columns, in any order; in the case it may be left out where there are but the two nodes. */

typedef enum pair_column { PAIR_NODE_A, PAIR_NODE_B, PAIR_GAP, PAIR_PRELOAD, PAIR_AREA, PAIR_COLUMNS } pair_column;

enum { PAIR_GROUND = -1 };

typedef struct pair_row {
  int a, b;                  /* nodes; b may be PAIR_GROUND */
  double gap, preload, area; /* 0, 0 and 1 where there is no such column */
  const double *normal;      /* [3] of this pair alone; NULL: of the entry */
} pair_row;

typedef struct pair_rows {
  case_reader *r;
  const yaml_node_t *list;    /* of rows in the case; NULL: a file                      */
  const yaml_node_t *current; /* row of the list                                        */
  int next;                   /* row of the list                                        */
  char *path, *bytes;         /* of the file                                            */
  matrix_text text;           /* the file, and the words of the current row of any kind */
  int columns;                /* in a row                                               */
  int column[PAIR_COLUMNS];   /* where each stands in a row; -1: nowhere                */
  patch side[2];              /* that `between` names; side[0].v = NULL: it is not given */
  pairing found;              /* between them                                            */
} pair_rows;

static const size_t most_bytes = (size_t)16 << 20;
static const char *const names[PAIR_COLUMNS] = {"node_a", "node_b", "gap", "preload", "area"};
static const char expected_columns[] = "node_a,node_b[,gap][,preload][,area]";

/* The message about word i of the current row, or with i < 0 about the row; after the word itself where `quoted`. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
static hc_status
refuse(pair_rows *p, int i, bool quoted, const char *format, ...)
{
  const char *at = i < 0 ? p->text.line_text : p->text.words[i].text;
  message *m = p->side[0].v ? yaml_blame(p->r, p->current)
               : !p->list   ? matrix_text_blame(&p->text, at)
               : i < 0      ? yaml_blame(p->r, p->current)
                            : yaml_blame(p->r, yaml_entry(p->r, p->current, i));
  va_list args;
  va_start(args, format);
  if (quoted) message_add_quoted(m, at, p->text.words[i].length);
  message_add_list(m, format, args);
  va_end(args);
  return HC_BAD_INPUT;
}

/* Go to the next row; false at the end. A row of the case is a list of single values. */
static bool next_row(pair_rows *p, hc_status *st)
{
  *st = HC_OK;
  if (!p->list) return matrix_text_next(&p->text);
  if (p->next == yaml_length(p->list)) return false;
  const yaml_node_t *row = p->current = yaml_entry(p->r, p->list, p->next++);
  bool whole = row->type == YAML_SEQUENCE_NODE && (p->text.n_words = yaml_length(row)) > 0;
  for (int i = 0; whole && i < p->text.n_words; ++i) {
    const yaml_node_t *word = yaml_entry(p->r, row, i);
    whole = word->type == YAML_SCALAR_NODE;
    if (whole && i < MATRIX_WORDS) p->text.words[i] = (matrix_word){yaml_node_text(word), word->data.scalar.length};
  }
  if (whole) return true;
  *st = refuse(p, -1, false, "%s stands where a row of pairs should, expected a list of %s", yaml_node_what(row),
               expected_columns);
  return false;
}

static hc_status read_names(pair_rows *p)
{
  p->columns = p->text.n_words;
  for (int i = 0; i < p->columns && i < MATRIX_WORDS; ++i) {
    const matrix_word w = p->text.words[i];
    int c = 0;
    while (c < PAIR_COLUMNS && (strlen(names[c]) != w.length || memcmp(names[c], w.text, w.length) != 0)) ++c;
    if (c == PAIR_COLUMNS) return refuse(p, i, true, ", expected %s", expected_columns);
    if (p->column[c] >= 0) return refuse(p, i, true, ", expected each column once");
    p->column[c] = i;
  }
  if (p->column[PAIR_NODE_A] >= 0 && p->column[PAIR_NODE_B] >= 0) return HC_OK;
  return refuse(p, -1, false, "no column %s, expected %s",
                names[p->column[PAIR_NODE_A] >= 0 ? PAIR_NODE_B : PAIR_NODE_A], expected_columns);
}

static hc_status open_file(pair_rows *p, const yaml_node_t *node)
{
  size_t length = 0;
  p->path = yaml_file_beside(p->r, node);
  const hc_status st = p->path ? text_file_read(p->path, most_bytes, &p->bytes, &length, &p->r->msg) : HC_NO_MEMORY;
  if (st == HC_NO_MEMORY) return case_out_of_memory(p->r);
  if (st != HC_OK)
    return yaml_file_failed(p->r, node, "pairs", p->path, "a csv file node_a,node_b[,gap][,preload][,area]");
  p->text = matrix_text_start(p->path, p->bytes, length, 0, &p->r->msg);
  if (matrix_text_next(&p->text)) return read_names(p);
  return matrix_text_refuse(&p->text, NULL, "nothing here, expected the line %s and one a pair", expected_columns);
}

/* Rows of two nodes need no names. */
static hc_status open_list(pair_rows *p, const yaml_node_t *node)
{
  hc_status st;
  int number;
  p->list = node;
  if (!next_row(p, &st))
    return st == HC_OK ? yaml_refuse(p->r, node, "pairs is an empty list, expected rows of %s", expected_columns) : st;
  if (number_read_integer(p->text.words[0].text, p->text.words[0].length, &number) != NUMBER_FINE) return read_names(p);
  p->columns = 2;
  p->column[PAIR_NODE_A] = 0, p->column[PAIR_NODE_B] = 1;
  p->next = 0;
  return HC_OK;
}

static hc_status read_side(pair_rows *p, const yaml_node_t *node, patch *to)
{
  case_reader *r = p->r;
  const char *name = node->type == YAML_SCALAR_NODE ? yaml_node_text(node) : "";
  const size_t length = strlen(name);
  hc_status st = HC_OK;
  if (length > 4 && !strcmp(name + length - 4, ".csv")) {
    char *path = yaml_file_beside(r, node);
    st = path ? patch_read(path, to, &r->msg) : HC_NO_MEMORY;
    if (st == HC_IO) st = yaml_file_failed(r, node, "pairs.between", path, "a csv file node,x,y,z");
    free(path);
  } else {
    st = case_mesh_read(r, node);
    const int set = r->mesh ? mesh_find(r->mesh, name, length) : -1;
    if (st != HC_OK) return st;
    const char *near = r->mesh ? mesh_nearest(r->mesh, name, length) : NULL;
    if (set < 0)
      return yaml_refuse(r, node,
                         "no set of nodes %s in structure.mesh%s, expected one, or a FILE.csv node,x,y,z%s%s%s",
                         QUOTED(name, length), r->mesh ? "" : ", which is not given", near ? "; did you mean `" : "",
                         near ? near : "", near ? "`?" : "");
    st = mesh_patch(r->mesh, set, to, &r->msg);
  }
  if (st == HC_NO_MEMORY) return case_out_of_memory(r);
  if (st == HC_OK && to->n == 0)
    return yaml_refuse(r, node, "no node in %s, expected nodes of one side of the contact", QUOTED(name, length));
  return st;
}

/* ", 2 nodes of PLAT_A without a partner: 17, 18" */
static void note_alone(const pair_rows *p, int side, const char *name, message *m)
{
  const patch *of = &p->side[side];
  int alone = of->n - p->found.n;
  if (alone > 0) message_add(m, "; %d node%s of %s without a partner:", alone, alone > 1 ? "s" : "", name);
  for (int i = 0, told = 0; i < of->n && told < alone; ++i) {
    bool has = false;
    for (int k = 0; k < p->found.n && !has; ++k) has = i == (side == 0 ? p->found.pairs[k].a : p->found.pairs[k].b);
    if (has) continue;
    message_add(m, "%s %d", told > 0 ? "," : "", of->v[i].node);
    ++told;
  }
}

static hc_status note_pairs(const pair_rows *p, const yaml_node_t *sides)
{
  char text[1024];
  const char *name[2];
  message m;
  message_start(&m, text, sizeof text);
  for (int i = 0; i < 2; ++i) name[i] = yaml_node_text(yaml_entry(p->r, sides, i));
  message_add(&m, "%d pairs between %s and %s, up to %.3g apart, area %.6g in all; normals and areas from ", p->found.n,
              name[0], name[1], p->found.farthest, p->found.area);
  if (p->found.from == PAIRING_PLANE) message_add(&m, "a plane through the nodes of %s, which have no faces", name[0]);
  else message_add(&m, "the faces of %s", name[p->found.from == PAIRING_FACES_B]);
  for (int i = 0; i < 2; ++i) note_alone(p, i, name[i], &m);
  return structure_note(p->r->sc.structure, text);
}

/* {between: [A, B], within: DISTANCE} */
static hc_status open_between(pair_rows *p, const yaml_node_t *node, const pairs_entry *e)
{
  case_reader *r = p->r;
  const yaml_node_t *sides = yaml_find(r, node, "between"), *distance = yaml_find(r, node, "within");
  double within;
  char words[384];
  message why;
  if (yaml_keys(node) != 2 || !sides || !distance || sides->type != YAML_SEQUENCE_NODE || yaml_length(sides) != 2)
    return yaml_refuse(r, node,
                       "pairs is a mapping of something else, expected {between: [SET, SET], within: DISTANCE}");
  hc_status st = yaml_number(r, distance, "pairs.within", &within);
  if (st == HC_OK && !(within > 0))
    return yaml_refuse(r, distance, "pairs.within is not positive, expected a distance");
  for (int i = 0; i < 2 && st == HC_OK; ++i) st = read_side(p, yaml_entry(r, sides, i), &p->side[i]);
  if (st != HC_OK) return st;
  message_start(&why, words, sizeof words);
  st = pairing_make(&p->side[0], &p->side[1], within, e->normal_given ? e->axes[NORMAL] : NULL, &p->found, &why);
  if (st == HC_OK) st = note_pairs(p, sides);
  if (st == HC_BAD_INPUT) return yaml_refuse(r, sides, "%s", words);
  return st == HC_NO_MEMORY ? case_out_of_memory(r) : st;
}

/* Open what the node of `pairs` names or holds, up to the names of the columns. To be closed however this ended. */
static hc_status pair_rows_open(pair_rows *p, case_reader *r, const yaml_node_t *node, const pairs_entry *e)
{
  *p = (pair_rows){.r = r, .current = node};
  for (int c = 0; c < PAIR_COLUMNS; ++c) p->column[c] = -1;
  if (node->type == YAML_MAPPING_NODE) return open_between(p, node, e);
  if (node->type == YAML_SEQUENCE_NODE) return open_list(p, node);
  if (node->type == YAML_SCALAR_NODE && node->data.scalar.length > 0) return open_file(p, node);
  return yaml_refuse(r, node, "pairs is %s, expected %s", yaml_node_what(node),
                     field_named("contacts", "pairs")->expects);
}

static void pair_rows_close(pair_rows *p)
{
  free(p->path);
  free(p->bytes);
  free(p->side[0].v);
  free(p->side[1].v);
  free(p->found.pairs);
}

static hc_status read_node(pair_rows *p, pair_column c, int *node)
{
  const matrix_word w = p->text.words[p->column[c]];
  *node = PAIR_GROUND;
  if (c == PAIR_NODE_B && w.length == 6 && !memcmp(w.text, "ground", 6)) return HC_OK;
  if (number_read_integer(w.text, w.length, node) == NUMBER_FINE && *node >= 0) return HC_OK;
  return refuse(p, p->column[c], true, ", expected the number of a node%s", c == PAIR_NODE_B ? ", or ground" : "");
}

static hc_status read_real(pair_rows *p, pair_column c, double low, const char *expected, double *value)
{
  if (p->column[c] < 0) return HC_OK;
  const matrix_word w = p->text.words[p->column[c]];
  double x;
  if (number_read(w.text, w.length, &x) != NUMBER_FINE || !(x >= low) || (c == PAIR_AREA && !(x > 0)))
    return refuse(p, p->column[c], true, ", expected %s", expected);
  *value = x + 0.0; /* -0 is 0 */
  return HC_OK;
}

/* The next row; *more = false at the end. */
static hc_status pair_rows_next(pair_rows *p, pair_row *row, bool *more)
{
  hc_status st;
  *row = (pair_row){.area = 1};
  if (p->side[0].v) {
    *more = p->next < p->found.n;
    if (!*more) return HC_OK;
    const node_pair *k = &p->found.pairs[p->next++];
    *row = (pair_row){p->side[0].v[k->a].node, p->side[1].v[k->b].node, 0, 0, k->area, k->normal};
    return HC_OK;
  }
  *more = next_row(p, &st);
  if (!*more) return st;
  if (p->text.n_words != p->columns)
    return refuse(p, -1, false, "%d values in a row of pairs, expected %d", p->text.n_words, p->columns);
  st = read_node(p, PAIR_NODE_A, &row->a);
  if (st == HC_OK) st = read_node(p, PAIR_NODE_B, &row->b);
  if (st == HC_OK) st = read_real(p, PAIR_GAP, -INFINITY, "a number, the gap", &row->gap);
  if (st == HC_OK) st = read_real(p, PAIR_PRELOAD, 0, "a number >= 0, the preload", &row->preload);
  if (st == HC_OK) st = read_real(p, PAIR_AREA, 0, "a number > 0, the area", &row->area);
  if (st != HC_OK || row->a != row->b) return st;
  return refuse(p, -1, false, "node %d against itself, expected two nodes", row->a);
}

/* ---- axes ---- */

static hc_status read_vector(case_reader *r, const yaml_node_t *node, axis k, double *to)
{
  char path[FIELD_PATH];
  snprintf(path, sizeof path, "axes.%s", axis_names[k]);
  if (node->type != YAML_SEQUENCE_NODE || yaml_length(node) != 3)
    return yaml_refuse(r, node, "%s is no direction in space, expected [X, Y, Z]", path);
  hc_status st = HC_OK;
  for (int d = 0; d < 3 && st == HC_OK; ++d) st = yaml_number(r, yaml_entry(r, node, d), path, &to[d]);
  return st;
}

/* Unit vectors across each other, to the digits that people write. */
static hc_status check_orthonormal(case_reader *r, const yaml_node_t *node, const pairs_entry *e)
{
  const double near = 1e-6;
  char text[NUMBER_TEXT];
  for (int i = 0; i < AXES; ++i)
    for (int k = 0; k <= i; ++k) {
      if (!e->has[i] || !e->has[k]) continue;
      const double product = dot_product(3, e->axes[i], e->axes[k]);
      if (fabs(product - (i == k)) <= near) continue;
      if (i == k)
        return yaml_refuse(r, node, "axes.%s has the length %s, expected 1", axis_names[i],
                           number_write(sqrt(product), text));
      return yaml_refuse(r, node, "axes.%s is not across axes.%s, their product is %s, expected 0", axis_names[i],
                         axis_names[k], number_write(product, text));
    }
  return HC_OK;
}

/* tangent_2 = normal x tangent */
static void put_across(double axes[AXES][3])
{
  for (int d = 0; d < 3; ++d) {
    const int j = (d + 1) % 3, k = (d + 2) % 3;
    axes[TANGENT_2][d] = axes[NORMAL][j] * axes[TANGENT][k] - axes[NORMAL][k] * axes[TANGENT][j];
  }
}

/* Pairs found by position take normals from the faces, tangents across; `tangent: none` leaves the normal alone. */
static hc_status read_axes(case_reader *r, const yaml_node_t *node, bool between, pairs_entry *e)
{
  bool seen[AXES] = {false};
  if (!node) {
    for (int k = 0; k < AXES; ++k) e->has[k] = true;
    return HC_OK;
  }
  if (node->type != YAML_MAPPING_NODE)
    return yaml_refuse(r, node, "axes is %s, expected %s", yaml_node_what(node),
                       field_named("contacts", "axes")->expects);
  for (int i = 0; i < yaml_keys(node); ++i) {
    const yaml_node_t *key = yaml_key(r, node, i), *value = yaml_value(r, node, i);
    int k = 0;
    hc_status st = yaml_check_key(r, key);
    if (st != HC_OK) return st;
    while (k < AXES && !yaml_node_is(key, axis_names[k])) ++k;
    if (k == AXES || seen[k])
      return yaml_refuse(r, key, "%s in axes, expected normal, tangent and tangent_2, each once",
                         k == AXES ? "another key" : "a key again");
    seen[k] = true;
    if ((k == TANGENT_2 || (k == TANGENT && between)) && yaml_node_is(value, "none")) continue;
    if (k == TANGENT_2 && between) return yaml_refuse(r, value, "axes.tangent_2 beside `between`, expected none");
    st = read_vector(r, value, (axis)k, e->axes[k]);
    if (st != HC_OK) return st;
    e->has[k] = true;
  }
  if (between) {
    const hc_status st = check_orthonormal(r, node, e);
    e->normal_given = e->has[NORMAL];
    e->has[NORMAL] = true;
    e->has[TANGENT] |= !seen[TANGENT];
    e->has[TANGENT_2] = e->has[TANGENT] && !seen[TANGENT_2];
    return st;
  }
  const bool alone = !e->has[TANGENT] && (e->has[TANGENT_2] || !e->has[NORMAL]);
  if (alone)
    return yaml_refuse(r, node, "axes without a tangent%s, expected %s",
                       e->has[TANGENT_2] ? ", but with a tangent_2" : " and without a normal",
                       field_named("contacts", "axes")->expects);
  const hc_status st = check_orthonormal(r, node, e);
  if (st != HC_OK || !e->has[NORMAL] || !e->has[TANGENT] || seen[TANGENT_2]) return st;
  put_across(e->axes);
  e->has[TANGENT_2] = true;
  return HC_OK;
}

/* The axes of one pair: the entry's, or with its own normal the part of the entry's tangent across that; where the
 * entry has none, of the axis of space that it is most nearly across. */
static hc_status axes_of(pair_rows *rows, const pairs_entry *e, const pair_row *row, double axes[AXES][3])
{
  memcpy(axes, e->axes, sizeof e->axes);
  if (!row->normal) return HC_OK;
  const double *n = row->normal;
  double *t = axes[TANGENT];
  memcpy(axes[NORMAL], n, sizeof axes[NORMAL]);
  if (is_zero(3, t))
    t[fabs(n[0]) <= fabs(n[1]) ? fabs(n[0]) <= fabs(n[2]) ? 0 : 2 : fabs(n[1]) <= fabs(n[2]) ? 1 : 2] = 1;
  const double along = dot_product(3, t, n);
  for (int d = 0; d < 3; ++d) t[d] -= along * n[d];
  const double length = norm_2(3, t);
  if (!(length > 1e-3))
    return refuse(rows, -1, false, "axes.tangent is the normal of the pair %d, %d, expected one across all normals",
                  row->a, row->b);
  for (int d = 0; d < 3; ++d) t[d] /= length;
  put_across(axes);
  return HC_OK;
}

/* ---- the entry ---- */

static hc_status read_keys(case_reader *r, const yaml_node_t *node, pairs_entry *e, const yaml_node_t **rows,
                           const yaml_node_t **axes)
{
  hc_status st = HC_OK;
  for (int i = 0; i < yaml_keys(node) && st == HC_OK; ++i) {
    const yaml_node_t *key = yaml_key(r, node, i), *value = yaml_value(r, node, i);
    const field *f = yaml_key_field(r, key, "contacts");
    if (!f) return HC_BAD_INPUT;
    const yaml_node_t **to = f == field_named("contacts", "pairs")  ? rows
                             : f == field_named("contacts", "axes") ? axes
                                                                    : NULL;
    if (!to &&
        (f->kind == FIELD_PART || f == field_named("contacts", "angle_deg"))) /* they are for one contact alone */
      return yaml_refuse(r, key, "%s beside `pairs`, expected `axes`: directions in space, of all pairs", f->name);
    st = yaml_give(r, f, key, value);
    if (to) *to = value;
    else if (st == HC_OK) st = yaml_scene_value(r, f, e->first, &e->given, value);
  }
  return st;
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
    const field *f = field_named("contacts", all[i].name);
    const bool given = case_given(r, f);
    if (given ? all[i].useful : !all[i].needed) continue;
    if (given)
      return case_refuse(r, r->at[field_index(f)], "%s beside axes that have no use for it, expected none", f->name);
    message *m = case_blame(r, e->place);
    message_add(m, "missing key `%s` beside `pairs`, expected ", f->name);
    field_expected(f, m);
    return HC_BAD_INPUT;
  }
  const bool gap = case_given(r, field_named("contacts", "gap")) || rows->column[PAIR_GAP] >= 0;
  const bool preload = case_given(r, field_named("contacts", "preload")) || rows->column[PAIR_PRELOAD] >= 0;
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
    if (dof < 0 && along[d] != 0)
      return refuse(rows, rows->column[c], false,
                    "no DOF of node %d in direction %c, expected one of structure.nodes%s", node, "xyz"[d],
                    s -> n_nodes == 0 ? ", which is not given" : "");
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
  c->area = row->area;
  c->given.law.kt *= row->area;
  c->given.law.kn *= row->area;
  if (rows->column[PAIR_GAP] >= 0) c->given.law.gap = row->gap;
  if (rows->column[PAIR_PRELOAD] >= 0) c->given.preload = row->preload;
  memset(c->given.name, 0, sizeof c->given.name);
  if (!name_contact(e, k, row, c->given.name) || !isfinite(c->given.law.kt) || !isfinite(c->given.law.kn))
    return refuse(rows, rows->column[PAIR_NODE_A], false,
                  "a pair whose name or stiffness becomes too large, expected a shorter name or a smaller area");
  double axes[AXES][3];
  double *const to[AXES] = {[NORMAL] = c->normal, [TANGENT] = c->tangent, [TANGENT_2] = c->tangent_2};
  hc_status st = axes_of(rows, e, row, axes);
  for (int i = 0; i < AXES && st == HC_OK; ++i) {
    if (!e->has[i]) continue;
    st = add_motion(rows, s, PAIR_NODE_A, row->a, axes[i], 1, to[i]);
    if (st == HC_OK && row->b != PAIR_GROUND) st = add_motion(rows, s, PAIR_NODE_B, row->b, axes[i], -1, to[i]);
  }
  return st;
}

static hc_status read_rows(pair_rows *rows, const pairs_entry *e, pair_row *all)
{
  bool more = true;
  hc_status st = HC_OK;
  for (int k = 0; st == HC_OK; ++k) {
    pair_row row;
    st = pair_rows_next(rows, &row, &more);
    if (st != HC_OK || !more) return st;
    if (k == MATRIX_MOST_DENSE)
      return refuse(rows, rows->column[PAIR_NODE_A], false, "another pair, expected at most %d",
                    (int)MATRIX_MOST_DENSE);
    for (int i = 0; i < k; ++i)
      if ((all[i].a == row.a && all[i].b == row.b) || (all[i].a == row.b && all[i].b == row.a))
        return refuse(rows, rows->column[PAIR_NODE_A], false, "the same two nodes again, expected each pair once");
    all[k] = row;
    st = add_contact(rows, e, k, &row);
  }
  return st;
}

hc_status yaml_pairs_read(case_reader *r, const yaml_node_t *node)
{
  static const char *const needed[] = {"pairs", "axes"};
  const yaml_node_t *given[2] = {NULL, NULL};
  pairs_entry e = {.place = yaml_place(r, node), .first = r->sc.structure->n_contacts};
  pair_rows rows;
  yaml_forget_fields(r, FIELD_IN_CONTACT);
  field_contact_defaults(&e.given);
  hc_status st = read_keys(r, node, &e, &given[0], &given[1]);
  if (st == HC_OK && e.given.kind != CONTACT_KINKED)
    return case_refuse(r, r->at[field_index(field_named("contacts", "law"))],
                       "pairs of nodes have friction and gap, expected `law: contact`, or none");
  const bool between = given[0] && given[0]->type == YAML_MAPPING_NODE;
  for (int i = 0; i < 2 && st == HC_OK; ++i) {
    if (given[i] || between) continue;
    return case_refuse(r, e.place, "missing key `%s` beside `%s`, expected %s", needed[i], needed[1 - i],
                       field_named("contacts", needed[i])->expects);
  }
  if (st == HC_OK) st = read_axes(r, given[1], between, &e);
  if (st != HC_OK) return st;
  st = pair_rows_open(&rows, r, given[0], &e);
  if (st == HC_OK) st = check_entry(r, &e, &rows);
  pair_row *all = st == HC_OK ? malloc(MATRIX_MOST_DENSE * sizeof *all) : NULL;
  if (st == HC_OK) st = all ? read_rows(&rows, &e, all) : case_out_of_memory(r);
  free(all);
  pair_rows_close(&rows);
  return st;
}
