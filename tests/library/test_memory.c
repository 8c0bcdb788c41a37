/* test_memory.c - each allocation of our own code fails in turn: every call answers HBMCHECK_NO_MEMORY and hands over
 * nothing, or does without and hands over the whole; and leaks nothing (the address sanitizer sees to that). */
#include "tests/library/case2.h"
#include "tests/wrap.h"

#include <stdbool.h>

static long asked, refused_one; /* refused_one: which allocation fails; 0: none */

static bool refuse(void) { return ++asked == refused_one; }

WRAP(void *, malloc, (size_t n)) { return refuse() ? NULL : __real_malloc(n); }
WRAP(void *, calloc, (size_t n, size_t size)) { return refuse() ? NULL : __real_calloc(n, size); }
WRAP(void *, realloc, (void *p, size_t n)) { return refuse() ? NULL : __real_realloc(p, n); }

/* What is tried: HBMCHECK_OK, *made is what there is of it, and everything freed; or a status and nothing. */
typedef struct material {
  hbmcheck_case *c;
  const char *command;
  const char *const *options;
} material;
typedef hbmcheck_status (*attempt)(const material *m, int *made);

static hbmcheck_status parse(const material *m, int *made)
{
  (void)m;
  hbmcheck_case *c;
  char message[64];
  hbmcheck_status st = hbmcheck_case_parse("x", case2_text, strlen(case2_text), 0, NULL, message, sizeof message, &c);
  if ((st == HBMCHECK_OK) != (c != NULL) || (st == HBMCHECK_OK) != !*message) return HBMCHECK_BUG;
  hbmcheck_case_free(c);
  *made = st == HBMCHECK_OK;
  return st;
}

static hbmcheck_status run(const material *m, int *made)
{
  hbmcheck_result *r;
  hbmcheck_status st = run_with(m->c, m->command, NULL, &r, m->options);
  if ((st == HBMCHECK_NO_MEMORY) != (r == NULL)) return HBMCHECK_BUG;
  *made = 0;
  const hbmcheck_table *t;
  for (int i = 0; (t = hbmcheck_result_table(r, i)); ++i) *made += 1 + hbmcheck_table_rows(t);
  hbmcheck_result_free(r);
  return st;
}

/* Every allocation, or `most` of them where there are more, spread evenly; the first and the last ones included. */
static void without(const material *m, const char *name, attempt try, int most)
{
  int whole, made;
  refused_one = asked = 0;
  assert_int_equal(try(m, &whole), HBMCHECK_OK);
  const long n = asked, tries = n < most ? n : most;
  assert_true(n > 0);
  for (long i = 0; i < tries; ++i) {
    refused_one = tries > 1 ? 1 + i * (n - 1) / (tries - 1) : 1;
    asked = 0;
    hbmcheck_status st = try(m, &made);
    if (st != HBMCHECK_NO_MEMORY && !(st == HBMCHECK_OK && made == whole))
      fail_msg("%s without allocation %ld of %ld: %s, %d of %d", name, refused_one, n, hbmcheck_status_text(st), made,
               whole);
  }
  refused_one = asked = 0;
  assert_int_equal(try(m, &made), HBMCHECK_OK); /* and all is well again */
  assert_int_equal(made, whole);
}

static void every_call(CHECK_STATE)
{
  const struct {
    const char *command, *options[3];
    int most;
  } runs[] = {{"frf", {NULL}, 100},
              {"frf", {"--at=4.5", "--contacts"}, 100},
              {"transient", {"--at=5.2", "--contacts"}, 40},
              {"compare", {"--at=5.6", "--contacts"}, 40},
              {"modes", {NULL}, 100},
              {"verify", {"--quantity=amplitude"}, 60},
              {"gate", {"--at=5.6"}, 40},
              {"contact", {"--motion=0,8,0", "--samples=64"}, 100},
              {"names", {NULL}, 100}};
  const double points[] = {3.5, 4, 4.5, 5, 4, 4, 5, 7}; /* a curve of nothing that ours is: every mistake is tried */
  material m = {.c = CASE2("sweep.omega=3,6", "hbm.harmonics=3")};
  assert_int_equal(hbmcheck_case_give(m.c, "against", 2, 4, points, NULL, 0), HBMCHECK_OK);
  without(&m, "parse", parse, 100);
  for (size_t i = 0; i < sizeof runs / sizeof *runs; ++i) {
    m.command = runs[i].command, m.options = runs[i].options;
    without(&m, runs[i].command, run, runs[i].most);
  }
  hbmcheck_case_free(m.c);
}

CHECK_TESTS("library.memory", 300, every_call)
