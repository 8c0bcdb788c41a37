/* pairing.h - which nodes of two patches touch, and along which normal and over which area each pair does. */
#pragma once

#include "model/casefile/mesh/mesh_file.h"

typedef enum pairing_source { PAIRING_FACES_A, PAIRING_FACES_B, PAIRING_PLANE } pairing_source;

typedef struct node_pair {
  int a, b;         /* places in the patches */
  double normal[3]; /* as long as 1, outwards from a's body: v = normal . (x_a - x_b) > 0 closes */
  double area;
} node_pair;

typedef struct pairing {
  int n;
  node_pair *pairs;    /* [n] by a; to free */
  pairing_source from; /* normals and areas: the faces of the first patch, or of the second one, or a plane */
  double farthest;     /* apart */
  double area;         /* of the pairs together */
} pairing;

/* Pairs are nodes that are each other's nearest and at most `within` apart. normal, unless NULL, is every pair's. Where
 * neither patch has faces, the plane of least squares through a's nodes gives the normal, and its area is shared out by
 * their Voronoi cells within their convex hull. HC_BAD_INPUT with words in `why`, without a place, where meshes do not
 * match: fewer than half of the smaller patch's nodes have a partner; a node is not clearly nearer to its partner than
 * to the next node; a node is in both; faces do not face each other. HC_NO_MEMORY; HC_NOT_CONVERGED. out->pairs is to
 * be freed in any case. */
hc_status pairing_make(const patch *a, const patch *b, double within, const double *normal, pairing *out, message *why);

/* A csv file of nodes alone into a patch, lines node,x,y,z, that line itself the first. Statuses as of mesh_read. */
hc_status patch_read(const char *path, patch *out, message *m);
