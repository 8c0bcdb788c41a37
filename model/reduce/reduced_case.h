/* reduced_case.h - a folder with a reduced structure and the case on it. */
#pragma once

#include "model/casefile/case_file.h"
#include "model/reduce/receptance.h"

/* The rows that loads, contacts, responses and the text itself name, ascending: those that stay. *kept, to free, has
 * *n of them. HC_NO_MEMORY. */
hc_status reduced_case_rows(const scene_structure *s, const case_source *source, int *n, int **kept);

/* Into the folder at `part`, which is made: mass.mtx, stiffness.mtx, damping.mtx where the damping is a matrix,
 * nodes.csv where there are nodes, a copy of each file that the case names elsewhere, and `name`, the case: its text
 * with these in place of its `structure`, with the numbers that kept rows have now, and with structure.reduction. Byte
 * for byte the same for the same input. HC_IO, errno telling why; HC_NO_MEMORY. */
hc_status reduced_case_write(const char *part, const char *name, case_source *source, const scene *sc,
                             const craig_bampton *cb, int modes, const receptance_error *stated);

/* Put the folder `part` in the place of `folder`, which may be one that was made so before, or not be there: false, and
 * errno, where it cannot be, or holds what is not in `part`. reduced_case_remove: the folder and the files in it. */
bool reduced_case_place(const char *part, const char *folder);
void reduced_case_remove(const char *part);
