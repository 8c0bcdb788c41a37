/* case2.h - case 2 of the paper as a public case, with assignments. */
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

/* set: assignments up to a NULL. */
static hbmcheck_case *case2_with(const char *const *set)
{
  char message[512];
  hbmcheck_case *c;
  int n = 0;
  while (n < CASE2_MOST_SET && set[n]) ++n;
  if (hbmcheck_case_parse("case 2", case2_text, strlen(case2_text), n, set, message, sizeof message, &c) != HBMCHECK_OK)
    fail_msg("%s", message);
  return c;
}

#define CASE2(...) case2_with((const char *const[CASE2_MOST_SET + 1]){__VA_ARGS__})
