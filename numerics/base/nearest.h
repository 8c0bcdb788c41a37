/* nearest.h - spelling suggestions for an unknown word, by edit distance. */
#pragma once

#include <stddef.h>

enum { NEAREST_FAR = 1000 };

/* Distance of key[length] from `name`: 0..2 typing mistakes (insertions, deletions, replacements, swaps of neighbours),
 * 1 for the start of the name, else NEAREST_FAR. Words of less than 6 letters may have one mistake only, since two
 * replacements turn most of them into each other. */
int nearest_distance(const char *key, size_t length, const char *name);

/* The nearest of words[], a list that ends in NULL; NULL if none is near. */
const char *nearest_word(const char *const *words, const char *key, size_t length);

/* ", did you mean 'compare'?" to append to a message about the unknown word; "" if none of words[] is near. Returns
 * hint. */
enum { NEAREST_HINT = 64 };
const char *nearest_hint(const char *const *words, const char *key, char hint[NEAREST_HINT]);
