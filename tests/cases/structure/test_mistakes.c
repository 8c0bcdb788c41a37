/* test_mistakes.c - case files of structures that are wrong, each refused with the place where it is. */
#include "tests/cases/structure/structure_text.h"

#define DC ", stiffness: [1, 1], damping: [0, 0]"

static void as_it_stands(const mistake *m) { refused(m->text, NULL, m->at, m->words); }

static void after_two_named(const mistake *m)
{
  char text[4096], start[128];
  snprintf(text, sizeof text, TWO_NAMED "%s\n", m->text);
  snprintf(start, sizeof start, "f:%s", m->at);
  refused(text, NULL, start, m->words);
}

static void in_the_section(CHECK_STATE) { each_mistake("structures", 70, as_it_stands); }
static void in_loads_contacts_and_responses(CHECK_STATE) { each_mistake("parts of a structure", 45, after_two_named); }

/* For a matrix that came from a file the line there. */
static void of_a_matrix(const mistake *m)
{
  char mtx[4096], text[256], start[256];
  snprintf(mtx, sizeof mtx, "%%%%MatrixMarket matrix coordinate real %s", m->text);
  const own_file f = write_file("m.mtx", mtx, strlen(mtx));
  snprintf(text, sizeof text, "structure: {mass: %s" DC "}\n" SWEEP, f.path);
  snprintf(start, sizeof start, "%s%s", f.path, m->at);
  refused(text, NULL, start, m->words);
  snprintf(text, sizeof text, "structure: {mass: [1, 1, 1], stiffness: %s, damping: [1, 1, 1]}\n" SWEEP, f.path);
  snprintf(start, sizeof start, "%s:2:1: ", f.path);
  refused(text, NULL, start, "a matrix of 2 x 2, expected 3 x 3");
  remove_file(&f);
}

static void of_nodes(const mistake *m)
{
  char text[256], start[256];
  const own_file f = write_file("n.csv", m->text, strlen(m->text));
  snprintf(text, sizeof text, "structure: {mass: [1, 1]" DC ", nodes: %s}\n" SWEEP, f.path);
  snprintf(start, sizeof start, "%s%s", f.path, m->at);
  refused(text, NULL, start, m->words);
  remove_file(&f);
}

static void in_a_matrix_file(CHECK_STATE) { each_mistake("a matrix file", 4, of_a_matrix); }
static void in_a_file_of_nodes(CHECK_STATE) { each_mistake("a file of nodes", 8, of_nodes); }

CHECK_TESTS("structure.mistakes", 60, in_the_section, in_loads_contacts_and_responses, in_a_matrix_file,
            in_a_file_of_nodes)
