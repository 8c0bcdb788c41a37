/* pairing.c - see pairing.h. */
#include "model/casefile/mesh/pairing.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/casefile/matrices/matrix_text.h"
#include "model/casefile/matrices/text_file.h"
#include "numerics/base/growing.h"
#include "numerics/base/number.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

static const size_t most_bytes = (size_t)1 << 28; /* of a csv file */

/* ---- which nodes ---- */

static int nearest(const patch *p, const double *x, double *distance)
{
  int best = 0;
  *distance = INFINITY;
  for (int i = 0; i < p->n; ++i) {
    const double d = distance_2(3, p->v[i].x, x);
    if (d < *distance) *distance = d, best = i;
  }
  return best;
}

/* Another node of p about as near: seen along the line from best to it, x lies beyond a third of the way. -1: none. */
static int rival(const patch *p, int best, const double *x)
{
  for (int k = 0; k < p->n; ++k) {
    double way = 0, square = 0;
    for (int d = 0; d < 3; ++d) {
      const double step = p->v[k].x[d] - p->v[best].x[d];
      way += step * (x[d] - p->v[best].x[d]);
      square += step * step;
    }
    if (k != best && !(3 * way <= square && square > 0)) return k;
  }
  return -1;
}

typedef struct partners {
  int *of;          /* [n] the nearest node of the other patch, -1: too far away */
  double *distance; /* [n] to it                                                */
} partners;

static hc_status find_partners(const patch *from, const patch *to, double within, partners *p, message *why)
{
  for (int i = 0; i < from->n; ++i) {
    const patch_node *own = &from->v[i];
    const int best = p->of[i] = nearest(to, own->x, &p->distance[i]);
    if (!(p->distance[i] <= within)) {
      p->of[i] = -1;
      continue;
    }
    if (own->node == to->v[best].node) {
      message_add(why, "node %d is in both, expected two nodes where two bodies touch", own->node);
      return HC_BAD_INPUT;
    }
    const int other = rival(to, best, own->x);
    if (other < 0) continue;
    message_add(why, "node %d may belong to %d or to %d, %.3g and %.3g away, expected meshes that match", own->node,
                to->v[best].node, to->v[other].node, p->distance[i], distance_2(3, own->x, to->v[other].x));
    return HC_BAD_INPUT;
  }
  return HC_OK;
}

static hc_status too_few(const patch *a, const patch *b, double within, int n, double *distance, message *why)
{
  qsort(distance, (size_t)a->n, sizeof *distance, ascending);
  message_add(
      why,
      "%d of %d and %d nodes have a partner within %.6g: from the first %s the nearest ones are %.3g to %.3g away, "
      "half of them up to %.3g, expected meshes that match",
      n, a->n, b->n, within, a->n == 1 ? "node" : "nodes", distance[0], distance[a->n - 1], distance[(a->n - 1) / 2]);
  return HC_BAD_INPUT;
}

/* ---- normals and areas from faces ---- */

static hc_status from_faces(const patch *p, double sign, const double *given, int node, node_pair *to, message *why)
{
  const patch_node *v = &p->v[node];
  const double length = norm_2(3, v->normal);
  if (!(v->area > 0) || (!given && !(length > 1e-3 * v->area))) {
    message_add(why, "node %d has no face with a normal, expected one of elements whose corners are all in the set",
                v->node);
    return HC_BAD_INPUT;
  }
  if (given && !p->sheet && sign * dot_product(3, given, v->normal) <= 0) {
    message_add(why, "axes.normal does not point out of the first body at its face of node %d, expected the other way",
                v->node);
    return HC_BAD_INPUT;
  }
  to->area = v->area;
  for (int d = 0; d < 3; ++d) to->normal[d] = given ? given[d] : sign * v->normal[d] / length;
  return HC_OK;
}

/* ---- and from a plane ---- */

/* The unit normal of least squares of a's nodes, from them to b's. */
static hc_status fit_plane(const patch *a, const patch *b, const pairing *pairs, double *normal, message *why)
{
  double centre[3] = {0}, spread[9] = {0}, lambda[3], axes[9], apart = 0, off = 0;
  const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (int i = 0; i < a->n; ++i)
    for (int d = 0; d < 3; ++d) centre[d] += a->v[i].x[d] / a->n;
  for (int i = 0; i < a->n; ++i) {
    double from[3];
    for (int d = 0; d < 3; ++d) from[d] = a->v[i].x[d] - centre[d];
    add_outer(3, 1.0 / a->n, from, from, spread);
  }
  const hc_status st = dense_modes(3, spread, one, lambda, axes);
  if (st != HC_OK) return st;
  const double extent = sqrt(lambda[2]);
  if (!(lambda[1] > 1e-12 * lambda[2])) {
    message_add(why, "nodes on a line, which have no area, expected elements, or a file of pairs with areas");
    return HC_BAD_INPUT;
  }
  for (int i = 0; i < a->n; ++i) {
    double from[3];
    for (int d = 0; d < 3; ++d) from[d] = a->v[i].x[d] - centre[d];
    off = fmax(off, fabs(dot_product(3, axes, from)));
  }
  for (int i = 0; i < pairs->n; ++i)
    for (int d = 0; d < 3; ++d)
      apart += axes[d] * (b->v[pairs->pairs[i].b].x[d] - a->v[pairs->pairs[i].a].x[d]) / pairs->n;
  for (int d = 0; d < 3; ++d) normal[d] = apart < 0 ? -axes[d] : axes[d];
  if (off <= 1e-3 * extent && fabs(apart) > 1e-9 * extent) return HC_OK;
  if (off > 1e-3 * extent) message_add(why, "nodes without faces that are up to %.3g off their plane", off);
  else message_add(why, "nodes without faces, of which the place alone does not say on which side their body is");
  message_add(why, ", expected elements in structure.mesh, or axes.normal");
  return HC_BAD_INPUT;
}

