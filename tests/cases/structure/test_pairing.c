/* test_pairing.c - pairs by position: the mesh, areas and normals, which nodes pair, every mistake with its place. */
#include <float.h>

#include "model/casefile/mesh/pairing.h"
#include "numerics/norm.h"
#include "tests/cases/structure/structure_text.h"

static mesh *mesh_of(const char *text)
{
  char words[512] = "";
  message m;
  mesh *s;
  message_start(&m, words, sizeof words);
  if (mesh_parse("m", text, strlen(text), &s, &m) != HC_OK) fail_msg("%s", words);
  assert_string_equal(words, "");
  return s;
}

static patch patch_of(const mesh *s, const char *name)
{
  char words[512] = "";
  message m;
  patch p;
  message_start(&m, words, sizeof words);
  const int set = mesh_find(s, name, strlen(name));
  assert_true(set >= 0);
  if (mesh_patch(s, set, &p, &m) != HC_OK) fail_msg("%s", words);
  return p;
}

static double area_of(const patch *p)
{
  double sum = 0;
  for (int i = 0; i < p->n; ++i) sum += p->v[i].area;
  return sum;
}

/* ---- two bodies, each a layer of bricks nx by ny, that meet in a face at z = 0, `gap` apart; the face is a plane of
 * lengths 3 and 2, or with R > 0 the part of a cylinder about y that stands for it. seed shuffles numbers. ---- */

enum { NX = 6, NY = 4, FACE = (NX + 1) * (NY + 1), NODES = 4 * FACE };
static const double LX = 3, LY = 2;

typedef struct bodies {
  int id[2][2][NX + 1][NY + 1]; /* of the body below and above; away from the face and on it */
  char *text;
} bodies;

static void place_node(double R, double gap, int body, int on, int i, int j, double x[3])
{
  const double up = body == 0 ? (on ? 0 : -0.5) : on ? gap : gap + 0.5, along = LX * i / NX;
  const double turn = R > 0 ? along / R : 0;
  x[0] = R > 0 ? (R + up) * sin(turn) : along;
  x[1] = LY * j / NY;
  x[2] = R > 0 ? (R + up) * cos(turn) - R : up;
}

static void make_bodies(bodies *b, double R, double gap, unsigned seed)
{
  int number[NODES], count = 0, element = 0;
  size_t size;
  FILE *to = open_memstream(&b->text, &size);
  for (int i = 0; i < NODES; ++i) number[i] = 10 + 3 * i;
  for (int i = NODES - 1; i > 0 && seed; --i) {
    seed = seed * 1103515245u + 12345u;
    const int k = (int)(seed / 65536u) % (i + 1), swap = number[i];
    number[i] = number[k], number[k] = swap;
  }
  fputs("*HEADING\n a name, not data\n*Node\n", to);
  for (int body = 0; body < 2; ++body)
    for (int on = 0; on < 2; ++on)
      for (int i = 0; i <= NX; ++i)
        for (int j = 0; j <= NY; ++j) {
          double x[3];
          place_node(R, gap, body, on, i, j, x);
          fprintf(to, "%d, %.17g, %.17g, %.17g\n", b->id[body][on][i][j] = number[count++], x[0], x[1], x[2]);
        }
  fputs("*ELEMENT, TYPE=C3D8R, ELSET=ALL\n", to);
  for (int body = 0; body < 2; ++body)
    for (int i = 0; i < NX; ++i)
      for (int j = 0; j < NY; ++j) {
        fprintf(to, "%d,\n", ++element);
        for (int k = 0; k < 2; ++k) { /* the lower nodes first */
          int(*at)[NY + 1] = b->id[body][body == 0 ? k : !k];
          fprintf(to, " %d, %d, %d, %d%s\n", at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1], k ? "" : ",");
        }
      }
  for (int body = 0; body < 2; ++body) {
    fprintf(to, "*NSET, NSET=%s\n", body == 0 ? "LOW" : "UP");
    for (int i = 0; i <= NX; ++i)
      for (int j = 0; j <= NY; ++j) fprintf(to, "%d%s", b->id[body][1][i][j], j < NY ? ", " : "\n");
  }
  fputs("*NSET, NSET=BOTH, GENERATE\n1, 1000\n", to);
  fclose(to);
}

