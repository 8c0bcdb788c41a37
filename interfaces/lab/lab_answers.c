/* lab_answers.c - lab_answers X OMEGAS: puts lab.h's questions to the case on standard input; prints a line a row, 17
 * digits, to hold the module's against. X: 2H+1 coefficients of a solution at the first of OMEGAS, both with commas. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "interfaces/lab/lab.h"

enum { MOST_TEXT = 1 << 16, MOST_NUMBERS = 401, SHOWN = 40, SAMPLES = 64, WRONG_CASE = 2, WRONG_USAGE = 64, BUG = 70 };

typedef struct numbers {
  int n;
  double v[MOST_NUMBERS];
} numbers;

static numbers numbers_of(const char *text)
{
  numbers list = {0};
  for (char *end; *text && list.n < MOST_NUMBERS; text = *end == ',' ? end + 1 : end) {
    list.v[list.n++] = strtod(text, &end);
    if (end == text) exit(WRONG_USAGE);
  }
  return list;
}

static void print(const lab *l, const char *question, int status)
{
  const int columns = lab_columns(l);
  const double *v = lab_values(l);
  printf("%s %d %d %d\n", question, status, lab_rows(l), columns);
  for (int i = 0; i < lab_rows(l); ++i)
    for (int c = 0; c < columns; ++c)
      printf("%.17g%c", v[(size_t)i * (size_t)columns + (size_t)c], c + 1 < columns ? ' ' : '\n');
}

int main(int argc, char **argv)
{
  if (argc != 3) return WRONG_USAGE;
  const numbers X = numbers_of(argv[1]), omegas = numbers_of(argv[2]);
  char *text = calloc(MOST_TEXT + 1, 1);
  lab *l = lab_new();
  int status = text && l ? WRONG_CASE : BUG;
  if (text && l && fread(text, 1, MOST_TEXT, stdin) > 0 && lab_read(l, text) == 0) {
    static const char *const forces[] = {[LAB_EXACT] = "exact", [LAB_SAMPLED] = "sampled"};
    char question[64];
    for (int force = LAB_EXACT; force <= LAB_SAMPLED; ++force) {
      snprintf(question, sizeof question, "curve %s", forces[force]);
      print(l, question, lab_curve(l, force));
      snprintf(question, sizeof question, "specials %s", forces[force]);
      print(l, question, lab_specials(l, force));
      for (int i = 0; i < omegas.n; ++i) {
        snprintf(question, sizeof question, "at %s %d", forces[force], i);
        print(l, question, lab_curve_at(l, force, omegas.v[i]));
      }
    }
    /* About the exact curve that ask_about_curves has asked for. */
    char near[64];
    for (int i = 0; i < omegas.n; ++i) {
      snprintf(near, sizeof near, "near %d", i);
      print(l, near, lab_neighbours_at(l, omegas.v[i]));
    }
    double *to = lab_motion(l, (X.n - 1) / 2);
    if (!to) exit(WRONG_USAGE);
    memcpy(to, X.v, (size_t)X.n * sizeof *to);
    print(l, "signal exact", lab_signal(l, LAB_EXACT, SAMPLES));
    print(l, "signal sampled", lab_signal(l, LAB_SAMPLED, SAMPLES));
    print(l, "spectrum", lab_spectrum(l, SAMPLES, SHOWN));
    print(l, "work", lab_work(l));
    print(l, "errors", lab_errors(l, omegas.v[0]));
    print(l, "transients", lab_transients(l, omegas.n, omegas.v));
    status = 0;
  }
  if (l && status != 0) fprintf(stderr, "%s\n", lab_message(l));
  lab_free(l);
  free(text);
  return status;
}
