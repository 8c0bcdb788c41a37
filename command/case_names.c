/* case_names.c - see case_names.h. */
#include "command/case_names.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/number.h"
#include "casefile/structure.h"

enum { LONGEST = CLI_NAME, MOST_LISTED = 12 };

/* Response r in full; the column shows its first RESPONSE_NAME - 1 letters. */
static const char *response_name(const scene *sc, int r, char text[LONGEST])
{
  if (!sc->structure) return "x";
  return structure_response_name(sc->structure, r, text, LONGEST);
}

static const char *contact_name(const scene *sc, int j, char text[LONGEST])
{
  const char *name = scene_contact_at(sc, j)->name;
  if (*name) snprintf(text, LONGEST, "%s", name);
  else snprintf(text, LONGEST, "%d", j);
  return text;
}

const char *cli_contact_name(const cli_common *common, int j, char text[CLI_NAME])
{
  return contact_name(common->scene, j, text);
}

typedef const char *name_of(const scene *sc, int i, char text[LONGEST]);

static void say_unknown(const cli_common *common, const char *option, const char *asked, int n, name_of *name)
{
  char words[LONGEST * 2], one[LONGEST];
  message m;
  message_start(&m, words, sizeof words);
  for (int i = 0; i < n && i < MOST_LISTED; ++i) message_add(&m, "%s%s", i ? ", " : "", name(common->scene, i, one));
  if (n > MOST_LISTED) message_add(&m, " and %d more", n - MOST_LISTED);
  cli_message(common, "--%s: the case has no `%s`; expected %s%s", option, asked, n > 1 ? "one of " : "",
              n > 0 ? words : "a case that has some");
}

/* d[n] of `2-1`, `0.5*tip+root`, with the DOFs in any order; false if it is no such sum. */
static bool read_direction(const scene_structure *s, const char *text, double *d)
{
  while (*text) {
    const double sign = *text == '-' ? -1 : 1;
    text += *text == '-' || *text == '+';
    size_t length = strcspn(text, "+-");
    const char *star = memchr(text, '*', length);
    double factor = 1;
    if (star && number_read(text, (size_t)(star - text), &factor) != NUMBER_FINE) return false;
    if (star) length -= (size_t)(star + 1 - text), text = star + 1;
    const int dof = structure_dof(s, text, length);
    if (dof < 0) return false;
    d[dof] += sign * factor;
    text += length;
  }
  return true;
}

/* The response along the direction that `name` spells in another way than the column does; -1 if there is none. */
static int response_spelt(const scene_structure *s, const char *name)
{
  int found = -1;
  double *d = calloc((size_t)s->n, sizeof *d);
  const bool read = d && *name && read_direction(s, name, d);
  for (int r = 0; r < s->n_responses && read && found < 0; ++r)
    if (!memcmp(s->responses[r].direction, d, (size_t)s->n * sizeof *d)) found = r;
  free(d);
  return found;
}

int cli_response_named(const cli_common *common, const char *name)
{
  const scene *sc = common->scene;
  const int n = sc->structure ? structure_response_count(sc->structure) : 1;
  char full[LONGEST], shown[RESPONSE_NAME];
  for (int r = 0; r < n; ++r) {
    if (!strcmp(response_name(sc, r, full), name)) return r;
    snprintf(shown, sizeof shown, "%.*s", RESPONSE_NAME - 1, full);
    if (!strcmp(shown, name)) return r;
  }
  const int spelt = sc->structure ? response_spelt(sc->structure, name) : -1;
  if (spelt >= 0) return spelt;
  say_unknown(common, "response", name, n, response_name);
  return -1;
}

int cli_keep_response(const cli_common *common, scene *sc, const char *name)
{
  const int r = name ? cli_response_named(common, name) : 0;
  if (r < 0) return EXIT_USAGE;
  if (name && sc->structure) structure_keep_response(sc->structure, r);
  return 0;
}

hc_status cli_response_names(const scene *sc, char (**out)[RESPONSE_NAME])
{
  *out = NULL;
  if (!sc->structure) return HC_OK;
  const int n = structure_response_count(sc->structure);
  *out = calloc((size_t)n, sizeof **out);
  for (int r = 0; r < n && *out; ++r) structure_response_name(sc->structure, r, (*out)[r], RESPONSE_NAME);
  return *out ? HC_OK : HC_NO_MEMORY;
}

int cli_contact_named(const cli_common *common, const char *name)
{
  const scene *sc = common->scene;
  const int n = scene_contact_count(sc);
  int j = sc->structure ? structure_contact_named(sc->structure, name, strlen(name)) : -1;
  if (j >= 0) return j;
  if (number_read_integer(name, strlen(name), &j) == NUMBER_FINE && j >= 0 && j < n) return j;
  say_unknown(common, "contact", name, n, contact_name);
  return -1;
}

int compare_lists(const cli_common *common, const table_lists *lists, scene *sc)
{
  static const double most_samples = 1 << 24;
  for (int i = 0; i < lists->harmonics.n; ++i)
    if (lists->harmonics.v[i] != floor(lists->harmonics.v[i]) || lists->harmonics.v[i] > HBM_MAX_HARMONICS)
      return cli_failed(common, EXIT_USAGE, "--harmonics: %g is not a whole number 1..%d", lists->harmonics.v[i],
                        HBM_MAX_HARMONICS);
  for (int i = 0; i < lists->samples.n; ++i)
    if (lists->samples.v[i] != floor(lists->samples.v[i]) || lists->samples.v[i] < 3 ||
        lists->samples.v[i] > most_samples)
      return cli_failed(common, EXIT_USAGE, "--samples: %g is not a whole number 3..%.0f", lists->samples.v[i],
                        most_samples);
  if (lists->harmonics.n) sc->compare.harmonics = lists->harmonics;
  if (lists->samples.n) sc->compare.samples = lists->samples;
  return 0;
}