/* All pairs of it: each node above the one that belongs to it, and each once; they go to *out. */
static void pair_bodies(double R, double gap, unsigned seed, bodies *b, patch side[2], pairing *out)
{
  char words[512] = "";
  message why;
  message_start(&why, words, sizeof words);
  make_bodies(b, R, gap, seed);
  mesh *s = mesh_of(b->text);
  side[0] = patch_of(s, "low"), side[1] = patch_of(s, "Up");
  if (pairing_make(&side[0], &side[1], 1.5 * gap + 1e-9, NULL, out, &why) != HC_OK) fail_msg("%s", words);
  assert_int_equal(out->n, FACE);
  assert_int_equal(out->from, PAIRING_FACES_A);
  for (int k = 0, found; k < FACE; ++k) {
    found = 0;
    for (int i = 0; i <= NX; ++i)
      for (int j = 0; j <= NY; ++j)
        found += b->id[0][1][i][j] == side[0].v[out->pairs[k].a].node &&
                 b->id[1][1][i][j] == side[1].v[out->pairs[k].b].node;
    assert_int_equal(found, 1);
  }
  mesh_free(s);
}

static void forget(bodies *b, patch side[2], pairing *p)
{
  free(b->text);
  free(side[0].v), free(side[1].v), free(p->pairs);
}

/* Areas of < 1000 triangles, each of rounded products of 3: 1000 eps 3^2. A node has a quarter of each face. */
static void flat_faces_pair(CHECK_STATE)
{
  for (unsigned seed = 0; seed < 20; ++seed) {
    bodies b;
    patch side[2];
    pairing p;
    pair_bodies(0, seed % 2 ? 0.3 : 0, seed, &b, side, &p);
    CHECK_NEAR(p.area, LX * LY, 1e4 * DBL_EPSILON, "seed %u", seed);
    CHECK_NEAR(p.farthest, seed % 2 ? 0.3 : 0, 4 * DBL_EPSILON, "seed %u", seed);
    for (int k = 0; k < p.n; ++k) {
      const double *x = side[0].v[p.pairs[k].a].x;
      const int edges = (x[0] == 0 || x[0] == LX) + (x[1] == 0 || x[1] == LY);
      CHECK_NEAR(p.pairs[k].area, LX * LY / (NX * NY) / (1 << edges), 1e4 * DBL_EPSILON, "node %d", k);
      assert_true(p.pairs[k].normal[0] == 0 && p.pairs[k].normal[1] == 0 && p.pairs[k].normal[2] == 1);
    }
    forget(&b, side, &p);
  }
}

/* In a set of all nodes faces between two elements are none: each body has the surface of a box. */
static void faces_are_outside(CHECK_STATE)
{
  bodies b;
  make_bodies(&b, 0, 0.3, 1);
  mesh *s = mesh_of(b.text);
  patch all = patch_of(s, "both");
  assert_int_equal(all.n, NODES);
  assert_int_equal(all.n_faces, 4 * (NX * NY + NX + NY));
  CHECK_NEAR(area_of(&all), 4 * (LX * LY + 0.5 * LX + 0.5 * LY), 1e4 * DBL_EPSILON, "two boxes");
  free(all.v), free(b.text);
  mesh_free(s);
}

/* Equal facets around a node have the radius as mean; at the edge one is half its angle off. */
static void normals_of_a_cylinder(CHECK_STATE)
{
  const double R = 4, half = LX / NX / R / 2;
  bodies b;
  patch side[2];
  pairing p;
  pair_bodies(R, 0.1, 7, &b, side, &p);
  CHECK_NEAR(p.area, 2 * R * sin(half) * NX * LY, 1e4 * DBL_EPSILON, "facets");
  for (int k = 0; k < p.n; ++k) {
    const double *x = side[0].v[p.pairs[k].a].x, *n = p.pairs[k].normal, turn = atan2(x[0], x[2] + R);
    const double off = turn < half ? half : turn > LX / R - half ? -half : 0;
    CHECK_NEAR(n[0], sin(turn + off), 1e3 * DBL_EPSILON, "turn %g", turn);
    CHECK_NEAR(n[2], cos(turn + off), 1e3 * DBL_EPSILON, "turn %g", turn);
    assert_true(n[1] == 0);
  }
  forget(&b, side, &p);
}

