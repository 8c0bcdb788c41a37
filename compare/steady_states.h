/* steady_states.h - the steady states of a model by time integration at the frequencies of compare.omega, from where
 * transient.start says: on each HBM solution's orbit, at rest, or swept from an end of the sweep, as on a shaker. */
#pragma once

#include "compare/compare_settings.h"
#include "compare/response.h"
#include "model/contact_period.h"
#include "numerics/base/status.h"
#include "timeint/steady/steady.h"

/* A row can fail in one of three ways, so that a message can say which side it was. */
typedef enum { STEADY_TRANSIENT, STEADY_SWEEP, STEADY_HBM } steady_stage;

typedef struct steady_row {
  int response;                      /* of the model, counted from 0: a row for each, the first one's first */
  char response_name[RESPONSE_NAME]; /* in words, where it has been given one; else empty */
  hc_status status;                  /* HC_OK, HC_NOT_SETTLED (result is the last period), or what failed */
  steady_stage stage;    /* where it failed; beyond STEADY_TRANSIENT there is no result but omega: no row to show */
  hc_status without_hbm; /* why an HBM start became a start at rest; HC_OK: it did not */
  timeint_result result;
  double from_regularisation; /* [1] estimated error of the amplitude, relative, by the exact law's orbit next to it;
                                 NaN: not known */
  char start[32];             /* "rest", "up", "down", "hbm branch 2" */
} steady_row;

/* One contact along one steady state. */
typedef struct steady_contact {
  double omega;
  char start[32];           /* of its row */
  int contact;              /* counted from 0, as in the case: a pair is one */
  char name[RESPONSE_NAME]; /* of the contact, or empty */
  contact_period period;
} steady_contact;

typedef struct steady_states {
  int n, n_contacts;
  steady_row *rows;
  steady_contact *contacts; /* with setup.contacts: every contact of every state that was measured, in that order */
} steady_states;

/* HC_OK even when single rows failed: they say so. HC_BAD_INPUT without compare.omega. After an interrupt, and else,
 * what was found is kept; the row that was interrupted is the last. Free with steady_states_clear in any case. */
hc_status steady_states_run(const compare_setup *setup, const hc_monitor *monitor, steady_states *out);
void steady_states_clear(steady_states *s);

/* "settled", "unstable", "period_2", "aperiodic", "not_settled", "unbounded", "creeps", "solver_failed" in text[24],
 * which is returned. */
const char *steady_verdict_text(const steady_row *row, char text[24]);
