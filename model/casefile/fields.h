/* fields.h - every field of a case file, in one table: name, kind, unit, default, range, meaning, and its place in a
 * scene. Reader, --set, echo and describe work from it; a new field is a new row in fields.c and nothing else. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "model/casefile/scene.h"
#include "numerics/base/message.h"

typedef enum field_kind {
  FIELD_REAL,     /* double                                             */
  FIELD_INTEGER,  /* int                                                */
  FIELD_FLAG,     /* bool                                               */
  FIELD_CHOICE,   /* an enum as large as an int: an index into choices    */
  FIELD_TEXT,     /* char[size]                                         */
  FIELD_PAIR,     /* double[2], from and to                             */
  FIELD_REALS,    /* number_list                                        */
  FIELD_INTEGERS, /* number_list of integers                            */
  FIELD_PART      /* of a structure, in a form of its own: yaml_structure_part reads it */
} field_kind;

enum {
  FIELD_IN_CONTACT = 1,    /* offset is into scene_contact, not into scene */
  FIELD_AUTO = 2,          /* `auto` is a value, HBM_AUTO */
  FIELD_OPEN = 4,          /* low itself is out of range */
  FIELD_NO_ECHO = 8,       /* not echoed: another field writes what this one stored */
  FIELD_IN_LOAD = 16,      /* offset is into structure_load */
  FIELD_IN_STRUCTURE = 32, /* offset is into scene_structure */
  FIELD_STRUCTURE = 64,    /* with `structure` only, not with `oscillator` */
  FIELD_OSCILLATOR = 128   /* the other way round: offset is that of a pointer in scene_structure */
};
enum { FIELD_ELSEWHERE = FIELD_IN_CONTACT | FIELD_IN_LOAD | FIELD_IN_STRUCTURE | FIELD_OSCILLATOR }; /* not in scene */

typedef struct field {
  const char *section, *name; /* section is "" for the top level; path is section.name; loads' is "forcing[]" */
  const char *symbol;         /* what docs/theory.md and the paper call it, or ""; only ever suggested, never read */
  field_kind kind;
  unsigned flags;             /* FIELD_IN_CONTACT, ... */
  const char *unit;           /* in terms of force, length, time; "1" for pure numbers, "" where there is none */
  size_t offset, size;        /* in bytes; size for FIELD_TEXT, and for FIELD_PART that is a direction: a double *, the
                                 offset into structure_load or structure_contact */
  size_t behind;              /* of FIELD_OSCILLATOR: bytes behind where the pointer points */
  const char *fallback;       /* the default as it is written in a file; "": empty; NULL: the field is required */
  double low, high;           /* range, of each entry in lists */
  double scale;               /* stored = scale * written; 0 counts as 1 */
  const char *const *choices; /* in the order of the enum, ending in NULL */
  size_t in_cycles; /* offset in a scene of the bool that becomes true if this field gave the sweep and has a scale, and
                        false if it has none; 0: of no concern to it */
  const char *group; /* the fields of a section with one group give the same quantity, each in its own way: never two of
                        them in one file; or NULL */
  const char *along; /* the direction of a contact without which the field says nothing, and with which it is required
                        unless it has a default; or NULL */
  unsigned laws;     /* of a contact's: SCENE_LAWS of those that have it; 0: `contact`; SCENE_ANY_LAW */
  const char *expects; /* what may stand there, in words, where kind and range do not say it: all of FIELD_PART */
  const char *meaning;
} field;

typedef struct field_section {
  const char *name, *meaning;
} field_section;

enum { FIELD_MAX = 112, FIELD_PATH = 64 }; /* rows at most, asserted; characters of a path */

int field_count(void);
const field *field_at(int i); /* 0 <= i < field_count(), in the order of the echo, sections together */
int field_index(const field *f);
const field *field_rival(const field *f, int i); /* the i-th other field of its group; NULL past the last one */
const field_section *field_section_at(int i);    /* NULL past the last one; the first is the top level, named "" */
const field_section *field_find_section(const char *name, size_t length);
const field *field_find(const char *section, const char *name, size_t length); /* NULL if there is none */
static inline const field *field_named(const char *section, const char *name)
{
  return field_find(section, name, strlen(name));
}

