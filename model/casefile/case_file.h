/* case_file.h - a scene from a YAML case file and from --set; the table of fields that drives reading, setting, echo
 * and describe. Every mistake is one message "FILE:LINE:COLUMN: what is wrong, what was expected" (suggestion
 * included where a key is nearly right). */
#pragma once

#include <stddef.h>
#include <stdio.h>

#include "model/casefile/scene.h"
#include "numerics/base/status.h"

enum { CASE_MESSAGE = 512 };
typedef struct case_error {
  char message[CASE_MESSAGE];
} case_error; /* one line, no newline; empty when all is well */

/* Read `path` ("-" is standard input), apply the n_set assignments "PATH=VALUE" in order, then check what depends on
 * several fields. HC_OK and *out filled, to be cleared with case_clear; or HC_BAD_INPUT / HC_IO / HC_NO_MEMORY, err
 * filled and *out untouched. Messages about an assignment start with "--set PATH=VALUE: ", those about a file that the
 * case names with its place there. */
hc_status case_read(const char *path, int n_set, const char *const *set, scene *out, case_error *err);

/* What a case's text says of its model, so that another one can take its place: where `structure` stands, and where
 * degrees of freedom go by number and files by name. Characters of the text are counted from 0. */
typedef struct case_mention {
  size_t from, to;
  int dof;    /* from 0; or -1: */
  char *file; /* its path, to free */
} case_mention;
typedef struct case_source {
  char *text;
  size_t length;   /* in bytes */
  size_t from, to; /* the value of `structure` */
  int n_mentions;
  case_mention *mentions;
} case_source;

/* With matrices of any size: a structure of more than `most_dense` rows is_sparse, for reduce/ alone, not for solvers,
 * and what depends on all entries of its matrices is not checked. *source, or NULL, is to be freed in any case. */
hc_status case_read_sparse(const char *path, int n_set, const char *const *set, int most_dense, scene *out,
                           case_source *source, case_error *err);
void case_source_free(case_source *source);

/* The same from memory; `name` stands for the file in messages. */
hc_status case_parse(const char *name, const char *text, size_t length, int n_set, const char *const *set, scene *out,
                     case_error *err);

/* Free what a scene that was read has: its structure. Copies of the scene share it, and are to be forgotten. */
void case_clear(scene *sc);

/* Write the resolved scene as a case file that reads back to the same scene, bit for bit. Matrices stand in it whatever
 * files they came from: full ones of more than some 150 rows make it larger than a case file may be. */
hc_status case_echo(const scene *sc, FILE *to);

/* Describe one field or section, or all (asked = NULL), as text for a terminal: name, unit, default, range, meaning.
 * HC_BAD_INPUT with a suggestion in err if there is no such field. */
hc_status case_describe(const char *asked, FILE *to, case_error *err);
