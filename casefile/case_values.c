/* case_values.c - see case_values.h. */
#include "casefile/case_values.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"

case_place case_field_place(const case_places *places, const field *f, int j)
{
  const case_place *at = j >= 0 ? places->contact[j] : places->field;
  const field *rival;
  for (int i = 0; at[field_index(f)].line == 0 && (rival = field_rival(f, i)) != NULL; ++i)
    if (rival->offset == f->offset && at[field_index(rival)].line > 0) return at[field_index(rival)];
  return at[field_index(f)];
}

/* The length of a section's name without the brackets of a list: forcing[] is forcing, too. */
static int stem_length(const char *section) { return (int)strcspn(section, "["); }

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

typedef struct list {
  case_derived *out;
  int n;
} list;

static void add(list *l, const char *name, double value, const char *unit, const char *meaning)
{
  case_derived *d = &l->out[l->n++];
  *d = (case_derived){.value = value, .unit = unit, .meaning = meaning};
  snprintf(d->name, sizeof d->name, "%s", name);
}

static void add_of_contact(list *l, int j, const char *name, double value, const char *unit, const char *meaning)
{
  char path[40];
  snprintf(path, sizeof path, "contacts[%d].%s", j, name);
  add(l, path, value, unit, meaning);
}

static double ratio(double a, double b) { return b > 0 ? a / b : NAN; }

/* With all contacts open, and with all of them closed and sticking: the two linear oscillators between which the
 * contacts move it. */
static void add_oscillators(list *l, const scene *sc)
{
  const double open = sqrt(sc->stiffness / sc->mass), stuck = sqrt(scene_max_stiffness(sc) / sc->mass);
  add(l, "omega_open", open, "rad/time", "natural frequency, every contact open");
  add(l, "omega_stuck", stuck, "rad/time", "natural frequency, every contact stuck");
  add(l, "frequency_open", open / TWO_PI, "cycles/time", "omega_open / (2 pi)");
  add(l, "frequency_stuck", stuck / TWO_PI, "cycles/time", "omega_stuck / (2 pi)");
  add(l, "damping_ratio_open", ratio(sc->damping, 2 * sc->mass * open), "1", "C / (2 M omega_open)");
  add(l, "damping_ratio_stuck", ratio(sc->damping, 2 * sc->mass * stuck), "1", "C / (2 M omega_stuck)");
  add(l, "static_deflection", ratio(sc->force, sc->stiffness), "length", "F0 / K");
}

static void add_contact(list *l, const scene *sc, int j)
{
  const moving_contact c = scene_moving_contact(&sc->contacts[j]);
  const double preload = contact_preload(&c.law);
  add_of_contact(l, j, "preload", preload, "force", "N0 = kn gap, at rest; 0 with a clearance");
  add_of_contact(l, j, "friction_limit", c.law.mu * preload, "force", "mu N0, at rest");
  add_of_contact(l, j, "touches_at", c.cv[0] > 0 ? 0 - c.law.gap / c.cv[0] : NAN, "length",
                 "x beyond which it touches, -gap / sin(alpha)");
}

int case_derive(const scene *sc, case_derived *out)
{
  list l = {.out = out};
  add_oscillators(&l, sc);
  for (int j = 0; j < sc->n_contacts; ++j) add_contact(&l, sc, j);
  return l.n;
}
