/* nearest.h - which word was meant by one that is not known, by their edit distance. */
#pragma once

#include <stddef.h>

enum { NEAREST_FAR = 1000 };

/* How far key[length] is from `name`: 0..2 typing mistakes (insertions, deletions, replacements, swaps of
 * neighbours), 1 for the start of the name, else NEAREST_FAR. Words of less than 6 letters may have one mistake
 * only, since two replacements turn most of them into each other. */
int nearest_distance(const char *key, size_t length, const char *name);

/* The nearest of words[], which ends in NULL, or NULL if none is near. */
const char *nearest_word(const char *const *words, const char *key, size_t length);

/* ", did you mean 'compare'?" for a message that ends in what is not known; "" where none of words[] is near. Returns
 * hint. */
enum { NEAREST_HINT = 64 };
const char *nearest_hint(const char *const *words, const char *key, char hint[NEAREST_HINT]);
