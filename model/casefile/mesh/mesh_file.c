/* mesh_file.c - see mesh_file.h. Nodes, elements and sets in the file's order; names are resolved when asked for. */
#include "model/casefile/mesh/mesh_file.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "model/casefile/matrices/matrix_text.h"
#include "model/casefile/matrices/text_file.h"
#include "numerics/base/growing.h"
#include "numerics/base/nearest.h"
#include "numerics/base/number.h"
#include "numerics/base/path.h"

enum { SET_NAME = 81, MOST_DEEP = 16, MOST_FACES = 6, MEMBER = 1 << MOST_FACES };
static const size_t most_bytes = (size_t)1 << 30;

/* ---- elements that have faces: the nodes of each, `a` the element's first; corners, in the order of CalculiX and
 * Abaqus, counter-clockwise as seen from within, then the nodes between them. Of a shell SNEG, then SPOS. ---- */

typedef struct shape {
  const char *family;
  int nodes;
  const char *faces[MOST_FACES];
} shape;

static const shape shapes[] = {
    {"C3D", 4, {"abc", "adb", "bdc", "cda"}},
    {"C3D", 10, {"abcefg", "adbhie", "bdcijf", "cdajhg"}},
    {"C3D", 6, {"abc", "dfe", "adeb", "befc", "cfda"}},
    {"C3D", 15, {"abcghi", "dfelkj", "adebmjng", "befcnkoh", "cfdaolmi"}},
    {"C3D", 8, {"abcd", "ehgf", "aefb", "bfgc", "cghd", "dhea"}},
    {"C3D", 20, {"abcdijkl", "ehgfponm", "aefbqmri", "bfgcrnsj", "cghdsotk", "dheatpql"}},
    {"S", 3, {"abc", "acb"}},
    {"S", 4, {"abcd", "adcb"}},
    {"S", 6, {"abcdef", "acbfed"}},
    {"S", 8, {"abcdefgh", "adcbhgfe"}},
};
enum { SNEG, SPOS, SHAPES = sizeof shapes / sizeof *shapes };

static bool is_sheet(const shape *h) { return *h->family == 'S'; }

static int corners_of(const char *face) { return strlen(face) % 3 == 0 ? 3 : 4; }

/* Such as "C3D8R": family, number of nodes, anything but a digit. */
static const shape *find_shape(matrix_word type)
{
  for (int i = 0; i < SHAPES; ++i) {
    const size_t family = strlen(shapes[i].family);
    size_t end = family;
    int nodes;
    while (end < type.length && type.text[end] >= '0' && type.text[end] <= '9') ++end;
    if (type.length > family && !strncasecmp(type.text, shapes[i].family, family) &&
        number_read_integer(type.text + family, end - family, &nodes) == NUMBER_FINE && nodes == shapes[i].nodes)
      return &shapes[i];
  }
  return NULL;
}

/* ---- the mesh ---- */

typedef struct place {
  int file, line;
} place;

typedef struct mesh_node { /* as of elements, the number comes first: find_from */
  int id;
  place at;
  double x[3];
} mesh_node;

typedef struct mesh_element {
  int id;
  place at;
  const shape *shape;
  int first; /* of its nodes in `corners` */
} mesh_element;

typedef enum set_kind { FACES, NODES_OF_SURFACE, NODES, ELEMENTS } set_kind;

typedef struct mesh_set {
  set_kind kind;
  bool defined; /* and not only named in another one */
  char name[SET_NAME];
} mesh_set;

typedef struct mesh_item { /* nodes or elements first, first + step, ... last; or with other >= 0, a set of them */
  int set, other, first, last, step;
  int face; /* of the elements, from 0; for FACES */
  place at;
} mesh_item;

struct mesh {
  int n_files, n_nodes, n_elements, n_corners, n_sets, n_items;
  char **files; /* their paths */
  mesh_node *nodes;
  mesh_element *elements;
  int *corners; /* numbers of nodes; once all is read, where they stand in `nodes` */
  mesh_set *sets;
  mesh_item *items;
};

