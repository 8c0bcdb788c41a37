/* mesh_file.h - a finite-element mesh from the input file of CalculiX or Abaqus (.inp), as far as contacts need it:
 * where nodes are, and the faces of elements between them.
 *
 * Read are *NODE, *ELEMENT (C3D4, C3D6, C3D8, C3D10, C3D15, C3D20, S3, S4, S6, S8 and what is derived from them: C3D8R,
 * S4R; others have no faces here), *NSET and *ELSET (GENERATE, names of other sets), *SURFACE of faces or nodes, and
 * *INCLUDE; all else is passed over. A set may stand before what it holds. Parts, instances and generated nodes are
 * refused. Names are the same in any case of letters. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "numerics/base/message.h"
#include "numerics/base/status.h"

typedef struct mesh mesh; /* of a file; from mesh_read, to mesh_free, which takes NULL */

/* A part of a surface, from a set of nodes or a surface. A node's share of a face is that of linear elements on it, a
 * face with nodes between its corners being cut into small ones: all shares are positive, their sum is the area. */
typedef struct patch_node {
  int node;
  double x[3];
  double area;      /* its share of the faces; 0: on none */
  double normal[3]; /* outwards, its share of the faces' area as a vector */
} patch_node;

typedef struct patch {
  int n;
  patch_node *v; /* [n] by ascending number; to free */
  int n_faces;
  bool sheet; /* of shells, whose outward side is that of their positive normal */
} patch;

/* HC_BAD_INPUT: "PATH:LINE:COLUMN: what is wrong, what was expected" in m; HC_IO: words to follow the file's name
 * ("cannot be opened: ..."); HC_NO_MEMORY. *out is NULL then. mesh_parse: from text[length], called `name`. */
hc_status mesh_read(const char *path, mesh **out, message *m);
hc_status mesh_parse(const char *name, const char *text, size_t length, mesh **out, message *m);
void mesh_free(mesh *s);

/* A mesh that was read as one file: what *INCLUDE names stands in its place. Statuses as of mesh_read. */
hc_status mesh_copy(const char *path, FILE *to, message *m);

/* The surface or else set of nodes of that name, -1 if there is none; then the name that was meant, or NULL. */
int mesh_find(const mesh *s, const char *name, size_t length);
const char *mesh_nearest(const mesh *s, const char *name, size_t length);

/* What mesh_find has found. Faces are the surface's; of a set of nodes, those on the outside of the elements (solids,
 * or else shells) with all corners in it. Statuses as of mesh_parse; out->v is to be freed in any case. */
hc_status mesh_patch(const mesh *s, int set, patch *out, message *m);
