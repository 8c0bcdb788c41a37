/* run.c - all checks of one scene; many scenes by several threads; and their results, kept as they come: a text file, a
 * line a scene, from which a run that was killed goes on.
 *
 *     # hbmcheck stress 4, seed 1, 2 s          or: 4, structures of seed 1, 2 s, structures in space of ...
 *     # checks: contact_force balance ...     the names behind the columns and codes below, in their order
 *     # outcomes: skipped agreed ...
 *     # reasons: STRESS_NO_REASON STRESS_TRUNCATED ...
 *     # statuses: HC_OK HC_BAD_INPUT ...
 *     INDEX SECONDS  OUTCOME REASON STATUS ERROR BOUND SECONDS  (for each check)  .
 *
 * OUTCOME, REASON and STATUS are places in these lists, from 0. A line counts once its final dot and newline are there;
 * what a kill left of one is cut off. */
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compare/stress/scenes.h"
#include "compare/stress/solved_scene.h"
#include "model/casefile/case_file.h"
#include "numerics/base/number.h"
#include "numerics/base/thread_clock.h"
#include "numerics/workers.h"

/* ---- one scene ------------------------------------------------------------------------------------------- */

/* of(s), if there is a solution and all its numbers are some. */
static stress_check check(solved_scene *s, stress_check (*of)(solved_scene *))
{
  if (s->base.status != HC_OK) return stress_refuse(s, s->base.status);
  for (int i = 0; i < s->n * s->n_coef; ++i)
    if (!isfinite(s->base.x[i])) return stress_find(STRESS_INTERNAL, NAN, NAN);
  return of(s);
}

hc_status stress_scene(const scene *sc, stress_kind last, double seconds, const hc_monitor *monitor, stress_result *out)
{
#define FUNCTION(code, name, function, meaning) function,
  static stress_check (*const checks[])(solved_scene *) = {STRESS_CHECKS(FUNCTION)};
#undef FUNCTION
  solved_scene s;
  const double start = thread_seconds();
  hc_status st = solved_scene_start(&s, sc, seconds, monitor);
  for (int k = 0; k <= (int)last && st == HC_OK; ++k) {
    solved_scene_clock(&s, 1);
    const double began = thread_seconds();
    out->check[k] = check(&s, checks[k]);
    out->check[k].seconds = thread_seconds() - began;
    st = s.fatal;
  }
  solved_scene_clear(&s);
  out->seconds = thread_seconds() - start;
  out->there = st == HC_OK;
  return st;
}

/* ---- the journal ------------------------------------------------------------------------------------------ */

enum { VERSION = 4, LINE = 128 + 96 * STRESS_N_CHECKS };

/* What the columns and codes of a line mean: lists as in stress.h and status.h. */
#define NAME_OF_CHECK(code, name, fun, meaning) " " name
#define NAME_OF_REASON(code, name, meaning)     " " #code
#define NAME_OF_OUTCOME(code, name)             " " name
#define NAME_OF_STATUS(code, text)              " " #code
static const char *const families[] = {"", "structures of ", "structures in space of "};
static const char *const lists[] = {
    "# checks:" STRESS_CHECKS(NAME_OF_CHECK) "\n",
    "# outcomes:" STRESS_OUTCOMES(NAME_OF_OUTCOME) "\n",
    "# reasons:" STRESS_REASONS(NAME_OF_REASON) "\n",
    "# statuses:" HC_STATUS_LIST(NAME_OF_STATUS) "\n",
};
enum { N_LISTS = sizeof lists / sizeof *lists };

static void first_line(const stress_plan *plan, char line[LINE])
{
  snprintf(line, LINE, "# hbmcheck stress %d, %sseed %lu, %.17g s\n", VERSION, families[plan->family], plan->seed,
           plan->seconds);
}

