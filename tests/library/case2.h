/* case2.h - case 2 of the paper as a public case, with assignments; and the runs of a case. */
#pragma once

#include "interfaces/library/hbmcheck.h"
#include "tests/check.h"

static const char case2_text[] =
    "oscillator: {mass: 1, damping: 0.4, stiffness: 40}\n"
    "forcing: {amplitude: 100}\n"
    "contacts:\n"
    "  - {tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.3, angle_deg: 45, gap: -5}\n"
    "sweep: {omega: [3, 20]}\n"
    "transient: {law: exact}\n";

enum { CASE2_MOST_SET = 8 };

static inline int up_to_null(const char *const *list)
{
  int n = 0;
  while (n < CASE2_MOST_SET && list[n]) ++n;
  return n;
}

/* set: assignments up to a NULL. */
static inline hbmcheck_case *case2_with(const char *const *set)
{
  char message[512];
  hbmcheck_case *c;
  if (hbmcheck_case_parse("case 2", case2_text, strlen(case2_text), up_to_null(set), set, message, sizeof message,
                          &c) != HBMCHECK_OK)
    fail_msg("%s", message);
  return c;
}

#define CASE2(...) case2_with((const char *const[CASE2_MOST_SET + 1]){__VA_ARGS__})

static inline hbmcheck_status run_with(const hbmcheck_case *c, const char *command, const hbmcheck_monitor *monitor,
                                       hbmcheck_result **out, const char *const *options)
{
  return hbmcheck_run(c, command, up_to_null(options), options, monitor, out);
}

/* The status of a run with these options, into *out. */
#define RUN(c, command, monitor, out, ...)                                                                             \
  run_with(c, command, monitor, out, (const char *const[CASE2_MOST_SET + 1]){__VA_ARGS__})

/* The table of that title; NULL without. */
static inline const hbmcheck_table *table_titled(const hbmcheck_result *r, const char *title)
{
  const hbmcheck_table *t = NULL;
  for (int i = 0; (t = hbmcheck_result_table(r, i)) && strcmp(hbmcheck_table_title(t), title) != 0;) ++i;
  return t;
}

/* Rows of the first table; 0 without. */
static inline int rows_of(const hbmcheck_result *r) { return hbmcheck_table_rows(hbmcheck_result_table(r, 0)); }
