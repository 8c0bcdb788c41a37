/* reduced_case.c - see reduced_case.h. */
#include "model/reduce/reduced_case.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "model/casefile/case_values.h"
#include "model/casefile/matrices/text_file.h"
#include "model/casefile/mesh/mesh_file.h"
#include "numerics/base/path.h"

/* ---- which rows ---- */

static void mark(int n, const double *direction, bool *keep)
{
  for (int i = 0; i < n; ++i) keep[i] |= direction[i] != 0;
}

static bool is_elsewhere(const case_source *source, const case_mention *m)
{
  return m->to <= source->from || m->from >= source->to;
}

hc_status reduced_case_rows(const scene_structure *s, const case_source *source, int *n, int **kept)
{
  bool *keep = calloc((size_t)s->n, sizeof *keep), driven = s->n_responses > 0;
  *n = 0;
  *kept = malloc((size_t)s->n * sizeof **kept);
  if (!keep || !*kept) return free(keep), HC_NO_MEMORY;
  for (int i = 0; i < s->n_loads; ++i) mark(s->n, s->loads[i].direction, keep), driven |= s->loads[i].harmonic > 0;
  for (int i = 0; i < s->n_responses; ++i) mark(s->n, s->responses[i].direction, keep);
  for (int j = 0; j < s->n_contacts; ++j) {
    mark(s->n, s->contacts[j].tangent, keep);
    mark(s->n, s->contacts[j].tangent_2, keep);
    mark(s->n, s->contacts[j].normal, keep);
    keep[0] |= s->contacts[j].by_angle;
  }
  for (int i = 0; i < source->n_mentions; ++i) {
    const case_mention *m = &source->mentions[i];
    if (m->dof >= 0 && is_elsewhere(source, m)) keep[m->dof] = true;
  }
  keep[0] |= !driven; /* the response where none is named, structure_model */
  for (int i = 0; i < s->n; ++i)
    if (keep[i]) (*kept)[(*n)++] = i;
  free(keep);
  return HC_OK;
}

/* The row's number among those kept, from 0; -1: it is not. */
static int kept_number(const craig_bampton *cb, int row)
{
  int low = 0, high = cb->n_kept;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (cb->kept[middle] < row) low = middle + 1;
    else high = middle;
  }
  return low < cb->n_kept && cb->kept[low] == row ? low : -1;
}

/* ---- files ---- */

static hc_status open_in(const char *folder, const char *name, FILE **to)
{
  const size_t size = strlen(folder) + strlen(name) + 2;
  char *path = malloc(size);
  if (!path) return HC_NO_MEMORY;
  snprintf(path, size, "%s/%s", folder, name);
  *to = fopen(path, "wb");
  free(path);
  return *to ? HC_OK : HC_IO;
}

static hc_status closed(FILE *to)
{
  const bool failed = ferror(to) != 0;
  return fclose(to) != 0 || failed ? HC_IO : HC_OK;
}

static hc_status write_matrix(const char *folder, const char *name, int n, const double *A)
{
  FILE *to;
  int entries = 0, i, j;
  const hc_status st = open_in(folder, name, &to);
  const bool symmetric = !structure_unsymmetric(n, A, &i, &j);
  if (st != HC_OK) return st;
  for (j = 0; j < n; ++j)
    for (i = symmetric ? j : 0; i < n; ++i) entries += A[(size_t)i + (size_t)n * (size_t)j] != 0;
  fprintf(to, "%%%%MatrixMarket matrix coordinate real %s\n%d %d %d\n", symmetric ? "symmetric" : "general", n, n,
          entries);
  for (j = 0; j < n; ++j)
    for (i = symmetric ? j : 0; i < n; ++i) {
      const double value = A[(size_t)i + (size_t)n * (size_t)j];
      if (value == 0) continue;
      fprintf(to, "%d %d %s\n", i + 1, j + 1, number_write(value, (char[NUMBER_TEXT]){0}));
    }
  return closed(to);
}

