/* case_reader.h - what the parts of the case reader share; private to casefile/ and to the study file's reader, which
 * speaks the same language (study/). The public face is case_file.h.
 *
 *     text --yaml_text_load--> document --yaml_scene_read--> scene --case_set_apply--> scene --case_check--> done */
#pragma once

#include <yaml.h>

#include "model/casefile/case_file.h"
#include "model/casefile/case_values.h"
#include "model/casefile/fields.h"
#include "model/casefile/mesh/mesh_file.h"
#include "model/casefile/structure.h"
#include "numerics/base/status.h"

enum { CASE_LARGEST = 16 << 20 }; /* bytes of a case file; an echoed one holds matrices of some 500 rows */

typedef struct case_reader {
  const char *name;         /* of the file, for messages                               */
  const char *noun;         /* "case", or what else such a file is, for messages       */
  const char *required;     /* the keys it must have, in words                         */
  const char *const *set;   /* the assignments                                         */
  int set_now;              /* the one being applied, from 1; 0 while the file is read */
  yaml_document_t doc;      /* of the file, or of the assignment being applied         */
  case_place here;          /* of the path being resolved or the value being set       */
  case_place end;           /* of the file's text; line = 0 before it is known         */
  scene sc;                 /* as far as it has been read                              */
  mesh *mesh;               /* of sc.structure->mesh, once it was asked for; or NULL   */
  const yaml_node_t *rests; /* the value of transient.rest, until the contacts are read; or NULL */
  bool owns_structure;      /* or shares it with the scene it was started from         */
  bool takes_large;         /* matrices of more than most_dense rows are kept sparse, not refused */
  int most_dense;
  case_source *source; /* or NULL: what another model needs of the text           */
  /* [field_index] where each field was last given; of contacts' fields, in the contact being read */
  case_place at[FIELD_MAX];
  /* of an oscillator's contacts, case_field_bit: that field has been given */
  unsigned long long contact_has[SCENE_MAX_CONTACTS];
  /* where each field of each contact was last given */
  case_place contact_field_at[SCENE_MAX_CONTACTS][FIELD_MAX];
  message msg; /* the first mistake */
} case_reader;

/* A bit for each field of contacts; they stand together in the table. */
static inline unsigned long long case_field_bit(const field *f) { return 1ull << field_index(f) % 64; }

static inline bool case_given(const case_reader *r, const field *f) { return r->at[field_index(f)].line > 0; }

/* A reader of the case file `name`, every field at its default; messages go to err. */
void case_reader_start(case_reader *r, const char *name, const char *const *set, case_error *err);

/* The bytes of r's file, "<stdin>" being standard input, in memory to free in any case. */
hc_status case_reader_slurp(case_reader *r, char **text, size_t *length);

/* After reading ended with st: r's scene into *out, its structure with it, or nothing kept. Returns st. */
hc_status case_reader_take(case_reader *r, hc_status st, scene *out);

/* ---- messages ---- */

/* Where a mark of libyaml stands; r->end where it is behind the file's last line, as without a line end. */
static inline case_place case_place_of(const case_reader *r, yaml_mark_t mark)
{
  if (r->set_now == 0 && r->end.line > 0 && mark.line + 1 > r->end.line) return r->end;
  return (case_place){.set = r->set_now, .line = mark.line + 1, .column = mark.column + 1};
}
static inline case_place yaml_place(const case_reader *r, const yaml_node_t *node)
{
  return case_place_of(r, node->start_mark);
}

/* Start the message with "FILE:LINE:COLUMN: " or "--set PATH=VALUE: " and return it for the rest. */
message *case_blame(case_reader *r, case_place place);
static inline message *yaml_blame(case_reader *r, const yaml_node_t *node)
{
  return case_blame(r, yaml_place(r, node));
}

/* The whole message, printf-style, about a place or where a node stands. Always HC_BAD_INPUT. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
hc_status
case_refuse(case_reader *r, case_place place, const char *format, ...);
#define yaml_refuse(r, node, ...) ((void)case_refuse(r, yaml_place(r, node), __VA_ARGS__), HC_BAD_INPUT)
hc_status case_out_of_memory(case_reader *r);

/* The file at `path`, which the node names for `what`, cannot be read: r->msg has the words for it. */
hc_status yaml_file_failed(case_reader *r, const yaml_node_t *node, const char *what, const char *path,
                           const char *expected);

/* ", did you mean `x`?", if there is one; with its whole path unless it is of `section` (NULL: always). */
bool case_suggest(message *m, suggestion s, const char *section, int j);

/* ---- documents ---- */

/* r->doc from text, without aliases, anchors, tags and depth, to be freed with yaml_document_delete when HC_OK. */
hc_status yaml_text_load(case_reader *r, const char *text, size_t length);

