/* test_pairs.c - `pairs`: the contacts that come out, the same ones written out, and every mistake with its place. */
#include "tests/cases/structure/structure_text.h"

/* Two nodes in space and one along z alone; what is appended starts on line 7. */
#define THREE                                                                                                          \
  "structure:\n  mass: [1, 1, 1, 1, 1, 1, 1]\n  stiffness: [1, 1, 1, 1, 1, 1, 1]\n  damping: {modal: 0.01}\n"          \
  "  nodes: [[1, 7, x], [2, 7, y], [3, 7, z], [4, 8, x], [5, 8, y], [6, 8, z], [7, 9, z]]\n" SWEEP
#define AXES "axes: {normal: [0, 0, 1], tangent: [1, 0, 0]}"
#define LAW  "tangential_stiffness: 20, normal_stiffness: 30, friction: 0.3"

/* pairs and a list of contacts are the same model. */
static void same(const char *pairs, const char *written_out)
{
  char a[2048], b[2048];
  snprintf(a, sizeof a, THREE "contacts:\n  - {%s}\n", pairs);
  snprintf(b, sizeof b, THREE "contacts: [%s]\n", written_out);
  model *of_pairs = model_of(a, NULL), *of_list = model_of(b, NULL);
  same_models(of_pairs, of_list);
  model_free(of_pairs);
  model_free(of_list);
}

static void pairs_are_contacts(CHECK_STATE)
{
#define DIRECTIONS(a, b, c, d, e, f)                                                                                   \
  "tangent: {" #a ": 1, " #d ": -1}, tangent_2: {" #b ": 1, " #e ": -1}, normal: {" #c ": 1, " #f ": -1}"
#define GROUND "tangent: {4: 1}, tangent_2: {5: 1}, normal: {6: 1}"
  same("pairs: [[7, 8]], " AXES ", " LAW, "{" LAW ", " DIRECTIONS(1, 2, 3, 4, 5, 6) "}");
  same("pairs: [[7, 8], [8, ground]], " AXES ", " LAW,
       "{" LAW ", " DIRECTIONS(1, 2, 3, 4, 5, 6) "}, {" LAW ", " GROUND "}");
  same("pairs: [[area, node_b, node_a, gap], [0.5, 7, 8, -1], [2, ground, 8, 3]], " AXES ", limit: square, " LAW,
       "{tangential_stiffness: 10, normal_stiffness: 15, friction: 0.3, limit: square, gap: -1, " DIRECTIONS(
           4, 5, 6, 1, 2,
           3) "}, {tangential_stiffness: 40, normal_stiffness: 60, friction: 0.3, limit: square, gap: 3, " GROUND "}");
  same("pairs: [[node_a, node_b, preload], [8, ground, 6]], " AXES ", " LAW, "{" LAW ", preload: 6, " GROUND "}");
  same("pairs: [[8, ground]], preload: 6, axes: {tangent: [0.6, 0.8, 0]}, tangential_stiffness: 20, friction: 0.3",
       "{tangential_stiffness: 20, friction: 0.3, preload: 6, tangent: {4: 0.6, 5: 0.8}}");
  same("pairs: [[9, 8]], axes: {normal: [0, 0, -1]}, normal_stiffness: 30, gap: 2",
       "{normal_stiffness: 30, gap: 2, normal: {7: -1, 6: 1}}");
  same("pairs: [[7, 8]], axes: {normal: [0, 0, 1], tangent: [1, 0, 0], tangent_2: none}, " LAW,
       "{" LAW ", tangent: {1: 1, 4: -1}, normal: {3: 1, 6: -1}}");
  same("pairs: [[8, ground]], axes: {normal: [0, 0, 1], tangent: [1, 0, 0], tangent_2: [0, -1, 0]}, " LAW,
       "{" LAW ", tangent: {4: 1}, tangent_2: {5: -1}, normal: {6: 1}}");
}

static void pairs_have_names_and_places(CHECK_STATE)
{
  scene sc;
  accepted(THREE "contacts:\n  - {pairs: [[7, 8], [8, ground]], name: face, " AXES ", " LAW "}\n"
                 "  - {pairs: [[7, ground], [8, 7]], " AXES ", " LAW "}\n",
           "contacts[face-2].gap=0.25", &sc);
  const structure_contact *c = sc.structure->contacts;
  assert_int_equal(sc.structure->n_contacts, 4);
  assert_string_equal(c[0].given.name, "face-1");
  assert_string_equal(c[1].given.name, "face-2");
  assert_string_equal(c[2].given.name, "7-ground");
  assert_string_equal(c[3].given.name, "8-7");
  assert_true(c[1].given.law.gap == 0.25 && c[0].given.law.gap == 0 && c[3].place.line == 9);
  case_clear(&sc);
}

