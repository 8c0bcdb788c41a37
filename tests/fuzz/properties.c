/* properties.c - see fuzz.h. */
#include <unistd.h>

#include "model/casefile/fields.h"
#include "numerics/base/utf8.h"
#include "tests/fuzz/fuzz.h"

long fuzz_accepted, fuzz_refused;

void must(bool holds, const char *format, ...)
{
  if (holds) return;
  va_list args;
  va_start(args, format);
  fputs("property broken: ", stderr);
  vfprintf(stderr, format, args);
  fputc('\n', stderr);
  va_end(args);
  abort();
}

char *fuzz_string(const uint8_t *data, size_t size)
{
  const uint8_t *nul = size ? memchr(data, 0, size) : NULL;
  size_t length = nul ? (size_t)(nul - data) : size;
  char *text = malloc(length + 1);
  must(text != NULL, "out of memory");
  if (length) memcpy(text, data, length);
  text[length] = '\0';
  return text;
}

/* ---- messages ---- */

static void text_is_clean(const char *text, size_t length)
{
  for (size_t i = 0, n; i < length; i += n) {
    unsigned long code = 0;
    n = utf8_character(text + i, length - i, &code);
    must(n > 0 && !utf8_is_control(code), "byte %zu, 0x%02X, is not UTF-8 or a control character: %s", i,
         (unsigned)(unsigned char)text[i], text);
  }
}

void message_is_clean(const char *words, size_t size)
{
  size_t length = strnlen(words, size);
  must(length > 0 && length < size, "a message of %zu bytes", length);
  text_is_clean(words, length);
}

/* Does a line end behind byte i? */
static bool ends_line(const char *text, size_t length, size_t i, bool yaml)
{
  bool lone = yaml && text[i] == '\r' && !(i + 1 < length && text[i + 1] == '\n');
  return text[i] == '\n' || lone;
}

/* Bytes of line number `line`, from 1, its end among them; -1 past the last one. */
static long line_length(const char *text, size_t length, size_t line, bool yaml)
{
  size_t begin = 0, now = 1;
  for (size_t i = 0; i < length && now < line; ++i)
    if (ends_line(text, length, i, yaml)) begin = i + 1, ++now;
  size_t end = begin;
  while (end < length && !ends_line(text, length, end, yaml)) ++end;
  return now == line ? (long)(end - begin) : -1;
}

void place_is_inside(const char *words, const char *name, const char *text, size_t length, bool yaml)
{
  size_t line = 0, column = 0, n = strlen(name);
  char behind = 0;
  must(!strncmp(words, name, n), "not about %s: %s", name, words);
  must(sscanf(words + n, ":%zu:%zu:%c", &line, &column, &behind) == 3 && behind == ' ', "no place: %s", words);
  long most = line > 0 ? line_length(text, length, line, yaml) : -1;
  must(most >= 0 && column >= 1 && column <= (size_t)most + 1, "a place outside the input (line %zu has %ld bytes): %s",
       line, most, words);
}

bool fuzz_was_read(hc_status st, const char *words, size_t size, const char *text, size_t length)
{
  must(st == HC_OK || st == HC_BAD_INPUT, "status %d: %s", (int)st, words);
  ++*(st == HC_OK ? &fuzz_accepted : &fuzz_refused);
  if (st == HC_OK) {
    must(!*words, "read, with a message: %s", words);
    return true;
  }
  message_is_clean(words, size);
  place_is_inside(words, "f", text, length, false);
  return false;
}

/* ---- scenes ---- */

static void number_is_in_range(const field *f, double x)
{
  if (f->flags & FIELD_AUTO && x == HBM_AUTO) return;
  must(isfinite(x) && x >= f->low && x <= f->high && !(f->flags & FIELD_OPEN && x == f->low),
       "%s.%s = %.17g is outside its range", f->section, f->name, x);
}

static void list_is_in_range(const field *f, const number_list *list)
{
  must(list->n >= 0 && list->n <= NUMBER_LIST_MAX, "%s.%s has %d entries", f->section, f->name, list->n);
  for (int i = 0; i < list->n; ++i) {
    number_is_in_range(f, list->v[i]);
    must(f->kind != FIELD_INTEGERS || list->v[i] == rint(list->v[i]), "%s.%s has %.17g among integers", f->section,
         f->name, list->v[i]);
  }
}

static void choice_is_known(const field *f, int choice)
{
  int n = 0;
  while (f->choices[n]) ++n;
  must(choice >= 0 && choice < n, "%s.%s is choice %d of %d", f->section, f->name, choice, n);
}

static void text_is_one_line(const field *f, const char *text)
{
  size_t length = strnlen(text, f->size);
  must(length < f->size, "%s.%s has no end", f->section, f->name);
  text_is_clean(text, length);
}

static void field_is_in_range(const field *f, const void *base)
{
  const void *at = field_look(f, base);
  switch (f->kind) {
  case FIELD_REAL: number_is_in_range(f, *(const double *)at); return;
  case FIELD_INTEGER: number_is_in_range(f, *(const int *)at); return;
  case FIELD_FLAG:
    must(*(const unsigned char *)at <= 1, "%s.%s is neither true nor false", f->section, f->name);
    return;
  case FIELD_CHOICE: choice_is_known(f, *(const int *)at); return;
  case FIELD_TEXT: text_is_one_line(f, at); return;
  case FIELD_PAIR:
    number_is_in_range(f, ((const double *)at)[0]), number_is_in_range(f, ((const double *)at)[1]);
    return;
  case FIELD_PART: return; /* its values are those of other fields */
  default: list_is_in_range(f, at); return;
  }
}