typedef struct point {
  double x, y;
} point;

/* The polygon[n] where it is nearer to p than to q; returns how many corners it has then, at most one more. */
static int keep_nearer(const point *from, int n, point p, point q, point *to)
{
  int kept = 0;
  for (int i = 0; i < n; ++i) {
    const point s = from[i], e = from[(i + 1) % n];
    const double ax = q.x - p.x, ay = q.y - p.y, mx = (p.x + q.x) / 2, my = (p.y + q.y) / 2;
    const double at_s = ax * (s.x - mx) + ay * (s.y - my), at_e = ax * (e.x - mx) + ay * (e.y - my);
    if (at_s <= 0) to[kept++] = s;
    if ((at_s <= 0) == (at_e <= 0)) continue;
    const double t = at_s / (at_s - at_e);
    to[kept++] = (point){s.x + t * (e.x - s.x), s.y + t * (e.y - s.y)};
  }
  return kept;
}

static double cross(point o, point a, point b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

static int left_first(const void *a, const void *b)
{
  const point *p = a, *q = b;
  return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->y > q->y) - (p->y < q->y);
}

/* Counter-clockwise convex hull of v[n], which is sorted, into hull[2 n]; monotone chain (Andrew 1979). */
static int convex_hull(point *v, int n, point *hull)
{
  int k = 0;
  qsort(v, (size_t)n, sizeof *v, left_first);
  for (int pass = 0; pass < 2; ++pass) {
    const int floor = k + 1;
    for (int i = 0; i < n; ++i) {
      const point p = v[pass == 0 ? i : n - 1 - i];
      while (k > floor && cross(hull[k - 2], hull[k - 1], p) <= 0) --k;
      hull[k++] = p;
    }
    --k; /* it begins the other chain */
  }
  return k;
}

/* Shares of the area of a's convex hull across `normal`: of each node its Voronoi cell. */
static hc_status share_plane(const patch *a, const double *normal, pairing *out)
{
  const size_t n = (size_t)a->n;
  point *at = malloc(9 * n * sizeof *at);
  if (!at) return HC_NO_MEMORY;
  point *sorted = at + n, *hull = sorted + n, *cell = hull + 2 * n, *other = cell + 2 * n;
  double along[2][3] = {{0}};
  along[0][fabs(normal[0]) < 0.7 ? 0 : 1] = 1;
  const double part = dot_product(3, along[0], normal);
  for (int d = 0; d < 3; ++d) along[0][d] -= part * normal[d];
  const double length = norm_2(3, along[0]);
  for (int d = 0; d < 3; ++d) along[0][d] /= length;
  for (int d = 0; d < 3; ++d) {
    const int j = (d + 1) % 3, k = (d + 2) % 3;
    along[1][d] = normal[j] * along[0][k] - normal[k] * along[0][j];
  }
  for (int i = 0; i < a->n; ++i)
    sorted[i] = at[i] = (point){dot_product(3, along[0], a->v[i].x), dot_product(3, along[1], a->v[i].x)};
  const int corners = convex_hull(sorted, a->n, hull);
  for (int i = 0; i < out->n; ++i) {
    const int own = out->pairs[i].a;
    int m = corners;
    memcpy(cell, hull, (size_t)m * sizeof *cell);
    for (int k = 0; k < a->n && m > 0; ++k) {
      if (k == own) continue;
      m = keep_nearer(cell, m, at[own], at[k], other);
      point *const swap = cell;
      cell = other, other = swap;
    }
    for (int k = 1; k + 1 < m; ++k) out->pairs[i].area += cross(cell[0], cell[k], cell[k + 1]) / 2;
    memcpy(out->pairs[i].normal, normal, sizeof out->pairs[i].normal);
  }
  free(at);
  return HC_OK;
}

/* ---- all of it ---- */

