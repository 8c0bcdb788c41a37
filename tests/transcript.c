/* transcript.c - runs a transcript, which holds command lines and what each must end with and say:
 *     test_transcript FILE
 * A line of FILE is, by what it begins with,
 *     == NAME    the beginning of a test; what stands before the first one sh is told before every command
 *     # ...      a comment, as is an empty line
 *     ? COMMAND  a condition: where it fails the rest of the test is skipped; before the first test, all of them
 *     $ COMMAND  a command for sh, in the source folder; hbmcheck, by its path $H, is the built one, $D a folder
 *     > ...      one more line of it
 *     CODE TEXT  the exit code that it must have, and a text it must say, in which \n is the end of a line
 *     + TEXT     one more such text
 *     - TEXT     a text that it must not say
 *     ~ WITHIN VALUE TEXT  behind this text it must say a number as near as that to the value; * is any cell of csv
 * The tests run in their order; the folder $D, empty at first, is of all of them. */
#include <stdbool.h>

#include "tests/folder.h"
#include "tests/shell.h"

#define BEGINS "== "
enum { MOST_TESTS = 64, LINE = 1 << 13 };

static char prologue[LINE], condition[LINE];
static char out[1 << 20]; /* what the last command said */

/* The line at *rest, zero-terminated, with *rest behind it; NULL: there is none. */
static char *next_line(char **rest)
{
  char *line = *rest, *end = line ? strchr(line, '\n') : NULL;
  *rest = end ? end + 1 : NULL;
  if (end) *end = 0;
  return line;
}

/* The text of an expectation, after `skipped` characters and a blank. */
static char *text_behind(char *line, size_t skipped)
{
  char *text = line + skipped, *to = text += *text == ' ';
  for (char *from = text; *from; ++from)
    if (from[0] == '\\' && from[1] == 'n') *to++ = '\n', ++from;
    else *to++ = *from;
  *to = 0;
  return text;
}

/* Behind the first place in `in` where `text` stands, * being any cell of csv; NULL: nowhere. */
static const char *find_behind(const char *in, const char *text)
{
  for (; *in; ++in) {
    const char *at = in;
    for (const char *c = text; at && *c; ++c) at = *c == '*' ? at + strcspn(at, ",\n") : *at == *c ? at + 1 : NULL;
    if (at) return at;
  }
  return NULL;
}

static int tell_sh(const char *command)
{
  char line[2 * LINE];
  snprintf(line, sizeof line, "%s%s", prologue, command);
  return shell_read(line, out, sizeof out);
}

static void add_line(char *to, const char *line)
{
  const size_t n = strlen(to);
  if (snprintf(to + n, LINE - n, "%s\n", line) >= (int)(LINE - n)) fail_msg("too long: %s", line);
}

/* One test, its lines from **state on. */
static void run_lines(void **state)
{
  char command[LINE] = "", *rest = *state;
  bool judged = true;
  int code = 0;
  if (*condition && tell_sh(condition)) skip();
  for (char *line; (line = next_line(&rest)) && strncmp(line, BEGINS, 3) != 0;) {
    const size_t digits = strspn(line, "0123456789");
    if (*line == '$' || *line == '?') {
      if (!judged) fail_msg("nothing is expected of: %s", command);
      judged = *line == '?';
      if (judged && tell_sh(line + 2)) skip();
      *command = 0;
    }
    if (*line == '$' || *line == '>') add_line(command, line + (line[1] ? 2 : 1));
    else if (digits > 0) {
      judged = true;
      code = tell_sh(command);
      shell_check(command, code, out, (int)strtol(line, NULL, 10), text_behind(line, digits));
    } else if (*line == '+') shell_check(command, code, out, code, text_behind(line, 1));
    else if (*line == '-') {
      const char *unwanted = text_behind(line, 1);
      if (strstr(out, unwanted)) fail_msg("%sexpected not to read '%s' in:\n%s", command, unwanted, out);
    } else if (*line == '~') {
      const double within = strtod(line + 1, &line), value = strtod(line, &line);
      const char *text = text_behind(line, 0), *at = find_behind(out, text);
      char *end = NULL;
      const double found = at ? strtod(at, &end) : NAN;
      if (end == at) fail_msg("no number behind '%s' in:\n%s", text, out);
      CHECK_NEAR(found, value, within, "behind '%s' in:\n%s", text, out);
    } else if (*line && !strchr("#?$", *line)) fail_msg("not a line of a transcript: %s", line);
  }
  if (!judged) fail_msg("nothing is expected of: %s", command);
}

int main(int argc, char **argv)
{
  struct CMUnitTest tests[MOST_TESTS] = {{0}};
  size_t n = 0, length = 0;
  char *text = NULL, path[LINE];
  FILE *from = argc == 2 ? fopen(argv[1], "r") : NULL;
  if (!from || getdelim(&text, &length, 0, from) < 0) {
    perror("test_transcript FILE");
    return 1;
  }
  fclose(from);
  check_watchdog(900);
  snprintf(path, sizeof path, "%.*s:%s", (int)(strrchr(HBMCHECK_COMMAND, '/') - HBMCHECK_COMMAND), HBMCHECK_COMMAND,
           getenv("PATH"));
  setenv("PATH", path, 1);
  for (char *line = text, *next = text; *line && n < MOST_TESTS; line = next) {
    char *end = line + strcspn(line, "\n");
    next = *end ? end + 1 : end;
    const bool begins = strncmp(line, BEGINS, 3) == 0;
    if (begins || n == 0) *end = 0;
    if (begins) tests[n++] = (struct CMUnitTest){line + 3, run_lines, NULL, NULL, next};
    else if (n == 0 && *line == '?') add_line(condition, line + 2);
    else if (n == 0 && *line != '#') add_line(prologue, line);
  }
  const int failed = _cmocka_run_group_tests(argv[1], tests, n, folder_make, folder_remove);
  free(text);
  return 0 < n && n < MOST_TESTS ? check_ended(failed) : 1;
}
