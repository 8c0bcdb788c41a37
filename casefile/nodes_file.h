/* nodes_file.h - which degree of freedom moves which node of a mesh in which direction: a csv file of lines
 * dof,node,direction, that line itself the first; CalculiX' JOB.dof; or a matrix file of Abaqus or CalculiX that says
 * what its rows are (matrix_file.h). The first line tells which. */
#ifndef HC_NODES_FILE_H
#define HC_NODES_FILE_H

#include "base/message.h"
#include "casefile/structure.h"

/* One more node of s, which is known not to be there yet. HC_NO_MEMORY. */
hc_status nodes_add(scene_structure *s, int dof, int node, char direction);

/* The file at `path` into s->nodes. HC_BAD_INPUT with "PATH:LINE:COLUMN: ..." in m, HC_IO with words that are to follow
 * the file's name ("cannot be opened: ..."), HC_NO_MEMORY. */
hc_status nodes_file_read(const char *path, scene_structure *s, message *m);

/* The same from text[length], which `name` stands for. */
hc_status nodes_file_parse(const char *name, const char *text, size_t length, scene_structure *s, message *m);

#endif
