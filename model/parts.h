/* parts.h - the uncoupled parts of a structure: what no matrix and no contact joins. */
#pragma once

#include "model/model.h"

/* part[n]: two degrees of freedom that a matrix or a contact's directions join have the same number. */
void model_find_parts(const model *m, int *part);

/* Parts a and b become one. */
void model_join_parts(int n, int *part, int a, int b);

/* part[n_contacts]: of each contact that of its degrees of freedom; -1 of one without any. HC_NO_MEMORY. */
hc_status model_parts_of_contacts(const model *m, int *part);