static void fields_of_contact_are_in_range(const scene_contact *c)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (f->kind != FIELD_PART && f->flags & FIELD_IN_CONTACT && field_is_of_law(f, c)) field_is_in_range(f, c);
  }
}

static void fields_of_load_are_in_range(const structure_load *load)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (f->kind != FIELD_PART && f->flags & FIELD_IN_LOAD) field_is_in_range(f, load);
  }
}

static void vector_is_finite(const double *v, size_t n)
{
  must(v != NULL, "a vector is missing");
  for (size_t i = 0; i < n; ++i) must(isfinite(v[i]), "entry %zu of a vector is %g", i, v[i]);
}

void scene_is_in_range(const scene *sc)
{
  must(!scene_is_oscillator(sc) || scene_contact_count(sc) <= SCENE_MAX_CONTACTS, "%d contacts",
       scene_contact_count(sc));
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (f->flags & FIELD_STRUCTURE || !field_is_of_case(f, sc)) continue;
    if (!(f->flags & FIELD_IN_CONTACT)) field_is_in_range(f, field_base(f, sc));
    for (int j = 0; f->flags & FIELD_IN_CONTACT && scene_is_oscillator(sc) && j < scene_contact_count(sc); ++j)
      if (field_is_of_law(f, &sc->structure->contacts[j].given))
        field_is_in_range(f, &sc->structure->contacts[j].given);
  }
  const hbm_settings *h = &sc->hbm;
  bool both_told = h->harmonics != HBM_AUTO && h->samples != HBM_AUTO;
  must(sc->omega_from != sc->omega_to, "the sweep stands still");
  must(h->force != HBM_FORCE_SAMPLED || !both_told || h->samples >= 2 * h->harmonics + 1, "%d samples for %d harmonics",
       h->samples, h->harmonics);
  must(sc->gate.ranges.ends.n % 2 == 0, "half a range");
  if (sc->structure) {
    const size_t n = (size_t)sc->structure->n;
    must(sc->structure->n >= 1, "%d degrees of freedom", sc->structure->n);
    vector_is_finite(sc->structure->mass.v, n * n);
    vector_is_finite(sc->structure->stiffness.v, n * n);
    vector_is_finite(sc->structure->damping.v, n * n);
    for (int j = 0; j < sc->structure->n_contacts; ++j) {
      fields_of_contact_are_in_range(&sc->structure->contacts[j].given);
      vector_is_finite(sc->structure->contacts[j].tangent, n);
      vector_is_finite(sc->structure->contacts[j].normal, n);
    }
    for (int i = 0; i < sc->structure->n_loads; ++i) {
      fields_of_load_are_in_range(&sc->structure->loads[i]);
      vector_is_finite(sc->structure->loads[i].direction, n);
    }
    for (int i = 0; i < sc->structure->n_responses; ++i) vector_is_finite(sc->structure->responses[i].direction, n);
  }
}

static char *echo(const scene *sc, size_t *length)
{
  char *text = NULL;
  FILE *to = open_memstream(&text, length);
  must(to != NULL && case_echo(sc, to) == HC_OK && fclose(to) == 0, "no echo");
  return text;
}

/* For structures the echoes are compared: they hold all bits, and the scenes only where they are. */
bool scenes_are_same(const scene *a, const scene *b)
{
  size_t of_a = 0, of_b = 0;
  char *text_a = echo(a, &of_a), *text_b = echo(b, &of_b);
  scene own = *a, other = *b;
  bool same = of_a == of_b && !memcmp(text_a, text_b, of_a);
  own.structure = other.structure = NULL;
  same &= !memcmp(&own, &other, sizeof own);
  free(text_a);
  free(text_b);
  return same;
}

void scene_echoes(const scene *sc)
{
  size_t length = 0;
  char *text = echo(sc, &length);
  scene back;
  case_error err;
  hc_status st = case_parse("echo", text, length, 0, NULL, &back, &err);
  must(st == HC_OK, "the echo is refused: %s\n%s", err.message, text);
  must(scenes_are_same(&back, sc), "the echo reads back as something else:\n%s", text);
  case_clear(&back);
  free(text);
}

void scene_mark(scene *sc) { memset(sc, 0x5A, sizeof *sc); }

bool scene_is_marked(const scene *sc)
{
  scene marked;
  scene_mark(&marked);
  return !memcmp(sc, &marked, sizeof marked);
}

/* ---- files ---- */

static char folder[FUZZ_PATH / 2];
static char written[4][FUZZ_PATH];

static void tidy_up(void)
{
  for (size_t i = 0; i < sizeof written / sizeof *written; ++i)
    if (*written[i]) unlink(written[i]);
  rmdir(folder);
}

void fuzz_write(const char *name, const char *text, size_t length, char path[FUZZ_PATH])
{
  if (!*folder) {
    const char *temporary = getenv("TMPDIR"); /* one in memory makes a fuzzer much faster */
    snprintf(folder, sizeof folder, "%.40s/hbmcheck-fuzz-XXXXXX", temporary ? temporary : "/tmp");
    must(mkdtemp(folder) != NULL && atexit(tidy_up) == 0, "no folder for files");
  }
  snprintf(path, FUZZ_PATH, "%.60s/%.60s", folder, name);
  size_t i = 0;
  while (*written[i] && strcmp(written[i], path)) must(++i < sizeof written / sizeof *written, "too many files");
  snprintf(written[i], FUZZ_PATH, "%s", path);
  unlink(path); /* a new file: one that is cut to nothing is flushed to the disk when closed, twenty times as slow */
  FILE *to = fopen(path, "wb");
  must(to != NULL && fwrite(text, 1, length, to) == length && fclose(to) == 0, "%s cannot be written", path);
}
