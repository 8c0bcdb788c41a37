/* case_reader.h - what the parts of the case reader share; private to cases/ and to the study file's reader, which
 * speaks the same language (campaigns/study/). The public face is case_file.h.
 *
 *     text --yaml_text_load--> document --yaml_scene_read--> scene --case_set_apply--> scene --case_check--> done */
#ifndef HC_CASE_READER_H
#define HC_CASE_READER_H

#include <yaml.h>

#include "base/status.h"
#include "cases/case_file.h"
#include "cases/case_values.h"
#include "cases/fields.h"
#include "cases/suggest.h"

enum { CASE_LARGEST = 1 << 20 }; /* bytes of a case file; a real one has a few thousand */

typedef struct case_reader {
  const char *name;       /* of the file, for messages                               */
  const char *noun;       /* "case", or what else such a file is, for messages       */
  const char *required;   /* the keys it must have, in words                         */
  const char *const *set; /* the assignments                                         */
  int set_now;            /* the one being applied, from 1; 0 while the file is read */
  case_place here;        /* of the path being resolved or the value being set       */
  case_place end;         /* of the file's text; line = 0 before it is known         */
  scene sc;               /* as far as it has been read                              */
  /* [field_index] where each field was last given; of contacts' fields, in the contact being read */
  case_place at[FIELD_MAX];
  /* where each contact appeared; bit field_index: that field of it has been given */
  case_place contact_at[SCENE_MAX_CONTACTS];
  unsigned long long contact_has[SCENE_MAX_CONTACTS];
  /* where each field of each contact was last given */
  case_place contact_field_at[SCENE_MAX_CONTACTS][FIELD_MAX];
  message msg; /* the first mistake */
} case_reader;

static inline bool case_given(const case_reader *r, const field *f) { return r->at[field_index(f)].line > 0; }
/* Where a mark of libyaml stands. If the last line has no line end, libyaml's mark may stand on a line after it, which
 * the file does not have: then r->end. */
static inline case_place case_place_of(const case_reader *r, yaml_mark_t mark)
{
  if (r->set_now == 0 && r->end.line > 0 && mark.line + 1 > r->end.line) return r->end;
  return (case_place){.set = r->set_now, .line = mark.line + 1, .column = mark.column + 1};
}

/* A reader of the case file `name`, every field at its default; messages go to err. */
void case_reader_start(case_reader *r, const char *name, const char *const *set, case_error *err);

/* The bytes of r's file, "<stdin>" being standard input, in memory to free in any case. */
hc_status case_reader_slurp(case_reader *r, char **text, size_t *length);

/* The scene of text[length], before assignments and case_check. */
hc_status case_reader_scene(case_reader *r, const char *text, size_t length);

/* Start the message with "FILE:LINE:COLUMN: " or "--set PATH=VALUE: " and return it for the rest. */
message *case_blame(case_reader *r, case_place place);

/* ", did you mean `x`?" if there is something to suggest. Fields show their whole path unless they are of `section`
 * (NULL: always). */
bool case_suggest(message *m, suggestion s, const char *section, int j);

/* text as one YAML document without aliases, anchors, tags and depth, to be freed with yaml_document_delete when
 * HC_OK. */
hc_status yaml_text_load(case_reader *r, const char *text, size_t length, yaml_document_t *doc);

/* The text of a scalar node, and what a node is in words: "a mapping", "a list", "a single value", "empty". */
static inline const char *yaml_node_text(const yaml_node_t *n) { return (const char *)n->data.scalar.value; }
const char *yaml_node_what(const yaml_node_t *n);
field_item yaml_node_item(const yaml_node_t *n); /* of a scalar */

/* v from a scalar or a list of scalars. NULL, or the node (a mapping, a list in a list) that cannot be a value. */
const yaml_node_t *yaml_node_value(yaml_document_t *doc, const yaml_node_t *node, field_value *v);

/* Is the key a scalar? false with the message made. */
bool yaml_check_key(case_reader *r, const yaml_node_t *key);
hc_status yaml_duplicate_key(case_reader *r, const yaml_node_t *key, case_place first);

/* A scene at `root`, its list of contacts, or contact j of it, into r->sc. */
hc_status yaml_scene_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *root);
hc_status yaml_scene_contacts(case_reader *r, yaml_document_t *doc, yaml_node_t *node);
hc_status yaml_scene_contact(case_reader *r, yaml_document_t *doc, yaml_node_t *node, int j);

/* The value of one field, of contact j if it is one of a contact's, into base (fields.h). */
hc_status yaml_scene_value(case_reader *r, yaml_document_t *doc, const field *f, int j, void *base,
                           const yaml_node_t *node);

/* What a path "hbm.samples" or "contacts[0].gap" names; f = NULL: a contact, or with contact = -1 all contacts. */
typedef struct case_target {
  const field *f;
  int contact; /* -1 outside contacts */
} case_target;
hc_status case_find_target(case_reader *r, const char *path, size_t length, case_target *t);

/* The scene, or the contact of t, which is appended if it is the one past the last; then note that t.f was given at
 * r->here. */
void *case_target_base(case_reader *r, case_target t);
void case_target_given(case_reader *r, case_target t);

/* f is being given: its rivals (sweep.frequency is sweep.omega's) go back to their defaults. */
void case_drop_rivals(case_reader *r, const field *f);

/* Apply assignment number k, from 1. */
hc_status case_set_apply(case_reader *r, int k);

/* What depends on several fields, once all of them are known. */
hc_status case_check(case_reader *r);

#endif
