/* test_matrix_formats.c - matrices of CalculiX and Abaqus: what is read, and every mistake with its place. */
#include "numerics/base/message.h"
#include "tests/cases/structure/structure_text.h"

enum { WORDS = 512 };

static hc_status parse_part(const char *text, const char *part, int expected, int *n, double **v, matrix_label **labels,
                            char words[WORDS])
{
  message m;
  sparse A;
  message_start(&m, words, WORDS);
  const hc_status st = matrix_file_parse("m", text, strlen(text), part, expected, &A, labels, &m);
  *n = A.n;
  *v = st == HC_OK ? sparse_to_dense(&A) : NULL;
  sparse_free(&A);
  return st;
}

/* text's part is rows[n][n], its rows being labels[n], or no labels where NULL. */
static void reads(const char *text, const char *part, int n, const double *rows, const matrix_label *labels)
{
  double *v;
  int found;
  matrix_label *found_labels;
  char words[WORDS];
  if (parse_part(text, part, 0, &found, &v, &found_labels, words) != HC_OK) fail_msg("%s\ngave `%s`", text, words);
  assert_int_equal(found, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) assert_true(v[i + n * j] == rows[n * i + j]);
  assert_true((found_labels != NULL) == (labels != NULL));
  for (int i = 0; labels && i < n; ++i)
    assert_true(found_labels[i].node == labels[i].node && found_labels[i].dof == labels[i].dof);
  free(v);
  free(found_labels);
}

static void triplets_are_read(CHECK_STATE)
{
  const double sym[] = {1, -2.5, -2.5, 4}, general[] = {1, 2, 3, 4}, diagonal[] = {1, 0, 0, 4};
  reads("         1          1  1.0000000000000e+00\n         1          2 -2.5000000000000e+00\n"
        "         2          2  4.0000000000000E+00\n",
        NULL, 2, sym, NULL);
  reads("1,1,1\r\n2, 1 ,-2.5\r\n2 2 4,\r\n", NULL, 2, sym, NULL);
  reads("** Abaqus\n1 1 1\n\n1 2 2\n2 1 3\n2 2 4", NULL, 2, general, NULL);
  reads("1 1 1\n2 2 4\n", NULL, 2, diagonal, NULL);
}

static void rows_by_node_are_sorted(CHECK_STATE)
{
  const double sym[] = {1, -2.5, 0, -2.5, 4, 5, 0, 5, 9};
  const matrix_label labels[] = {{3, 2}, {7, 1}, {7, 3}};
  reads("7,1, 7,1, 4.0\n7,1, 3,2, -2.5\n3,2,3,2,1\n** a comment\n7 3 7 1 5\n7,3,7,3,9\n", NULL, 3, sym, labels);
  reads("3,2,3,2,1\n3,2,7,1,-2.5\n7,1,3,2,-2.5\n7,1,7,1,4\n7,1,7,3,5\n7,3,7,1,5\n7,3,7,3,9\n", NULL, 3, sym, labels);
}

#define HEADER "**\n** ELEMENT TYPE Z1\n*USER ELEMENT, NODES= 2, LINEAR\n** ELEMENT NODES\n** 5, 9\n1, 2\n2, 3\n"
#define ROWS   " 1.0 ,\n-2.5 , 4.0\n 0, 5, 9,\n"