/* ---- every face of every element: positive shares, the area of its corners, outwards ---- */

static void faces_of_all_elements(CHECK_STATE)
{
#define TET   "0 0 0 3 0 0 0 2 0 0 0 1 "
#define WEDGE "0 0 0 3 0 0 0 2 0 0 0 1 3 0 1 0 2 1 "
#define BRICK "0 0 0 3 0 0 3 2 0 0 2 0 0 0 1 3 0 1 3 2 1 0 2 1 "
  static const struct {
    const char *type, *corners, *between; /* pairs of corners that the further nodes are between */
    double area;                          /* of all faces; of a shell both sides */
    int faces;
  } all[] = {
      {"C3D4", TET, "", 3 + 1 + 1.5 + 3.5, 4},
      {"C3D10M", TET, "122313142434", 3 + 1 + 1.5 + 3.5, 4},
      {"C3D6", WEDGE, "", 6 + 3 + 2 + 3.605551275463989, 5},
      {"C3D15", WEDGE, "122313455646142536", 6 + 3 + 2 + 3.605551275463989, 5},
      {"C3D8I", BRICK, "", 22, 6},
      {"C3D20R", BRICK, "122334415667788515263748", 22, 6},
      {"S3", "0 0 0 3 0 0 0 2 0 ", "", 6, 2},
      {"S6", "0 0 0 3 0 0 0 2 0 ", "122331", 6, 2},
      {"S4R", "0 0 0 3 0 0 3 2 0 0 2 0 ", "", 12, 2},
      {"S8R5", "0 0 0 3 0 0 3 2 0 0 2 0 ", "12233441", 12, 2},
  };
  for (size_t e = 0; e < sizeof all / sizeof *all; ++e) {
    double x[20][3], total = 0, closed[3] = {0};
    int n = 0, used = 0;
    char *text, name[16];
    size_t size;
    FILE *to = open_memstream(&text, &size);
    for (const char *s = all[e].corners; *s; s += used, ++n)
      assert_int_equal(sscanf(s, "%lf %lf %lf %n", &x[n][0], &x[n][1], &x[n][2], &used), 3);
    double centre[3] = {0};
    for (int i = 0; i < n; ++i)
      for (int d = 0; d < 3; ++d) centre[d] += x[i][d] / n;
    for (const char *s = all[e].between; *s; s += 2, ++n)
      for (int d = 0; d < 3; ++d) x[n][d] = (x[s[0] - '1'][d] + x[s[1] - '1'][d]) / 2;
    fputs("*NODE\n", to);
    for (int i = 0; i < n; ++i) fprintf(to, "%d, %.17g, %.17g, %.17g\n", i + 1, x[i][0], x[i][1], x[i][2]);
    fprintf(to, "*ELEMENT, TYPE=%s\n 7", all[e].type);
    for (int i = 0; i < n; ++i) fprintf(to, ",%s %d", i == 9 ? "\n" : "", i + 1);
    for (int f = 1; f <= all[e].faces; ++f) fprintf(to, "\n*SURFACE, NAME=F%d, TYPE=ELEMENT\n7, S%d", f, f);
    fprintf(to, "\n*NSET, NSET=ALL, GENERATE\n1, %d\n", n);
    fclose(to);
    mesh *s = mesh_of(text);
    for (int f = 1; f <= all[e].faces; ++f) {
      snprintf(name, sizeof name, "F%d", f);
      patch p = patch_of(s, name);
      double out[3] = {0}, middle[3] = {0};
      assert_int_equal(p.n_faces, 1);
      for (int i = 0; i < p.n; ++i) {
        assert_true(p.v[i].area > 0);
        for (int d = 0; d < 3; ++d) out[d] += p.v[i].normal[d], middle[d] += (p.v[i].x[d] - centre[d]) / p.n;
      }
      CHECK_NEAR(norm_2(3, out), area_of(&p), 1e3 * DBL_EPSILON, "%s %s is flat", all[e].type, name);
      if (*all[e].type == 'C') assert_true(dot_product(3, out, middle) > 0);
      else assert_true(out[2] > 0 ? f == 2 : f == 1);
      for (int d = 0; d < 3; ++d) closed[d] += out[d];
      total += area_of(&p);
      free(p.v);
    }
    patch whole = patch_of(s, "ALL"); /* a set of all nodes has the same faces, of a shell the one of its normal */
    CHECK_NEAR(total, all[e].area, 1e3 * DBL_EPSILON, "%s", all[e].type);
    CHECK_NEAR(area_of(&whole), *all[e].type == 'S' ? all[e].area / 2 : all[e].area, 1e3 * DBL_EPSILON, "%s",
               all[e].type);
    CHECK_LE(norm_2(3, closed), 1e3 * DBL_EPSILON, "%s is closed", all[e].type);
    assert_int_equal(whole.n, n);
    assert_true(whole.sheet == (*all[e].type == 'S'));
    free(whole.v);
    mesh_free(s);
    free(text);
  }
}

