/* case_reader.h - what the parts of the case reader share; private to cases/. The public face is case_file.h.
 *
 *     text --yaml_text_load--> document --yaml_scene_read--> scene --case_set_apply--> scene --case_check--> done */
#ifndef HC_CASE_READER_H
#define HC_CASE_READER_H

#include <yaml.h>

#include "cases/fields.h"
#include "cases/status.h"
#include "cases/suggest.h"

enum { CASE_LARGEST = 1 << 20 }; /* bytes of a case file; a real one has a few thousand */

/* Where something was said: the set-th assignment, counted from 1, or for set = 0 a line and column of the file. line = 0: nowhere. */
typedef struct case_place {
  int set;
  size_t line, column;
} case_place;

typedef struct case_reader {
  const char *name;         /* of the file, for messages                                         */
  const char *const *set;   /* the assignments                                                   */
  int set_now;              /* the one being applied, from 1; 0 while the file is read           */
  scene sc;                 /* filled as reading goes on                                         */
  case_place at[FIELD_MAX]; /* [field_index] where each field was last given; for contacts' fields, in the contact being read */
  case_place contact_at[SCENE_MAX_CONTACTS];          /* where each contact appeared                  */
  unsigned long long contact_has[SCENE_MAX_CONTACTS]; /* bit field_index: the field has been given    */
  message msg;                                        /* the one message                                                   */
} case_reader;

static inline bool case_given(const case_reader *r, const field *f) { return r->at[field_index(f)].line > 0; }
static inline case_place case_place_of(const case_reader *r, yaml_mark_t mark)
{
  return (case_place){.set = r->set_now, .line = mark.line + 1, .column = mark.column + 1};
}

/* Start the message with "FILE:LINE:COLUMN: " or "--set PATH=VALUE: " and return it for the rest. */
message *case_blame(case_reader *r, case_place place);

/* ", did you mean `x`?" if there is something to suggest. Fields show their whole path unless they are of `section` (NULL: always). */
bool case_suggest(message *m, suggestion s, const char *section, int j);

/* text as one YAML document without aliases, anchors, tags and depth, to be freed with yaml_document_delete when HC_OK. */
hc_status yaml_text_load(case_reader *r, const char *text, size_t length, yaml_document_t *doc);

/* The whole document, its list of contacts, or contact j of it, into r->sc. */
hc_status yaml_scene_read(case_reader *r, yaml_document_t *doc);
hc_status yaml_scene_contacts(case_reader *r, yaml_document_t *doc, yaml_node_t *node);
hc_status yaml_scene_contact(case_reader *r, yaml_document_t *doc, yaml_node_t *node, int j);

/* Apply assignment number k, from 1. */
hc_status case_set_apply(case_reader *r, int k);

/* What depends on several fields, once all of them are known. */
hc_status case_check(case_reader *r);

#endif