static hc_status add_geometry(const patch *a, const patch *b, const double *given, pairing *out, message *why)
{
  hc_status st = HC_OK;
  const bool of_b = b->n_faces > 0 && (a->n_faces == 0 || (a->sheet && !b->sheet));
  out->from = of_b ? PAIRING_FACES_B : a->n_faces > 0 ? PAIRING_FACES_A : PAIRING_PLANE;
  for (int i = 0; i < out->n && st == HC_OK && out->from != PAIRING_PLANE; ++i) {
    node_pair *p = &out->pairs[i];
    const patch_node *x = &a->v[p->a], *y = &b->v[p->b];
    st = from_faces(of_b ? b : a, of_b ? -1 : 1, given, of_b ? p->b : p->a, p, why);
    if (st != HC_OK || a->sheet || b->sheet || !(dot_product(3, x->normal, y->normal) > 0)) continue;
    message_add(why, "the faces at nodes %d and %d look the same way, expected two bodies that face each other",
                x->node, y->node);
    st = HC_BAD_INPUT;
  }
  if (out->from != PAIRING_PLANE) return st;
  double normal[3];
  if (given) memcpy(normal, given, sizeof normal);
  else st = fit_plane(a, b, out, normal, why);
  return st == HC_OK ? share_plane(a, normal, out) : st;
}

hc_status pairing_make(const patch *a, const patch *b, double within, const double *normal, pairing *out, message *why)
{
  const size_t n = (size_t)a->n + (size_t)b->n;
  partners of_a = {malloc(n * sizeof(int)), malloc(n * sizeof(double))};
  partners of_b = {of_a.of + a->n, of_a.distance + a->n};
  hc_status st = of_a.of && of_a.distance ? HC_OK : HC_NO_MEMORY;
  *out = (pairing){.pairs = calloc((size_t)a->n, sizeof *out->pairs)};
  if (!out->pairs) st = HC_NO_MEMORY;
  if (st == HC_OK) st = find_partners(a, b, within, &of_a, why);
  if (st == HC_OK) st = find_partners(b, a, within, &of_b, why);
  for (int i = 0; i < a->n && st == HC_OK; ++i) {
    if (of_a.of[i] < 0 || of_b.of[of_a.of[i]] != i) continue;
    out->pairs[out->n++] = (node_pair){.a = i, .b = of_a.of[i]};
    out->farthest = fmax(out->farthest, of_a.distance[i]);
  }
  if (st == HC_OK && (out->n == 0 || (2 * out->n < a->n && 2 * out->n < b->n)))
    st = too_few(a, b, within, out->n, of_a.distance, why);
  if (st == HC_OK) st = add_geometry(a, b, normal, out, why);
  for (int i = 0; i < out->n && st == HC_OK; ++i) {
    out->area += out->pairs[i].area;
    if (out->pairs[i].area > 0) continue;
    message_add(why, "node %d has no area, expected elements, or a file of pairs with areas",
                a->v[out->pairs[i].a].node);
    st = HC_BAD_INPUT;
  }
  free(of_a.of);
  free(of_a.distance);
  return st;
}

/* ---- csv ---- */

static int by_node(const void *a, const void *b)
{
  const int x = ((const patch_node *)a)->node, y = ((const patch_node *)b)->node;
  return (x > y) - (x < y);
}

static hc_status read_csv(matrix_text *t, patch *out)
{
  static const char *const names[] = {"node", "x", "y", "z"};
  bool header = matrix_text_next(t) && t->n_words == 4;
  for (int i = 0; i < 4 && header; ++i) header = matrix_word_is(&t->words[i], names[i]);
  if (!header) return matrix_text_refuse(t, t->line_text, "expected the line node,x,y,z and one a node");
  while (matrix_text_next(t)) {
    patch_node node = {0};
    if (t->n_words != 4) return matrix_text_refuse(t, t->line_text, "%d values, expected node,x,y,z", t->n_words);
    if (!matrix_text_integer(t, 0, 0, INT_MAX, "a node", &node.node)) return HC_BAD_INPUT;
    for (int d = 0; d < 3; ++d)
      if (!matrix_text_number(t, 1 + d, &node.x[d])) return HC_BAD_INPUT;
    if (!GROW(out->v, out->n)) return HC_NO_MEMORY;
    out->v[out->n++] = node;
  }
  if (out->n > 0) qsort(out->v, (size_t)out->n, sizeof *out->v, by_node);
  for (int i = 1; i < out->n; ++i)
    if (out->v[i].node == out->v[i - 1].node)
      return matrix_text_refuse(t, NULL, "node %d is there twice, expected each once", out->v[i].node);
  return HC_OK;
}

hc_status patch_read(const char *path, patch *out, message *m)
{
  char *text;
  size_t length;
  *out = (patch){0};
  hc_status st = text_file_read(path, most_bytes, &text, &length, m);
  if (st == HC_OK) {
    matrix_text t = matrix_text_start(path, text, length, 0, m);
    st = read_csv(&t, out);
  }
  free(text);
  return st;
}