/* Sets within sets, before and after what they name; *INCLUDE; faces between two elements are none. */
static void sets_and_includes(CHECK_STATE)
{
  const own_file part =
      write_file("part.inp", "5, 0, 0, 2\n6, 1, 0, 2\n7, 1, 1, 2\n8, 0, 1, 2\n9, 0, 0, 4\n*NSET, NSET=A\n1,",
                 strlen("5, 0, 0, 2\n6, 1, 0, 2\n7, 1, 1, 2\n8, 0, 1, 2\n9, 0, 0, 4\n*NSET, NSET=A\n1,"));
  char text[2048];
  snprintf(
      text, sizeof text,
      "*NSET, NSET=BOTH\nA, B, 4\n*SURFACE, NAME=TOP\nE, S2\n*SURFACE, NAME=CORNERS, TYPE=NODE\nB,\n9, 0.5\n"
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n*INCLUDE, INPUT=%s\n2\n*NSET, NSET=B, GENERATE\n3, 7, 2\n"
      "*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=SPRING1\n2, 9\n*NSET, NSET=A\nb\n",
      part.path);
  mesh *s = mesh_of(text);
  static const struct {
    const char *name;
    int n, faces, node[8];
  } all[] = {{"A", 5, 0, {1, 2, 3, 5, 7}},
             {"B", 3, 0, {3, 5, 7}},
             {"both", 6, 1, {1, 2, 3, 4, 5, 7}},
             {"TOP", 4, 1, {5, 6, 7, 8}},
             {"CORNERS", 4, 0, {3, 5, 7, 9}}};
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    patch p = patch_of(s, all[i].name);
    assert_int_equal(p.n, all[i].n);
    assert_int_equal(p.n_faces, all[i].faces);
    for (int k = 0; k < p.n; ++k) assert_int_equal(p.v[k].node, all[i].node[k]);
    free(p.v);
  }
  assert_int_equal(mesh_find(s, "E", 1), -1);
  assert_string_equal(mesh_nearest(s, "CORNER", 6), "CORNERS");
  mesh_free(s);
  remove_file(&part);
}

static void check_words(const mistake *m, const char *words)
{
  if (strncmp(words, m->at, strlen(m->at)) || !strstr(words, m->words))
    fail_msg("%s\n  gave `%s`\n  not `%s...%s...`", m->text, words, m->at, m->words);
}

static void no_mesh(const mistake *wrong)
{
  char words[512];
  message m;
  mesh *s;
  message_start(&m, words, sizeof words);
  assert_int_equal(mesh_parse("m", wrong->text, strlen(wrong->text), &s, &m), HC_BAD_INPUT);
  assert_null(s);
  check_words(wrong, words);
}

static void no_patch(const mistake *wrong)
{
  char words[512];
  message m;
  patch p;
  mesh *s = mesh_of(wrong->text);
  message_start(&m, words, sizeof words);
  assert_int_equal(mesh_patch(s, mesh_find(s, "A", 1), &p, &m), HC_BAD_INPUT);
  check_words(wrong, words);
  free(p.v);
  mesh_free(s);
}

static void mistakes_in_a_mesh(CHECK_STATE)
{
  each_mistake("meshes", 21, no_mesh);
  each_mistake("sets of a mesh", 4, no_patch);
}

