/* header.c - see header.h. */
#include "compare/verify/curve_file/header.h"

#include <stdio.h>
#include <string.h>

#include "base/number.h"

enum { PLAIN = 48 };

/* A name without what does not count, and its unit. */
typedef struct plain_name {
  char name[PLAIN], unit[PLAIN];
} plain_name;

typedef enum meaning { MEANS_NOTHING, MEANS_OMEGA, MEANS_CYCLES, MEANS_QUANTITY, MEANS_VALUE } meaning;

static const char *const omegas[] = {"omega", "w",      "om",        "\xCF\x89", "\xCE\xA9", "angularfrequency",
                                     "rad/s", "omegaw", "pulsation", NULL};
static const char *const cycles[] = {"frequency", "freq", "f", "hz", "excitationfrequency", "forcingfrequency", NULL};
static const char *const values[] = {"value", "y", "response", NULL};
static const struct {
  const char *name, *quantity;
} quantities[] = {
    {"amplitude", "amplitude"},
    {"amp", "amplitude"},
    {"a", "amplitude"},
    {"x", "amplitude"},
    {"xamplitude", "amplitude"},
    {"xamp", "amplitude"},
    {"db", "dB"},
    {"x1", "harmonic_1"},
    {"firstharmonic", "harmonic_1"},
    {"fundamental", "harmonic_1"},
    {"xmax", "max"},
    {"xmin", "min"},
    {"xrms", "rms"},
    {"2norm", "norm"},
    {"l2norm", "norm"},
    {"vel", "velocity"},
    {"v", "velocity"},
    {"acc", "acceleration"},
    {"peaktopeak", "double_amplitude"},
    {"p2p", "double_amplitude"},
    {"pp", "double_amplitude"},
};

static char lower(char c) { return (char)(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); }

static plain_name plain_of(const field *f)
{
  plain_name p = {{0}, {0}};
  char *to = p.name, *end = p.name + PLAIN - 1;
  for (size_t i = 0; i < f->length; ++i) {
    const char c = lower(f->text[i]);
    if (c == '[' || c == '(') to = p.unit, end = p.unit + PLAIN - 1;
    else if (to < end && !strchr(" _-|\"])", c) && c) *to++ = c;
  }
  return p;
}

static bool among(const char *const *words, const char *name)
{
  for (; *words; ++words)
    if (!strcmp(*words, name)) return true;
  return false;
}

/* "h3" or "harmonic3", or one of the names that --quantity takes, written as one may. */
static bool quantity_of(const char *name, verify_quantity *out)
{
  char text[PLAIN + 16];
  const size_t digits = strspn(name, "harmonic"), length = strlen(name);
  int k;
  for (size_t i = 0; i < sizeof quantities / sizeof *quantities; ++i)
    if (!strcmp(quantities[i].name, name))
      return verify_quantity_read(quantities[i].quantity, strlen(quantities[i].quantity), out);
  if ((digits == 1 || !strncmp(name, "harmonic", 8)) && name[0] == 'h' && digits < length &&
      number_read_integer(name + digits, length - digits, &k) == NUMBER_FINE) {
    snprintf(text, sizeof text, "harmonic_%s", name + digits);
    return verify_quantity_read(text, strlen(text), out);
  }
  return verify_quantity_read(name, length, out);
}

static meaning meaning_of(const field *f, verify_quantity *q)
{
  const plain_name p = plain_of(f);
  const bool radians = strstr(p.unit, "rad"), hertz = !strcmp(p.unit, "hz") || !strcmp(p.unit, "khz");
  if (among(omegas, p.name)) return hertz ? MEANS_NOTHING : MEANS_OMEGA; /* omega in Hz: which of the two? */
  if (among(cycles, p.name)) return radians ? MEANS_OMEGA : !strcmp(p.unit, "khz") ? MEANS_NOTHING : MEANS_CYCLES;
  if (among(values, p.name)) return MEANS_VALUE;
  if (!(f->length && (verify_quantity_read(f->text, f->length, q) || quantity_of(p.name, q)))) return MEANS_NOTHING;
  q->decibel |= !strcmp(p.unit, "db");
  return MEANS_QUANTITY;
}

static void say_ambiguous(int n, const field *fields, const char *what, int found, message *m)
{
  message_add(m, found ? "more than one column of %s among '" : "no column named like %s among '", what);
  for (int i = 0; i < n && i < 10; ++i) {
    message_add(m, i ? "', '" : "");
    message_add_input(m, fields[i].text, fields[i].length, 24);
  }
  message_add(m, n > 10 ? "', ..., expected --columns omega=1,amplitude=2 (or frequency=, and any of --quantity)"
                        : "', expected --columns omega=1,amplitude=2 (or frequency=, and any of --quantity)");
}

bool header_recognise(int n, const field *fields, bool quantity_given, verify_columns *columns, message *m)
{
  const verify_quantity wanted = columns->quantity;
  int of_omega = 0, of_cycles = 0, of_value = 0, of_unnamed = 0, omega = 0, cycle = 0, value = 0, unnamed = 0;
  for (int i = 0; i < n; ++i) {
    verify_quantity q = {0};
    switch (meaning_of(&fields[i], &q)) {
    case MEANS_OMEGA: ++of_omega, omega = i + 1; break;
    case MEANS_CYCLES: ++of_cycles, cycle = i + 1; break;
    case MEANS_VALUE: ++of_unnamed, unnamed = i + 1; break;
    case MEANS_QUANTITY:
      if (quantity_given && !verify_quantity_same(&q, &wanted)) break;
      ++of_value, value = i + 1;
      columns->quantity = q;
      break;
    case MEANS_NOTHING: break;
    }
  }
  if (quantity_given && of_value == 0) of_value = of_unnamed, value = unnamed;
  columns->cycles = of_omega == 0;
  columns->omega = (verify_column){.number = of_omega ? omega : cycle};
  columns->value = (verify_column){.number = value};
  const int frequencies = of_omega ? of_omega : of_cycles; /* omega and frequency side by side say the same */
  if (frequencies != 1) say_ambiguous(n, fields, "frequencies", frequencies, m);
  else if (of_value != 1) say_ambiguous(n, fields, "values", of_value, m);
  return frequencies == 1 && of_value == 1;
}
