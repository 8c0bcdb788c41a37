/* case_values.h - a case file as it was resolved: every field with its value and where that is from, and what follows
 * from them before anything is solved. For those who show cases (hbmcheck describe). */
#pragma once

#include "model/casefile/case_file.h"
#include "model/casefile/fields.h"
#include "model/casefile/structure.h"

/* [field_index] where each field was last given; those of contacts are in `contact` alone. */
typedef struct case_places {
  case_place field[FIELD_MAX];
  case_place contact[SCENE_MAX_CONTACTS][FIELD_MAX];
} case_places;

/* case_read (case_file.h), with the places where fields were given; places may be NULL. */
hc_status case_read_placed(const char *path, int n_set, const char *const *set, scene *out, case_places *places,
                           case_error *err);

/* Does this field say something in this scene? Of rivals the one in force does; an empty list does not. */
bool case_field_counts(const field *f, const scene *sc);

/* Does this field say something of contact c of s? Of gap and preload the one that was given does. */
bool case_contact_field_counts(const scene_structure *s, const structure_contact *c, const field *f);

/* A table's points as a case file has them: [[-1, -5], [0, 0], [1, 20]]. */
void case_write_points(const scene_contact *c, FILE *to);

/* Likewise a text, in quotes; damping that is no matrix, with n modal ratios, {rayleigh: [0.1, 1e-5]} or {modal: 0.01};
 * and what a reduced structure states: reduction: {error: 1e-4, at: 12}. */
void case_write_text(const char *text, FILE *to);
void case_write_damping(const scene_structure *s, int n, FILE *to);
void case_write_reduction(double error, double at, FILE *to);

/* Where the value of f is from, of contact j if it is one of a contact's: its own place, or else, where it stores what
 * a rival gave (compare.omega, compare.frequency), the rival's. line = 0: the default. */
case_place case_field_place(const case_places *places, const field *f, int j);

/* Is f what `asked` names: a path (with or without index), a section, a name or a symbol? NULL names all. */
bool case_field_asked(const field *f, const char *asked);

/* Quantities that follow from a scene. value: NaN where there is none. */
typedef struct case_derived {
  char name[40];       /* "omega_open", "contacts[0].preload" */
  double value;        /* [unit] */
  const char *unit;    /* as in fields.h */
  const char *meaning; /* a constant string */
} case_derived;

enum { CASE_DERIVED_MAX = 7 + 3 * SCENE_MAX_CONTACTS };

/* Into out[CASE_DERIVED_MAX]; how many. */
int case_derive(const scene *sc, case_derived *out);