/* ---- which nodes pair ---- */

/* A patch without faces of places x, y, z, numbered from `first`. */
static patch points(int first, int n, double (*x)[3])
{
  patch p = {.n = n, .v = calloc((size_t)n, sizeof *p.v)};
  for (int i = 0; i < n; ++i) {
    p.v[i].node = first + i;
    memcpy(p.v[i].x, x[i], sizeof x[i]);
  }
  return p;
}

static void what_does_not_match(CHECK_STATE)
{
#define SQUARE                                                                                                         \
  {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, { 0, 1, 0 }
#define ABOVE                                                                                                          \
  {0, 0, .1}, {1, 0, .1}, {1, 1, .1}, { 0, 1, .1 }
  static struct {
    int na, nb, first_b;
    double a[6][3], b[6][3], within;
    const char *words; /* NULL: they match */
    int n;
  } all[] = {
      {4, 4, 11, {SQUARE}, {ABOVE}, 0.2, NULL, 4},
      {4, 4, 11, {SQUARE}, {{1, 1, 2}, {0, 1, 2}, {1, 0, 2}, {0, 0, 2}}, 2.5, NULL, 4}, /* a gap wider than a face */
      {4, 4, 11, {SQUARE}, {{.2, 0, .1}, {1.2, 0, .1}, {1.2, 1, .1}, {.2, 1, .1}}, 0.5, NULL, 4},
      {4, 4, 11, {SQUARE}, {{.4, 0, .1}, {1.4, 0, .1}, {1.4, 1, .1}, {.4, 1, .1}}, 0.5, "node 2 may belong to ", 0},
      {4, 5, 11, {SQUARE}, {ABOVE, {.5, .5, .1}}, 0.2, NULL, 4},
      {4, 5, 11, {SQUARE}, {ABOVE, {.5, 0, .1}}, 0.6, "node 15 may belong to ", 0},
      {4, 5, 11, {SQUARE}, {ABOVE, {0, 1, .1}}, 0.2, "node 4 may belong to ", 0},
      {4, 2, 11, {SQUARE}, {{0, 0, .1}, {1, 0, .1}}, 0.2, NULL, 2},
      {5, 4, 11, {SQUARE, {5, 0, 0}}, {ABOVE}, 20, NULL, 4},
      {4, 4, 11, {SQUARE}, {{0, 0, .1}, {5, 0, .1}, {5, 1, .1}, {5, 2, .1}}, 0.2, "1 of 4 and 4 nodes", 0},
      {4, 4, 11, {SQUARE}, {{0, 0, 3}, {1, 0, 3}, {1, 1, 3}, {0, 1, 3}}, 0.2, "the nearest ones are 3 to 3 away", 0},
      {4, 4, 1, {SQUARE}, {{0, 0, 0}, {1, 0, .1}, {1, 1, .1}, {0, 1, .1}}, 0.2, "node 1 is in both", 0},
      {4, 4, 11, {SQUARE}, {SQUARE}, 0.2, "does not say on which side", 0},
      {4,
       4,
       11,
       {{0, 0, 0}, {1, 0, 0}, {1, 1, .2}, {0, 1, 0}},
       {{0, 0, .1}, {1, 0, .1}, {1, 1, .3}, {0, 1, .1}},
       .2,
       "off their plane",
       0},
      {3, 3, 11, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 0, .1}, {1, 0, .1}, {2, 0, .1}}, 0.2, "nodes on a line", 0},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    char words[512] = "";
    message why;
    pairing p;
    message_start(&why, words, sizeof words);
    patch a = points(1, all[i].na, all[i].a), b = points(all[i].first_b, all[i].nb, all[i].b);
    const hc_status st = pairing_make(&a, &b, all[i].within, NULL, &p, &why);
    if (st != (all[i].words ? HC_BAD_INPUT : HC_OK) || (all[i].words && !strstr(words, all[i].words)) ||
        (!all[i].words && p.n != all[i].n))
      fail_msg("%zu: %d, %d pairs, `%s`", i, (int)st, p.n, words);
    free(a.v), free(b.v), free(p.pairs);
  }
}

