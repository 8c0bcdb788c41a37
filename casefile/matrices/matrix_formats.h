/* matrix_formats.h - the formats of a matrix file, each recognised by what its first line says; matrix_file.c chooses.
 * Each reads all of r's text into r->values, or returns HC_BAD_INPUT with the message made, or HC_NO_MEMORY. */
#ifndef HC_MATRIX_FORMATS_H
#define HC_MATRIX_FORMATS_H

#include "casefile/matrices/matrix_text.h"

/* Matrix Market, https://math.nist.gov/MatrixMarket/formats.html: its banner comes first. matrix_market.c */
hc_status matrix_market_parse(matrix_text *r);

/* Lines of row, column and value, parted by blanks or commas, rows counted from 1: CalculiX (*FREQUENCY,
 * SOLVER=MATRIXSTORAGE: JOB.sti, JOB.mas) and Abaqus (*MATRIX OUTPUT, FORMAT=COORDINATE). The upper or the lower
 * triangle of a symmetric matrix; or both, each entry with its mirror image, of any. triplets.c */
hc_status triplets_parse(matrix_text *r);

/* Abaqus' default of *MATRIX OUTPUT, FORMAT=MATRIX INPUT, lines of node, DOF, node, DOF and value, and of CalculiX'
 * OUTPUT FILE=MATRIX. The rows are the DOFs that have an entry on the diagonal, by node, then by DOF: r->labels.
 * Triangles as of triplets. triplets.c */
hc_status labelled_triplets_parse(matrix_text *r);

/* Abaqus' *SUBSTRUCTURE MATRIX OUTPUT and *ELEMENT MATRIX OUTPUT, OUTPUT FILE=USER DEFINED, and CalculiX': the header
 * *USER ELEMENT, then *MATRIX,TYPE=STIFFNESS, TYPE=MASS and so on, each with the rows of its lower triangle. Of these
 * the one that r->part names, in capitals without blanks; if NULL, the first. r->labels where the header tells all of
 * them. abaqus_element.c */
hc_status abaqus_element_parse(matrix_text *r);

#endif