static void elements_are_read(CHECK_STATE)
{
  const double stiffness[] = {1, -2.5, 0, -2.5, 4, 5, 0, 5, 9}, mass[] = {7},
               five[] = {1, 0, 0, 0, 2, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 2, 0, 0, 0, 1};
  const matrix_label labels[] = {{5, 1}, {5, 2}, {9, 3}};
  reads(HEADER "*MATRIX,TYPE=STIFFNESS\n" ROWS, NULL, 3, stiffness, labels);
  reads(HEADER "*Matrix, type = Stiffness\n" ROWS "*MATRIX,TYPE=VISCOUS DAMPING\n7\n", "STIFFNESS", 3, stiffness,
        labels);
  reads(HEADER "*MATRIX,TYPE=STIFFNESS\n" ROWS "*MATRIX,TYPE=VISCOUS DAMPING\n7\n", "VISCOUSDAMPING", 1, mass, NULL);
  reads(HEADER "*MATRIX,TYPE=STIFFNESS\n" ROWS "**\n*MATRIX,TYPE=MASS\n7\n", "MASS", 1, mass, NULL);
  reads("*MATRIX,TYPE=MASS\n1\n0 1\n0 0 1\n0,0,0,1\n2,0,0,0,\n1\n", "MASS", 5, five, NULL); /* without a header */
}

static void is_refused(const char *text, const char *part, int expected, const char *place, const char *said)
{
  double *v = (double *)text;
  matrix_label *labels = (matrix_label *)text;
  int n = 7;
  char words[WORDS];
  const hc_status st = parse_part(text, part, expected, &n, &v, &labels, words);
  if (st != HC_BAD_INPUT || strncmp(words, place, strlen(place)) != 0 || !strstr(words, said))
    fail_msg("%s\ngave `%s`\nnot  `%s ... %s ...`", text, words, place, said);
  assert_null(v);
  assert_null(labels);
  assert_int_equal(n, 0);
}

static void is_no_matrix(const mistake *m) { is_refused(m->text, NULL, 0, m->at, m->words); }

static void another_file_is_named(CHECK_STATE) { each_mistake("other files", 7, is_no_matrix); }

static void mistakes_in_triplets(CHECK_STATE)
{
  each_mistake("triplets", 15, is_no_matrix);
  is_refused("1 1 1\n2 2 1\n", NULL, 3, "m:2:1: ", "a matrix of 2 x 2 ends here, expected 3 x 3");
}

static void mistakes_in_elements(CHECK_STATE)
{
  each_mistake("elements", 9, is_no_matrix);
  is_refused(HEADER "*MATRIX,TYPE=STIFFNESS\n" ROWS, "MASS", 0, "m:12:1: ", "no *MATRIX,TYPE=MASS in this file");
  is_refused(HEADER "*MATRIX,TYPE=STIFFNESS\n" ROWS, NULL, 4,
             "m:11:1: ", "a matrix of 3 x 3 ends here, expected 4 x 4");
}

/* The line of an entry, which messages about the matrix name. */
static void entries_are_found_again(CHECK_STATE)
{
  static const struct {
    const char *text;
    size_t line, column;
  } all[] = {{"1 1 1\n2 2 1\n1 2 5\n", 3, 1},
             {"5,1,5,1,1\n5,2,5,2,1\n5,2,5,1,5\n", 3, 1},
             {HEADER "*MATRIX,TYPE=MASS\n1\n1, 2\n*MATRIX,TYPE=STIFFNESS\n1\n 3, 4\n", 13, 2}};
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
    for (int flip = 0; flip < 2; ++flip) {
      const own_file f = write_file("m", all[i].text, strlen(all[i].text));
      size_t line, column;
      matrix_file_place(f.path, "STIFFNESS", flip, 1 - flip, &line, &column);
      assert_int_equal(line, all[i].line);
      assert_int_equal(column, all[i].column);
      remove_file(&f);
    }
}

/* ---- whole models ---- */

#define FORMATS SOURCE_DIR "/cases/formats/"

static model *chain(const char *mass, const char *stiffness, const char *nodes)
{
  char text[2048];
  snprintf(text, sizeof text,
           "structure:\n  mass: %s\n  stiffness: %s\n  damping: {modal: 0.01}\n  nodes: %s\n" SWEEP
           "forcing: [{node: 20, direction: y, amplitude: 1}]\nresponse: [{node: 31, direction: z}]\n",
           mass, stiffness, nodes);
  return model_of(text, NULL);
}

