/* gate.c - see gate.h. The reference of each solution is decided in judge_solution(), and nowhere else. */
#include "compare/gate/gate.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "compare/gate_limits.h"
#include "compare/motion.h"
#include "numerics/base/constants.h"
#include "numerics/base/growing.h"
#include "numerics/base/thread_clock.h"
#include "numerics/base/utf8.h"

/* clang-format off */
static const struct quantity { const char *name; size_t offset; } quantities[] = {
#define QUANTITY(q) {#q, offsetof(discrepancy, q)}
  QUANTITY(amplitude), QUANTITY(harmonic_1), QUANTITY(mean), QUANTITY(waveform)
#undef QUANTITY
};
/* clang-format on */
enum { N_QUANTITIES = sizeof quantities / sizeof *quantities, MEAN = 2 };

static double at(const discrepancy *d, int q)
{
  return *(const double *)(const void *)((const char *)d + quantities[q].offset);
}

const char *gate_result_name(gate_result r)
{
  static const char *const names[] = {
      [GATE_PASS] = "pass", [GATE_FAIL] = "fail", [GATE_ERROR] = "error", [GATE_NOT_APPLICABLE] = "not_applicable"};
  return names[r];
}

static bool within(double found, double allowed) { return found <= allowed * (1 + GATE_SLACK); } /* false for NaN */

/* ---- collecting ---- */

typedef struct judge {
  const compare_setup *setup;
  const comparison *c;
  gate_case *out;
  hc_status st; /* HC_NO_MEMORY from then on */
} judge;

static void add(judge *j, const gate_check *check)
{
  gate_case *g = j->out;
  if (!GROW(g->checks, g->n)) {
    j->st = HC_NO_MEMORY;
    return;
  }
  g->checks[g->n++] = *check;
  g->failures += check->result == GATE_FAIL;
  g->errors += check->result == GATE_ERROR;
  g->not_applicable += check->result == GATE_NOT_APPLICABLE;
}

/* A check of `row` (NULL: of the curve), initially GATE_PASS. */
static gate_check check_of(const comparison_row *row, const char *quantity, const char *against)
{
  gate_check c = {.branch = -1, .response = -1, .quantity = quantity, .against = against, .result = GATE_PASS};
  c.omega = c.allowed = c.found = NAN;
  if (row) c.omega = row->omega, c.branch = row->branch, c.response = row->response;
  if (row) comparison_verdict_text(row, c.verdict);
  return c;
}

__attribute__((format(printf, 3, 4))) static void not_passed(gate_check *c, gate_result result, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(c->reason, sizeof c->reason, format, args);
  va_end(args);
  c->result = result;
}

/* ---- one HBM solution ---- */

/* Adds a check for each quantity of the discrepancy from `motion`, the transient or the orbit. */
static void check_errors(judge *j, const comparison_row *r, const discrepancy *errors, const timeint_result *motion,
                         const char *against)
{
  const discrepancy most = gate_limits_at(j->setup->limits, r->omega);
  for (int q = 0; q < N_QUANTITIES; ++q) {
    gate_check c = check_of(r, quantities[q].name, against);
    c.allowed = at(&most, q);
    c.found = at(errors, q);
    if (r->still)
      not_passed(&c, GATE_NOT_APPLICABLE, "not applicable: it moves less than 1e-9 of the largest response");
    else if (q == MEAN && motion_mean_is_free(motion))
      not_passed(&c, GATE_NOT_APPLICABLE, "not applicable: a slider never slips, and the mean depends on the history");
    else if (isnan(c.found)) not_passed(&c, GATE_ERROR, "it is not a number");
    else if (!within(c.found, c.allowed)) c.result = GATE_FAIL;
    add(j, &c);
  }
}

/* With gate.band, of each solution with a band; one that may be wider has not passed. */
static void judge_band(judge *j, const comparison_row *r)
{
  gate_check c = check_of(r, "band", "limit");
  c.allowed = j->setup->limits->band;
  c.found = band_width(&r->band);
  if (c.allowed == 0 || r->band.kind == BAND_NONE || r->branch < 0) return;
  const bool free = r->hbm_status == HC_OK && r->hbm.contact.free_sliders > 0;
  if (r->still || !free) return;
  if (isnan(c.found))
    not_passed(&c, GATE_ERROR, "the band of steady states is not known: it was not asked, or not found");
  else if (!within(c.found, c.allowed)) c.result = GATE_FAIL;
  else if (r->band.kind == BAND_AT_LEAST)
    not_passed(&c, GATE_ERROR, "the band is this wide at least: several sliders never slip, or an end was not found");
  add(j, &c);
}

