/* case_describe.c - the table of fields as text for a terminal of 100 columns. */
#include <string.h>

#include "casefile/case_values.h"
#include "casefile/suggest.h"

static const char *expected(const field *f, char text[128])
{
  message m;
  message_start(&m, text, 128);
  field_expected(f, &m);
  return text;
}

static bool either_of_two(const field *f) { return !f->fallback && field_rival(f, 0); }

static void write_default(const field *f, FILE *to)
{
  if (either_of_two(f)) fprintf(to, "required, unless %s is given", field_rival(f, 0)->name);
  else if (!f->fallback) fputs("required", to);
  else if (*f->fallback) fputs(f->fallback, to);
  else fputs(!strcmp(f->name, "title") ? "the file's name" : "none", to);
}

/* Two lines in the list of everything. */
static void describe_briefly(const field *f, FILE *to)
{
  char text[128];
  fprintf(to, "%s%s", *f->section ? "  " : "", f->name);
  if (*f->unit) fprintf(to, " [%s]", f->unit);
  fprintf(to, ": %s; ", expected(f, text));
  fputs(f->fallback ? "default " : "", to);
  write_default(f, to);
  fprintf(to, "\n      %s%s%s\n", *f->symbol ? f->symbol : "", *f->symbol ? ", " : "", f->meaning);
}

static void describe_section(const field_section *s, FILE *to)
{
  if (*s->name) fprintf(to, "%s: %s\n", s->name, s->meaning);
  for (int i = 0; i < field_count(); ++i)
    if (!strcmp(field_at(i)->section, s->name)) describe_briefly(field_at(i), to);
}

static void describe_all(FILE *to)
{
  const field_section *s;
  for (int i = 0; (s = field_section_at(i)) != NULL; ++i) {
    if (i > 0) putc('\n', to);
    describe_section(s, to);
  }
}

/* Everything about one field. */
static void describe_field(const field *f, FILE *to)
{
  char path[FIELD_PATH], text[128];
  fprintf(to, "%s: %s\n", field_path(f, -1, path), f->meaning);
  if (*f->symbol) fprintf(to, "  symbol    %s\n", f->symbol);
  if (*f->unit) fprintf(to, "  unit      [%s]\n", f->unit);
  fprintf(to, "  expected  %s\n  default   ", expected(f, text));
  write_default(f, to);
  const field *rival;
  for (int i = 0; !either_of_two(f) && (rival = field_rival(f, i)) != NULL; ++i)
    fprintf(to, "%s%s.%s", i ? ", " : "\n  instead   ", rival->section, rival->name);
  const char *example = f->fallback && *f->fallback ? f->fallback : f->choices ? f->choices[0] : "VALUE";
  fprintf(to, "\n  set it    --set '%s=%s'\n", field_path(f, 0, path), example);
}

/* The length of a section's name without the brackets of a list: forcing[] is forcing, too. */
static int stem_length(const char *section) { return (int)strcspn(section, "["); }

static hc_status unknown_field(const char *asked, case_error *err)
{
  message m;
  message_start(&m, err->message, sizeof err->message);
  message_add(&m, "no field or section `");
  message_add_input(&m, asked, strlen(asked), 60);
  message_add(&m, "`");
  suggestion s = suggest_path(asked, strlen(asked));
  char path[FIELD_PATH];
  if (s.f) message_add(&m, ", did you mean `%s`?", field_path(s.f, -1, path));
  else if (s.s) message_add(&m, ", did you mean `%s`?", s.s->name);
  else message_add(&m, ", expected one such as hbm.samples (without a name, describe lists them)");
  return HC_BAD_INPUT;
}

hc_status case_describe(const char *asked, FILE *to, case_error *err)
{
  err->message[0] = '\0';
  if (!asked) describe_all(to);
  int n = !asked;
  const field_section *s;
  for (int i = 1; asked && (s = field_section_at(i)) != NULL; ++i) {
    const int stem = stem_length(s->name);
    if (strcmp(s->name, asked) && (strncmp(s->name, asked, (size_t)stem) || asked[stem])) continue;
    if (n++) putc('\n', to);
    describe_section(s, to);
  }
  bool sections = n > 0;
  for (int i = 0; i < field_count() && !sections; ++i) {
    const field *f = field_at(i);
    if (!case_field_asked(f, asked)) continue;
    if (n++) putc('\n', to);
    describe_field(f, to);
  }
  if (n == 0) return unknown_field(asked, err);
  return ferror(to) ? HC_IO : HC_OK;
}