static void one_model_in_every_format(CHECK_STATE)
{
  static const char *const all[][3] = {
      {FORMATS "chain.mas", FORMATS "chain.sti", FORMATS "chain.dof"},
      {FORMATS "chain_MASS1.mtx", FORMATS "chain_STIF1.mtx", FORMATS "chain_STIF1.mtx"},
      {FORMATS "chain_MASS1_coordinate.mtx", FORMATS "chain_STIF1_coordinate.mtx", FORMATS "chain.dof"},
      {FORMATS "chain_element.mtx", FORMATS "chain_element.mtx", FORMATS "chain_element.mtx"},
  };
  model *reference = chain(FORMATS "M.mtx", FORMATS "K.mtx", FORMATS "chain.dof");
  assert_int_equal(reference->n, 12);
  assert_true(reference->loads[0].cosine[7] == 1 && reference->responses[11] == 1);
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    model *m = chain(all[i][0], all[i][1], all[i][2]);
    same_models(reference, m);
    model_free(m);
  }
  model_free(reference);
}

/* structure with the files of those texts; refused with the words at `place` of the file that is named. */
static void model_is_refused(const char *mass, const char *stiffness, const char *nodes, const char *file,
                             const char *place, const char *said)
{
  const own_file m = write_file("M", mass, strlen(mass)), k = write_file("K", stiffness, strlen(stiffness)),
                 n = write_file("N", nodes, strlen(nodes));
  char text[1024], start[256];
  snprintf(text, sizeof text, "structure:\n  mass: %s\n  stiffness: %s\n  damping: {modal: 0.01}\n  nodes: %s\n" SWEEP,
           m.path, k.path, n.path);
  snprintf(start, sizeof start, "%s:%s", *file == 'M' ? m.path : *file == 'K' ? k.path : n.path, place);
  refused(text, NULL, start, said);
  remove_file(&m), remove_file(&k), remove_file(&n);
}

static void rows_and_nodes_must_fit(CHECK_STATE)
{
  const char *const mass = "5,1,5,1,1\n9,2,9,2,1\n", *const csv = "dof,node,direction\n";
  model_is_refused(mass, "5,1,5,1,1\n9,1,9,1,1\n", csv, "K",
                   "2:1: ", "row 2 of structure.stiffness is DOF 1 of node 9, but of structure.mass DOF 2 of node 9");
  model_is_refused(mass, mass, "5.1\n9.4\n", "N", "2:1: ", "`9.4`, expected NODE.DIRECTION such as 17.2");
  model_is_refused(mass, mass, "5.1\n5.1\n", "N", "2:1: ", "`5.1` again, expected it once");
  model_is_refused(mass, mass, "5.1\n", "N", "2:1: ", "the file ends after 1 lines, expected 2, one a DOF");
  model_is_refused(mass, mass, "5.1\n5.2\n5.3\n", "N", "3:1: ", "`5.3`, one line too many, expected 2");
  model_is_refused(mass, mass, "5.1\n9.2 1\n", "N", "2:1: ", "`9.2`, expected NODE.DIRECTION");
  model_is_refused(mass, mass, "1 1 1\n2 2 1\n", "N", "1:1: ", "a matrix that does not say which nodes its rows are");
  model_is_refused(mass, mass, "5,1,5,1,1\n", "N", "1:1: ", "a matrix of 1 x 1 ends here, expected 2 x 2");
  model_is_refused("5,1,5,1,1\n9,2,9,2,-1\n", mass, csv, "M", "2:1: ", "structure.mass is not positive definite");
}

CHECK_TESTS("structure.matrix_formats", 60, triplets_are_read, rows_by_node_are_sorted, elements_are_read,
            another_file_is_named, mistakes_in_triplets, mistakes_in_elements, entries_are_found_again,
            one_model_in_every_format, rows_and_nodes_must_fit)