void mesh_free(mesh *s)
{
  if (!s) return;
  for (int i = 0; i < s->n_files; ++i) free(s->files[i]);
  free(s->files);
  free(s->nodes);
  free(s->elements);
  free(s->corners);
  free(s->sets);
  free(s->items);
  free(s);
}

#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
static hc_status
refuse_at(const mesh *s, place at, message *m, const char *format, ...)
{
  va_list args;
  message_start(m, m->text, m->size);
  message_add_input(m, s->files[at.file], strlen(s->files[at.file]), 240);
  message_add(m, ":%d:1: ", at.line);
  va_start(args, format);
  message_add_list(m, format, args);
  va_end(args);
  return HC_BAD_INPUT;
}

static int find_set(const mesh *s, set_kind kind, const char *name, size_t length)
{
  for (int k = 0; k < s->n_sets; ++k)
    if (s->sets[k].kind == kind && strlen(s->sets[k].name) == length && !strncasecmp(s->sets[k].name, name, length))
      return k;
  return -1;
}

/* ---- reading ---- */

typedef enum block { PASSED_OVER, NODE_LINES, ELEMENT_LINES, SET_LINES } block;

typedef struct inp_reader {
  mesh *s;
  matrix_text *t; /* of the innermost file */
  int file, depth;
  block now;          /* what the lines after the last keyword are */
  int set;            /* that they go into; -1: none */
  bool generate;      /* its lines are first, last, step */
  const shape *shape; /* of the elements */
  int lacking;        /* nodes of the last one */
} inp_reader;

static place here(const inp_reader *r) { return (place){r->file, (int)r->t->line}; }

static matrix_word trimmed(const char *from, const char *to)
{
  while (from < to && strchr(" \t\r\n\"", *from) && *from) ++from;
  while (to > from && strchr(" \t\r\n\"", to[-1]) && to[-1]) --to;
  return (matrix_word){from, (size_t)(to - from)};
}

/* VALUE of `name=VALUE` in the keyword's line, or the end of `name` alone; false: not there. */
static bool parameter(const matrix_text *t, const char *name, matrix_word *value)
{
  const char *end = t->next;
  while (end > t->line_text && strchr("\r\n", end[-1]) && end[-1]) --end;
  const char *comma = memchr(t->line_text, ',', (size_t)(end - t->line_text));
  while (comma) {
    const char *from = comma + 1;
    comma = memchr(from, ',', (size_t)(end - from));
    const char *to = comma ? comma : end, *equals = memchr(from, '=', (size_t)(to - from));
    const matrix_word key = trimmed(from, equals ? equals : to);
    if (!matrix_word_is(&key, name)) continue;
    *value = trimmed(equals ? equals + 1 : to, to);
    return true;
  }
  return false;
}

static hc_status name_set(inp_reader *r, set_kind kind, matrix_word name, bool defined, int *set)
{
  mesh *s = r->s;
  *set = find_set(s, kind, name.text, name.length);
  if (name.length == 0 || name.length >= SET_NAME)
    return matrix_text_refuse(r->t, name.text, "a set without a name or with a long one, expected one of 1..%d letters",
                              SET_NAME - 1);
  if (*set < 0) {
    if (!GROW(s->sets, s->n_sets)) return HC_NO_MEMORY;
    *set = s->n_sets++;
    s->sets[*set] = (mesh_set){.kind = kind};
    memcpy(s->sets[*set].name, name.text, name.length);
  }
  s->sets[*set].defined |= defined;
  return HC_OK;
}

static hc_status add_item(inp_reader *r, mesh_item item)
{
  mesh *s = r->s;
  if (!GROW(s->items, s->n_items)) return HC_NO_MEMORY;
  item.set = r->set, item.at = here(r);
  s->items[s->n_items++] = item;
  return HC_OK;
}

static mesh_item one(int id) { return (mesh_item){.other = -1, .first = id, .last = id, .step = 1}; }