/* A turned grid without elements: Voronoi's cells are its quarters, halves, wholes; the normal is from a to b. */
static void a_plane_through_nodes_alone(CHECK_STATE)
{
  static const double e[3][3] = {{2 / 3., 1 / 3., -2 / 3.}, {-2 / 3., 2 / 3., -1 / 3.}, {1 / 3., 2 / 3., 2 / 3.}};
  double x[2][FACE][3];
  char words[512] = "";
  message why;
  pairing p;
  message_start(&why, words, sizeof words);
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < FACE; ++k)
      for (int d = 0; d < 3; ++d)
        x[side][k][d] = LX * (k / (NY + 1)) / NX * e[0][d] + LY * (k % (NY + 1)) / NY * e[1][d] - 0.25 * side * e[2][d];
  patch a = points(1, FACE, x[0]), b = points(101, FACE, x[1]);
  if (pairing_make(&a, &b, 0.3, NULL, &p, &why) != HC_OK) fail_msg("%s", words);
  assert_int_equal(p.n, FACE);
  assert_int_equal(p.from, PAIRING_PLANE);
  CHECK_NEAR(p.area, LX * LY, 1e4 * DBL_EPSILON, "the hull's area");
  for (int k = 0; k < FACE; ++k) {
    const int edges = (k / (NY + 1) % NX == 0) + (k % (NY + 1) % NY == 0);
    CHECK_NEAR(p.pairs[k].area, LX * LY / (NX * NY) / (1 << edges), 1e4 * DBL_EPSILON, "node %d", k);
    for (int d = 0; d < 3; ++d) CHECK_NEAR(p.pairs[k].normal[d], -e[2][d], 1e3 * DBL_EPSILON, "axis %d", d);
  }
  free(a.v), free(b.v), free(p.pairs);
}

/* ---- in a case ---- */

/* Nodes 1..4 below nodes 5..8 as DOFs; what is appended starts on line 7, structure.mesh is the file of make_case. */
#define CASE                                                                                                           \
  "structure:\n  mass: [1, 1, 1, 1, 1, 1]\n  stiffness: [1, 1, 1, 1, 1, 1]\n  damping: {modal: 0.01}\n"                \
  "  nodes: [[1, 3, x], [2, 3, y], [3, 3, z], [4, 7, x], [5, 7, y], [6, 7, z]]\n  mesh: %s\n" SWEEP "%s"
#define CUBES                                                                                                          \
  "*NODE\n1,0,0,0\n2,2,0,0\n3,2,2,0\n4,0,2,0\n5,0,0,0\n6,2,0,0\n7,2,2,0\n8,0,2,0\n11,0,0,-1\n12,2,0,-1\n13,2,2,-1\n"   \
  "14,0,2,-1\n15,0,0,1\n16,2,0,1\n17,2,2,1\n18,0,2,1\n*ELEMENT, TYPE=C3D8\n1, 11,12,13,14,1,2,3,4\n"                   \
  "2, 5,6,7,8,15,16,17,18\n*NSET, NSET=LOW\n1, 2, 3, 4\n*NSET, NSET=UP\n5, 6, 7, 8\n*NSET, NSET=ONE\n3\n"              \
  "*NSET, NSET=NONE\n*SURFACE, NAME=L\n1, S2\n*SURFACE, NAME=ONCE, TYPE=NODE\n7\n"

static own_file cubes;

static void no_pairs(const mistake *m)
{
  char text[8192], more[4096], start[128];
  snprintf(more, sizeof more,
           "contacts:\n  - {pairs: %s, tangential_stiffness: 20, normal_stiffness: 30, friction: 0.3}\n", m->text);
  snprintf(text, sizeof text, CASE, cubes.path, more);
  snprintf(start, sizeof start, "f:%s", m->at);
  refused(text, NULL, start, m->words);
}

static void in_a_case(CHECK_STATE)
{
  char text[1024];
  cubes = write_file("m.inp", CUBES, strlen(CUBES));
  each_mistake("pairs by position", 13, no_pairs);
  snprintf(text, sizeof text, CASE, "none.inp", "");
  refused(text, NULL, "f:6:9: ", "structure.mesh: none.inp cannot be opened: ");
  remove_file(&cubes);
}

