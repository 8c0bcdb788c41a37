/* journal.c - see journal.h. */
#include "compare/stress/journal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LINE = 128 + 96 * STRESS_N_CHECKS };

struct stress_journal { FILE *file; };

static void heading(const stress_plan *plan, char text[LINE])
{
  snprintf(text, LINE, "# hbmcheck stress 1, seed %lu, %.17g s, %d checks\n", plan->seed, plan->seconds, STRESS_N_CHECKS);
}

static bool parse(const char *line, stress_result *r)
{
  int used;
  if (sscanf(line, "%ld %lf%n", &r->index, &r->seconds, &used) != 2) return false;
  for (int k = 0; k < STRESS_N_CHECKS; ++k) {
    stress_check *c = &r->check[k];
    int outcome, reason, status, n;
    if (sscanf(line + used, "%d %d %d %lf %lf %lf%n", &outcome, &reason, &status, &c->error, &c->bound, &c->seconds, &n) != 6) return false;
    if (outcome < 0 || outcome >= STRESS_N_OUTCOMES || reason < 0 || reason >= STRESS_N_REASONS || status < HC_OK || status > HC_BUG) return false;
    *c = (stress_check){(stress_outcome)outcome, (stress_reason)reason, (hc_status)status, c->error, c->bound, c->seconds};
    used += n;
  }
  r->there = !strcmp(line + used, " .\n");
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
    fprintf(j->file, "  %d %d %d %.17g %.17g %.3f", (int)c->outcome, (int)c->reason, (int)c->status, c->error, c->bound, c->seconds);
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
