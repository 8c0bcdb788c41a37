/* case_describe.c - the table of fields as text for a terminal of 100 columns. */
#include <math.h>
#include <string.h>

#include "model/casefile/case_reader.h"
#include "model/casefile/case_values.h"
#include "numerics/base/constants.h"

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

/* The length of a section's name without the brackets of a list: forcing[] is forcing, too. */
static int stem_length(const char *section) { return (int)strcspn(section, "["); }

static hc_status unknown_field(const char *asked, case_error *err)
{
  message m;
  message_start(&m, err->message, sizeof err->message);
  if (field_was_removed(&m, asked, strlen(asked))) return HC_BAD_INPUT;
  message_add(&m, "no field or section ");
  message_add_quoted(&m, asked, strlen(asked));
  if (!case_suggest(&m, suggest_path(asked, strlen(asked)), NULL, -1))
    message_add(&m, ", expected one such as hbm.samples (without a name, describe lists them)");
  return HC_BAD_INPUT;
}

hc_status case_describe(const char *asked, FILE *to, case_error *err)
{
  err->message[0] = '\0';
  int n = 0;
  const field_section *s;
  for (int i = asked ? 1 : 0; (s = field_section_at(i)) != NULL; ++i) {
    const int stem = stem_length(s->name);
    const bool meant = !asked || !strcmp(s->name, asked) || (!strncmp(s->name, asked, (size_t)stem) && !asked[stem]);
    if (!meant) continue;
    if (n++) putc('\n', to);
    if (*s->name) fprintf(to, "%s: %s\n", s->name, s->meaning);
    for (int k = 0; k < field_count(); ++k)
      if (!strcmp(field_at(k)->section, s->name)) describe_briefly(field_at(k), to);
  }
  bool sections = n > 0;
  for (int i = 0; i < field_count() && !sections; ++i) {
    const field *f = field_at(i);
    if (!case_field_asked(f, asked)) continue;
    if (n++) putc('\n', to);
    char path[FIELD_PATH], text[128];
    fprintf(to, "%s: %s\n", field_path(f, -1, path), f->meaning);
    if (*f->symbol) fprintf(to, "  symbol    %s\n", f->symbol);
    if (*f->unit) fprintf(to, "  unit      [%s]\n", f->unit);
    fprintf(to, "  expected  %s\n  default   ", expected(f, text));
    write_default(f, to);
    const field *rival;
    for (int k = 0; !either_of_two(f) && (rival = field_rival(f, k)) != NULL; ++k)
      fprintf(to, "%s%s.%s", k ? ", " : "\n  instead   ", rival->section, rival->name);
    const char *example = f->fallback && *f->fallback ? f->fallback : f->choices ? f->choices[0] : "VALUE";
    fprintf(to, "\n  set it    --set '%s=%s'\n", field_path(f, 0, path), example);
  }
  if (asked && n == 0) return unknown_field(asked, err);
  return ferror(to) ? HC_IO : HC_OK;
}

/* ---- a case as it was resolved ---- */

case_place case_field_place(const case_places *places, const field *f, int j)
{
  const case_place *at = j >= 0 ? places->contact[j] : places->field;
  const field *rival;
  for (int i = 0; at[field_index(f)].line == 0 && (rival = field_rival(f, i)) != NULL; ++i)
    if (rival->offset == f->offset && at[field_index(rival)].line > 0) return at[field_index(rival)];
  return at[field_index(f)];
}

/* contacts.gap, contacts[].gap and contacts[3].gap are one field; structure.damping.rayleigh[1] is one of its own. */
static bool is_path(const field *f, const char *asked)
{
  const char *open = strchr(asked, '['), *close = open ? strchr(open, ']') : NULL;
  char path[FIELD_PATH], plain[FIELD_PATH];
  int cut = close ? (int)(open - asked) : (int)strlen(asked);
  snprintf(plain, sizeof plain, "%.*s%s", cut, asked, close ? close + 1 : "");
  snprintf(path, sizeof path, "%.*s%s%s", stem_length(f->section), f->section, *f->section ? "." : "", f->name);
  return !strcmp(asked, path) || (!strcmp(plain, path) && (!open || field_is_in_list(f)));
}

bool case_field_asked(const field *f, const char *asked)
{
  if (!asked) return true;
  if (field_find_section(asked, strlen(asked))) return !strcmp(f->section, asked);
  return is_path(f, asked) || !strcmp(f->name, asked) || (*asked && !strcmp(f->symbol, asked));
}

static double ratio(double a, double b) { return b > 0 ? a / b : NAN; }

int case_derive(const scene *sc, case_derived *out)
{
  /* The linear oscillators with all contacts open, and with all closed and sticking. */
  const scene_structure *s = sc->structure;
  const double mass = *s->mass.v, damping = *s->damping.v, stiffness = *s->stiffness.v;
  const double open = sqrt(stiffness / mass), stuck = sqrt(scene_max_stiffness(sc) / mass);
  const case_derived of_oscillator[] = {
      {"omega_open", open, "rad/time", "natural frequency, every contact open"},
      {"omega_stuck", stuck, "rad/time", "natural frequency, every contact stuck"},
      {"frequency_open", open / TWO_PI, "cycles/time", "omega_open / (2 pi)"},
      {"frequency_stuck", stuck / TWO_PI, "cycles/time", "omega_stuck / (2 pi)"},
      {"damping_ratio_open", ratio(damping, 2 * mass * open), "1", "C / (2 M omega_open)"},
      {"damping_ratio_stuck", ratio(damping, 2 * mass * stuck), "1", "C / (2 M omega_stuck)"},
      {"static_deflection", ratio(s->loads->amplitude, stiffness), "length", "F0 / K"}};
  int n = sizeof of_oscillator / sizeof *of_oscillator;
  memcpy(out, of_oscillator, sizeof of_oscillator);
  for (int j = 0; j < s->n_contacts; ++j) {
    const scene_contact *given = &s->contacts[j].given;
    const moving_contact c = scene_moving_contact(given);
    if (given->kind != CONTACT_KINKED) continue;
    const double preload = contact_preload(&c.law) + c.law.load, touches = c.cv[0] != 0 ? 0 - c.law.gap / c.cv[0] : NAN;
    const case_derived of_contact[] = {
        {"preload", preload, "force", "N0 = kn gap, at rest; 0 with a clearance"},
        {"friction_limit", c.law.mu * preload, "force", "mu N0, at rest"},
        {"touches_at", touches, "length", "x beyond which it touches, -gap / sin(alpha)"}};
    for (size_t i = 0; i < sizeof of_contact / sizeof *of_contact; ++i, ++n) {
      out[n] = of_contact[i];
      snprintf(out[n].name, sizeof out[n].name, "contacts[%d].%.16s", j, of_contact[i].name);
    }
  }
  return n;
}