/* The text of a scalar node; in backquotes; what a node is: "a mapping", "a list", "a single value", "empty". */
static inline const char *yaml_node_text(const yaml_node_t *n) { return (const char *)n->data.scalar.value; }
#define YAML_QUOTED(n) QUOTED(yaml_node_text(n), (n)->data.scalar.length)
const char *yaml_node_what(const yaml_node_t *n);
bool yaml_node_is(const yaml_node_t *n, const char *word); /* a scalar, and that word? */
bool yaml_node_is_axis(const yaml_node_t *n);              /* x, y or z? */
field_item yaml_node_item(const yaml_node_t *n);           /* of a scalar */

static inline const yaml_node_t *yaml_get(case_reader *r, int index) { return yaml_document_get_node(&r->doc, index); }

/* Lists: length, entry i. Mappings: number of keys, key i, its value, the value of the first such key or NULL. */
static inline int yaml_length(const yaml_node_t *list)
{
  return (int)(list->data.sequence.items.top - list->data.sequence.items.start);
}
static inline const yaml_node_t *yaml_entry(case_reader *r, const yaml_node_t *list, int i)
{
  return yaml_get(r, list->data.sequence.items.start[i]);
}
static inline int yaml_keys(const yaml_node_t *mapping)
{
  return (int)(mapping->data.mapping.pairs.top - mapping->data.mapping.pairs.start);
}
static inline const yaml_node_t *yaml_key(case_reader *r, const yaml_node_t *mapping, int i)
{
  return yaml_get(r, mapping->data.mapping.pairs.start[i].key);
}
static inline const yaml_node_t *yaml_value(case_reader *r, const yaml_node_t *mapping, int i)
{
  return yaml_get(r, mapping->data.mapping.pairs.start[i].value);
}
const yaml_node_t *yaml_find(case_reader *r, const yaml_node_t *mapping, const char *key);

/* v from a scalar or a list of scalars. NULL, or the node (a mapping, a list in a list) that cannot be a value. */
const yaml_node_t *yaml_node_value(case_reader *r, const yaml_node_t *node, field_value *v);

/* A finite number, of which `what` tells in a message. */
hc_status yaml_number(case_reader *r, const yaml_node_t *node, const char *what, double *x);

/* ---- keys and fields ---- */

/* HC_BAD_INPUT: the key is no scalar; it has been given before; there is no such field. */
hc_status yaml_check_key(case_reader *r, const yaml_node_t *key);
hc_status yaml_duplicate_key(case_reader *r, const yaml_node_t *key, case_place first);
hc_status yaml_unknown_key(case_reader *r, const yaml_node_t *key, const char *section);

/* The field of that section that a key names; NULL with the message made if there is none. */
const field *yaml_key_field(case_reader *r, const yaml_node_t *key, const char *section);

/* Note that f is given by the key, once and not beside a rival. */
hc_status yaml_give(case_reader *r, const field *f, const yaml_node_t *key, const yaml_node_t *value);

/* The first rival of f that has been given, or NULL. */
const field *yaml_given_rival(const case_reader *r, const field *f);

/* No field of contacts (FIELD_IN_CONTACT) or of loads (FIELD_IN_LOAD) has been given yet: the next one begins. */
void yaml_forget_fields(case_reader *r, unsigned of);

/* What transient.rest holds, into the contacts; nothing where it was not given. */
hc_status yaml_rests_read(case_reader *r);

/* The value of one field, of contact or load j if it is one of theirs, into base (fields.h). */
hc_status yaml_scene_value(case_reader *r, const field *f, int j, void *base, const yaml_node_t *node);

/* A scene at `root` into r->sc. */
hc_status yaml_scene_read(case_reader *r, const yaml_node_t *root);

/* ---- of a structure, into r->sc.structure ---- */

/* The section `structure` into a new structure; read first, since the others speak of its degrees of freedom. */
hc_status yaml_structure_read(case_reader *r, const yaml_node_t *node);

/* One part of it, `structure.mass`, or `base.direction`; or one number, `structure.damping.modal`. */
hc_status yaml_structure_part(case_reader *r, const field *f, const yaml_node_t *node);

/* The lists, which replace what there was; or entry j, one past the last being new. */
hc_status yaml_loads_read(case_reader *r, const yaml_node_t *node);
hc_status yaml_load_read(case_reader *r, const yaml_node_t *node, int j);
hc_status yaml_contacts_read(case_reader *r, const yaml_node_t *node);
hc_status yaml_contact_read(case_reader *r, const yaml_node_t *node, int j);
hc_status yaml_responses_read(case_reader *r, const yaml_node_t *node);

/* r->mesh from the structure's file, unless it is there already or the case names none; the node is where to blame. */
hc_status case_mesh_read(case_reader *r, const yaml_node_t *node);

/* An entry of contacts with `pairs` and `axes`: a new contact for each pair of nodes. */
hc_status yaml_pairs_read(case_reader *r, const yaml_node_t *node);

/* One field, or all of a mapping, into base. by_node: of a load, `node` and `direction` say where. */
hc_status yaml_field_read(case_reader *r, const field *f, const yaml_node_t *key, const yaml_node_t *value, int j,
                          void *base);
