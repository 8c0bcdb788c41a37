/* case_file.c - from a file to a scene; see case_file.h, and case_reader.h for the steps in between. */
#include "model/casefile/case_file.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "model/casefile/case_reader.h"
#include "numerics/base/path.h"

static hc_status file_failed(case_reader *r, const char *words)
{
  message_add(case_blame(r, (case_place){0}), "%s, expected a %s file", words, r->noun);
  return HC_IO;
}

void case_reader_start(case_reader *r, const char *name, const char *const *set, case_error *err)
{
  memset(r, 0, sizeof *r);
  r->name = name;
  r->noun = "case";
  r->required = "`oscillator`, `forcing` and `sweep`";
  r->set = set;
  r->most_dense = MATRIX_MOST_DENSE;
  message_start(&r->msg, err->message, sizeof err->message);
  field_defaults(&r->sc);
}

static hc_status read_scene(case_reader *r, const char *text, size_t length, int n_set)
{
  hc_status st = yaml_text_load(r, text, length);
  if (st != HC_OK) return st;
  st = yaml_scene_read(r, yaml_document_get_root_node(&r->doc));
  yaml_document_delete(&r->doc);
  for (int k = 1; k <= n_set && st == HC_OK; ++k) st = case_set_apply(r, k);
  if (st == HC_OK) st = case_check(r);
  /* "dir/case2.yaml" is titled "case2". */
  if (st == HC_OK && r->at[field_index(field_named("", "title"))].line == 0) {
    int stem;
    const char *base = path_name(r->name, &stem);
    message m;
    message_start(&m, r->sc.title, SCENE_MAX_TEXT);
    message_add_input(&m, base, (size_t)stem, SCENE_MAX_TEXT);
    memset(r->sc.title + m.used, 0, SCENE_MAX_TEXT - m.used);
  }
  return st;
}

void case_clear(scene *sc)
{
  structure_free(sc->structure);
  sc->structure = NULL;
}

hc_status case_reader_take(case_reader *r, hc_status st, scene *out)
{
  if (st == HC_OK) *out = r->sc;
  else if (r->owns_structure) structure_free(r->sc.structure);
  mesh_free(r->mesh);
  r->mesh = NULL;
  r->sc.structure = NULL;
  r->owns_structure = false;
  return st;
}

hc_status case_parse(const char *name, const char *text, size_t length, int n_set, const char *const *set, scene *out,
                     case_error *err)
{
  case_reader r;
  case_reader_start(&r, name, set, err);
  return case_reader_take(&r, read_scene(&r, text, length, n_set), out);
}

hc_status case_reader_slurp(case_reader *r, char **text, size_t *length)
{
  const bool standard_input = !strcmp(r->name, "<stdin>");
  struct stat info;
  hc_status st = HC_OK;
  *text = NULL;
  FILE *from = standard_input ? stdin : fopen(r->name, "rb");
  if (!from && errno == ENOMEM) return case_out_of_memory(r);
  if (!from) {
    const int error = errno;
    message *m = case_blame(r, (case_place){0});
    message_add(m, "cannot be opened: ");
    message_add_errno(m, error);
    return HC_IO;
  }
  if (fstat(fileno(from), &info) == 0 && S_ISDIR(info.st_mode)) {
    st = file_failed(r, "a directory");
  } else if (!(*text = malloc(CASE_LARGEST + 1))) { /* a byte more than allowed: then it is too large */
    st = case_out_of_memory(r);
  } else {
    *length = fread(*text, 1, CASE_LARGEST + 1, from);
    if (ferror(from)) st = file_failed(r, "cannot be read");
  }
  if (!standard_input) fclose(from);
  return st;
}

hc_status case_read_sparse(const char *path, int n_set, const char *const *set, int most_dense, scene *out,
                           case_source *source, case_error *err)
{
  case_reader r;
  char *text = NULL;
  size_t length = 0;
  case_reader_start(&r, !strcmp(path, "-") ? "<stdin>" : path, set, err);
  r.takes_large = true;
  r.most_dense = most_dense;
  r.source = source;
  if (source) *source = (case_source){0};
  hc_status st = case_reader_slurp(&r, &text, &length);
  if (st == HC_OK) st = read_scene(&r, text, length, n_set);
  if (source) source->text = text, source->length = length;
  else free(text);
  return case_reader_take(&r, st, out);
}

void case_source_free(case_source *source)
{
  for (int i = 0; i < source->n_mentions; ++i) free(source->mentions[i].file);
  free(source->mentions);
  free(source->text);
  *source = (case_source){0};
}

hc_status case_read_placed(const char *path, int n_set, const char *const *set, scene *out, case_places *places,
                           case_error *err)
{
  case_reader r;
  char *text = NULL;
  size_t length = 0;
  case_reader_start(&r, !strcmp(path, "-") ? "<stdin>" : path, set, err);
  hc_status st = case_reader_slurp(&r, &text, &length);
  if (st == HC_OK) st = read_scene(&r, text, length, n_set);
  if (st == HC_OK && places) {
    memcpy(places->field, r.at, sizeof r.at);
    memcpy(places->contact, r.contact_field_at, sizeof r.contact_field_at);
  }
  free(text);
  return case_reader_take(&r, st, out);
}

hc_status case_read(const char *path, int n_set, const char *const *set, scene *out, case_error *err)
{
  return case_read_placed(path, n_set, set, out, NULL, err);
}