static hc_status write_nodes(const char *folder, const scene_structure *s, const craig_bampton *cb)
{
  FILE *to;
  const hc_status st = open_in(folder, "nodes.csv", &to);
  if (st != HC_OK) return st;
  fputs("dof,node,direction\n", to);
  for (int i = 0; i < s->n_nodes; ++i) {
    const int dof = kept_number(cb, s->nodes[i].dof);
    if (dof >= 0) fprintf(to, "%d,%d,%c\n", dof + 1, s->nodes[i].node, s->nodes[i].direction);
  }
  return closed(to);
}

static hc_status copy_file(const char *path, const char *folder, const char *name)
{
  FILE *to;
  char *bytes, words[160];
  size_t length;
  message m;
  message_start(&m, words, sizeof words);
  hc_status st = text_file_read(path, (size_t)1 << 31, &bytes, &length, &m);
  if (st == HC_OK) st = open_in(folder, name, &to);
  if (st == HC_OK) {
    fwrite(bytes, 1, length, to);
    st = closed(to);
  }
  free(bytes);
  return st;
}

/* ---- the case ---- */

/* The structure in place of the large one. */
static void put_structure(const scene *sc, const craig_bampton *cb, int modes, const receptance_error *stated, FILE *to)
{
  const scene_structure *s = sc->structure;
  fputs("{mass: mass.mtx, stiffness: stiffness.mtx, damping: ", to);
  if (s->how == STRUCTURE_DAMPING_MATRIX) fputs("damping.mtx", to);
  else case_write_damping(s, cb->n_kept + modes, to);
  for (int k = 0; k < cb->n_kept && s->names; ++k) {
    fputs(k == 0 ? ", names: [" : ", ", to);
    case_write_text(s->names[cb->kept[k]], to);
  }
  for (int k = 0; k < modes && s->names; ++k) fprintf(to, ", \"inner mode %d\"", k + 1);
  if (s->names) putc(']', to);
  if (s->n_nodes > 0) fputs(", nodes: nodes.csv", to);
  if (s->mesh) fputs(", mesh: mesh.inp", to);
  fputs(", ", to);
  case_write_reduction(stated->error, scene_frequency(sc, stated->omega), to);
  putc('}', to);
}

/* The name that mention i's file has in the folder: its own, or with its number where another one has that. */
static const char *copy_name(const case_source *source, int i, char name[256])
{
  static const char *const taken[] = {"mass.mtx", "stiffness.mtx", "damping.mtx", "nodes.csv", "mesh.inp"};
  const char *own = path_name(source->mentions[i].file, NULL);
  bool alone = true;
  for (size_t k = 0; k < sizeof taken / sizeof *taken; ++k) alone &= strcmp(own, taken[k]) != 0;
  for (int k = 0; k < i; ++k) {
    const char *other = source->mentions[k].file;
    if (other && is_elsewhere(source, &source->mentions[k])) alone &= strcmp(own, path_name(other, NULL)) != 0;
  }
  snprintf(name, 256, alone ? "%.200s" : "%.200s.%d", own, i);
  return name;
}

/* The byte where character k of the text begins, from byte `at` on, where character *now is. */
static size_t byte_of(const case_source *source, size_t k, size_t at, size_t *now)
{
  for (; *now < k && at < source->length; ++*now)
    for (++at; at < source->length && ((unsigned char)source->text[at] & 0xC0) == 0x80;) ++at;
  return at;
}

static int by_place(const void *a, const void *b)
{
  const case_mention *x = a, *y = b;
  return (x->from > y->from) - (x->from < y->from);
}