static void judge_transient(judge *j, const comparison_row *r)
{
  gate_check c = check_of(r, "transient", "transient");
  if (r->accounted) c.result = GATE_PASS;
  else if (r->verdict == VERDICT_PERIOD_K)
    not_passed(&c, GATE_FAIL, "the transient repeats only after %d forcing periods: no HBM solution is what happens",
               r->transient.period_multiple);
  else if (r->verdict == VERDICT_APERIODIC)
    not_passed(&c, GATE_FAIL, "the transient never repeats: no HBM solution is what happens");
  else
    not_passed(&c, GATE_FAIL, "the transient runs elsewhere, and no HBM solution at this omega is within the limits");
  add(j, &c);
}

static void judge_orbit(judge *j, const comparison_row *r)
{
  if (r->orbit_status == HC_OK) {
    check_errors(j, r, &r->orbit_errors, &r->orbit, "orbit");
    return;
  }
  gate_check c = check_of(r, "orbit", NULL);
  not_passed(&c, GATE_ERROR, "no exact orbit was found next to this HBM solution: %s", hc_status_text(r->orbit_status));
  add(j, &c);
}

static void judge_solution(judge *j, const comparison_row *r)
{
  judge_band(j, r);
  gate_check lost = check_of(r, "solution", NULL);
  switch (r->verdict) {
  case VERDICT_MATCH:
  case VERDICT_FAMILY:
  case VERDICT_DIFFERS: check_errors(j, r, &r->errors, &r->transient, "transient"); return;
  case VERDICT_UNSTABLE:
  case VERDICT_OTHER_BRANCH:
  case VERDICT_PERIOD_K:
  case VERDICT_APERIODIC:
  case VERDICT_UNDECIDED:
    judge_orbit(j, r);
    judge_transient(j, r);
    return;
  default: break;
  }
  const bool goes_away = r->verdict == VERDICT_CREEPS || r->verdict == VERDICT_UNBOUNDED;
  if (r->hbm_status != HC_OK && !goes_away)
    not_passed(&lost, GATE_ERROR, "harmonic balance: %s", hc_status_text(r->hbm_status));
  else not_passed(&lost, GATE_ERROR, "time integration: %s", hc_status_text(r->transient_status));
  add(j, &lost);
}

/* ---- the response curve ---- */

static void judge_cost(judge *j, const char *quantity, int allowed, long found)
{
  gate_check c = check_of(NULL, quantity, "limit");
  if (allowed == 0) return;
  c.allowed = allowed;
  c.found = (double)found;
  if (found > allowed) c.result = GATE_FAIL;
  add(j, &c);
}

static void judge_curve(judge *j)
{
  gate_check c = check_of(NULL, "curve", NULL);
  const hbm_curve *curve = &j->c->curve;
  if (curve->end != HC_OK && curve->n > 0)
    not_passed(&c, GATE_ERROR, "the HBM curve stopped at omega = %.10g: %s", curve->ends_at,
               hc_status_text(curve->end));
  else if (curve->end != HC_OK)
    not_passed(&c, GATE_ERROR, "the HBM curve has no points: %s", hc_status_text(curve->end));
  else if (j->c->n_rows == 0) not_passed(&c, GATE_ERROR, "nothing was compared");
  if (c.result != GATE_PASS) add(j, &c);
  judge_cost(j, "iterations", j->setup->limits->iterations, j->c->summary.iterations);
  judge_cost(j, "evaluations", j->setup->limits->evaluations, j->c->summary.evaluations);
}

/* ---- the case ---- */

static void judge_nonlinearity(judge *j)
{
  gate_check c = check_of(NULL, "nonlinear", "limit");
  j->out->n_rows = j->c->n_rows;
  j->out->linear = j->c->n_rows > 0 && !comparison_nonlinear(j->c);
  if (j->setup->limits->nonlinear != GATE_NONLINEAR_REQUIRED) return;
  if (j->out->linear) not_passed(&c, GATE_FAIL, COMPARISON_LINEAR, j->c->n_rows);
  add(j, &c);
}

hc_status gate_add_proof(gate_case *g, const compare_setup *setup, double omega, int branch, const char *unproven,
                         double error)
{
  judge j = {.setup = setup, .out = g, .st = HC_OK};
  gate_check c = check_of(NULL, "proven", isnan(error) ? NULL : "orbit");
  c.omega = omega;
  c.branch = branch;
  if (branch >= 0) c.allowed = gate_limits_at(setup->limits, omega).amplitude;
  if (unproven) not_passed(&c, GATE_FAIL, "unproven: %s", unproven);
  else if (branch >= 0 && isnan(error))
    not_passed(&c, GATE_NOT_APPLICABLE,
               "not applicable: a slider was on the verge of slip; proven is another one's orbit");
  else if (branch >= 0 && !within(c.found = error, c.allowed)) c.result = GATE_FAIL;
  add(&j, &c);
  return j.st;
}