/* *KEYWORD, NAME=SET: the lines that follow go into that set. */
static hc_status begin_set(inp_reader *r, const char *name, set_kind kind, bool needed)
{
  matrix_word value;
  if (parameter(r->t, name, &value)) return name_set(r, kind, value, true, &r->set);
  return needed ? matrix_text_refuse(r->t, r->t->line_text, "a set without a name, expected %s=NAME", name) : HC_OK;
}

static hc_status read_text(inp_reader *r, const char *name, const char *text, size_t length, message *m);

static hc_status include(inp_reader *r)
{
  matrix_word file;
  char *path = NULL, *text = NULL, words[128];
  size_t length = 0;
  message why;
  matrix_text *t = r->t;
  message_start(&why, words, sizeof words);
  if (!parameter(t, "input", &file) || file.length == 0 || r->depth == MOST_DEEP)
    return matrix_text_refuse(t, t->line_text, "an *INCLUDE %s, expected *INCLUDE, INPUT=FILE",
                              r->depth == MOST_DEEP ? "within too many others" : "of no file");
  path = path_beside(t->name, file.text, file.length);
  hc_status st = path ? text_file_read(path, most_bytes, &text, &length, &why) : HC_NO_MEMORY;
  if (st == HC_IO) st = matrix_text_refuse(t, file.text, "%s %s, expected a file", MATRIX_QUOTED(file), words);
  else if (st == HC_OK) st = read_text(r, path, text, length, t->m);
  free(path);
  free(text);
  return st;
}

static hc_status read_keyword(inp_reader *r)
{
  static const char *const others[] = {"part",  "instance", "assembly", "system", "ngen",
                                       "ncopy", "nfill",    "elgen",    "elcopy"};
  matrix_text *t = r->t;
  const char *end = t->next, *comma = memchr(t->line_text, ',', (size_t)(end - t->line_text));
  const matrix_word key = trimmed(t->line_text + 1, comma ? comma : end);
  matrix_word value = {0};
  if (matrix_word_is(&key, "include")) return include(r); /* the lines of any block may stand in it */
  if (r->lacking > 0) {
    const mesh_element *e = &r->s->elements[r->s->n_elements - 1];
    return matrix_text_refuse(t, t->line_text, "element %d has %d nodes so far, expected %d", e->id,
                              e->shape->nodes - r->lacking, e->shape->nodes);
  }
  r->now = PASSED_OVER, r->set = -1, r->generate = false;
  for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
    if (matrix_word_is(&key, others[i]))
      return matrix_text_refuse(t, t->line_text,
                                "*%s, expected a flat file: each node with its place in space, each element with its "
                                "nodes, no parts or instances",
                                others[i]);
  const bool nodes = matrix_word_is(&key, "node"), elements = matrix_word_is(&key, "element");
  if ((nodes || elements) && (parameter(t, "input", &value) || parameter(t, "system", &value)))
    return matrix_text_refuse(t, value.text, "lines in another file or system, expected *INCLUDE, and x, y, z");
  if (nodes) {
    r->now = NODE_LINES;
    return begin_set(r, "nset", NODES, false);
  }
  if (elements) {
    r->shape = parameter(t, "type", &value) ? find_shape(value) : NULL;
    if (r->shape) r->now = ELEMENT_LINES;
    return begin_set(r, "elset", ELEMENTS, false);
  }
  if (matrix_word_is(&key, "nset") || matrix_word_is(&key, "elset")) {
    const bool of_nodes = matrix_word_is(&key, "nset");
    r->now = SET_LINES;
    r->generate = parameter(t, "generate", &value);
    if (of_nodes && parameter(t, "elset", &value))
      return matrix_text_refuse(t, value.text, "ELSET in *NSET, expected lines of nodes or of sets of them");
    return begin_set(r, of_nodes ? "nset" : "elset", of_nodes ? NODES : ELEMENTS, true);
  }
  if (!matrix_word_is(&key, "surface")) return HC_OK;
  const bool typed = parameter(t, "type", &value), of_nodes = typed && matrix_word_is(&value, "node");
  if (typed && !of_nodes && !matrix_word_is(&value, "element")) return HC_OK;
  r->now = SET_LINES;
  return begin_set(r, "name", of_nodes ? NODES_OF_SURFACE : FACES, true);
}

