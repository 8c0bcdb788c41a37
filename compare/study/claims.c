/* claims.c - see store.h. */
#include "compare/study/store.h"

#include <stdio.h>
#include <string.h>

#include "numerics/base/number.h"

enum { TICK_EVERY = 10000 /* of SQLite's instructions */, VALUE_TEXT = 512, ANY_COLUMNS = 0 };

const table_column *study_claims_columns(int which, int *n)
{
  static const table_column plain[] = {
      {"source", TABLE_TEXT}, {"says", TABLE_TEXT}, {"found", TABLE_TEXT}, {"holds", TABLE_TEXT}};
  static const table_column sides[] = {{"source", TABLE_TEXT},      {"says", TABLE_TEXT},
                                       {"paper_found", TABLE_TEXT}, {"paper_holds", TABLE_TEXT},
                                       {"ours_found", TABLE_TEXT},  {"ours_holds", TABLE_TEXT}};
  static const table_column steps[] = {{"source", TABLE_TEXT},           {"says", TABLE_TEXT},
                                       {"fixed_step_found", TABLE_TEXT}, {"fixed_step_holds", TABLE_TEXT},
                                       {"paper_holds", TABLE_TEXT},      {"ours_holds", TABLE_TEXT}};
  static const table_column seconds[] = {{"source", TABLE_TEXT},
                                         {"reported_s", TABLE_REAL},
                                         {"paper_s", TABLE_REAL},
                                         {"ours_s", TABLE_REAL},
                                         {"says", TABLE_TEXT}};
  switch (which) {
  case STUDY_SIDES: *n = sizeof sides / sizeof *sides; return sides;
  case STUDY_STEPS: *n = sizeof steps / sizeof *steps; return steps;
  case STUDY_SECONDS: *n = sizeof seconds / sizeof *seconds; return seconds;
  default: *n = sizeof plain / sizeof *plain; return plain;
  }
}

static hc_status blame(const study *s, const study_value *query, const char *what, const char *why, case_error *err)
{
  message m;
  message_start(&m, err->message, sizeof err->message);
  message_add_input(&m, s->name, strlen(s->name), 240);
  message_add(&m, ":%zu:%zu: `%s`: ", query->line, query->column, what);
  message_add_input(&m, why, strlen(why), 200);
  return HC_BAD_INPUT;
}

/* One query that gives that many columns. */
static hc_status prepare(const study *s, sqlite3 *db, const study_value *query, const char *what, int columns,
                         sqlite3_stmt **q, case_error *err)
{
  const char *rest = "";
  char why[128];
  if (sqlite3_prepare_v2(db, query->text, -1, q, &rest) != SQLITE_OK) {
    int code = sqlite3_errcode(db);
    blame(s, query, what, code == SQLITE_AUTH ? "may only read, expected one SELECT" : sqlite3_errmsg(db), err);
    return code == SQLITE_NOMEM ? HC_NO_MEMORY : HC_BAD_INPUT;
  }
  snprintf(why, sizeof why, "gives %d columns, expected one value", sqlite3_column_count(*q));
  const char *fault = !*q                              ? "is no query, expected one SELECT"
                      : rest[strspn(rest, " \t\r\n;")] ? "is more than one query, expected one SELECT"
                      : !sqlite3_stmt_readonly(*q)     ? "may only read, expected one SELECT"
                      : columns != ANY_COLUMNS && sqlite3_column_count(*q) != columns ? why
                                                                                      : NULL;
  if (!fault) return HC_OK;
  sqlite3_finalize(*q);
  *q = NULL;
  return blame(s, query, what, fault, err);
}

static hc_status make_views(const study *s, study_store *store, case_error *err)
{
  sqlite3 *db = study_store_readonly(store);
  hc_status st = HC_OK;
  for (int i = 0; i < s->n_views && st == HC_OK; ++i) {
    const study_view *v = &s->views[i];
    sqlite3_stmt *q = NULL;
    st = prepare(s, db, &v->query, v->name.text, ANY_COLUMNS, &q, err);
    sqlite3_finalize(q);
    if (st == HC_OK) st = study_store_view(store, v->name.text, v->query.text);
    if (st == HC_IO) st = blame(s, &v->query, v->name.text, study_store_error(store), err);
  }
  return st;
}