hc_status gate_judge(const char *name, const compare_setup *setup, const comparison *c, gate_case *out)
{
  *out = (gate_case){.name = name, .in_cycles = setup->limits->ranges.in_cycles};
  judge j = {setup, c, out, HC_OK};
  for (int i = 0; i < c->n_rows; ++i) judge_solution(&j, &c->rows[i]);
  judge_curve(&j);
  judge_nonlinearity(&j);
  return j.st;
}

/* The check of a comparison that failed as a whole. */
static hc_status judge_failure(hc_status failure, gate_case *out)
{
  judge j = {.out = out, .st = HC_OK};
  gate_check c = check_of(NULL, "comparison", NULL);
  not_passed(&c, GATE_ERROR, "it could not be made: %s", hc_status_text(failure));
  add(&j, &c);
  return j.st;
}

hc_status gate_run(const char *name, const compare_setup *setup, const hc_monitor *monitor, gate_case *out)
{
  comparison c;
  compare_setup spare = *setup;
  spare.spare = true;
  const double began = thread_seconds();
  hc_status st = comparison_run(&spare, monitor, &c);
  hc_status judged = gate_judge(name, setup, &c, out);
  out->seconds = thread_seconds() - began;
  comparison_clear(&c);
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return st;
  return st != HC_OK && judged == HC_OK ? judge_failure(st, out) : judged;
}

gate_case gate_of_wrong_case(const char *name, const char *wrong)
{
  return (gate_case){.name = name, .wrong = wrong, .errors = 1};
}

void gate_clear(gate_case *g)
{
  free(g->checks);
  *g = (gate_case){0};
}

/* ---- what is shown ---- */

enum { GATE_PLACE = 32 };

/* "omega 7", or "frequency 345" in cycles, in text[GATE_PLACE], which is returned. */
static const char *gate_place(const gate_case *g, double omega, char text[GATE_PLACE])
{
  if (g->in_cycles) snprintf(text, GATE_PLACE, "frequency %.10g", omega / TWO_PI);
  else snprintf(text, GATE_PLACE, "omega %.10g", omega);
  return text;
}

const char *gate_response(const gate_case *g, const gate_check *c)
{
  return g->responses && c->response >= 0 ? g->responses[c->response] : NULL;
}

double gate_shown(const gate_check *c)
{
  if (!isfinite(c->found) || !strcmp(c->against, "limit")) return c->found;
  if (c->found <= GATE_SLACK * c->allowed) return 0;
  for (int digits = 3; digits < 17; ++digits) {
    char text[32];
    snprintf(text, sizeof text, "%.*e", digits - 1, c->found);
    double shown = strtod(text, NULL);
    if ((shown <= c->allowed) == (c->result == GATE_PASS)) return shown;
  }
  return c->found;
}

bool gate_is_worst(const gate_case *g, int i)
{
  const gate_check *c = &g->checks[i];
  for (int k = 0; k < g->n; ++k) {
    const gate_check *other = &g->checks[k];
    if (k == i || strcmp(other->quantity, c->quantity)) continue;
    const bool idle = c->result == GATE_NOT_APPLICABLE, other_idle = other->result == GATE_NOT_APPLICABLE;
    if (idle && !other_idle) return false;
    if (other_idle && !idle) continue;
    /* gate_shown: values below GATE_SLACK count as 0, so that noise does not rank */
    double mine = gate_shown(c) / c->allowed, theirs = gate_shown(other) / other->allowed;
    if (theirs > mine || (!(mine > theirs) && k < i))
      return false; /* among equal ones, and those without numbers, the first is the worst */
  }
  return true;
}

int gate_exit_code(int n, const gate_case *cases)
{
  int failures = 0, errors = 0;
  for (int i = 0; i < n; ++i) failures += cases[i].failures, errors += cases[i].errors;
  return failures ? 1 : errors ? 3 : 0;
}

/* ---- JUnit  ---------------------------------------------------------------------------------- */

typedef struct junit {
  FILE *to;
  hc_status st; /* HC_NO_MEMORY from then on */
} junit;

