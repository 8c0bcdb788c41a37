/* journal.c - see journal.h. */
#include "campaigns/stress/journal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LINE = 128 + 96 * STRESS_N_CHECKS };

struct stress_journal {
  FILE *file;
};

static void heading(const stress_plan *plan, char text[LINE])
{
  snprintf(text, LINE, "# hbmcheck stress 1, seed %lu, %.17g s, %d checks\n", plan->seed, plan->seconds,
           STRESS_N_CHECKS);
}

/* The next number of the line; false: there is none. */
static bool take(const char **at, double *x)
{
  char *end;
  *x = strtod(*at, &end);
  bool there = end != *at;
  *at = end;
  return there;
}

/* The next one, a code 0 .. n-1. */
static bool take_code(const char **at, int n, int *code)
{
  double x;
  if (!take(at, &x) || !(x >= 0 && x < n)) return false;
  *code = (int)x;
  return true;
}

static bool parse(const char *line, stress_result *r)
{
  double index;
  if (!take(&line, &index) || !(index >= 0 && index < 1e15) || !take(&line, &r->seconds)) return false;
  r->index = (long)index;
  for (int k = 0; k < STRESS_N_CHECKS; ++k) {
    stress_check c = {STRESS_SKIPPED, STRESS_NO_REASON, HC_OK, 0, 0, 0};
    int outcome, reason, status;
    if (!take_code(&line, STRESS_N_OUTCOMES, &outcome) || !take_code(&line, STRESS_N_REASONS, &reason) ||
        !take_code(&line, HC_BUG + 1, &status))
      return false;
    if (!take(&line, &c.error) || !take(&line, &c.bound) || !take(&line, &c.seconds)) return false;
    c.outcome = (stress_outcome)outcome, c.reason = (stress_reason)reason, c.status = (hc_status)status;
    r->check[k] = c;
  }
  r->there = !strcmp(line, " .\n");
  return r->there;
}

/* Read what is there; *end is where the last whole line ends. */
static hc_status read_all(const stress_plan *plan, FILE *file, stress_result *results, long *there, long *end)
{
  char line[LINE], expected[LINE];
  *end = 0;
  if (!fgets(line, sizeof line, file)) return ferror(file) ? HC_IO : HC_OK;
  heading(plan, expected);
  if (strcmp(line, expected) != 0) return HC_BAD_INPUT;
  *end = ftell(file);
  while (fgets(line, sizeof line, file)) {
    stress_result r;
    if (!parse(line, &r)) break;
    *end = ftell(file);
    if (r.index < plan->first || r.index >= plan->first + plan->scenes) continue; /* of a longer run */
    stress_result *to = &results[r.index - plan->first];
    *there += !to->there;
    *to = r;
  }
  return ferror(file) ? HC_IO : HC_OK;
}

hc_status stress_journal_open(const stress_plan *plan, stress_result *results, long *there, stress_journal **out)
{
  long end = 0;
  char text[LINE];
  *out = NULL;
  if (!plan->journal) return HC_OK;
  stress_journal *j = calloc(1, sizeof *j);
  if (!j) return HC_NO_MEMORY;
  hc_status st = HC_OK;
  if (!(j->file = fopen(plan->journal, "r+")) && errno == ENOENT) j->file = fopen(plan->journal, "w+");
  if (!j->file) st = HC_IO;
  if (st == HC_OK) st = read_all(plan, j->file, results, there, &end);
  if (st == HC_OK && (fseek(j->file, end, SEEK_SET) != 0 || ftruncate(fileno(j->file), end) != 0)) st = HC_IO;
  heading(plan, text);
  if (st == HC_OK && end == 0 && (fputs(text, j->file) == EOF || fflush(j->file) != 0)) st = HC_IO;
  if (st == HC_OK) {
    *out = j;
    return HC_OK;
  }
  int why = errno;
  stress_journal_close(j);
  errno = why;
  return st;
}

hc_status stress_journal_add(stress_journal *j, const stress_result *r)
{
  if (!j) return HC_OK;
  fprintf(j->file, "%ld %.3f", r->index, r->seconds);
  for (int k = 0; k < STRESS_N_CHECKS; ++k) {
    const stress_check *c = &r->check[k];
    fprintf(j->file, "  %d %d %d %.17g %.17g %.3f", (int)c->outcome, (int)c->reason, (int)c->status, c->error, c->bound,
            c->seconds);
  }
  fputs(" .\n", j->file);
  return fflush(j->file) == 0 && !ferror(j->file) ? HC_OK : HC_IO;
}

hc_status stress_journal_close(stress_journal *j)
{
  if (!j) return HC_OK;
  hc_status st = !j->file || fclose(j->file) == 0 ? HC_OK : HC_IO;
  free(j);
  return st;
}
