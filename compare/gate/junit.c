/* junit.c - the checks as JUnit XML, the dialect that GitLab, Jenkins and the usual GitHub actions read:
 *     testsuites > testsuite (a case) > testcase (a check) > failure | error
 * Everything from outside goes through put_text(): file names may hold anything. time is always 0: how long it took
 * is not a result. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/utf8.h"
#include "compare/gate/gate.h"

/* In an attribute or between tags. What XML 1.0 cannot hold even escaped, control characters and U+FFFE, U+FFFF,
 * utf8_clean makes spaces. */
static hc_status put_text(const char *raw, FILE *to)
{
  char *text = utf8_clean(raw, true);
  if (!text) return HC_NO_MEMORY;
  for (const char *p = text; *p; ++p) {
    if (*p == '&') fputs("&amp;", to);
    else if (*p == '<') fputs("&lt;", to);
    else if (*p == '>') fputs("&gt;", to);
    else if (*p == '"') fputs("&quot;", to);
    else putc(*p, to);
  }
  free(text);
  return HC_OK;
}

static hc_status put_attribute(const char *name, const char *value, FILE *to)
{
  fprintf(to, " %s=\"", name);
  hc_status st = put_text(value, to);
  putc('"', to);
  return st;
}

static void name_check(const gate_case *g, const gate_check *c, char *text, size_t size)
{
  char place[GATE_PLACE];
  const char *response = gate_response(g, c);
  if (isnan(c->omega)) snprintf(text, size, "response curve: %s", c->quantity);
  else if (c->branch < 0) snprintf(text, size, "%s: %s", gate_place(g, c->omega, place), c->quantity);
  else
    snprintf(text, size, "%s branch %d%s%s: %s", gate_place(g, c->omega, place), c->branch,
             response ? " response " : "", response ? response : "", c->quantity);
}

static void say_check(const gate_check *c, char *text, size_t size)
{
  char found[NUMBER_TEXT], allowed[NUMBER_TEXT];
  number_write(gate_shown(c), found);
  number_write(c->allowed, allowed);
  if (*c->reason) snprintf(text, size, "%s", c->reason);
  else if (!strcmp(c->against, "limit")) snprintf(text, size, "%s %s, at most %s allowed", found, c->quantity, allowed);
  else
    snprintf(text, size, "%s is off the %s by %s of its amplitude, %s allowed (verdict %s)", c->quantity, c->against,
             found, allowed, c->verdict);
}

static hc_status put_skipped(const gate_check *c, FILE *to)
{
  fputs(">\n      <skipped", to);
  hc_status st = put_attribute("message", c->reason, to);
  fputs("/>\n    </testcase>\n", to);
  return st;
}

static hc_status put_check(const gate_case *g, const gate_check *c, FILE *to)
{
  char name[512], words[GATE_REASON + 96];
  name_check(g, c, name, sizeof name);
  fputs("    <testcase", to);
  hc_status st = put_attribute("classname", g->name, to);
  if (st == HC_OK) st = put_attribute("name", name, to);
  fputs(" time=\"0\"", to);
  if (c->result == GATE_PASS) fputs("/>\n", to);
  if (c->result == GATE_PASS || st != HC_OK) return st;
  if (c->result == GATE_NOT_APPLICABLE) return put_skipped(c, to);
  const char *tag = c->result == GATE_FAIL ? "failure" : "error";
  say_check(c, words, sizeof words);
  fprintf(to, ">\n      <%s", tag);
  st = put_attribute("message", words, to);
  if (st == HC_OK) st = put_attribute("type", c->quantity, to);
  putc('>', to);
  if (st == HC_OK) st = put_text(g->name, to);
  fputs(", ", to);
  if (st == HC_OK) st = put_text(name, to);
  fputs(": ", to);
  if (st == HC_OK) st = put_text(words, to);
  fprintf(to, "</%s>\n    </testcase>\n", tag);
  return st;
}

static void put_counts(int tests, int failures, int errors, int skipped, FILE *to)
{
  fprintf(to, " tests=\"%d\" failures=\"%d\" errors=\"%d\" skipped=\"%d\" time=\"0\">\n", tests, failures, errors,
          skipped);
}

hc_status gate_write_junit(int n, const gate_case *cases, FILE *to)
{
  int tests = 0, failures = 0, errors = 0, skipped = 0;
  hc_status st = HC_OK;
  for (int i = 0; i < n; ++i) {
    tests += cases[i].n, failures += cases[i].failures;
    errors += cases[i].errors, skipped += cases[i].not_applicable;
  }
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"hbmcheck gate\"", to);
  put_counts(tests, failures, errors, skipped, to);
  for (int i = 0; i < n && st == HC_OK; ++i) {
    fputs("  <testsuite", to);
    st = put_attribute("name", cases[i].name, to);
    put_counts(cases[i].n, cases[i].failures, cases[i].errors, cases[i].not_applicable, to);
    for (int k = 0; k < cases[i].n && st == HC_OK; ++k) st = put_check(&cases[i], &cases[i].checks[k], to);
    fputs("  </testsuite>\n", to);
  }
  fputs("</testsuites>\n", to);
  return st != HC_OK ? st : ferror(to) ? HC_IO : HC_OK;
}

/* The suite of one case file: wrong, or fine and not run because another one is wrong. */
static hc_status put_unread(const char *name, const char *wrong, FILE *to)
{
  fputs("  <testsuite", to);
  hc_status st = put_attribute("name", name, to);
  put_counts(1, 0, wrong != NULL, !wrong, to);
  fputs("    <testcase", to);
  if (st == HC_OK) st = put_attribute("classname", name, to);
  fprintf(to, " name=\"case file\" time=\"0\">\n      <%s", wrong ? "error" : "skipped");
  if (st == HC_OK) st = put_attribute("message", wrong ? wrong : "not run: another case file is wrong", to);
  if (wrong) fputs(" type=\"case file\"", to);
  putc('>', to);
  if (st == HC_OK && wrong) st = put_text(wrong, to);
  fprintf(to, "</%s>\n    </testcase>\n  </testsuite>\n", wrong ? "error" : "skipped");
  return st;
}

hc_status gate_write_junit_unread(int n, const char *const *names, const char *const *wrong, FILE *to)
{
  int errors = 0;
  hc_status st = HC_OK;
  for (int i = 0; i < n; ++i) errors += wrong[i] != NULL;
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"hbmcheck gate\"", to);
  put_counts(n, 0, errors, n - errors, to);
  for (int i = 0; i < n && st == HC_OK; ++i) st = put_unread(names[i], wrong[i], to);
  fputs("</testsuites>\n", to);
  return st != HC_OK ? st : ferror(to) ? HC_IO : HC_OK;
}
