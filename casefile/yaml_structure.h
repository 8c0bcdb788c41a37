/* yaml_structure.h - `structure`, its list of loads, its contacts and its responses, from a YAML document into
 * r->sc.structure. Matrices: yaml_matrix.c; degrees of freedom and directions: yaml_direction.c; lists: yaml_lists.c.
 */
#ifndef HC_YAML_STRUCTURE_H
#define HC_YAML_STRUCTURE_H

#include "casefile/case_reader.h"
#include "casefile/structure.h"

/* The section `structure` into a new structure. It comes first, whatever the order of the file: the other sections
 * speak of its degrees of freedom. */
hc_status yaml_structure_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node);

/* One part of it, `structure.mass`, or one number, `structure.damping.modal`. */
hc_status yaml_structure_part(case_reader *r, yaml_document_t *doc, const field *f, const yaml_node_t *node);

/* The lists, which replace what there was; or entry j, one past the last being new. */
hc_status yaml_loads_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node);
hc_status yaml_load_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int j);
hc_status yaml_contacts_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node);
hc_status yaml_contact_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int j);
hc_status yaml_responses_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node);

/* An entry of contacts with `pairs` and `axes`: a new contact for each pair of nodes. */
hc_status yaml_pairs_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node);

/* One part of load or contact j: a degree of freedom or direction. */
hc_status yaml_entry_part(case_reader *r, yaml_document_t *doc, const field *f, int j, const yaml_node_t *node);

/* A matrix of `expected` rows, or with expected = 0 of any number of rows, into *out, which it replaces. `what` is its
 * path. */
hc_status yaml_matrix_read(case_reader *r, yaml_document_t *doc, const char *what, const yaml_node_t *node,
                           int expected, int *n, structure_matrix *out);

/* Start the message with the place of entry (i, j), from 0, of a matrix: in its file, or else in the case. */
message *yaml_matrix_blame(case_reader *r, const structure_matrix *m, int i, int j);

/* A number, of which `what` tells in a message. */
hc_status yaml_number(case_reader *r, const yaml_node_t *node, const char *what, double *x);

/* A degree of freedom by name or number, or as {node: 17, direction: y}. */
hc_status yaml_dof(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int *dof);

/* A degree of freedom, or factors {tip: 1, root: -0.5}, not all 0, into direction[n]. `what` is its path, of entry j if
 * j >= 0. */
hc_status yaml_direction(case_reader *r, yaml_document_t *doc, const char *what, const yaml_node_t *node,
                         double *direction);

/* f, one of the fields of damping, has been stored: which kind of damping that is. Of Rayleigh damping one number given
 * alone leaves the other where there was such damping, and else 0. */
void structure_damping_given(scene_structure *s, const field *f);

#endif
