/* matlab_variable.c - see matlab_variable.h. What libmatio announces of a variable is looked at before it reads the
 * numbers: a huge one is refused unread. */
#include "casefile/matlab_variable.h"

#include <stdlib.h>
#include <string.h>

#include "base/nearest.h"
#include "casefile/matlab_layout.h"
#include "casefile/text_file.h"

enum { NAMES_TOLD = 12, NAME_TOLD = 63 /* MATLAB's names are not longer */ };

static hc_status no_matlab_file(const char *path, message *m)
{
  char head[20] = {0};
  FILE *from = fopen(path, "rb");
  const size_t length = from ? fread(head, 1, sizeof head - 1, from) : 0;
  if (from) fclose(from);
  message_add(m, "is in no MATLAB file or a damaged one, expected version 4, 5 (-v6, -v7) or 7.3");
  if (length == 0) message_add(m, " (the file is empty)");
  if (strstr(head, "Octave") || !memcmp(head, "\x89HDF", 4)) message_add(m, " (Octave writes one with save -v7)");
  if (!strncmp(head, "%%MatrixMarket", 14)) message_add(m, " (a Matrix Market file is not named .mat)");
  return HC_BAD_INPUT;
}

static bool same_letters(const char *a, const char *b) /* in any case */
{
  for (; *a && *b; ++a, ++b)
    if (*a != *b && ((*a ^ *b) != 0x20 || (*a | 0x20) < 'a' || (*a | 0x20) > 'z')) return false;
  return *a == *b;
}

/* The one meant by a name that is none of names[count], or NULL. */
static const char *near_name(char *const *names, size_t count, const char *name)
{
  const char *best = NULL;
  int least = NEAREST_FAR;
  for (size_t i = 0; i < count; ++i) {
    if (same_letters(names[i], name)) return names[i];
    const int d = nearest_distance(name, strlen(name), names[i]);
    if (d < least) best = names[i], least = d;
  }
  return best;
}

static void tell_names(message *m, char *const *names, size_t count)
{
  message_add(m, count > 0 ? "the file has " : "the file has no variable");
  for (size_t i = 0; i < count && i < NAMES_TOLD; ++i) {
    message_add(m, "%s`", i == 0 ? "" : i + 1 == count ? " and " : ", ");
    message_add_input(m, names[i], strlen(names[i]), NAME_TOLD);
    message_add(m, "`");
  }
  if (count > NAMES_TOLD) message_add(m, " and %zu more", count - NAMES_TOLD);
}

static hc_status missing(char *const *names, size_t count, const char *name, message *m)
{
  const char *near = near_name(names, count, name);
  message_add(m, "is not there: ");
  tell_names(m, names, count);
  message_add(m, ", expected FILE.mat#VARIABLE of these");
  if (!near) return HC_BAD_INPUT;
  message_add(m, ", did you mean `");
  message_add_input(m, near, strlen(near), NAME_TOLD);
  message_add(m, "`?");
  return HC_BAD_INPUT;
}

/* The variable meant: name, or without one the only one there is. */
static hc_status choose(mat_t *mat, const char *name, const char **chosen, message *m)
{
  size_t count = 0;
  char *const *names = Mat_GetDir(mat, &count);
  if (!names) count = 0;
  for (size_t i = 0; i < count; ++i)
    if (!names[i]) return HC_NO_MEMORY;
  if (!name && count == 1) *chosen = names[0];
  for (size_t i = 0; name && i < count; ++i)
    if (!strcmp(names[i], name)) *chosen = names[i];
  if (*chosen) return HC_OK;
  if (name) return missing(names, count, name, m);
  message_add(m, "names no variable: ");
  tell_names(m, names, count);
  message_add(m, ", expected FILE.mat#VARIABLE");
  return HC_BAD_INPUT;
}

static hc_status damaged(message *m)
{
  message_add(m, "cannot be read: libmatio refuses it, expected a MATLAB file without damage");
  return HC_BAD_INPUT;
}

/* The matrix of v, of which the data is yet to be read. */
static hc_status read_matrix(mat_t *mat, matvar_t *v, int expected, int *rows, double **values, message *m)
{
  int n;
  const bool announced =
      Mat_GetVersion(mat) != MAT_FT_MAT4 || v->class_type != MAT_C_SPARSE; /* else: known when read */
  hc_status st = announced ? matlab_matrix_check(v, expected, &n, m) : HC_OK;
  if (st != HC_OK) return st;
  if (Mat_VarReadDataAll(mat, v) != 0) return damaged(m);
  if ((st = matlab_matrix_check(v, expected, &n, m)) != HC_OK) return st;
  if (!(*values = calloc((size_t)n * (size_t)n, sizeof **values))) return HC_NO_MEMORY;
  *rows = n;
  return matlab_matrix_fill(v, n, *values, m);
}

static hc_status read_variable(mat_t *mat, const char *path, const char *name, int expected, int *rows, double **values,
                               message *m)
{
  const char *chosen = NULL;
  hc_status st = HC_OK;
  if (Mat_GetVersion(mat) == MAT_FT_MAT5) st = matlab_layout_check(path, name, m);
  if (st == HC_OK) st = choose(mat, name, &chosen, m);
  if (st != HC_OK) return st;
  matvar_t *v = Mat_VarReadInfo(mat, chosen);
  if (!v) return damaged(m);
  st = read_matrix(mat, v, expected, rows, values, m);
  Mat_VarFree(v);
  return st;
}

hc_status matlab_variable_read(const char *path, const char *variable, int expected, int *rows, double **values,
                               message *m)
{
  *rows = 0;
  *values = NULL;
  mat_t *mat = Mat_Open(path, MAT_ACC_RDONLY);
  if (!mat) return no_matlab_file(path, m);
  const hc_status st = read_variable(mat, path, variable, expected, rows, values, m);
  Mat_Close(mat);
  if (st == HC_OK) return HC_OK;
  free(*values);
  *values = NULL;
  *rows = 0;
  return st;
}