/* Is it of this version, of this plan, with these lists? */
static hc_status read_heading(const stress_plan *plan, FILE *file)
{
  static const char begin[] = "# hbmcheck stress ";
  char line[LINE], expected[LINE];
  if (!fgets(line, sizeof line, file)) return ferror(file) ? HC_IO : HC_BAD_INPUT;
  first_line(plan, expected);
  if (strcmp(line, expected) != 0) {
    const char *number = line + sizeof begin - 1;
    int version = VERSION;
    if (strncmp(line, begin, sizeof begin - 1) != 0) return HC_BAD_INPUT;
    number_read_integer(number, strcspn(number, ","), &version); /* what is no number leaves VERSION */
    return version != VERSION ? HC_UNSUPPORTED : HC_BAD_INPUT;
  }
  for (int i = 0; i < N_LISTS; ++i)
    if (!fgets(line, sizeof line, file) || strcmp(line, lists[i]) != 0) return ferror(file) ? HC_IO : HC_UNSUPPORTED;
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

static bool parse(const char *line, stress_result *r)
{
  double index;
  if (!read_number(&line, &index) || !(index >= 0 && index < 1e15) || !read_number(&line, &r->seconds)) return false;
  r->index = (long)index;
  for (int k = 0; k < STRESS_N_CHECKS; ++k) {
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

/* *end: where the last whole line ends, 0: there is none. A whole line that does not parse is damage. */
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
    if (!parse(line, &r)) {
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

/* plan->journal, if any: its scenes that belong to the plan into results, *there of them. *out is NULL where there
 * is none to keep. HC_BAD_INPUT: it is no journal of this seed and these seconds, or is damaged; HC_UNSUPPORTED: its
 * version or its lists of names are not those of this program; HC_IO. What is refused is left as it was. */
static hc_status open_journal(const stress_plan *plan, stress_result *results, long *there, FILE **out)
{
  *out = NULL;
  if (!plan->journal) return HC_OK;
  FILE *file = fopen(plan->journal, "r+");
  if (!file && errno == ENOENT) file = fopen(plan->journal, "w+");
  if (!file) return HC_IO;
  long end;
  hc_status st = read_all(plan, file, results, there, &end);
  /* half a line is cut off; a heading at its beginning */
  if (st == HC_OK && (fseek(file, end, SEEK_SET) != 0 || ftruncate(fileno(file), end) != 0)) st = HC_IO;
  if (st == HC_OK && end == 0) {
    char line[LINE];
    first_line(plan, line);
    fputs(line, file);
    for (int i = 0; i < N_LISTS; ++i) fputs(lists[i], file);
  }
  if (st == HC_OK && (fflush(file) != 0 || ferror(file))) st = HC_IO;
  const int why = errno;
  if (st == HC_OK) *out = file;
  else fclose(file);
  errno = why;
  return st;
}

/* ---- all of them ---------------------------------------------------------------------------------------- */

typedef struct pool {
  const stress_plan *plan;
  stress_result *results;
  long *left;           /* places in results of the scenes to classify, rising */
  pthread_mutex_t lock; /* of what follows */
  int next;             /* of left: scenes are drawn in their order, which is cheap */
  stress_scenes *scenes;
  FILE *journal; /* NULL: none */
} pool;

/* On disk when this returns HC_OK, if it is to be anywhere. */
static hc_status classify(void *self, int task, const hc_monitor *monitor)
{
  pool *p = self;
  scene sc;
  (void)task;
  pthread_mutex_lock(&p->lock);
  stress_result *r = &p->results[p->left[p->next++]];
  hc_status st = stress_scene_of(p->scenes, p->plan->family, r->index, &sc);
  pthread_mutex_unlock(&p->lock);
  if (st != HC_OK) return st;
  st = stress_scene(&sc, STRESS_N_CHECKS - 1, p->plan->seconds, monitor, r);
  case_clear(&sc);
  if (st != HC_OK || !p->journal) return st;
  pthread_mutex_lock(&p->lock);
  fprintf(p->journal, "%ld %.3f", r->index, r->seconds);
  for (int k = 0; k < STRESS_N_CHECKS; ++k) {
    const stress_check *c = &r->check[k];
    fprintf(p->journal, "  %d %d %d %.17g %.17g %.3f", (int)c->outcome, (int)c->reason, (int)c->status, c->error,
            c->bound, c->seconds);
  }
  fputs(" .\n", p->journal);
  if (fflush(p->journal) != 0 || ferror(p->journal)) st = HC_IO;
  pthread_mutex_unlock(&p->lock);
  return st;
}

hc_status stress_run(const stress_plan *plan, const hc_monitor *monitor, stress_result *results, long *resumed)
{
  pool p = {.plan = plan, .results = results, .left = malloc((size_t)plan->scenes * sizeof *p.left)};
  int n = 0;
  *resumed = 0;
  for (long i = 0; i < plan->scenes; ++i) results[i] = (stress_result){.index = plan->first + i};
  hc_status st = p.left ? open_journal(plan, results, resumed, &p.journal) : HC_NO_MEMORY;
  for (long i = 0; i < plan->scenes && st == HC_OK; ++i)
    if (!results[i].there) p.left[n++] = i;
  if (st == HC_OK) st = stress_scenes_new(plan->seed, &p.scenes);
  if (st == HC_OK && pthread_mutex_init(&p.lock, NULL) != 0) st = HC_NO_MEMORY;
  else if (st == HC_OK) {
    st = workers_run(plan->jobs, n, classify, &p, monitor);
    pthread_mutex_destroy(&p.lock);
  }
  const int why = errno;
  if (p.journal && fclose(p.journal) != 0 && st == HC_OK) st = HC_IO;
  else errno = why;
  stress_scenes_free(p.scenes);
  free(p.left);
  return st;
}
