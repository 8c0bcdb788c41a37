/* main.c - hbmcheck-proof: checks certificates, completes candidates. */
#include "numerics/base/number.h"
#include "proof/around/complete.h"
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_ACCEPTED = 0, EXIT_REJECTED = 1, EXIT_WRONG = 2, EXIT_USAGE = 64 };

typedef struct options {
  bool complete, json;
  int precision;      /* bits for `complete`; 0: 128 */
  const char *output; /* output file of `complete` */
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

static char text[LIMIT_BYTES + 2]; /* terminated by 0 */

/* Reads the next line, or the whole file, into text; returns its length, above LIMIT_BYTES if it is too long. */
static size_t next_text(FILE *from, bool line)
{
  size_t n = 0;
  for (int c; n <= LIMIT_BYTES && (c = getc(from)) != EOF && !(line && c == '\n');) text[n++] = (char)c;
  return n;
}

static json_t *answer_text(const options *o, size_t length)
{
  json_error_t error;
  char why[512] = "too long";
  json_t *json = length <= LIMIT_BYTES ? json_loadb(text, length, JSON_REJECT_DUPLICATES, &error) : NULL, *answer;
  if (!json) {
    if (length <= LIMIT_BYTES) snprintf(why, sizeof why, "%d:%d: %s", error.line, error.column, error.text);
    return answer_json(NULL, NULL, why);
  }
  if (o->complete) answer = complete(json, o->precision, COMPLETE_MOST_WORK);
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

/* All lines of standard input. */
static int stream(const options *o)
{
  int status = 0;
  size_t length = 0;
  while (length <= LIMIT_BYTES && !feof(stdin) && !ferror(stdin)) {
    length = next_text(stdin, true);
    if (length > LIMIT_BYTES || strspn(text, " \t\r") < length) {
      json_t *answer = answer_text(o, length);
      const int one = print_line(answer, stdout) ? status_of(answer) : EXIT_WRONG;
      if (one > status) status = one;
      json_decref(answer);
    }
  }
  return status;
}

static int one_file(const options *o, const char *path)
{
  FILE *file = fopen(path, "r");
  json_t *answer = file ? answer_text(o, next_text(file, false)) : answer_json(NULL, NULL, strerror(errno));
  const json_t *made = json_object_get(answer, "certificate");
  const bool whole = o->output && json_is_object(made), printed = whole && strcmp(o->output, "-") == 0;
  int status = status_of(answer);
  if (file) fclose(file);
  json_object_set_new(answer, "file", json_string(path));
  if (whole && !printed && json_dump_file(made, o->output, JSON_INDENT(1)) != 0) {
    fprintf(stderr, "hbmcheck-proof: %s: %s\n", o->output, errno ? strerror(errno) : "could not be written");
    status = EXIT_WRONG;
  }
  if (printed || o->json) print_line(answer, stdout);
  else print_text(path, answer);
  json_decref(answer);
  return status;
}

/* ---- the command line ---- */

int main(int argc, char **argv)
{
  static const struct option known[] = {{"format", required_argument, NULL, 'f'},
                                        {"precision-bits", required_argument, NULL, 'p'},
                                        {"help", no_argument, NULL, 'h'},
                                        {"version", no_argument, NULL, 'V'},
                                        {NULL, 0, NULL, 0}};
  options o = {0};
  bool fine = true;
  int status = 0;
  for (int c; (c = getopt_long(argc, argv, "o:h", known, NULL)) != -1;) {
    if (c == 'h') return fputs(usage, stdout) < 0 ? EXIT_WRONG : 0;
    if (c == 'V') return printf("hbmcheck-proof %s\nFLINT %s\n", HBMCHECK_VERSION, flint_version) < 0 ? EXIT_WRONG : 0;
    if (c == 'f') o.json = strcmp(optarg, "json") == 0;
    if (c == 'o') o.output = optarg;
    fine = fine && c != '?' && (c != 'f' || o.json || strcmp(optarg, "text") == 0) &&
           (c != 'p' || (number_read_integer(optarg, strlen(optarg), &o.precision) == NUMBER_FINE &&
                         o.precision >= 32 && o.precision <= LIMIT_PRECISION));
  }
  const char *command = optind < argc ? argv[optind++] : "", *first = optind < argc ? argv[optind] : "";
  o.complete = strcmp(command, "complete") == 0;
  if (o.complete) /* candidates from standard input go with -o - */
    fine = fine && argc - optind == 1 && o.output && (strcmp(first, "-") != 0 || strcmp(o.output, "-") == 0);
  else fine = fine && strcmp(command, "check") == 0 && optind < argc && !o.output && !o.precision;
  if (!fine) return fputs(usage, stderr), EXIT_USAGE;
  for (; optind < argc; optind++) {
    const int one = strcmp(argv[optind], "-") == 0 ? stream(&o) : one_file(&o, argv[optind]);
    if (one > status) status = one;
  }
  if (fflush(stdout) != 0) status = EXIT_WRONG;
  flint_cleanup_master();
  return status;
}
