/* fuzz_nodes.c - bytes as a file of nodes: each node and direction once, DOFs in range; or refused. */
#include "model/casefile/structure.h"
#include "numerics/base/message.h"
#include "tests/fuzz/fuzz.h"

enum { DOFS = 3 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  char words[512];
  message m;
  scene_structure *s = structure_new();
  must(s != NULL, "out of memory");
  s->n = DOFS;
  message_start(&m, words, sizeof words);
  const char *text = size ? (const char *)data : "";
  const hc_status st = nodes_file_parse("f", text, size, s, &m);
  fuzz_was_read(st, words, sizeof words, text, size);
  for (int i = 0; i < s->n_nodes; ++i) {
    const structure_node *node = &s->nodes[i];
    must(node->dof >= 0 && node->dof < DOFS && node->direction >= 'x' && node->direction <= 'z', "node %d", i);
    must(structure_node_dof(s, node->node, node->direction) == node->dof, "node %d twice", node->node);
  }
  structure_free(s);
  return 0;
}