/* The echo writes them out, and reads back to the same. */
static void pairs_are_echoed_as_contacts(CHECK_STATE)
{
  scene sc;
  accepted(THREE "contacts:\n  - {pairs: [[7, 8], [8, ground]], name: face, " AXES ", " LAW "}\n", NULL, &sc);
  char *text = echoed(&sc, HC_OK);
  assert_null(strstr(text, "pairs"));
  model *a, *b = model_of(text, NULL);
  assert_int_equal(scene_model(&sc, &a), HC_OK);
  same_models(a, b);
  model_free(a), model_free(b);
  free(text);
  case_clear(&sc);
}

static void a_file_of_pairs(CHECK_STATE)
{
  static const mistake all[] = {
      /* place NULL: read */
      {"node_a,node_b,area\n7,8,2\n8,ground,1\n", NULL, NULL},
      {"node_a, node_b\r\n\r\n 7 , 8\r\n", NULL, NULL},
      {"", "1:1: ", "nothing here, expected the line node_a,node_b[,gap][,preload][,area]"},
      {"7,8\n", "1:1: ", "`7`, expected node_a,node_b"},
      {"node_a,nodeb\n7,8\n", "1:8: ", "`nodeb`, expected node_a,node_b"},
      {"node_a,gap\n7,8\n", "1:1: ", "no column node_b"},
      {"node_a,node_b,node_a\n7,8\n", "1:15: ", "`node_a`, expected each column once"},
      {"node_a,node_b\n7,8\n7\n", "3:1: ", "1 values in a row of pairs, expected 2"},
      {"node_a,node_b\n7,8,9\n", "2:1: ", "3 values in a row of pairs, expected 2"},
      {"node_a,node_b\n7,x\n", "2:3: ", "`x`, expected the number of a node, or ground"},
      {"node_a,node_b\nground,7\n", "2:1: ", "`ground`, expected the number of a node"},
      {"node_a,node_b\n7,7\n", "2:1: ", "node 7 against itself"},
      {"node_a,node_b\n7,8\n8,7\n", "3:1: ", "the same two nodes again, expected each pair once"},
      {"node_a,node_b\n7,10\n", "2:3: ", "no DOF of node 10 in direction z, expected one of structure.nodes"},
      {"node_a,node_b\n9,8\n", "2:1: ", "no DOF of node 9 in direction x, expected one of structure.nodes"},
      {"node_a,node_b,area\n7,8,0\n", "2:5: ", "`0`, expected a number > 0, the area"},
      {"node_a,node_b,area\n7,8,1e308\n", "2:1: ", "stiffness becomes too large"},
      {"node_a,node_b,preload\n7,8,-1\n", "2:5: ", "`-1`, expected a number >= 0, the preload"},
      {"node_a,node_b,gap\n7,8,nan\n", "2:5: ", "`nan`, expected a number, the gap"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    const own_file f = write_file("pairs.csv", all[i].text, strlen(all[i].text));
    char text[2048], start[160];
    scene sc;
    snprintf(text, sizeof text, THREE "contacts:\n  - {pairs: %s, " AXES ", " LAW "}\n", f.path);
    snprintf(start, sizeof start, "%s:%s", f.path, all[i].at ? all[i].at : "");
    if (all[i].at) refused(text, NULL, start, all[i].words);
    else accepted(text, NULL, &sc), case_clear(&sc);
    remove_file(&f);
  }
}

static void mistakes_in_an_entry(CHECK_STATE)
{
  static const mistake all[] = {
      {"{pairs: [[7, 8]], " LAW "}", "8:5: ", "missing key `axes` beside `pairs`, expected {normal: [X, Y, Z]"},
      {"{" AXES ", " LAW "}", "8:5: ", "missing key `pairs` beside `axes`, expected a csv file"},
      {"{pairs: [[7, 8]], axes: [1], " LAW "}", "8:29: ", "axes is a list, expected {normal: [X, Y, Z]"},
      {"{pairs: [[7, 8]], axes: {normal: [0, 0, 2], tangent: [1, 0, 0]}, " LAW "}",
       "8:29: ", "axes.normal has the length 2"},
      {"{pairs: [[7, 8]], axes: {normal: [0, 0, 1], tangent: [0.6, 0, 0.8]}, " LAW "}",
       "8:29: ", "axes.tangent is not across axes.normal, their product is 0.8, expected 0"},
      {"{pairs: [[7, 8]], axes: {normal: [0, 1]}, " LAW "}", "8:38: ", "axes.normal is no direction in space"},
      {"{pairs: [[7, 8]], axes: {normal: [0, 1, a]}, " LAW "}", "8:45: ", "axes.normal is `a`, expected a number"},
      {"{pairs: [[7, 8]], axes: {norm: [0, 1, 0]}, " LAW "}",
       "8:30: ", "another key in axes, expected normal, tangent"},
      {"{pairs: [[7, 8]], axes: {tangent: none}, " LAW "}", "8:39: ", "axes.tangent is no direction in space"},
      {"{pairs: [[7, 8]], axes: {tangent_2: none}, " LAW "}", "8:29: ", "axes without a tangent and without a normal"},
      {"{pairs: [[7, 8]], axes: {normal: [1, 0, 0], tangent_2: [0, 1, 0]}, " LAW "}",
       "8:29: ", "axes without a tangent, but with a tangent_2"},
      {"{pairs: [[7, 8]], " AXES ", friction: 0.3, normal_stiffness: 1}",
       "8:5: ", "missing key `tangential_stiffness` beside"},
      {"{pairs: [[7, 8]], axes: {tangent: [1, 0, 0]}, friction: 1, tangential_stiffness: 1}",
       "8:5: ", "missing key `preload` beside `pairs`"},
      {"{pairs: [[7, 8]], axes: {normal: [1, 0, 0]}, friction: 1, normal_stiffness: 1}",
       "8:60: ", "friction beside axes that have no use for it"},
      {"{pairs: [[7, 8]], axes: {normal: [1, 0, 0], tangent: [0, 1, 0], tangent_2: none}, limit: circle, " LAW "}",
       "8:94: ", "limit beside axes that have no use for it"},
      {"{pairs: [[7, 8]], " AXES ", gap: 1, preload: 1, " LAW "}", "8:78: ", "both `gap` (line 8) and `preload`"},
      {"{pairs: [[node_a, node_b, gap], [7, 8, 1]], " AXES ", preload: 1, " LAW "}",
       "8:5: ", "both a gap and a preload"},
      {"{pairs: [[7, 8]], " AXES ", tangent: 1, " LAW "}", "8:70: ", "tangent beside `pairs`, expected `axes`"},
      {"{pairs: [[7, 8]], " AXES ", angle_deg: 1, " LAW "}", "8:70: ", "angle_deg beside `pairs`, expected `axes`"},
      {"{pairs: [[7, 8]], pairs: [[7, 8]], " AXES ", " LAW "}", "8:23: ", "duplicate key `pairs`"},
      {"{pairs: {a: 1}, " AXES ", " LAW "}", "8:13: ", "pairs is a mapping of something else, expected {between"},
      {"{pairs: [], " AXES ", " LAW "}", "8:13: ", "pairs is an empty list"},
      {"{pairs: [7, 8], " AXES ", " LAW "}", "8:14: ", "a single value stands where a row of pairs should"},
      {"{pairs: [[7, 8], [7]], " AXES ", " LAW "}", "8:22: ", "1 values in a row of pairs, expected 2"},
      {"{pairs: [[7, 8], [7, 12]], " AXES ", " LAW "}", "8:26: ", "no DOF of node 12 in direction z"},
      {"{pairs: none.csv, " AXES ", " LAW "}", "8:13: ", "pairs: none.csv cannot be opened: "},
      {"{pairs: [[7, 8]], name: much_too_long_for_any_contact_, " AXES ", " LAW "}", "8:15: ", "a shorter name"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    char text[2048], start[32];
    snprintf(text, sizeof text, THREE "contacts:\n  - %s\n", all[i].text);
    snprintf(start, sizeof start, "f:%s", all[i].at);
    refused(text, NULL, start, all[i].words);
  }
  refused(THREE "contacts: [{pairs: [[7, 8]], " AXES ", " LAW "}]\n", "contacts[0].pairs=[[7, 8]]", "--set ",
          "pairs of a single contact");
  refused(THREE "contacts: [{pairs: [[7, 8]], " AXES ", " LAW "}]\n", "contacts[0]={pairs: [[7, 8]]}", "--set ",
          "pairs of a single contact");
}

CHECK_TESTS("structure.pairs", 60, pairs_are_contacts, pairs_have_names_and_places, pairs_are_echoed_as_contacts,
            a_file_of_pairs, mistakes_in_an_entry)
