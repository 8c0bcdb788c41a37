/* test_mistakes.c - case files of structures that are wrong, each refused with the place where it is. */
#include "tests/cases/structure/structure_text.h"

#define STRUCTURE(body) "structure: {" body "}\n" SWEEP
#define DC              ", stiffness: [1, 1], damping: [0, 0]"

static void in_the_section(CHECK_STATE)
{
  static const mistake all[] = {
      {"structure: 5\n" SWEEP, "f:1:12: ", "structure is a single value, expected a mapping {mass: ..., damping"},
      {STRUCTURE("mass: [1]"),
       "f:1:12: ", "missing key `stiffness` in `structure`, expected a matrix: rows, a diagonal"},
      {STRUCTURE("stiffness: [1], damping: [1]"), "f:1:12: ", "missing key `mass` in `structure`"},
      {STRUCTURE("mass: [1], mass: [1]"), "f:1:24: ", "duplicate key `mass`"},
      {STRUCTURE("mas: [1]"), "f:1:13: ", "unknown key `mas` in `structure`, did you mean `mass`?"},
      {STRUCTURE("modal: 1"), "f:1:13: ", "unknown key `modal` in `structure`"},
      {SMALLEST "structure: {mass: [1]" DC "}\n", "f:4:1: ", "both `oscillator` (line 1) and `structure`"},
      {"structure: {mass: [1], stiffness: [1], damping: [1]}\n" SMALLEST,
       "f:2:1: ", "both `structure` (line 1) and `oscil"},
      {TWO "structure: {}\n", "f:6:1: ", "duplicate key `structure`"},
      {"structure: {mass: [1], stiffness: [1], damping: [1]}\n", "f:1:1: ", "missing section `sweep`"},
      {"forcing: {amplitude: 1}\n" SWEEP, "f:1:1: ",
       "missing section `oscillator`, expected `oscillator: {mass: ..., "
       "damping: ..., stiffness: ...}`, or `structure`"},
      {SMALLEST "response: [1]\n", "f:4:1: ", "`response` is for a structure"},
      {SMALLEST "contacts: [{preload: 1}]\n", "f:4:13: ", "`preload` is for a structure"},
      {SMALLEST "forcing[]: 1\n", "f:4:1: ", "unknown key `forcing[]`"},
      /* matrices */
      {STRUCTURE("mass: {a: 1}"),
       "f:1:19: ", "structure.mass is a mapping, expected rows, a diagonal, or a file of Matrix Market"},
      {STRUCTURE("mass: []"), "f:1:19: ", "structure.mass is a list of 0, expected 1 to 2000"},
      {STRUCTURE("mass: [[1, 2], [3]]"), "f:1:28: ", "structure.mass[1] has 1 entries, expected 2"},
      {STRUCTURE("mass: [[1, 2], 3]"), "f:1:28: ", "structure.mass[1] is a single value, expected a row of 2 numbers"},
      {STRUCTURE("mass: [[1, 2]]"), "f:1:20: ", "structure.mass[0] has 2 entries, expected 1"},
      {STRUCTURE("mass: [1, x]"), "f:1:23: ", "structure.mass[1] is `x`, expected a number"},
      {STRUCTURE("mass: [1, \"2\"]"), "f:1:23: ", "structure.mass[1] is `2`, expected a number (in quotes it is text)"},
      {STRUCTURE("mass: [[1, 0], [0, .nan]]"),
       "f:1:32: ", "structure.mass[1][1] is `.nan`, expected a number (it must be"},
      {STRUCTURE("mass: [1, [2]]"), "f:1:23: ", "structure.mass[1] is a list, expected a number"},
      {STRUCTURE("mass: [[1, 2], [3, 9]]" DC), "f:1:19: ", "not symmetric: entry (2, 1) is 3, but (1, 2) is 2"},
      {STRUCTURE("mass: [[1, 2], [2, 3]]" DC), "f:1:19: ", "not positive definite: its leading minor of order 2"},
      {STRUCTURE("mass: [1, 0]" DC), "f:1:19: ", "not positive definite: its leading minor of order 2"},
      {STRUCTURE("mass: [-1, 1]" DC), "f:1:19: ", "not positive definite: its leading minor of order 1"},
      {STRUCTURE("mass: [1, 1], stiffness: [1], damping: [1, 1]"),
       "f:1:38: ", "structure.stiffness has 1 entries, expected 2"},
      {STRUCTURE("mass: [1, 1], stiffness: [[1]], damping: [1, 1]"),
       "f:1:38: ", "structure.stiffness has 1 rows, expected 2"},
      {STRUCTURE("mass: no.mtx"), "f:1:19: ", "structure.mass: no.mtx cannot be opened: "},
      {STRUCTURE("mass: cases"), "f:1:19: ", "structure.mass: cases is no file, expected a matrix"},
      {STRUCTURE("mass: rom.mat#M"), "f:1:19: ",
       "structure.mass: rom.mat#M is a MATLAB file, which is not read, expected Matrix Market, which MATLAB"},
      {STRUCTURE("mass: ROM.MAT"), "f:1:19: ", "fprintf(f,'%d %d %.17g\\n',[i j v]'); fclose(f)"},
      {STRUCTURE("mass: README.md"), "README.md:1:1: ", "no matrix's first line"},
      /* damping */
      {STRUCTURE("mass: [1, 1], stiffness: [1, 1], damping: {modl: 1}"),
       "f:1:56: ", "structure.damping is a mapping of"},
      {STRUCTURE("mass: [1, 1], stiffness: [1, 1], damping: {}"), "f:1:55: ", "structure.damping is a mapping of"},
      {STRUCTURE("mass: [1, 1], stiffness: [1, 1], damping: {modal: -1}"),
       "f:1:63: ", "is `-1`, expected a number >= 0"},
      {STRUCTURE("mass: [1, 1], stiffness: [1, 1], damping: {modal: [1, 1, 1]}"),
       "f:1:63: ", "has 3 entries, expected one"},
      {STRUCTURE("mass: [1, 1], stiffness: [1, 1], damping: {rayleigh: 1}"),
       "f:1:66: ", "expected two numbers, [ALPHA, BETA]"},
      {STRUCTURE("mass: [1, 1], stiffness: [[1, 2], [0, 1]], damping: {modal: 0}"),
       "f:1:38: ", "is not symmetric, as modal"},
      {STRUCTURE("mass: [1, 1], stiffness: [1, -1], damping: {modal: 0}"), "f:1:64: ", "a mode of structure.mass and"},
      {STRUCTURE("mass: [1, 1], stiffness: [1, 1e10], damping: {rayleigh: [0, 1e300]}"),
       "f:1:69: ", "structure.damping becomes too large to be held"},
      /* names and nodes */
      {STRUCTURE("mass: [1, 1]" DC ", names: [a]"), "f:1:70: ", "structure.names has 1 names, expected 2, one a DOF"},
      {STRUCTURE("mass: [1, 1]" DC ", names: [a, a]"), "f:1:74: ", "name 2 of structure.names is there twice"},
      {STRUCTURE("mass: [1, 1]" DC ", names: [a, 1]"), "f:1:74: ", "name 2 of structure.names is a number"},
      {STRUCTURE("mass: [1, 1]" DC ", names: [a, node]"),
       "f:1:74: ", "name 2 of structure.names is a word of the case"},
      {STRUCTURE("mass: [1, 1]" DC ", names: [a, \"\"]"), "f:1:74: ", "name 2 of structure.names is none"},
      {STRUCTURE("mass: [1, 1]" DC ", nodes: [[1, 2]]"),
       "f:1:71: ", "an entry of structure.nodes, expected [DOF, NODE,"},
      {STRUCTURE("mass: [1, 1]" DC ", nodes: [[3, 2, x]]"), "f:1:72: ", "no DOF `3`, expected a number 1..2"},
      {STRUCTURE("mass: [1, 1]" DC ", nodes: [[1, 2, x], [2, 2, x]]"), "f:1:82: ", "each node and direction once"},
      {STRUCTURE("mass: [1, 1]" DC ", nodes: no.csv"), "f:1:70: ", "structure.nodes: no.csv cannot be opened: "},
      {STRUCTURE("mass: [1, 1]" DC ", nodes: README.md"),
       "README.md:1:1: ", "expected the line `dof,node,direction` first"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) refused(all[i].text, NULL, all[i].at, all[i].words);
}

static void in_loads_contacts_and_responses(CHECK_STATE)
{
  static const mistake all[] = {
      {"forcing: {amplitude: 1}", "7:10: ", "forcing is a mapping, expected a list of loads"},
      {"forcing: [5]", "7:11: ", "forcing[0] is a single value, expected a mapping such as {dof: 1, amplitude: 100}"},
      {"forcing: [{dof: tip}]", "7:11: ", "missing key `amplitude` in `forcing[0]`"},
      {"forcing: [{amplitude: 1}]", "7:11: ", "missing key `dof` in `forcing[0]`"},
      {"forcing: [{dof: 3, amplitude: 1}]", "7:17: ", "no DOF `3`, expected a number 1..2 or one of structure.names"},
      {"forcing: [{dof: 0, amplitude: 1}]", "7:17: ", "no DOF `0`"},
      {"forcing: [{dof: tipp, amplitude: 1}]", "7:17: ", "no DOF `tipp`, did you mean `tip`?"},
      {"forcing: [{dof: [1], amplitude: 1}]", "7:17: ", "a list stands where a DOF should"},
      {"forcing: [{dof: 1, dof: 2, amplitude: 1}]", "7:20: ", "duplicate key `dof`"},
      {"forcing: [{dof: 1, direction: {1: 1}, amplitude: 1}]", "7:11: ", "acts on `dof` and something else"},
      {"forcing: [{direction: {}, amplitude: 1}]",
       "7:23: ", "forcing[0].direction is a direction of zeros, which moves nothing"},
      {"forcing: [{direction: {1: 0}, amplitude: 1}]", "7:23: ", "direction of zeros"},
      {"forcing: [{direction: {1: 1, tip: 2}, amplitude: 1}]", "7:30: ", "gives DOF `tip` twice"},
      {"forcing: [{direction: {1: x}, amplitude: 1}]", "7:27: ", "is `x`, expected a number"},
      {"forcing: [{node: 1, direction: y, amplitude: 1}]", "7:18: ",
       "no DOF of node 1 in direction y, expected one of "
       "structure.nodes, which is not given"},
      {"forcing: [{node: 1, amplitude: 1}]", "7:18: ", "a node without its number or direction"},
      {"forcing: [{dof: 1, amplitude: 1, harmonic: -1}]",
       "7:44: ", "forcing[0].harmonic is `-1`, expected an integer 0..200"},
      {"forcing: [{dof: 1, amplitude: 1, harmonic: 9}]", "7:11: ", "forcing[0] has harmonic 9 and hbm.harmonics is 5"},
      {"forcing: [{dof: 1, amplitude: 1, harmonic: 0, phase_deg: 3}]", "7:11: ", "forcing[0] is a static load"},
      {"forcing: [{direction: {1: 1e10}, amplitude: 1e300}]", "7:11: ", "forcing[0] is too large to be held"},
      {"forcing: [{dof: 1, amplitud: 1}]",
       "7:20: ", "unknown key `amplitud` in `forcing[]`, did you mean `amplitude`?"},
      {"contacts: {}", "7:11: ", "contacts is a mapping, expected a list of contacts"},
      {"contacts: [{}]", "7:12: ", "contacts[0] moves nothing, expected `tangent`, `normal` or both"},
      {"contacts: [{tangential_stiffness: 1, friction: 1, preload: 1}]", "7:12: ", "contacts[0] moves nothing"},
      {"contacts: [{tangential_stiffness: 1, friction: 1, preload: 1, tangent: {1: 0}}]", "7:72: ",
       "contacts[0].tangent is a "
       "direction of zeros"},
      {"contacts: [{friction: 1, preload: 1, tangent: 1}]",
       "7:12: ", "missing key `tangential_stiffness` in `contacts[0]`"},
      {"contacts: [{tangential_stiffness: 1, preload: 1, tangent: 1}]",
       "7:12: ", "missing key `friction` in `contacts[0]`"},
      {"contacts: [{tangential_stiffness: 1, friction: 1, tangent: 1}]", "7:12: ",
       "missing key `preload` in `contacts[0]`, which has a "
       "tangent but no normal"},
      {"contacts: [{normal: 1}]", "7:12: ", "missing key `normal_stiffness` in `contacts[0]`, which has a normal"},
      {"contacts: [{normal_stiffness: 1, friction: 1, normal: 1}]",
       "7:12: ", "contacts[0] has friction, but no tangent"},
      {"contacts: [{tangential_stiffness: 1, friction: 1, preload: 1, gap: 1, tangent: 1}]",
       "7:63: ", "both `preload`"},
      {"contacts: [{normal_stiffness: 1, normal: 1, angle_deg: 0}]", "7:56: ", "an angle is for one DOF"},
      {"contacts: [{name: a, normal_stiffness: 1, normal: 1}, {name: a, normal_stiffness: 1, normal: 2}]",
       "7:55: ", "contacts[1] is named `a` like contacts[0]"},
      {"contacts: [{name: 12, normal_stiffness: 1, normal: 1}]",
       "7:12: ", "contacts[0] is named `12`, expected a name"},
      {"contacts: [{tangent_2: {1: 1}}]", "7:24: ", "tangent_2 in `contacts[0]`, which has no tangent"},
      {"contacts: [{tangential_stiffness: 1, friction: 1, preload: 1, tangent: 1, limit: circle}]",
       "7:82: ", "limit in `contacts[0]`, which has one tangent"},
      {"contacts: [{tangential_stiffness: 1, friction: 1, preload: 1, tangent: 1, tangent_2: 2, limit: round}]",
       "7:96: ", "contacts[0].limit is `round`, expected circle or square"},
      {"contacts: [{tangential_stiffness: 1, friction: 1, preload: 1, tangent: 1, tangent_2: {1: -2}}]",
       "7:12: ", "contacts[0] has tangent_2 along its tangent"},
      {"contacts: [{tangential_stiffness: 1, friction: 1.2e308, preload: 1, tangent: 1, tangent_2: 2}]",
       "7:12: ", "too large a friction"},
      {"contacts: [{pairs: p.csv}]", "7:12: ", "missing key `axes` beside `pairs`"},
      {"response: tip", "7:11: ", "response is a single value, expected a list of DOFs or directions"},
      {"response: []", "7:11: ", "response is an empty list"},
      {"response: [tip, 1]", "7:17: ", "response 2 is response 1 again, expected different ones"},
      {"response: [{tip: 0}]", "7:12: ", "response is a direction of zeros"},
      {"response: [tap]", "7:12: ", "no DOF `tap`, did you mean `tip`?"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    char text[1024], start[32];
    snprintf(text, sizeof text, TWO_NAMED "%s\n", all[i].text);
    snprintf(start, sizeof start, "f:%s", all[i].at);
    refused(text, NULL, start, all[i].words);
  }
}

/* Of a matrix that came from a file: the line there. */
static void in_a_matrix_file(CHECK_STATE)
{
  static const mistake all[] = {
      {"general\n2 2 3\n1 1 1\n2 2 1\n2 1 0.5\n",
       ":5:1: ", "structure.mass is not symmetric: entry (2, 1) is 0.5, but (1, 2) is 0"},
      {"symmetric\n2 2 2\n1 1 1\n2 2 -1\n",
       ":4:1: ", "structure.mass is not positive definite: its leading minor of order 2"},
      {"symmetric\n2 2 1\n1 1 1\n", ":1:1: ", "structure.mass is not positive definite: its leading minor of order 2"},
      {"symmetric\n2 2 2\n1 1 1\n", ":4:1: ", "the file ends after 1 entries, expected 2"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    char mtx[256], text[256], start[256];
    snprintf(mtx, sizeof mtx, "%%%%MatrixMarket matrix coordinate real %s", all[i].text);
    const own_file f = write_file("m.mtx", mtx, strlen(mtx));
    snprintf(text, sizeof text, "structure: {mass: %s" DC "}\n" SWEEP, f.path);
    snprintf(start, sizeof start, "%s%s", f.path, all[i].at);
    refused(text, NULL, start, all[i].words);
    snprintf(text, sizeof text, "structure: {mass: [1, 1, 1], stiffness: %s, damping: [1, 1, 1]}\n" SWEEP, f.path);
    snprintf(start, sizeof start, "%s:2:1: ", f.path);
    refused(text, NULL, start, "a matrix of 2 x 2, expected 3 x 3");
    remove_file(&f);
  }
}

static void in_a_file_of_nodes(CHECK_STATE)
{
  static const mistake all[] = {
      {"", ":1:1: ", "nothing here, expected the line `dof,node,direction`"},
      {"dof,node\n", ":1:1: ", "expected the line `dof,node,direction` first"},
      {"dof,node,direction\n1,17\n", ":2:1: ", "expected three values: dof, node and direction"},
      {"dof,node,direction\n1,17,y,z\n", ":2:1: ", "expected three values"},
      {"dof,node,direction\n1, 17.5,y\n", ":2:4: ", "`17.5` is no node, expected its number"},
      {"dof,node,direction\n3,17,y\n", ":2:1: ", "`3` is no DOF, expected a name or a number 1..2"},
      {"dof,node,direction\n1,17,u\n", ":2:6: ", "`u` is no direction, expected x, y or z"},
      {"dof,node,direction\n1,17,y\n2,17,y\n", ":3:1: ", "node 17 in direction y again, expected it once"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    char text[256], start[256];
    const own_file f = write_file("n.csv", all[i].text, strlen(all[i].text));
    snprintf(text, sizeof text, "structure: {mass: [1, 1]" DC ", nodes: %s}\n" SWEEP, f.path);
    snprintf(start, sizeof start, "%s%s", f.path, all[i].at);
    refused(text, NULL, start, all[i].words);
    remove_file(&f);
  }
}

CHECK_TESTS("structure.mistakes", 60, in_the_section, in_loads_contacts_and_responses, in_a_matrix_file,
            in_a_file_of_nodes)