/* A file that ends within a line of numbers may have lost some. */
static hc_status check_end(inp_reader *r)
{
  const matrix_text *t = r->t;
  if (t->next < t->end || t->end[-1] == '\n') return HC_OK;
  return matrix_text_refuse(r->t, NULL,
                            "the file ends within a line of numbers, expected a whole line: is it cut off?");
}

static hc_status read_node(inp_reader *r)
{
  mesh *s = r->s;
  mesh_node node = {.at = here(r)};
  if (r->t->n_words < 4)
    return matrix_text_refuse(r->t, r->t->line_text, "%d values, expected a node's number and x, y, z", r->t->n_words);
  if (!matrix_text_integer(r->t, 0, 1, INT_MAX, "a node", &node.id)) return HC_BAD_INPUT;
  for (int d = 0; d < 3; ++d)
    if (!matrix_text_number(r->t, 1 + d, &node.x[d])) return HC_BAD_INPUT;
  if (!GROW(s->nodes, s->n_nodes)) return HC_NO_MEMORY;
  s->nodes[s->n_nodes++] = node;
  const hc_status st = check_end(r);
  return st == HC_OK && r->set >= 0 ? add_item(r, one(node.id)) : st;
}

/* Numbers of an element and its nodes, on one line or several. */
static hc_status read_element(inp_reader *r)
{
  mesh *s = r->s;
  for (int i = 0; i < r->t->n_words; ++i) {
    int id;
    if (i > 0 && r->lacking == 0)
      return matrix_text_refuse(r->t, r->t->words[i].text, "another node, expected %d of an element", r->shape->nodes);
    if (!matrix_text_integer(r->t, i, 1, INT_MAX, r->lacking ? "a node" : "an element", &id)) return HC_BAD_INPUT;
    if (r->lacking > 0) {
      if (!GROW(s->corners, s->n_corners)) return HC_NO_MEMORY;
      s->corners[s->n_corners++] = id;
      --r->lacking;
      continue;
    }
    if (!GROW(s->elements, s->n_elements)) return HC_NO_MEMORY;
    s->elements[s->n_elements++] = (mesh_element){id, here(r), r->shape, s->n_corners};
    r->lacking = r->shape->nodes;
    const hc_status st = r->set >= 0 ? add_item(r, one(id)) : HC_OK;
    if (st != HC_OK) return st;
  }
  return check_end(r);
}

/* Word i: a number, or the name of a set of that kind. */
static hc_status read_item(inp_reader *r, int i, set_kind kind, mesh_item *item)
{
  const matrix_word w = r->t->words[i];
  int id;
  *item = (mesh_item){.other = -1};
  if (number_read_integer(w.text, w.length, &id) != NUMBER_FINE)
    return name_set(r, kind, trimmed(w.text, w.text + w.length), false, &item->other);
  *item = one(id);
  return HC_OK;
}

static hc_status read_set_line(inp_reader *r)
{
  matrix_text *t = r->t;
  const set_kind kind = r->s->sets[r->set].kind, of = kind == FACES || kind == ELEMENTS ? ELEMENTS : NODES;
  mesh_item item;
  if (r->generate) {
    item = one(0);
    if (t->n_words < 2) return matrix_text_refuse(t, t->line_text, "one value, expected first, last and step");
    if (!matrix_text_integer(t, 0, 1, INT_MAX, "the first", &item.first) ||
        !matrix_text_integer(t, 1, item.first, INT_MAX, "the last", &item.last) ||
        (t->n_words > 2 && !matrix_text_integer(t, 2, 1, INT_MAX, "the step", &item.step)))
      return HC_BAD_INPUT;
    return add_item(r, item);
  }
  const bool one_a_line = kind == FACES || kind == NODES_OF_SURFACE;
  for (int i = 0; i < (one_a_line ? 1 : t->n_words); ++i) {
    hc_status st = read_item(r, i, of, &item);
    if (st == HC_OK && kind == FACES) {
      static const char *const labels[] = {"s1", "s2", "s3", "s4", "s5", "s6", "sneg", "spos"};
      int k = 0;
      while (k < 8 && (t->n_words != 2 || !matrix_word_is(&t->words[1], labels[k]))) ++k;
      if (k == 8) return matrix_text_refuse(t, t->line_text, "no face of elements, expected ELEMENTS, S1 or another");
      item.face = k < MOST_FACES ? k : k == MOST_FACES ? SNEG : SPOS;
    }
    if (st == HC_OK) st = add_item(r, item);
    if (st != HC_OK) return st;
  }
  return HC_OK;
}

