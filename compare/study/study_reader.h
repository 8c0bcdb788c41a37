/* study_reader.h - what the parts of the study file's reader share; private to study/. Messages and places
 * are the case reader's.
 *
 *     study_file.c: the file, base, set, views, claims     study_axes.c: vary */
#pragma once

#include "compare/study/study.h"
#include "model/casefile/case_reader.h"

/* A field that `set`, --set or an axis gives: none is both set and varied. */
typedef struct study_given {
  char path[FIELD_PATH];
  case_place at;
} study_given;

typedef struct study_reader {
  case_reader r; /* name: the study file; sc: the base as far as it is known */
  study *s;
  int n_given;
  study_given given[STUDY_MOST_FIELDS];
} study_reader;

/* Which of words[] (NULL at the end) the key is, noted in seen[]; -1 with the message: none, or twice. */
int study_key(study_reader *q, const yaml_node_t *key, const char *where, const char *const *words, case_place *seen);

/* The field a key names goes into *t, its full name into path. Given before, it or its rival, is a mistake. */
hc_status study_give(study_reader *q, const yaml_node_t *key, case_target *t, char path[FIELD_PATH]);

/* It is set or varied: too many are a mistake. */
hc_status study_note_given(study_reader *q, const char *path, case_place at);

/* The value of `vary`, into s->axes. */
hc_status study_read_axes(study_reader *q, const yaml_node_t *node);

/* The text of a node that must be a single value into a study_value, to free. HC_BAD_INPUT when it is none or empty. */
hc_status study_read_text(study_reader *q, const char *what, const yaml_node_t *node, void *out);

/* s->fingerprint, once all the rest is there. */
hc_status study_take_fingerprint(study *s);