/* All nodes of the face have DOFs: by position and by rows of pairs the same contacts come out, of area 4/4 each. */
static void by_position_as_by_rows(CHECK_STATE)
{
  static const struct {
    const char *pairs, *axes, *rows_axes;
  } all[] = {
      {"[LOW, UP]", "", ""},
      {"[L, up]", ", axes: {tangent: [1, 0, 0]}", ""},
      {"[LOW, UP]", ", axes: {tangent: [0.6, 0, 0.8], tangent_2: none}", ", tangent_2: none"},
      {"[L, UP]", ", axes: {normal: [0, 0, 1]}", ""},
      {"[%s, UP]", ", axes: {normal: [0, 0, 1], tangent: [1, 0, 0]}", ""},
  };
  static const char csv[] = "node,x,y,z\n1,0,0,0\n2,2,0,0\n3,2,2,0\n4,0,2,0\n";
  const own_file f = write_file("m.inp", CUBES, strlen(CUBES)), g = write_file("n.csv", csv, strlen(csv));
  char head[2048] = "structure:\n  mass: [1", text[4096], sides[256];
  for (int i = 1; i < 24; ++i) strcat(head, ", 1");
  strcat(head, "]\n  stiffness: [1");
  for (int i = 1; i < 24; ++i) strcat(head, ", 1");
  strcat(head, "]\n  damping: {modal: 0.01}\n  nodes: [");
  for (int i = 0; i < 24; ++i)
    snprintf(head + strlen(head), 32, "%s[%d, %d, %c]", i > 0 ? ", " : "", i + 1, i / 3 + 1, "xyz"[i % 3]);
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    scene found, rows;
    snprintf(sides, sizeof sides, all[i].pairs[1] == '%' ? "[%s, UP]" : "%s",
             all[i].pairs[1] == '%' ? g.path : all[i].pairs);
    snprintf(text, sizeof text,
             "%s]\n  mesh: %s\n" SWEEP "contacts: [{name: face, pairs: {between: %s, within: 0.1}%s, friction: 0.3,"
             " tangential_stiffness: 20, normal_stiffness: 30}]\n",
             head, f.path, sides, all[i].axes);
    accepted(text, NULL, &found);
    snprintf(text, sizeof text,
             "%s]\n" SWEEP
             "contacts: [{name: face, pairs: %s, axes: {normal: [0, 0, 1], tangent: [1, 0, 0]%s}, friction: 0.3,"
             " tangential_stiffness: 20, normal_stiffness: 30}]\n",
             head, "[[1, 5], [2, 6], [3, 7], [4, 8]]", all[i].rows_axes);
    accepted(text, NULL, &rows);
    assert_int_equal(found.structure->n_contacts, 4);
    for (int j = 0; j < 4; ++j) {
      const structure_contact *a = &found.structure->contacts[j], *b = &rows.structure->contacts[j];
      assert_string_equal(a->given.name, b->given.name);
      CHECK_NEAR(a->given.law.kt, 20, 1e3 * DBL_EPSILON, "contact %d", j);
      CHECK_NEAR(a->given.law.kn, 30, 1e3 * DBL_EPSILON, "contact %d", j);
      CHECK_LE(distance_2(24, a->tangent, b->tangent), 8 * DBL_EPSILON, "contact %d", j);
      CHECK_LE(distance_2(24, a->tangent_2, b->tangent_2), 8 * DBL_EPSILON, "contact %d", j);
      CHECK_LE(distance_2(24, a->normal, b->normal), 8 * DBL_EPSILON, "contact %d", j);
    }
    char *echo = echoed(&found, HC_OK);
    snprintf(text, sizeof text, "# 4 pairs between %.*s", (int)strcspn(sides + 1, ","), sides + 1);
    if (!strstr(echo, text) || !strstr(echo, "area 4 in all")) fail_msg("no `%s` in\n%s", text, echo);
    free(echo);
    case_clear(&found), case_clear(&rows);
  }
  remove_file(&f), remove_file(&g);
}