static hc_status check_query(const study *s, sqlite3 *db, const study_value *query, const char *what, case_error *err)
{
  sqlite3_stmt *q = NULL;
  hc_status st = query->text ? prepare(s, db, query, what, 1, &q, err) : HC_OK;
  sqlite3_finalize(q);
  return st;
}

static hc_status check_answer(const study *s, sqlite3 *db, const study_answer *a, case_error *err)
{
  hc_status st = check_query(s, db, &a->found, "found", err);
  if (st == HC_OK) st = check_query(s, db, &a->holds, "holds", err);
  return st == HC_OK ? check_query(s, db, &a->seconds, "seconds", err) : st;
}

hc_status study_claims_check(const study *s, case_error *err)
{
  study_store *empty = NULL;
  if (s->n_claims == 0 && s->n_views == 0) return HC_OK;
  hc_status st = study_store_open(s, ":memory:", "", false, &empty, err);
  if (st != HC_OK) return st;
  st = make_views(s, empty, err);
  sqlite3 *db = study_store_readonly(empty);
  for (int i = 0; i < s->n_claims * STUDY_ANSWERS && st == HC_OK; ++i)
    st = check_answer(s, db, &s->claims[i / STUDY_ANSWERS].answers[i % STUDY_ANSWERS], err);
  study_store_close(empty);
  return st;
}

static int tick(void *self) { return !hc_monitor_tick(self, -1); }

/* The one value into text[VALUE_TEXT], "" for NULL or no row at all. */
static hc_status evaluate(const study *s, sqlite3 *db, const study_value *query, const char *what, char *text,
                          case_error *err)
{
  sqlite3_stmt *q = NULL;
  *text = 0;
  hc_status st = query->text ? prepare(s, db, query, what, 1, &q, err) : HC_OK;
  int code = q ? sqlite3_step(q) : SQLITE_DONE;
  if (code == SQLITE_ROW) {
    int type = sqlite3_column_type(q, 0);
    if (type == SQLITE_FLOAT) snprintf(text, VALUE_TEXT, "%.10g", sqlite3_column_double(q, 0));
    else if (type != SQLITE_NULL) snprintf(text, VALUE_TEXT, "%s", (const char *)sqlite3_column_text(q, 0));
    code = sqlite3_step(q);
    if (code == SQLITE_ROW) st = blame(s, query, what, "gives more than one row, expected one value", err);
  }
  if (st == HC_OK && code == SQLITE_INTERRUPT) st = HC_INTERRUPTED;
  else if (st == HC_OK && code != SQLITE_DONE) {
    st = blame(s, query, what, sqlite3_errmsg(db), err);
    if (code == SQLITE_NOMEM) st = HC_NO_MEMORY;
  }
  sqlite3_finalize(q);
  return st;
}

typedef struct said {
  bool there;
  char found[VALUE_TEXT], holds[VALUE_TEXT], seconds[VALUE_TEXT];
} said;

static hc_status answer(const study *s, sqlite3 *db, const study_answer *a, said *to, case_error *err)
{
  to->there = a->holds.text != NULL;
  hc_status st = evaluate(s, db, &a->found, "found", to->found, err);
  if (st == HC_OK) st = evaluate(s, db, &a->holds, "holds", to->holds, err);
  return st == HC_OK ? evaluate(s, db, &a->seconds, "seconds", to->seconds, err) : st;
}

/* As what `expect` can be. */
static study_expectation verdict_of(const said *a)
{
  return !strcmp(a->holds, "1")   ? STUDY_EXPECT_AGREE
         : !strcmp(a->holds, "0") ? STUDY_EXPECT_DISAGREE
                                  : STUDY_EXPECT_UNSAID;
}

static void put_verdict(const said *a, table *t)
{
  static const char *const words[] = {[STUDY_EXPECT_AGREE] = "agrees",
                                      [STUDY_EXPECT_DISAGREE] = "does not agree",
                                      [STUDY_EXPECT_UNSAID] = "cannot be said"};
  if (a->there) table_put_text(t, words[verdict_of(a)]);
  else table_put_missing(t);
}