static hc_status read_lines(inp_reader *r)
{
  matrix_text *t = r->t;
  hc_status st = HC_OK;
  while (st == HC_OK && matrix_text_next(t)) {
    if (*t->words[0].text == '*') st = read_keyword(r);
    else if (r->now == PASSED_OVER) continue;
    else if (t->n_words > MATRIX_WORDS)
      st = matrix_text_refuse(t, t->line_text, "more than %d values, expected a shorter line", MATRIX_WORDS);
    else if (r->now == NODE_LINES) st = read_node(r);
    else st = r->now == ELEMENT_LINES ? read_element(r) : read_set_line(r);
  }
  return st;
}

/* A file, within another or not. */
static hc_status read_text(inp_reader *r, const char *name, const char *text, size_t length, message *m)
{
  mesh *s = r->s;
  const inp_reader around = *r;
  matrix_text t = matrix_text_start(name, text, length, 0, m);
  if (!GROW(s->files, s->n_files) || !(s->files[s->n_files] = strdup(name))) return HC_NO_MEMORY;
  r->t = &t, r->file = s->n_files++, ++r->depth;
  hc_status st = read_lines(r);
  if (st == HC_OK && r->depth == 1 && r->lacking > 0)
    st = matrix_text_refuse(&t, NULL, "the file ends in the midst of element %d, expected its other %d nodes",
                            s->elements[s->n_elements - 1].id, r->lacking);
  r->t = around.t, r->file = around.file, --r->depth;
  return st;
}

/* ---- numbers to places in lists ---- */

static int id_at(const void *list, size_t size, int i)
{
  int id;
  memcpy(&id, (const char *)list + size * (size_t)i, sizeof id);
  return id;
}

/* The first entry of a number >= id; n: none. */
static int find_from(const void *list, int n, size_t size, int id)
{
  int low = 0, high = n;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (id_at(list, size, middle) < id) low = middle + 1;
    else high = middle;
  }
  return low;
}

/* The node of that number, -1: none. */
static int find_node(const mesh *s, int id)
{
  const int i = find_from(s->nodes, s->n_nodes, sizeof *s->nodes, id);
  return i < s->n_nodes && s->nodes[i].id == id ? i : -1;
}

static int by_id(const void *a, const void *b)
{
  const mesh_node *p = a, *q = b; /* an element begins the same way */
  if (p->id != q->id) return p->id < q->id ? -1 : 1;
  if (p->at.file != q->at.file) return p->at.file < q->at.file ? -1 : 1;
  return p->at.line < q->at.line ? -1 : p->at.line > q->at.line;
}
_Static_assert(offsetof(mesh_node, at) == offsetof(mesh_element, at), "by_id serves both");

static hc_status finish(mesh *s, message *m)
{
  if (s->n_nodes == 0) return refuse_at(s, (place){0, 1}, m, "a file without *NODE, expected nodes");
  qsort(s->nodes, (size_t)s->n_nodes, sizeof *s->nodes, by_id);
  if (s->n_elements > 0) qsort(s->elements, (size_t)s->n_elements, sizeof *s->elements, by_id);
  for (int i = 1; i < s->n_nodes; ++i)
    if (s->nodes[i].id == s->nodes[i - 1].id)
      return refuse_at(s, s->nodes[i].at, m, "node %d again, expected each once", s->nodes[i].id);
  for (int i = 0; i < s->n_elements; ++i) {
    const mesh_element *e = &s->elements[i];
    if (i > 0 && e->id == e[-1].id) return refuse_at(s, e->at, m, "element %d again, expected each once", e->id);
    for (int *c = s->corners + e->first, *end = c + e->shape->nodes; c < end; ++c) {
      const int node = find_node(s, *c);
      if (node < 0) return refuse_at(s, e->at, m, "element %d has the node %d, which is not there", e->id, *c);
      *c = node;
    }
  }
  return HC_OK;
}

