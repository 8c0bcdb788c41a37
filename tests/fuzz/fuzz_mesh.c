/* fuzz_mesh.c - an input file of CalculiX: finite coordinates; each set or surface a patch of ascending nodes and
 * shares of area >= 0, or refused with a place; of the first two, paired, each node is in one pair at most. */

#include "model/casefile/mesh/pairing.h"
#include "tests/fuzz/fuzz.h"

enum { SETS = 4 };
static const char *const names[SETS] = {"A", "B", "S", "T"};

static void check_patch(const patch *p)
{
  for (int i = 0; i < p->n; ++i) {
    must(i == 0 || p->v[i].node > p->v[i - 1].node, "node %d after %d", p->v[i].node, p->v[i > 0 ? i - 1 : 0].node);
    must(!(p->v[i].area < 0), "node %d has the area %g", p->v[i].node, p->v[i].area);
    for (int d = 0; d < 3; ++d) must(isfinite(p->v[i].x[d]), "node %d", p->v[i].node);
  }
}

static void check_pairs(const patch *a, const patch *b)
{
  char words[512];
  message why;
  pairing p;
  message_start(&why, words, sizeof words);
  const hc_status st = pairing_make(a, b, 1, NULL, &p, &why);
  must(st == HC_OK || st == HC_BAD_INPUT || st == HC_NOT_CONVERGED, "status %d: %s", (int)st, words);
  must((st == HC_BAD_INPUT) == (*words != '\0'), "status %d: %s", (int)st, words);
  for (int i = 0; i < p.n && st == HC_OK; ++i) {
    must(p.pairs[i].area > 0, "pair %d has the area %g", i, p.pairs[i].area);
    for (int k = 0; k < i; ++k)
      must(p.pairs[k].a < p.pairs[i].a && p.pairs[k].b != p.pairs[i].b, "a node in two pairs");
  }
  free(p.pairs);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  char words[512];
  message m;
  mesh *s;
  patch found[SETS] = {{0}};
  message_start(&m, words, sizeof words);
  const char *text = size ? (const char *)data : "";
  const hc_status st = mesh_parse("f", text, size, &s, &m);
  must((st == HC_OK) == (s != NULL), "status %d", (int)st);
  if (!fuzz_was_read(st, words, sizeof words, text, size)) return 0;
  for (int k = 0; k < SETS; ++k) {
    const int set = mesh_find(s, names[k], 1);
    if (set < 0) continue;
    message_start(&m, words, sizeof words);
    const hc_status of = mesh_patch(s, set, &found[k], &m);
    must(of == HC_OK || of == HC_BAD_INPUT, "status %d: %s", (int)of, words);
    if (of == HC_BAD_INPUT) place_is_inside(words, "f", text, size, false);
    else check_patch(&found[k]);
    if (of != HC_OK) found[k].n = 0;
  }
  if (found[0].n > 0 && found[1].n > 0) check_pairs(&found[0], &found[1]);
  for (int k = 0; k < SETS; ++k) free(found[k].v);
  mesh_free(s);
  return 0;
}
