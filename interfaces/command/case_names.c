/* case_names.c - see case_names.h. */
#include "interfaces/command/case_names.h"

enum { MOST_LISTED = 12 };

/* Response r in full; the column shows its first RESPONSE_NAME - 1 letters. */
static const char *response_name(const cli_common *common, int r, char text[CLI_NAME])
{
  return structure_response_name(common->scene->structure, r, text, CLI_NAME);
}

const char *cli_contact_name(const cli_common *common, int j, char text[CLI_NAME])
{
  const char *name = scene_contact_at(common->scene, j)->name;
  if (*name) snprintf(text, CLI_NAME, "%s", name);
  else snprintf(text, CLI_NAME, "%d", j);
  return text;
}

typedef const char *name_of(const cli_common *common, int i, char text[CLI_NAME]);

static void say_unknown(const cli_common *common, const char *option, const char *asked, int n, name_of *name)
{
  char words[CLI_NAME * 2], one[CLI_NAME];
  message m;
  message_start(&m, words, sizeof words);
  for (int i = 0; i < n && i < MOST_LISTED; ++i) message_add(&m, "%s%s", i ? ", " : "", name(common, i, one));
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
  const int n = structure_response_count(sc->structure);
  char full[CLI_NAME], shown[RESPONSE_NAME];
  for (int r = 0; r < n; ++r) {
    if (!strcmp(response_name(common, r, full), name)) return r;
    snprintf(shown, sizeof shown, "%.*s", RESPONSE_NAME - 1, full);
    if (!strcmp(shown, name)) return r;
  }
  const int spelt = response_spelt(sc->structure, name);
  if (spelt >= 0) return spelt;
  say_unknown(common, "response", name, n, response_name);
  return -1;
}

int cli_keep_response(const cli_common *common, scene *sc, const char *name)
{
  const int r = name ? cli_response_named(common, name) : 0;
  if (r < 0) return EXIT_USAGE;
  if (name) structure_keep_response(sc->structure, r);
  return 0;
}

hc_status cli_response_names(const scene *sc, char (**out)[RESPONSE_NAME])
{
  *out = NULL;
  if (scene_is_oscillator(sc)) return HC_OK;
  const int n = structure_response_count(sc->structure);
  *out = calloc((size_t)n, sizeof **out);
  for (int r = 0; r < n && *out; ++r) structure_response_name(sc->structure, r, (*out)[r], RESPONSE_NAME);
  return *out ? HC_OK : HC_NO_MEMORY;
}

int cli_contact_named(const cli_common *common, const char *name)
{
  const scene *sc = common->scene;
  const int n = scene_contact_count(sc);
  int j = structure_contact_named(sc->structure, name, strlen(name));
  if (j >= 0) return j;
  if (number_read_integer(name, strlen(name), &j) == NUMBER_FINE && j >= 0 && j < n) return j;
  say_unknown(common, "contact", name, n, cli_contact_name);
  return -1;
}

/* The list of that option in the place of the scene's, if it was given. 0, or the exit code after the message. */
static int take_whole_numbers(const cli_common *common, const char *option, const number_list *given, int low, int high,
                              number_list *to)
{
  for (const double *v = given->v; v < given->v + given->n; ++v)
    if (*v != floor(*v) || *v < low || *v > high)
      return cli_failed(common, EXIT_USAGE, "--%s: %g is not a whole number %d..%d", option, *v, low, high);
  if (given->n) *to = *given;
  return 0;
}

int compare_lists(const cli_common *common, const table_lists *lists, scene *sc)
{
  const int code =
      take_whole_numbers(common, "harmonics", &lists->harmonics, 1, HBM_MAX_HARMONICS, &sc->compare.harmonics);
  return code ? code : take_whole_numbers(common, "samples", &lists->samples, 3, 1 << 24, &sc->compare.samples);
}