hc_status mesh_parse(const char *name, const char *text, size_t length, mesh **out, message *m)
{
  inp_reader r = {.s = calloc(1, sizeof *r.s), .set = -1};
  *out = NULL;
  if (!r.s) return HC_NO_MEMORY;
  hc_status st = read_text(&r, name, text, length, m);
  if (st == HC_OK) st = finish(r.s, m);
  if (st == HC_OK) *out = r.s;
  else mesh_free(r.s);
  return st;
}

hc_status mesh_read(const char *path, mesh **out, message *m)
{
  char *text;
  size_t length;
  *out = NULL;
  hc_status st = text_file_read(path, most_bytes, &text, &length, m);
  if (st == HC_OK) st = mesh_parse(path, text, length, out, m);
  free(text);
  return st;
}

static hc_status copy_text(const char *path, int depth, FILE *to, message *m)
{
  char *text;
  size_t length;
  hc_status st = depth <= MOST_DEEP ? text_file_read(path, most_bytes, &text, &length, m) : HC_BAD_INPUT;
  if (st != HC_OK) return st;
  matrix_text t = matrix_text_start(path, text, length, 0, m);
  while (st == HC_OK && matrix_text_line(&t)) {
    matrix_word file;
    if (!strncasecmp(t.line_text, "*include", strlen("*include")) && parameter(&t, "input", &file)) {
      char *inner = path_beside(path, file.text, file.length);
      st = inner ? copy_text(inner, depth + 1, to, m) : HC_NO_MEMORY;
      free(inner);
    } else fwrite(t.line_text, 1, (size_t)(t.next - t.line_text), to);
  }
  if (length > 0 && text[length - 1] != '\n') fputc('\n', to);
  free(text);
  return st;
}

hc_status mesh_copy(const char *path, FILE *to, message *m) { return copy_text(path, 1, to, m); }

/* ---- sets ---- */

int mesh_find(const mesh *s, const char *name, size_t length)
{
  for (set_kind kind = FACES; kind <= NODES; ++kind) {
    const int set = find_set(s, kind, name, length);
    if (set >= 0 && s->sets[set].defined) return set;
  }
  return -1;
}

const char *mesh_nearest(const mesh *s, const char *name, size_t length)
{
  const char *best = NULL;
  int least = NEAREST_FAR;
  for (int k = 0; k < s->n_sets; ++k) {
    const int d = nearest_distance(name, length, s->sets[k].name);
    if (s->sets[k].defined && s->sets[k].kind != ELEMENTS && d < least) least = d, best = s->sets[k].name;
  }
  return best;
}

typedef struct marks {
  unsigned char *node;    /* [n_nodes] is it in the set?                                       */
  unsigned char *element; /* [n_elements] a bit a face, and MEMBER                             */
  unsigned char *seen;    /* [n_sets] has been marked: no set is walked twice, or in a circle */
} marks;

/* The nodes, or elements as MEMBERs, of an item that is numbers. A single one must be there. */
static hc_status mark_numbers(const mesh *s, const mesh_item *item, bool nodes, marks *to, message *m)
{
  const void *list = nodes ? (const void *)s->nodes : s->elements;
  const size_t size = nodes ? sizeof *s->nodes : sizeof *s->elements;
  const int n = nodes ? s->n_nodes : s->n_elements, from = find_from(list, n, size, item->first);
  if (item->first == item->last && (from == n || id_at(list, size, from) != item->first) && (nodes || s->n_elements))
    return refuse_at(s, item->at, m, "no %s %d, expected one of the file%s", nodes ? "node" : "element", item->first,
                     nodes ? "" : " that has faces");
  for (int i = from; i < n && id_at(list, size, i) <= item->last; ++i) {
    if ((id_at(list, size, i) - item->first) % item->step) continue;
    if (nodes) to->node[i] = 1;
    else to->element[i] |= MEMBER;
  }
  return HC_OK;
}

