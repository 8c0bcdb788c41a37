/* echo_structure.h - a structure as parts of a case file, which read back to the same bits. */
#ifndef HC_ECHO_STRUCTURE_H
#define HC_ECHO_STRUCTURE_H

#include <stdbool.h>
#include <stdio.h>

#include "casefile/structure.h"

/* Write what the section of that name says of a structure; false where it says nothing that an oscillator's does not.
 * The list of responses goes with the section `structure`. */
bool echo_structure(const scene_structure *s, const char *section, FILE *to);

#endif
