/* test_memory.c - reading a structure with the n-th allocation failing, for each n: out of memory is said, the scene is
 * left alone, and nothing leaks (that is for the address sanitizer to see). The linker wraps our own allocations. */
#include "tests/cases/structure/structure_text.h"
#include "tests/wrap.h"

static long asked, failing; /* failing = 0: none */

static bool fails(void) { return ++asked == failing; }

WRAP(void *, malloc, (size_t size)) { return fails() ? NULL : __real_malloc(size); }
WRAP(void *, calloc, (size_t count, size_t size)) { return fails() ? NULL : __real_calloc(count, size); }
WRAP(void *, realloc, (void *block, size_t size)) { return fails() ? NULL : __real_realloc(block, size); }
WRAP(char *, strdup, (const char *text)) { return fails() ? NULL : __real_strdup(text); }

static hc_status read_and_build(const char *text, int n_set, const char *const *set, char *words, size_t size)
{
  scene sc, before;
  case_error err = {{0}};
  model *m = NULL;
  memset(&sc, 0x5A, sizeof sc);
  before = sc;
  asked = 0;
  hc_status st = case_parse("f", text, strlen(text), n_set, set, &sc, &err);
  snprintf(words, size, "%s", err.message);
  if (st != HC_OK) {
    assert_memory_equal(&sc, &before, sizeof sc);
    return st;
  }
  st = scene_model(&sc, &m);
  assert_true((st == HC_OK) == (m != NULL));
  model_free(m);
  case_clear(&sc);
  return st;
}

static void each_allocation_may_fail(CHECK_STATE)
{
  static const char mtx[] = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 680\n2 1 -40\n2 2 40\n";
  static const char csv[] = "dof,node,direction\n1,17,x\n2,17,y\n";
  const own_file k = write_file("k.mtx", mtx, sizeof mtx - 1), nodes = write_file("n.csv", csv, sizeof csv - 1);
  static const char *const set[] = {"structure.damping.modal=[0.1, 0.2]",
                                    "structure.names=[a, b]",
                                    "contacts[1]={normal_stiffness: 1, normal: b}",
                                    "structure.mass=[2, 3]",
                                    "forcing[0].dof=b",
                                    "response=[a]"};
  char text[1024], words[512];
  snprintf(text, sizeof text,
           "structure: {mass: %s, stiffness: %s, damping: {modal: 0.01}, names: [tip, root], nodes: %s}\n" SWEEP
           "forcing: [{dof: tip, amplitude: 1}, {node: 17, direction: y, amplitude: 1, harmonic: 0}]\n"
           "contacts: [" JENKINS "]\nresponse: [tip, {tip: 1, root: -1}]\n",
           "[1, 2]", k.path, nodes.path);
  failing = 0;
  assert_int_equal(read_and_build(text, 6, set, words, sizeof words), HC_OK);
  const long all = asked;
  assert_true(all > 40);
  for (long n = 1; n <= all; ++n) {
    failing = n;
    const hc_status st = read_and_build(text, 6, set, words, sizeof words);
    if (st != HC_NO_MEMORY || (*words && !strstr(words, "out of memory")))
      fail_msg("allocation %ld of %ld: status %d, %s", n, all, (int)st, words);
  }
  failing = 0;
  remove_file(&k);
  remove_file(&nodes);
}

CHECK_TESTS("structure.memory", 60, each_allocation_may_fail)
