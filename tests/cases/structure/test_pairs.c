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

static void in_a_file(const mistake *m)
{
  const own_file f = write_file("pairs.csv", m->text, strlen(m->text));
  char text[2048], start[256];
  scene sc;
  snprintf(text, sizeof text, THREE "contacts:\n  - {pairs: %s, " AXES ", " LAW "}\n", f.path);
  snprintf(start, sizeof start, "%s:%s", f.path, m->at);
  if (strcmp(m->message, "-") != 0) refused(text, NULL, start, m->words);
  else accepted(text, NULL, &sc), case_clear(&sc);
  remove_file(&f);
}

static void in_an_entry(const mistake *m)
{
  char text[4096], start[128];
  snprintf(text, sizeof text, THREE "contacts:\n  - %s\n", m->text);
  snprintf(start, sizeof start, "f:%s", m->at);
  refused(text, NULL, start, m->words);
}

static void a_file_of_pairs(CHECK_STATE) { each_mistake("files of pairs", 19, in_a_file); }

static void mistakes_in_an_entry(CHECK_STATE)
{
  each_mistake("pairs", 27, in_an_entry);
  refused(THREE "contacts: [{pairs: [[7, 8]], " AXES ", " LAW "}]\n", "contacts[0].pairs=[[7, 8]]", "--set ",
          "pairs of a single contact");
  refused(THREE "contacts: [{pairs: [[7, 8]], " AXES ", " LAW "}]\n", "contacts[0]={pairs: [[7, 8]]}", "--set ",
          "pairs of a single contact");
}

CHECK_TESTS("structure.pairs", 60, pairs_are_contacts, pairs_have_names_and_places, pairs_are_echoed_as_contacts,
            a_file_of_pairs, mistakes_in_an_entry)
