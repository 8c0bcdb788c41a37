/* describe_structure.h - hbmcheck describe --case of a structure: what its parts resolved to. */
#ifndef HC_DESCRIBE_STRUCTURE_H
#define HC_DESCRIBE_STRUCTURE_H

#include "casefile/case_values.h"
#include "casefile/structure.h"

/* Does f say something of a structure, or of one of its loads or contacts? Then it has no place in the scene itself. */
bool describes_structure(const field *f);

/* How many values f has: of a list, one an entry. */
int describe_structure_count(const scene_structure *s, const field *f);

/* The value of f, of entry j if it is one of a list's, as text to free, or NULL where it does not count; and where it
 * is from. HC_NO_MEMORY. */
hc_status describe_structure_value(const scene_structure *s, const field *f, int j, char **text, case_place *at);

/* Sizes, and the lowest natural frequencies, into out[CASE_DERIVED_MAX]; *n of them. Errors of model_modes. */
hc_status describe_structure_derive(const scene *sc, case_derived *out, int *n);

#endif