hc_status yaml_fields_read(case_reader *r, const yaml_node_t *node, const char *section, int j, void *base,
                           bool by_node);

/* The coefficients or points of contact j; and whether the field is one of these. */
hc_status yaml_law_part(case_reader *r, const field *f, int j, const yaml_node_t *node);
bool yaml_is_law_part(const field *f);

/* case_field_bit of all that is given of the contact being read. Must contact c, whose direction is an angle, give f,
 * too? Nothing of a tangent at +-90 degrees; with `preload` and no normal spring it slides along x. */
unsigned long long case_contact_given(const case_reader *r);
bool case_contact_needs(const scene_contact *c, unsigned long long has, const field *f);

/* Contact j, whose fields r->at tells the places of, has none of another law, and what its own needs. */
hc_status case_check_law(case_reader *r, int j, const scene_contact *c, case_place place);
hc_status case_check_law_given(case_reader *r, int j, const scene_contact *c, case_place place); /* the latter alone */

/* One part of load or contact j: a degree of freedom or direction. */
hc_status yaml_entry_part(case_reader *r, const field *f, int j, const yaml_node_t *node);

/* A matrix of `expected` rows (0: any number) into *out, which it replaces. `what` is its path. */
hc_status yaml_matrix_read(case_reader *r, const char *what, const yaml_node_t *node, int expected, int *n,
                           structure_matrix *out);

/* Start the message with the place of entry (i, j), from 0, of a matrix: in its file, or else in the case. */
message *yaml_matrix_blame(case_reader *r, const structure_matrix *m, int i, int j);

/* The entries (i, j) and (j, i) of a matrix, kept either way, are the same but for rounding; else the message. */
hc_status yaml_matrix_symmetric(case_reader *r, const char *what, const structure_matrix *m, int n);

/* The path of the file that a scalar names, to free, which r->source is told; NULL: out of memory. */
char *yaml_file_beside(case_reader *r, const yaml_node_t *node);

/* Tells r->source, if any, that the node names a DOF by number, or else, dof < 0, a file. HC_NO_MEMORY. */
hc_status yaml_mention(case_reader *r, const yaml_node_t *node, int dof, const char *file);

/* A degree of freedom by name or number, or as {node: 17, direction: y}. */
hc_status yaml_dof(case_reader *r, const yaml_node_t *node, int *dof);

/* A degree of freedom, or factors {tip: 1, root: -0.5}, not all 0, into direction[n]. `what` is its path. */
hc_status yaml_direction(case_reader *r, const char *what, const yaml_node_t *node, double *direction);

/* The kind of damping after f, one of its fields, is stored. Of Rayleigh's, one given alone keeps the other, else 0. */
void structure_damping_given(scene_structure *s, const field *f);

/* ---- paths and assignments ---- */

/* A field ("hbm.samples", "contacts[0].gap", "contacts[joint].gap"); or, f = NULL, a list or by an index its entry. */
typedef enum case_list { CASE_NO_LIST, CASE_CONTACTS, CASE_LOADS } case_list;
typedef struct case_target {
  const field *f;
  case_list list;
  int index;  /* in the list; -1: all of it, or no list */
  bool whole; /* and case_target_next: all contacts of an entry of pairs, whose stiffnesses are per area */
} case_target;
static inline case_target case_target_of(const field *f, int index, bool whole)
{
  const case_list list = f->flags & FIELD_IN_CONTACT ? CASE_CONTACTS
                         : f->flags & FIELD_IN_LOAD  ? CASE_LOADS
                                                     : CASE_NO_LIST;
  return (case_target){f, list, index, whole};
}
hc_status case_find_target(case_reader *r, const char *path, size_t length, case_target *t);

/* t becomes the next contact of its entry; false: it was the last one, or is no entry's. */
bool case_target_next(const case_reader *r, case_target *t);

/* What t.f is stored in (fields.h): the scene, its structure, or the contact or load of t; an oscillator's contact is
 * appended if it is the one past the last. NULL, with the message made: out of memory, for a structure that is shared
 * is copied first. Then note that t.f was given at r->here. */
void *case_target_base(case_reader *r, case_target t);
void case_target_given(case_reader *r, case_target t);

/* t.f of `base` is being given: its rivals (sweep.frequency is sweep.omega's) go back to their defaults. */
void case_drop_rivals(case_reader *r, const field *f, void *base);

/* What t names, from a document; r->here is where. */
hc_status case_target_read(case_reader *r, case_target t, const yaml_node_t *node);

/* r's structure is its own from now on: copied if it was shared. HC_NO_MEMORY with the message made. */
hc_status case_own_structure(case_reader *r);

/* Apply assignment number k, from 1. */
hc_status case_set_apply(case_reader *r, int k);

/* What depends on several fields, once all of them are known. */
hc_status case_check(case_reader *r);