static hc_status write_case(const char *folder, const char *name, case_source *source, const scene *sc,
                            const craig_bampton *cb, int modes, const receptance_error *stated)
{
  FILE *to;
  char copy[256];
  hc_status st = open_in(folder, name, &to);
  if (st != HC_OK) return st;
  const bool marked = source->length >= 3 && !memcmp(source->text, "\xEF\xBB\xBF", 3);
  size_t at = marked ? 3 : 0, now = 0;
  bool before = true; /* `structure` has not been written */
  if (source->n_mentions > 0) qsort(source->mentions, (size_t)source->n_mentions, sizeof *source->mentions, by_place);
  for (int i = 0; i <= source->n_mentions && st == HC_OK; ++i) {
    const case_mention *m = i < source->n_mentions ? &source->mentions[i] : NULL;
    if (before && (!m || m->from >= source->from)) {
      const size_t from = byte_of(source, source->from, at, &now);
      fwrite(source->text + at, 1, from - at, to);
      put_structure(sc, cb, modes, stated, to);
      at = byte_of(source, source->to, from, &now);
      before = false;
    }
    if (!m || !is_elsewhere(source, m)) continue;
    const size_t from = byte_of(source, m->from, at, &now);
    fwrite(source->text + at, 1, from - at, to);
    at = byte_of(source, m->to, from, &now);
    if (m->file) {
      case_write_text(copy_name(source, i, copy), to);
      st = copy_file(m->file, folder, copy);
    } else fprintf(to, "%d", kept_number(cb, m->dof) + 1);
  }
  fwrite(source->text + at, 1, source->length - at, to);
  const hc_status last = closed(to);
  return st == HC_OK ? last : st;
}

static hc_status copy_mesh(const char *path, const char *folder)
{
  FILE *to;
  char words[160];
  message m;
  message_start(&m, words, sizeof words);
  hc_status st = open_in(folder, "mesh.inp", &to);
  if (st != HC_OK) return st;
  st = mesh_copy(path, to, &m);
  const hc_status end = closed(to);
  return st == HC_OK ? end : st;
}

hc_status reduced_case_write(const char *part, const char *name, case_source *source, const scene *sc,
                             const craig_bampton *cb, int modes, const receptance_error *stated)
{
  scene_structure *small;
  hc_status st = craig_bampton_structure(cb, sc->structure, modes, &small);
  if (st != HC_OK) return st;
  reduced_case_remove(part);
  if (mkdir(part, 0777) != 0) st = HC_IO;
  if (st == HC_OK) st = write_matrix(part, "mass.mtx", small->n, small->mass.v);
  if (st == HC_OK) st = write_matrix(part, "stiffness.mtx", small->n, small->stiffness.v);
  if (st == HC_OK && small->how == STRUCTURE_DAMPING_MATRIX)
    st = write_matrix(part, "damping.mtx", small->n, small->damping.v);
  if (st == HC_OK && sc->structure->n_nodes > 0) st = write_nodes(part, sc->structure, cb);
  if (st == HC_OK && sc->structure->mesh) st = copy_mesh(sc->structure->mesh, part);
  if (st == HC_OK) st = write_case(part, name, source, sc, cb, modes, stated);
  structure_free(small);
  return st;
}

/* ---- folders ---- */

/* Is there a file `name` in the folder? And of all files in the folder `of`: is it in `folder`, too? */
static bool all_are_in(const char *of, const char *folder)
{
  DIR *list = opendir(of);
  bool all = list != NULL;
  for (struct dirent *e; all && (e = readdir(list)) != NULL;) {
    char path[4096];
    struct stat info;
    if (!strcmp(e->d_name, ".") || !strcmp(e->d_name, "..")) continue;
    snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
    all = stat(path, &info) == 0 && S_ISREG(info.st_mode);
  }
  if (list) closedir(list);
  return all;
}

void reduced_case_remove(const char *part)
{
  DIR *list = opendir(part);
  if (!list) return;
  for (struct dirent *e; (e = readdir(list)) != NULL;) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", part, e->d_name);
    unlink(path); /* of . and .. it fails */
  }
  closedir(list);
  rmdir(part);
}

bool reduced_case_place(const char *part, const char *folder)
{
  if (access(folder, F_OK) == 0) {
    if (!all_are_in(folder, part)) {
      errno = EEXIST;
      return false;
    }
    reduced_case_remove(folder);
  }
  return rename(part, folder) == 0;
}
