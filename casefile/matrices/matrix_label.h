/* matrix_label.h - what a row of a matrix stands for, where its file says it. */
#ifndef HC_MATRIX_LABEL_H
#define HC_MATRIX_LABEL_H

typedef struct matrix_label {
  int node, dof; /* 1..3 along x, y, z; 4..6 rotations; others as the program has them */
} matrix_label;

#endif