/* The elements that are MEMBERs give this face to a surface. */
static hc_status mark_faces(const mesh *s, const mesh_item *item, marks *to, message *m)
{
  for (int i = 0; i < s->n_elements; ++i) {
    if (!(to->element[i] & MEMBER)) continue;
    if (!s->elements[i].shape->faces[item->face])
      return refuse_at(s, item->at, m, "element %d has no face S%d", s->elements[i].id, item->face + 1);
    to->element[i] = (unsigned char)((to->element[i] & ~MEMBER) | 1u << item->face);
  }
  return HC_OK;
}

static hc_status mark(const mesh *s, int set, int depth, marks *to, message *m)
{
  const set_kind kind = s->sets[set].kind;
  hc_status st = HC_OK;
  if (to->seen[set]) return HC_OK;
  to->seen[set] = 1;
  for (int i = 0; i < s->n_items && st == HC_OK; ++i) {
    const mesh_item *item = &s->items[i];
    if (item->set != set) continue;
    if (item->other < 0) {
      st = mark_numbers(s, item, kind == NODES || kind == NODES_OF_SURFACE, to, m);
    } else {
      const mesh_set *other = &s->sets[item->other];
      if (!other->defined || depth == MOST_DEEP)
        return refuse_at(s, item->at, m, "%s set %s, expected one that is defined",
                         other->defined ? "too deep within others the" : "no",
                         QUOTED(other->name, strlen(other->name)));
      if (kind == FACES) memset(to->seen, 0, (size_t)s->n_sets); /* once more, for another face */
      st = mark(s, item->other, depth + 1, to, m);
    }
    if (st == HC_OK && kind == FACES) st = mark_faces(s, item, to, m);
  }
  return st;
}

/* ---- patches ---- */

typedef struct candidate { /* a face whose corners are all in a set of nodes */
  int corner[4];           /* ascending, then -1 */
  int element, face;
} candidate;

static int by_corners(const void *a, const void *b)
{
  const candidate *p = a, *q = b;
  for (int i = 0; i < 4; ++i)
    if (p->corner[i] != q->corner[i]) return p->corner[i] < q->corner[i] ? -1 : 1;
  return 0;
}

static int by_number(const void *a, const void *b)
{
  const int x = *(const int *)a, y = *(const int *)b;
  return (x > y) - (x < y);
}

/* Faces on the outside of the solids, or of shells SPOS, whose corners are all marked. */
static hc_status mark_outside(const mesh *s, bool sheets, marks *to, int *n_faces)
{
  candidate *all = NULL;
  int n = 0;
  *n_faces = 0;
  for (int i = 0; i < s->n_elements; ++i) {
    const mesh_element *e = &s->elements[i];
    if (is_sheet(e->shape) != sheets) continue;
    for (int k = sheets ? SPOS : 0; k < MOST_FACES && e->shape->faces[k]; ++k) {
      const char *face = e->shape->faces[k];
      candidate c = {.element = i, .face = k, .corner = {-1, -1, -1, -1}};
      int inside = 0;
      while (inside < corners_of(face) && to->node[s->corners[e->first + face[inside] - 'a']])
        c.corner[inside] = s->corners[e->first + face[inside] - 'a'], ++inside;
      if (inside < corners_of(face)) continue;
      qsort(c.corner, (size_t)inside, sizeof *c.corner, by_number);
      if (!GROW(all, n)) return free(all), HC_NO_MEMORY;
      all[n++] = c;
    }
  }
  if (n > 0) qsort(all, (size_t)n, sizeof *all, by_corners);
  for (int i = 0, next; i < n; i = next) {
    for (next = i + 1; next < n && !by_corners(&all[i], &all[next]);) ++next;
    if (next == i + 1) to->element[all[i].element] |= (unsigned char)(1u << all[i].face), ++*n_faces;
  }
  free(all);
  return HC_OK;
}

