/* journal.c - see journal.h. */
#include "stress/journal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/number.h"

enum { VERSION = 3, LINE = 128 + 96 * STRESS_N_CHECKS };

/* What the columns and codes of a line mean: lists as in stress.h and status.h. */
#define NAME_OF_CHECK(code, name, meaning)  " " name
#define NAME_OF_REASON(code, name, meaning) " " #code
#define NAME_OF_OUTCOME(code, name)         " " name
#define NAME_OF_STATUS(code, text)          " " #code
static const char *const checks[] = {
    "# checks:" STRESS_CHECKS(NAME_OF_CHECK) "\n", "# checks:" STRESS_STRUCTURE_CHECKS(NAME_OF_CHECK) "\n",
    "# checks:" STRESS_STRUCTURE_CHECKS(NAME_OF_CHECK) STRESS_SPACE_CHECKS(NAME_OF_CHECK) "\n"}; /* of each family */
static const char *const families[] = {"", "structures of ", "structures in space of "};
static const char *const lists[] = {
    "# outcomes:" STRESS_OUTCOMES(NAME_OF_OUTCOME) "\n",
    "# reasons:" STRESS_REASONS(NAME_OF_REASON) "\n",
    "# statuses:" HC_STATUS_LIST(NAME_OF_STATUS) "\n",
};
enum { N_LISTS = sizeof lists / sizeof *lists };

struct stress_journal {
  stress_family family;
  FILE *file;
};

static void write_heading(const stress_plan *plan, FILE *file)
{
  fprintf(file, "# hbmcheck stress %d, %sseed %lu, %.17g s\n", VERSION, families[plan->family], plan->seed,
          plan->seconds);
  fputs(checks[plan->family], file);
  for (int i = 0; i < N_LISTS; ++i) fputs(lists[i], file);
}

/* Is it of this version, of this plan, with these lists? */
static hc_status read_heading(const stress_plan *plan, FILE *file)
{
  static const char begin[] = "# hbmcheck stress ";
  char line[LINE], expected[LINE];
  if (!fgets(line, sizeof line, file)) return ferror(file) ? HC_IO : HC_BAD_INPUT;
  snprintf(expected, sizeof expected, "# hbmcheck stress %d, %sseed %lu, %.17g s\n", VERSION, families[plan->family],
           plan->seed, plan->seconds);
  if (strcmp(line, expected) != 0) {
    const char *number = line + sizeof begin - 1;
    int version = VERSION;
    if (strncmp(line, begin, sizeof begin - 1) != 0) return HC_BAD_INPUT;
    number_read_integer(number, strcspn(number, ","), &version); /* what is no number leaves VERSION */
    return version != VERSION ? HC_UNSUPPORTED : HC_BAD_INPUT;
  }
  for (int i = -1; i < N_LISTS; ++i)
    if (!fgets(line, sizeof line, file) || strcmp(line, i < 0 ? checks[plan->family] : lists[i]) != 0)
      return ferror(file) ? HC_IO : HC_UNSUPPORTED;
  return HC_OK;
}

/* The next number of the line; false: there is none. */
static bool read_number(const char **at, double *x)
{
  char *end;
  *x = strtod(*at, &end);
  bool there = end != *at;
  *at = end;
  return there;
}

/* The next one, a code 0 .. n-1. */
static bool read_code(const char **at, int n, int *code)
{
  double x;
  if (!read_number(at, &x) || !(x >= 0 && x < n)) return false;
  *code = (int)x;
  return true;
}

static bool parse(stress_family family, const char *line, stress_result *r)
{
  double index;
  if (!read_number(&line, &index) || !(index >= 0 && index < 1e15) || !read_number(&line, &r->seconds)) return false;
  r->index = (long)index;
  for (int k = stress_first_check(family); k < stress_end_of_checks(family); ++k) {
    stress_check c = {STRESS_SKIPPED, STRESS_NO_REASON, HC_OK, 0, 0, 0};
    int outcome, reason, status;
    if (!read_code(&line, STRESS_N_OUTCOMES, &outcome) || !read_code(&line, STRESS_N_REASONS, &reason) ||
        !read_code(&line, HC_BUG + 1, &status))
      return false;
    if (!read_number(&line, &c.error) || !read_number(&line, &c.bound) || !read_number(&line, &c.seconds)) return false;
    c.outcome = (stress_outcome)outcome, c.reason = (stress_reason)reason, c.status = (hc_status)status;
    r->check[k] = c;
  }
  r->there = !strcmp(line, " .\n");
  return r->there;
}

/* Read what is there; *end is where the last whole line ends, 0: nothing is there. A line that has its newline and does
 * not parse is none of ours. */
static hc_status read_all(const stress_plan *plan, FILE *file, stress_result *results, long *there, long *end)
{
  char line[LINE];
  int first = getc(file);
  *end = 0;
  if (first == EOF) return ferror(file) ? HC_IO : HC_OK;
  ungetc(first, file);
  hc_status st = read_heading(plan, file);
  if (st != HC_OK) return st;
  *end = ftell(file);
  while (fgets(line, sizeof line, file)) {
    stress_result r = {0};
    if (!parse(plan->family, line, &r)) {
      if (strchr(line, '\n')) return HC_BAD_INPUT;
      break;
    }
    *end = ftell(file);
    if (r.index < plan->first || r.index >= plan->first + plan->scenes) continue; /* of a longer run */
    stress_result *to = &results[r.index - plan->first];
    *there += !to->there;
    *to = r;
  }
  return ferror(file) ? HC_IO : HC_OK;
}

/* Ready to be written to: what is there taken over, half a line cut off, a heading at its beginning. */
static hc_status start(const stress_plan *plan, FILE *file, stress_result *results, long *there)
{
  long end;
  hc_status st = read_all(plan, file, results, there, &end);
  if (st != HC_OK) return st;
  if (fseek(file, end, SEEK_SET) != 0 || ftruncate(fileno(file), end) != 0) return HC_IO;
  if (end == 0) write_heading(plan, file);
  return fflush(file) == 0 && !ferror(file) ? HC_OK : HC_IO;
}

hc_status stress_journal_open(const stress_plan *plan, stress_result *results, long *there, stress_journal **out)
{
  *out = NULL;
  if (!plan->journal) return HC_OK;
  stress_journal *j = calloc(1, sizeof *j);
  if (!j) return HC_NO_MEMORY;
  j->family = plan->family;
  if (!(j->file = fopen(plan->journal, "r+")) && errno == ENOENT) j->file = fopen(plan->journal, "w+");
  hc_status st = j->file ? start(plan, j->file, results, there) : HC_IO;
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
  for (int k = stress_first_check(j->family); k < stress_end_of_checks(j->family); ++k) {
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