/* Count the verdict, and put it with its evidence. */
static void put_answer(const study_claim *c, int which, const said *a, table *t, study_claims_tally *tally)
{
  static const char *const with[STUDY_ANSWERS] = {"", " with the source's settings", " with ours", " in fixed steps"};
  table_put_text(t, *a->found ? a->found : NULL);
  put_verdict(a, t);
  if (!a->there) return;
  study_expectation expect = c->answers[which].expect, is = verdict_of(a);
  ++*(is == STUDY_EXPECT_AGREE      ? &tally->agree[which]
      : is == STUDY_EXPECT_DISAGREE ? &tally->disagree[which]
                                    : &tally->unsaid[which]);
  const char *source = c->source.text ? c->source.text : "a claim";
  if (expect != STUDY_EXPECT_UNSAID && !*a->holds)
    table_note(t, "no row answers%s: %s: %s", with[which], source, c->says.text);
  if (expect == STUDY_EXPECT_NOTHING || expect == is) return;
  ++tally->unexpected;
  table_note(t, "not as expected%s: %s: %s", with[which], source, c->says.text);
}

static void put_claim(const study_claim *c, const said a[STUDY_ANSWERS], table *const t[STUDY_CLAIM_TABLES],
                      study_claims_tally *tally)
{
  if (a[STUDY_PLAIN].there) {
    table_put_text(t[STUDY_CLAIMS], c->source.text);
    table_put_text(t[STUDY_CLAIMS], c->says.text);
    put_answer(c, STUDY_PLAIN, &a[STUDY_PLAIN], t[STUDY_CLAIMS], tally);
  } else if (a[STUDY_PAPER].there || a[STUDY_OURS].there) {
    table_put_text(t[STUDY_SIDES], c->source.text);
    table_put_text(t[STUDY_SIDES], c->says.text);
    for (int k = STUDY_PAPER; k <= STUDY_OURS; ++k) put_answer(c, k, &a[k], t[STUDY_SIDES], tally);
  }
  if (a[STUDY_FIXED_STEP].there) {
    table_put_text(t[STUDY_STEPS], c->source.text);
    table_put_text(t[STUDY_STEPS], c->says.text);
    put_answer(c, STUDY_FIXED_STEP, &a[STUDY_FIXED_STEP], t[STUDY_STEPS], tally);
    for (int k = STUDY_PAPER; k <= STUDY_OURS; ++k) put_verdict(&a[k], t[STUDY_STEPS]);
  }
  if (!(c->seconds >= 0) && !*a[STUDY_PAPER].seconds && !*a[STUDY_OURS].seconds) return;
  table_put_text(t[STUDY_SECONDS], c->source.text);
  table_put_real(t[STUDY_SECONDS], c->seconds);
  for (int k = STUDY_PAPER; k <= STUDY_OURS; ++k) {
    double x;
    if (number_read(a[k].seconds, strlen(a[k].seconds), &x) == NUMBER_FINE)
      table_put_real(t[STUDY_SECONDS], (double)(long long)(x * 1e5 + 0.5) / 1e5);
    else table_put_missing(t[STUDY_SECONDS]);
  }
  table_put_text(t[STUDY_SECONDS], c->says.text);
}

hc_status study_claims_run(const study *s, study_store *store, const hc_monitor *stop,
                           table *const t[STUDY_CLAIM_TABLES], study_claims_tally *tally, case_error *err)
{
  hc_status st = make_views(s, store, err);
  sqlite3 *db = study_store_readonly(store);
  hc_monitor monitor = *stop;
  sqlite3_progress_handler(db, TICK_EVERY, tick, &monitor);
  for (int i = 0; i < s->n_claims && st == HC_OK; ++i) {
    said a[STUDY_ANSWERS];
    for (int k = 0; k < STUDY_ANSWERS && st == HC_OK; ++k) st = answer(s, db, &s->claims[i].answers[k], &a[k], err);
    if (st == HC_OK) put_claim(&s->claims[i], a, t, tally);
  }
  sqlite3_progress_handler(db, 0, NULL, NULL);
  return st;
}
