/* main.c - hbmcheck-proof: checks certificates, completes candidates. */
#include "base/number.h"
#include "proof/complete.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_ACCEPTED = 0, EXIT_REJECTED = 1, EXIT_WRONG = 2, EXIT_USAGE = 64 };

typedef struct options {
  bool complete, json;
  int precision;      /* 0: 128 */
  const char *output; /* of complete */
  int n;
  char **files;
} options;

static const char usage[] =
    "Usage: hbmcheck-proof check CERTIFICATE... [--format text|json]\n"
    "  or:  hbmcheck-proof complete CANDIDATE -o CERTIFICATE [--precision-bits N]\n"
    "Decide in ball arithmetic whether there is a periodic orbit where a certificate says so; or make a certificate\n"
    "of an orbit that is known in double precision, and decide that.\n"
    "  -                   standard input: one JSON object a line, answered by one a line; -o - is standard output\n"
    "  --format FORMAT     text or json: an object a line                                              [text]\n"
    "  --precision-bits N  of the balls, where the candidate says nothing, 32..1024                    [128]\n"
    "exit: 0 all accepted  1 one rejected  2 a file is wrong  64 usage\n"
    "example: hbmcheck-proof check orbit.json\n";

/* ---- answers ---- */

static int status_of(const json_t *answer)
{
  const char *verdict = json_string_value(json_object_get(answer, "verdict"));
  return strcmp(verdict, "accepted") == 0   ? EXIT_ACCEPTED
         : strcmp(verdict, "rejected") == 0 ? EXIT_REJECTED
                                            : EXIT_WRONG;
}

static void print_text(const char *file, const json_t *answer)
{
  static const char *const shown[] = {"amplitude", "mean", "harmonic_1", "multiplier"};
  const char *reason = json_string_value(json_object_get(answer, "reason"));
  switch (status_of(answer)) {
  case EXIT_WRONG: fprintf(stderr, "hbmcheck-proof: %s: %s\n", file, reason); return;
  case EXIT_REJECTED: printf("%s: rejected: %s\n", file, reason); return;
  default: break;
  }
  printf("%s: accepted, %s", file, json_string_value(json_object_get(answer, "stability")));
  for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
    const json_t *interval = json_object_get(answer, shown[i]);
    if (json_is_array(interval))
      printf("; %s %s to %s", shown[i], json_string_value(json_array_get(interval, 0)),
             json_string_value(json_array_get(interval, 1)));
  }
  printf("; radius %s, alone within %s\n", json_string_value(json_object_get(answer, "radius")),
         json_string_value(json_object_get(answer, "uniqueness_radius")));
}

static bool print_line(const json_t *answer, FILE *to)
{
  return json_dumpf(answer, to, JSON_COMPACT) == 0 && fputc('\n', to) != EOF && fflush(to) == 0;
}

/* ---- one text ---- */

static json_t *answer_text(const options *o, const char *text, size_t length)
{
  json_error_t error;
  char why[512];
  json_t *json = json_loadb(text, length, JSON_REJECT_DUPLICATES, &error), *answer;
  if (!json) {
    snprintf(why, sizeof why, "%d:%d: %s", error.line, error.column, error.text);
    return answer_json(NULL, NULL, why);
  }
  if (o->complete) answer = complete(json, o->precision);
  else {
    decision v;
    decision_init(&v);
    certificate *c = certificate_read(json, false, why, sizeof why);
    if (c) prove(c, NULL, &v);
    answer = answer_json(c, &v, c ? NULL : why);
    certificate_free(c);
    decision_clear(&v);
  }
  json_decref(json);
  return answer;
}

/* The next text of a stream: a line, or all of it. NULL: none, or too long: *length is then past the limit. To free. */
static char *next_text(FILE *from, bool line, size_t *length)
{
  size_t room = 1 << 16;
  char *text = malloc(room);
  int c = EOF;
  *length = 0;
  if (!text) return NULL;
  while (*length <= LIMIT_BYTES && (c = getc(from)) != EOF && !(line && c == '\n')) {
    if (*length == room) {
      char *more = realloc(text, room *= 2);
      if (!more) {
        free(text);
        return NULL;
      }
      text = more;
    }
    text[(*length)++] = (char)c;
  }
  if (*length <= LIMIT_BYTES && (*length > 0 || c != EOF)) return text;
  free(text);
  return NULL;
}

