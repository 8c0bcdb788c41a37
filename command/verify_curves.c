/* verify_curves.c - see verify_curves.h. Only what stands behind an @ is read here: the rest of --columns is
 * verify_columns_read's to judge. */
#include "command/verify_curves.h"

#include <stdio.h>
#include <string.h>

#include "casefile/structure_model.h"
#include "command/case_names.h"

/* NAME=COLUMN or NAME@RESPONSE=COLUMN of the list. */
typedef struct entry {
  const char *text;
  size_t length, name; /* of all of it; of NAME alone */
  const char *at;      /* the @, NULL: none */
} entry;

static entry entry_at(const char *text)
{
  entry e = {.text = text, .length = strcspn(text, ",")};
  const size_t equals = strcspn(text, "=,");
  e.at = memchr(text, '@', equals);
  e.name = e.at ? (size_t)(e.at - text) : equals;
  return e;
}

static bool is_frequency(const entry *e)
{
  return (e->name == 5 && !memcmp(e->text, "omega", 5)) || (e->name == 9 && !memcmp(e->text, "frequency", 9));
}

static bool set_response(const cli_common *common, const char *name, verify_curve *out)
{
  const scene *sc = common->scene;
  out->response = name ? cli_response_named(common, name) : 0;
  if (out->response >= 0 && sc->structure)
    structure_response_name(sc->structure, out->response, out->name, sizeof out->name);
  return out->response >= 0;
}

/* The list again with no other values than those of entry `kept`, and that without its @. */
static bool keep_one(const cli_common *common, const char *list, const char *kept, verify_curve *out)
{
  size_t used = 0;
  out->columns[0] = 0;
  for (const char *text = list;; ++text) {
    const entry e = entry_at(text);
    const size_t behind = e.at ? strcspn(e.at, "=,") : 0;
    const bool wanted = is_frequency(&e) || text == kept;
    if (wanted && used + e.length + 2 > sizeof out->columns) return false;
    if (wanted) {
      const char *rest = e.at ? e.at + behind : e.text + e.name;
      used += (size_t)snprintf(out->columns + used, sizeof out->columns - used, "%s%.*s%.*s", used ? "," : "",
                               (int)e.name, e.text, (int)(e.length - (size_t)(rest - e.text)), rest);
    }
    if (text == kept && e.at) {
      char name[CLI_NAME];
      snprintf(name, sizeof name, "%.*s", (int)(behind - 1), e.at + 1);
      if (!set_response(common, name, out)) return false;
    }
    text += e.length;
    if (!*text) return true;
  }
}

/* One curve for each entry with an @. -1 after a message. */
static int curves_of_list(const cli_common *common, const verify_asked *asked, verify_curve *out)
{
  int n = 0;
  for (const char *text = asked->columns; text; ++text) {
    const entry e = entry_at(text);
    if (e.at && n == VERIFY_MOST_CURVES)
      return cli_message(common, "--columns: more than %d responses", VERIFY_MOST_CURVES), -1;
    if (e.at && asked->n_responses)
      return cli_message(common, "--columns names a response behind @ and --response another way; give one of them"),
             -1;
    if (e.at && !keep_one(common, asked->columns, text, &out[n++])) return -1;
    text += e.length;
    if (!*text) break;
  }
  return n;
}

int verify_curves_of(const cli_common *common, const verify_asked *asked, verify_curve *out)
{
  memset(out, 0, VERIFY_MOST_CURVES * sizeof *out);
  int n = curves_of_list(common, asked, out);
  if (n != 0) return n < 0 ? 0 : n;
  if (asked->columns && strlen(asked->columns) >= sizeof out->columns)
    return cli_message(common, "--columns: longer than %zu letters", sizeof out->columns - 1), 0;
  n = asked->n_responses ? asked->n_responses : 1;
  for (int i = 0; i < n; ++i) {
    if (!set_response(common, asked->n_responses ? asked->responses[i] : NULL, &out[i])) return 0;
    if (asked->columns) snprintf(out[i].columns, sizeof out->columns, "%s", asked->columns);
  }
  return n;
}
