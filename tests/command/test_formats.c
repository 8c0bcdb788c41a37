/* test_formats.c - one model in every format of matrices that is read, up to what is printed of it. */
#include "tests/shell.h"

#define AT "cases/formats/"

enum { MODES = 12, MOST = 1 << 16 };

static char out[MOST];

/* What `modes` prints of the chain with two node pairs, its matrices and nodes in those files, 17 digits each. */
static void print_modes(const char *mass, const char *stiffness, const char *nodes)
{
  char line[4096];
  snprintf(
      line, sizeof line,
      "printf '%%s\\n' 'structure: {mass: " AT "%s, stiffness: " AT "%s, nodes: " AT
      "%s, damping: {modal: 0.01}}' 'forcing: [{node: 20, direction: y, amplitude: 300}]' 'contacts:' '  - {pairs: "
      "[[node_a, node_b, area], [12, ground, 2e-6], [31, 20, 4e-6]], axes: {normal: [0, 0, 1], tangent: [1, 0, "
      "0]}, tangential_stiffness: 2e10, normal_stiffness: 2.5e10, friction: 0.3, preload: 40}' 'sweep: {frequency: "
      "[5, 100]}' | %s modes - -q --format csv 2>&1",
      mass, stiffness, nodes, HBMCHECK_COMMAND);
  const int code = shell_read(line, out, sizeof out);
  if (code != 0) fail_msg("%s: %s", mass, out);
}

static void every_format_has_the_same_modes(CHECK_STATE)
{
  static const char *const all[][3] = {
      {"chain.mas", "chain.sti", "chain.dof"},
      {"chain_MASS1.mtx", "chain_STIF1.mtx", "chain_STIF1.mtx"},
      {"chain_MASS1_coordinate.mtx", "chain_STIF1_coordinate.mtx", "chain.dof"},
      {"chain_element.mtx", "chain_element.mtx", "chain_element.mtx"},
  };
  char reference[MOST];
  int rows = 0;
  print_modes("M.mtx", "K.mtx", "chain.dof");
  memcpy(reference, out, sizeof reference);
  for (const char *at = out; (at = strchr(at, '\n')) != NULL; ++at) ++rows;
  assert_true(rows > MODES && strstr(out, "\n12,") != NULL);
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    print_modes(all[i][0], all[i][1], all[i][2]);
    if (strcmp(out, reference) != 0) fail_msg("%s:\n%s\nbut of M.mtx\n%s", all[i][0], out, reference);
  }
}

CHECK_TESTS("command.formats", 60, every_format_has_the_same_modes)