/* All contacts of an entry are set by its name, their stiffnesses per area; one alone as it is. */
static void an_entry_is_set_at_once(CHECK_STATE)
{
  const own_file f = write_file("m.inp", CUBES, strlen(CUBES));
  char text[4096];
  scene sc;
  snprintf(text, sizeof text, CASE, f.path,
           "contacts:\n  - {name: face, pairs: {between: [ONE, ONCE], within: 0.1}, axes: {normal: [0, 0, 1]},\n"
           "     tangential_stiffness: 20, normal_stiffness: 30, friction: 0.3}\n");
  refused(text, NULL, "f:9:35: ", "node 3 has no area");
  snprintf(text, sizeof text, CASE, f.path,
           "contacts:\n  - {name: face, pairs: [[node_a, node_b, area], [3, 7, 2], [7, ground, 0.5]],\n"
           "     axes: {normal: [0, 0, 1], tangent: [1, 0, 0]},"
           "     tangential_stiffness: 20, normal_stiffness: 30, friction: 0.3}\n");
  accepted(text, "contacts[face].friction=0.2", &sc);
  const structure_contact *c = sc.structure->contacts;
  assert_true(c[0].given.law.mu == 0.2 && c[1].given.law.mu == 0.2 && c[0].given.law.kt == 40);
  case_clear(&sc);
  accepted(text, "contacts[face].tangential_stiffness=100", &sc);
  c = sc.structure->contacts;
  assert_true(c[0].given.law.kt == 200 && c[1].given.law.kt == 50 && c[0].given.law.kn == 60);
  case_clear(&sc);
  accepted(text, "contacts[face].normal_stiffness=100", &sc);
  c = sc.structure->contacts;
  assert_true(c[0].given.law.kn == 200 && c[1].given.law.kn == 50 && c[0].given.law.kt == 40);
  case_clear(&sc);
  accepted(text, "contacts[face-2].tangential_stiffness=100", &sc); /* one by its name: its own */
  c = sc.structure->contacts;
  assert_true(c[0].given.law.kt == 40 && c[1].given.law.kt == 100);
  case_clear(&sc);
  refused(text, "contacts[face].friction=-1", "--set ", "contacts[0].friction");
  refused(text, "contacts[face].name=x", "--set ", "is several contacts, expected a field of them");
  refused(text, "contacts[face]={normal_stiffness: 1, normal: 3}", "--set ", "is several contacts");
  refused(text, "contacts[fac].friction=1", "--set ", "no contact is named `fac`");
  remove_file(&f);
}

/* Responses by node: named so, and after an echo, too; the default one, where a load was given by node. */
static void responses_are_named_by_node(CHECK_STATE)
{
#define NAMES                                                                                                          \
  "structure: {mass: [1, 1], stiffness: [1, 1], damping: {modal: 0.01}, nodes: [[1, 1328, z], [2, 1328, y]]}\n" SWEEP
  static const struct {
    const char *text, *set, *names[3];
  } all[] = {
      {NAMES "response: [{node: 1328, direction: z}, 2, {1: 1, 2: -1}]\n", NULL, {"1328 z", "2", "1-2"}},
      {NAMES "forcing: [{node: 1328, direction: y, amplitude: 1}]\n", NULL, {"1328 y"}},
      {NAMES "forcing: [{dof: 2, amplitude: 1}]\n", NULL, {"2"}},
      {NAMES "forcing: [{node: 1328, direction: y, amplitude: 1}]\n", "forcing[0].dof=1", {"1"}},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    scene sc, again;
    char name[64];
    accepted(all[i].text, all[i].set, &sc);
    char *text = echoed(&sc, HC_OK);
    accepted(text, NULL, &again);
    for (int r = 0; r < structure_response_count(sc.structure); ++r) {
      assert_string_equal(structure_response_name(sc.structure, r, name, sizeof name), all[i].names[r]);
      assert_string_equal(structure_response_name(again.structure, r, name, sizeof name), all[i].names[r]);
    }
    free(text);
    case_clear(&sc), case_clear(&again);
  }
}

CHECK_TESTS("structure.pairing", 60, flat_faces_pair, faces_are_outside, normals_of_a_cylinder, faces_of_all_elements,
            sets_and_includes, mistakes_in_a_mesh, what_does_not_match, a_plane_through_nodes_alone,
            by_position_as_by_rows, in_a_case, an_entry_is_set_at_once, responses_are_named_by_node)