/* Escapes text for an attribute or between tags; utf8_clean replaces what XML 1.0 does not allow by spaces. */
static void put_text(junit *x, const char *raw)
{
  char *text = x->st == HC_OK ? utf8_clean(raw, true) : NULL;
  if (!text) x->st = HC_NO_MEMORY;
  for (const char *p = text; p && *p; ++p) {
    if (*p == '&') fputs("&amp;", x->to);
    else if (*p == '<') fputs("&lt;", x->to);
    else if (*p == '>') fputs("&gt;", x->to);
    else if (*p == '"') fputs("&quot;", x->to);
    else putc(*p, x->to);
  }
  free(text);
}

static void put_attribute(junit *x, const char *name, const char *value)
{
  fprintf(x->to, " %s=\"", name);
  put_text(x, value);
  putc('"', x->to);
}

/* The counts and the time of one case, or the sums of several. */
static void put_counts(junit *x, const gate_case *g)
{
  fprintf(x->to, " tests=\"%d\" failures=\"%d\" errors=\"%d\" skipped=\"%d\" time=\"%.3f\">\n", g->wrong ? 1 : g->n,
          g->failures, g->errors, g->not_applicable, g->seconds);
}

static void begin_case(junit *x, const char *suite, const char *name)
{
  fputs("    <testcase", x->to);
  put_attribute(x, "classname", suite);
  put_attribute(x, "name", name);
}

static void put_check(junit *x, const gate_case *g, const gate_check *c)
{
  static const char *const tags[] = {
      [GATE_PASS] = "", [GATE_FAIL] = "failure", [GATE_ERROR] = "error", [GATE_NOT_APPLICABLE] = "skipped"};
  char name[512], words[GATE_REASON + 96];
  char place[GATE_PLACE];
  const char *response = gate_response(g, c);
  if (isnan(c->omega)) snprintf(name, sizeof name, "response curve: %s", c->quantity);
  else if (c->branch < 0) snprintf(name, sizeof name, "%s: %s", gate_place(g, c->omega, place), c->quantity);
  else
    snprintf(name, sizeof name, "%s branch %d%s%s: %s", gate_place(g, c->omega, place), c->branch,
             response ? " response " : "", response ? response : "", c->quantity);
  char found[NUMBER_TEXT], allowed[NUMBER_TEXT];
  number_write(gate_shown(c), found);
  number_write(c->allowed, allowed);
  if (*c->reason) snprintf(words, sizeof words, "%s", c->reason);
  else if (!strcmp(c->against, "limit"))
    snprintf(words, sizeof words, "%s %s, at most %s allowed", found, c->quantity, allowed);
  else
    snprintf(words, sizeof words, "%s is off the %s by %s of its amplitude, %s allowed (verdict %s)", c->quantity,
             c->against, found, allowed, c->verdict);
  begin_case(x, g->name, name);
  if (c->result == GATE_PASS) {
    fputs("/>\n", x->to);
    return;
  }
  fprintf(x->to, ">\n      <%s", tags[c->result]);
  put_attribute(x, "message", words);
  if (c->result == GATE_NOT_APPLICABLE) fputs("/>", x->to);
  else {
    put_attribute(x, "type", c->quantity);
    putc('>', x->to);
    put_text(x, g->name);
    fputs(", ", x->to);
    put_text(x, name);
    fputs(": ", x->to);
    put_text(x, words);
    fprintf(x->to, "</%s>", tags[c->result]);
  }
  fputs("\n    </testcase>\n", x->to);
}

static void put_wrong(junit *x, const gate_case *g)
{
  begin_case(x, g->name, "case file");
  fputs(">\n      <error", x->to);
  put_attribute(x, "message", g->wrong);
  put_attribute(x, "type", "case file");
  putc('>', x->to);
  put_text(x, g->wrong);
  fputs("</error>\n    </testcase>\n", x->to);
}

hc_status gate_write_junit(int n, const gate_case *cases, FILE *to)
{
  junit x = {to, HC_OK};
  gate_case all = {0};
  for (int i = 0; i < n; ++i) {
    const gate_case *g = &cases[i];
    all.n += g->wrong ? 1 : g->n;
    all.failures += g->failures, all.errors += g->errors, all.not_applicable += g->not_applicable;
    all.seconds += g->seconds;
  }
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"hbmcheck gate\"", to);
  put_counts(&x, &all);
  for (int i = 0; i < n && x.st == HC_OK; ++i) {
    const gate_case *g = &cases[i];
    fputs("  <testsuite", to);
    put_attribute(&x, "name", g->name);
    put_counts(&x, g);
    if (g->wrong) put_wrong(&x, g);
    for (int k = 0; k < g->n && x.st == HC_OK; ++k) put_check(&x, g, &g->checks[k]);
    fputs("  </testsuite>\n", to);
  }
  fputs("</testsuites>\n", to);
  return x.st != HC_OK ? x.st : ferror(to) ? HC_IO : HC_OK;
}
