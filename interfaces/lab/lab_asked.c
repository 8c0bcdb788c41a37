/* lab_asked.c - lab_asked: puts the questions on standard input to the lab, one a line, and prints the table of each:
 * status, rows and columns; a line each of names, kinds and words, tabs between; then a line a row, 17 digits. The
 * module is held against it, and what the page works out from questions.
 *     read BYTES, and on the next line so many bytes     curve FORCE     at FORCE OMEGA     specials FORCE
 *     neighbours     near OMEGA     motion H X[2H+1] (no table)     signal FORCE N     spectrum N SHOWN     work
 *     errors OMEGA     transients N OMEGA[N] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "interfaces/lab/lab.h"

enum { MOST_TEXT = 1 << 16, MOST_OMEGAS = 64, WRONG_USAGE = 64, BUG = 70 };

static double number(void)
{
  char text[40], *end;
  if (scanf("%39s", text) != 1) exit(WRONG_USAGE);
  const double v = strtod(text, &end);
  if (*end) exit(WRONG_USAGE);
  return v;
}

static int integer(void) { return (int)number(); }

static int answer_question(lab *l, const char *question)
{
  if (!strcmp(question, "read")) {
    const int bytes = integer();
    if (bytes < 0 || bytes > MOST_TEXT || getchar() != '\n') exit(WRONG_USAGE);
    char *text = calloc((size_t)bytes + 1, 1);
    if (!text) exit(BUG);
    if (fread(text, 1, (size_t)bytes, stdin) != (size_t)bytes) exit(WRONG_USAGE);
    const int status = lab_read(l, text);
    free(text);
    return status;
  }
  if (!strcmp(question, "motion")) {
    const int n_harm = integer();
    double *X = lab_motion(l, n_harm);
    if (!X) exit(WRONG_USAGE);
    for (int i = 0; i < 2 * n_harm + 1; ++i) X[i] = number();
    return 0;
  }
  if (!strcmp(question, "work")) return lab_work(l);
  if (!strcmp(question, "neighbours")) return lab_neighbours(l);
  const double first = number();
  if (!strcmp(question, "specials")) return lab_specials(l, (int)first);
  if (!strcmp(question, "transients")) {
    double omega[MOST_OMEGAS];
    if (first > MOST_OMEGAS) exit(WRONG_USAGE);
    for (int i = 0; i < first; ++i) omega[i] = number();
    return lab_transients(l, (int)first, omega);
  }
  if (!strcmp(question, "curve")) return lab_curve(l, (int)first);
  if (!strcmp(question, "errors")) return lab_errors(l, first);
  if (!strcmp(question, "near")) return lab_neighbours_at(l, first);
  const double second = number();
  if (!strcmp(question, "at")) return lab_curve_at(l, (int)first, second);
  if (!strcmp(question, "signal")) return lab_signal(l, (int)first, (int)second);
  if (!strcmp(question, "spectrum")) return lab_spectrum(l, (int)first, (int)second);
  exit(WRONG_USAGE);
}

static void print_texts(const lab *l, const char *text_of(const lab *l, int i))
{
  for (int i = 0; text_of(l, i); ++i) printf("%s%s", i ? "\t" : "", text_of(l, i));
  putchar('\n');
}

static void print_table(const lab *l, int status)
{
  const int columns = lab_columns(l);
  const double *v = lab_values(l);
  printf("%d %d %d\n", status, lab_rows(l), columns);
  print_texts(l, lab_name);
  print_texts(l, lab_kind);
  print_texts(l, lab_word);
  for (int i = 0; i < lab_rows(l); ++i)
    for (int c = 0; c < columns; ++c)
      printf("%.17g%c", v[(size_t)i * (size_t)columns + (size_t)c], c + 1 < columns ? ' ' : '\n');
}

int main(void)
{
  char question[16];
  lab *l = lab_new();
  if (!l) return BUG;
  while (scanf("%15s", question) == 1) {
    const int status = answer_question(l, question);
    if (strcmp(question, "motion") != 0) print_table(l, status);
  }
  lab_free(l);
  return 0;
}