/* A face to its nodes, as triangles of which each gives its three nodes a third of its area; those from `half` on count
 * half: both ways to cut a quadrilateral, which gives each corner the integral of its bilinear function. */
static void add_face(const mesh *s, const mesh_element *e, const char *face, const int *row, patch *to)
{
  static const struct {
    const char *triangles;
    int half;
  } cuts[] = {{"012", 1}, {"012230123301", 0}, {"035314542345", 4}, {"047415526637456674567745", 4}};
  const bool triangle = corners_of(face) == 3;
  bool between = strlen(face) > 4; /* and those nodes are of the patch, too */
  for (const char *c = face; *c; ++c) between = between && row[s->corners[e->first + *c - 'a']] >= 0;
  const int cut = 2 * between + !triangle;
  for (int t = 0; cuts[cut].triangles[3 * t]; ++t) {
    patch_node *corner[3];
    double side[2][3], area[3];
    for (int i = 0; i < 3; ++i) {
      const char c = face[cuts[cut].triangles[3 * t + i] - '0'];
      corner[i] = &to->v[row[s->corners[e->first + c - 'a']]];
    }
    for (int i = 0; i < 3; ++i)
      side[0][i] = corner[2]->x[i] - corner[0]->x[i], side[1][i] = corner[1]->x[i] - corner[0]->x[i];
    const double third = (t < cuts[cut].half ? 1 : 0.5) / 6;
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      area[i] = third * (side[0][j] * side[1][k] - side[0][k] * side[1][j]);
      square += area[i] * area[i];
    }
    for (int i = 0; i < 3; ++i) {
      corner[i]->area += sqrt(square);
      for (int d = 0; d < 3; ++d) corner[i]->normal[d] += area[d];
    }
  }
}

static hc_status make_patch(const mesh *s, int set, marks *of, int *row, patch *out, message *m)
{
  const bool faces = s->sets[set].kind == FACES;
  hc_status st = mark(s, set, 0, of, m);
  if (st == HC_OK && !faces) st = mark_outside(s, false, of, &out->n_faces);
  if (st == HC_OK && !faces && out->n_faces == 0) st = mark_outside(s, true, of, &out->n_faces);
  for (int i = 0; i < s->n_elements && faces; ++i) /* the nodes of the surface's faces */
    for (int k = 0; k < MOST_FACES && s->elements[i].shape->faces[k]; ++k) {
      if (!(of->element[i] >> k & 1)) continue;
      ++out->n_faces;
      for (const char *c = s->elements[i].shape->faces[k]; *c; ++c)
        of->node[s->corners[s->elements[i].first + *c - 'a']] = 1;
    }
  for (int i = 0; i < s->n_nodes; ++i) row[i] = of->node[i] ? out->n++ : -1;
  if (st != HC_OK || out->n == 0) return st;
  if (!(out->v = calloc((size_t)out->n, sizeof *out->v))) return HC_NO_MEMORY;
  for (int i = 0; i < s->n_nodes; ++i) {
    if (row[i] < 0) continue;
    out->v[row[i]].node = s->nodes[i].id;
    memcpy(out->v[row[i]].x, s->nodes[i].x, sizeof s->nodes[i].x);
  }
  for (int i = 0; i < s->n_elements; ++i)
    for (int k = 0; k < MOST_FACES; ++k) {
      if (!(of->element[i] >> k & 1)) continue;
      add_face(s, &s->elements[i], s->elements[i].shape->faces[k], row, out);
      out->sheet = is_sheet(s->elements[i].shape);
    }
  return HC_OK;
}

hc_status mesh_patch(const mesh *s, int set, patch *out, message *m)
{
  marks of = {calloc((size_t)s->n_nodes, 1), calloc((size_t)s->n_elements + 1, 1), calloc((size_t)s->n_sets, 1)};
  int *row = malloc((size_t)s->n_nodes * sizeof *row);
  *out = (patch){0};
  const hc_status st = of.node && of.element && of.seen && row ? make_patch(s, set, &of, row, out, m) : HC_NO_MEMORY;
  free(of.node);
  free(of.element);
  free(of.seen);
  free(row);
  return st;
}