static int write_certificate(const char *path, const json_t *paper)
{
  if (json_dump_file(paper, path, JSON_INDENT(1)) == 0) return 0;
  fprintf(stderr, "hbmcheck-proof: %s: %s\n", path, errno ? strerror(errno) : "could not be written");
  return EXIT_WRONG;
}

/* All lines of standard input. */
static int stream(const options *o)
{
  int status = 0, worst;
  size_t length;
  char *text;
  while ((text = next_text(stdin, true, &length))) {
    if (strspn(text, " \t\r") < length) {
      json_t *answer = answer_text(o, text, length);
      worst = status_of(answer);
      if (worst > status) status = worst;
      if (!print_line(answer, stdout)) status = EXIT_WRONG;
      json_decref(answer);
    }
    free(text);
  }
  if (length > LIMIT_BYTES) {
    fprintf(stderr, "hbmcheck-proof: a line of more than %d bytes\n", LIMIT_BYTES);
    status = EXIT_WRONG;
  }
  return status;
}

static int one_file(const options *o, const char *path)
{
  FILE *file = fopen(path, "r");
  size_t length = 0;
  char *text = file ? next_text(file, false, &length) : NULL;
  const char *why = !file ? strerror(errno) : length ? "too long" : "empty";
  json_t *answer = text ? answer_text(o, text, length) : answer_json(NULL, NULL, why);
  json_t *made = json_object_get(answer, "certificate");
  int status = status_of(answer);
  if (file) fclose(file);
  free(text);
  json_object_set_new(answer, "file", json_string(path));
  const bool whole = o->output && json_is_object(made);
  if (whole && strcmp(o->output, "-") == 0) print_line(answer, stdout);
  else {
    if (whole && write_certificate(o->output, made) != 0) status = EXIT_WRONG;
    if (o->json) print_line(answer, stdout);
    else print_text(path, answer);
  }
  json_decref(answer);
  return status;
}

/* ---- the command line ---- */

static int refuse(const char *what)
{
  fprintf(stderr, "hbmcheck-proof: %s\n%s", what, usage);
  return EXIT_USAGE;
}

int main(int argc, char **argv)
{
  options o = {0};
  if (argc == 2 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0))
    return fputs(usage, stdout) < 0 ? EXIT_WRONG : 0;
  if (argc == 2 && strcmp(argv[1], "--version") == 0)
    return printf("hbmcheck-proof %s\nFLINT %s\n", HBMCHECK_VERSION, flint_version) < 0 ? EXIT_WRONG : 0;
  if (argc < 3) return refuse("a command and a file were expected");
  o.complete = strcmp(argv[1], "complete") == 0;
  if (!o.complete && strcmp(argv[1], "check") != 0) return refuse("the commands are check and complete");
  o.files = argv + 2;
  for (int i = 2; i < argc; i++) {
    const char *option = argv[i], *value = argv[i + 1];
    if (option[0] != '-' || !option[1]) {
      o.files[o.n++] = argv[i];
      continue;
    }
    if (!value) return refuse("an option without its value");
    i++;
    if (strcmp(option, "--format") == 0 && (strcmp(value, "json") == 0 || strcmp(value, "text") == 0))
      o.json = strcmp(value, "json") == 0;
    else if (o.complete && strcmp(option, "-o") == 0) o.output = value;
    else if (o.complete && strcmp(option, "--precision-bits") == 0 &&
             number_read_integer(value, strlen(value), &o.precision) == NUMBER_FINE && o.precision >= 32 &&
             o.precision <= LIMIT_PRECISION)
      continue;
    else return refuse("an option that is not known, or its value");
  }
  if (o.n < 1 || (o.complete && (o.n > 1 || !o.output)))
    return refuse(o.complete ? "one candidate and -o were expected" : "a certificate was expected");
  int status = 0;
  for (int i = 0; i < o.n; i++) {
    const bool standard = strcmp(o.files[i], "-") == 0;
    if (standard && o.complete && strcmp(o.output, "-") != 0)
      return refuse("candidates from standard input go with -o -");
    const int one = standard ? stream(&o) : one_file(&o, o.files[i]);
    if (one > status) status = one;
  }
  if (fflush(stdout) != 0) status = EXIT_WRONG;
  flint_cleanup_master();
  return status;
}