/* "hbm.samples", "title", "contacts[2].gap", "forcing[0].phase_deg"; j < 0 gives "contacts[].gap". Returns path. */
const char *field_path(const field *f, int j, char path[FIELD_PATH]);

/* What may stand there, in words: "a number > 0", "an integer 1..200 or auto", "true or false". */
void field_expected(const field *f, message *m);

/* Is it one of those of a contact or a load, of which a list has many? */
static inline bool field_is_in_list(const field *f) { return f->flags & (FIELD_IN_CONTACT | FIELD_IN_LOAD); }

/* Where the field lives in base: the scene, or what its flags tell, of an oscillator its structure. Not for
 * FIELD_PART. */
static inline void *field_place(const field *f, void *base)
{
  void *at = (char *)base + f->offset, *structure;
  if (!(f->flags & FIELD_OSCILLATOR)) return at;
  memcpy(&structure, at, sizeof(void *));
  return (char *)structure + f->behind;
}
static inline const void *field_look(const field *f, const void *base) { return field_place(f, (void *)(size_t)base); }

/* Has the case that kind of field: of a structure, or of an oscillator? */
static inline bool field_is_of_case(const field *f, const scene *sc)
{
  return !(f->flags & (scene_is_oscillator(sc) ? FIELD_STRUCTURE : FIELD_OSCILLATOR));
}

/* Of a field that is in no list: where field_place begins. */
static inline const void *field_base(const field *f, const scene *sc)
{
  return f->flags & FIELD_OSCILLATOR ? (const void *)sc->structure : sc;
}

/* Has a contact of that law the field; and is it written for this one? */
#define SCENE_LAWS(kind) (1u << (kind))
#define SCENE_ANY_LAW    15u
bool field_is_of_law(const field *f, const scene_contact *c);
bool field_is_echoed(const field *f, const scene_contact *c);

/* A direction among the fields of a load or contact: entry is the structure_load or structure_contact. */
static inline double *field_direction(const field *f, const void *entry)
{
  return *(double *const *)(const void *)((const char *)entry + f->offset);
}

/* A value as it was written, not yet read as a number or a choice. */
typedef struct field_item {
  const char *text;
  size_t length;
  bool quoted;         /* "5" in quotes is text, not a number */
  size_t line, column; /* from 1; 0 when not from a file      */
} field_item;
typedef struct field_value {
  bool list;
  int n; /* entries; 1 if not a list. More than fit are counted, not kept */
  field_item item[NUMBER_LIST_MAX];
} field_value;

/* Store v, checked against the field's kind and range. On false nothing is stored, m got what comes after the path
 * (" is `12,5`, expected a number > 0") and *bad is the entry at fault, or -1 for the value as a whole. */
bool field_store(const field *f, void *base, const field_value *v, message *m, int *bad);

/* v from text[length] of --set or a default: `5`, `sampled`, `[1, 3, 5]` or `1,3,5` for lists. v points into text. */
void field_split(const field *f, const char *text, size_t length, field_value *v);

/* The stored value as text of a case file; reads back to the same bits. */
void field_write(const field *f, const void *base, FILE *to);

/* Back to the default; a required field keeps what it has. */
void field_reset(const field *f, void *base);

/* Everything at its default, no contacts; required fields are zero. */
void field_defaults(scene *sc);
void field_contact_defaults(scene_contact *c);
void field_load_defaults(structure_load *load); /* those of the table; its direction stays */

/* ---- which field or section was meant by a key that does not exist ---- */

/* "transient.richardson was removed: ...", with what does its work, if an earlier version had a field of that path. */
bool field_was_removed(message *m, const char *path, size_t length);

typedef struct suggestion { /* at most one is not NULL */
  const field *f;
  const field_section *s;
} suggestion;

/* The likeliest meaning of `key` in `section` ("" at the top level): a typing mistake (edit distance 1, or 2 in
 * longer words), the symbol of docs/theory.md (kt, M, F0), the start of a name, or the right key of another section. */
suggestion suggest_key(const char *section, const char *key, size_t length);

/* The same for a whole path, "hbm.sample". */
suggestion suggest_path(const char *path, size_t length);
