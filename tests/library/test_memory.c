/* test_memory.c - each allocation of our own code fails in turn: every call answers HBMCHECK_NO_MEMORY, hands over
 * nothing, and leaks nothing (the address sanitizer sees to that); without a failure it is HBMCHECK_OK. */
#include "tests/library/case2.h"
#include "tests/wrap.h"

#include <stdbool.h>

static long asked, refused_one; /* refused_one: which allocation fails; 0: none */

static bool refuse(void) { return ++asked == refused_one; }

WRAP(void *, malloc, (size_t n)) { return refuse() ? NULL : __real_malloc(n); }
WRAP(void *, calloc, (size_t n, size_t size)) { return refuse() ? NULL : __real_calloc(n, size); }
WRAP(void *, realloc, (void *p, size_t n)) { return refuse() ? NULL : __real_realloc(p, n); }

/* What is tried: HBMCHECK_OK and everything freed, or a status and nothing handed over. */
typedef struct material {
  hbmcheck_case *c;
  hbmcheck_curve *curve;
  int samples; /* of a contact's force */
} material;
typedef hbmcheck_status (*attempt)(material *m);

static hbmcheck_status parse(material *m)
{
  (void)m;
  hbmcheck_case *c;
  char message[64];
  hbmcheck_status st = hbmcheck_case_parse("x", case2_text, strlen(case2_text), 0, NULL, message, sizeof message, &c);
  if ((st == HBMCHECK_OK) != (c != NULL) || (st == HBMCHECK_OK) != !*message) return HBMCHECK_BUG;
  hbmcheck_case_free(c);
  return st;
}

/* A call that makes an object of that type: handed over with HBMCHECK_OK, and with that alone. */
#define MAKES(name, type, call)                                                                                        \
  static hbmcheck_status name(material *m)                                                                             \
  {                                                                                                                    \
    type *made;                                                                                                        \
    hbmcheck_status st = call;                                                                                         \
    if ((st == HBMCHECK_OK) != (made != NULL)) return HBMCHECK_BUG;                                                    \
    type##_free(made);                                                                                                 \
    return st;                                                                                                         \
  }
MAKES(trace, hbmcheck_curve, hbmcheck_curve_trace(m->c, NULL, &made))
MAKES(solve_at, hbmcheck_solutions, hbmcheck_curve_at(m->curve, 4.5, &made))
MAKES(settle, hbmcheck_transient, hbmcheck_transient_run(m->c, 1, (double[]){5.2}, NULL, &made))
MAKES(compare, hbmcheck_comparison, hbmcheck_comparison_run(m->c, 1, (double[]){5.6}, NULL, &made))

static hbmcheck_status specials(material *m)
{
  hbmcheck_special out[4];
  int n = -1;
  hbmcheck_status st = hbmcheck_curve_specials(m->curve, 4, out, &n);
  return (st == HBMCHECK_OK) == (n >= 0) ? st : HBMCHECK_BUG;
}

static hbmcheck_status summary(material *m)
{
  hbmcheck_summary s = {.points = -1};
  hbmcheck_status st = hbmcheck_curve_summary(m->curve, &s);
  return (st == HBMCHECK_OK) == (s.points >= 0) ? st : HBMCHECK_BUG;
}

static hbmcheck_status contacts(material *m)
{
  hbmcheck_contact_period out[1];
  int n = -1;
  hbmcheck_status st = hbmcheck_curve_contacts(m->curve, hbmcheck_curve_points(m->curve), 0, 1, out, &n);
  return (st == HBMCHECK_OK) == (n == 1) ? st : HBMCHECK_BUG;
}

/* A curve of nothing that ours is: every mistake is tried. */
static hbmcheck_status verify(material *m)
{
  const double omega[] = {3.5, 4, 4.5, 5}, value[] = {4, 4, 5, 7};
  const hbmcheck_foreign theirs = {.quantity = "amplitude", .n = 4, .omega = omega, .value = value};
  hbmcheck_verification *v;
  char message[64];
  hbmcheck_status st = hbmcheck_verification_run(m->c, &theirs, NULL, message, sizeof message, &v);
  if ((st == HBMCHECK_OK) != (v != NULL) || (st == HBMCHECK_OK) != !*message) return HBMCHECK_BUG;
  if (st == HBMCHECK_OK && hbmcheck_verification_hypotheses(v) == 0) return HBMCHECK_BUG;
  hbmcheck_verification_free(v);
  return st;
}

static hbmcheck_status contact_force(material *m)
{
  const double u[] = {0, 0.2, 0}, v[] = {0, 6, 0};
  double T[3] = {-1}, N[3] = {-1};
  hbmcheck_status st = hbmcheck_contact_force(m->c, 0, 1, u, NULL, v, m->samples, T, NULL, N);
  return (st == HBMCHECK_OK) == (N[0] != -1) ? st : HBMCHECK_BUG;
}

static hbmcheck_status tangents(material *m)
{
  return hbmcheck_case_contact_tangents(m->c, 0) == 1 ? HBMCHECK_OK : HBMCHECK_NO_MEMORY;
}

/* Every allocation, or `most` of them where there are more, spread evenly; the first and the last ones included. */
static void without(material *m, const char *name, attempt try, int most)
{
  refused_one = asked = 0;
  assert_int_equal(try(m), HBMCHECK_OK);
  const long n = asked, tries = n < most ? n : most;
  assert_true(n > 0);
  for (long i = 0; i < tries; ++i) {
    refused_one = tries > 1 ? 1 + i * (n - 1) / (tries - 1) : 1;
    asked = 0;
    hbmcheck_status st = try(m);
    if (st != HBMCHECK_NO_MEMORY)
      fail_msg("%s without allocation %ld of %ld: %s", name, refused_one, n, hbmcheck_status_text(st));
  }
  refused_one = asked = 0;
  assert_int_equal(try(m), HBMCHECK_OK); /* and all is well again */
}

static void every_call(CHECK_STATE)
{
  material m = {.c = CASE2("sweep.omega=3,6", "hbm.harmonics=3")};
  assert_int_equal(hbmcheck_curve_trace(m.c, NULL, &m.curve), HBMCHECK_OK);
  without(&m, "hbmcheck_case_parse", parse, 100);
  without(&m, "hbmcheck_curve_trace", trace, 100);
  without(&m, "hbmcheck_curve_at", solve_at, 100);
  without(&m, "hbmcheck_curve_specials", specials, 100);
  without(&m, "hbmcheck_curve_summary", summary, 100);
  without(&m, "hbmcheck_transient_run", settle, 40);
  without(&m, "hbmcheck_comparison_run", compare, 40);
  hbmcheck_case_watch_contacts(m.c, 1);
  without(&m, "hbmcheck_transient_run, contacts watched", settle, 40);
  without(&m, "hbmcheck_comparison_run, contacts watched", compare, 40);
  without(&m, "hbmcheck_curve_contacts", contacts, 100);
  without(&m, "hbmcheck_verification_run", verify, 60);
  without(&m, "hbmcheck_contact_force, exact", contact_force, 100);
  m.samples = 64;
  without(&m, "hbmcheck_contact_force, sampled", contact_force, 100);
  without(&m, "hbmcheck_case_contact_tangents", tangents, 100);
  hbmcheck_curve_free(m.curve);
  hbmcheck_case_free(m.c);
}

CHECK_TESTS("library.memory", 300, every_call)
