/* test_advice.c - what is advised is never what is set already: every failure of either side under every combination of
 * the settings that advice names. About a discrepancy: tests/command/advice.py. */
#include "compare/advice.h"
#include "tests/check.h"

/* `advised` in the text only where it would change something; the text is "" or begins as advice does. */
static void check(const char *text, const char *advised, bool so_already, int failure)
{
  if (so_already && strstr(text, advised)) fail_msg("%s: '%s' is so already", hc_status_text((hc_status)failure), text);
}

static void hbm_is_never_advised_what_it_has(CHECK_STATE)
{
  char text[ADVICE_TEXT];
  for (int failure = HC_OK; failure <= HC_BUG; ++failure)
    for (int i = 0; i < 4 * 2 * 2; ++i) {
      const hbm_settings how = {.continuation = (hbm_continuation)(i % 4),
                                .force = (hbm_force)(i / 4 % 2),
                                .tolerance = i / 8 ? 1e-14 : 1e-10,
                                .step = 0.02};
      advice_for_hbm(&how, (hc_status)failure, text);
      check(text, "hbm.continuation=auto", how.continuation == HBM_CONTINUATION_AUTO, failure);
      check(text, "hbm.force=exact", how.force == HBM_FORCE_EXACT, failure);
      check(text, "hbm.force=sampled", how.force == HBM_FORCE_SAMPLED, failure);
      check(text, "hbm.tolerance=1e-10", how.tolerance == 1e-10, failure);
      check(text, "hbm.step", how.continuation != HBM_CONTINUATION_FIXED_STEP, failure);
      CHECK_LE((int)strlen(text), ADVICE_TEXT - 2, "%s", text);
    }
}

static void the_transient_is_never_advised_what_it_has(CHECK_STATE)
{
  char text[ADVICE_TEXT];
  for (int failure = HC_OK; failure <= HC_BUG; ++failure)
    for (int i = 0; i < 2 * 3 * 4 * 2; ++i) {
      const bool ends = i / 24;
      const transient_settings how = {.law = (transient_law)(i % 2),
                                      .steady = (transient_steady)(i / 2 % 3),
                                      .start = (transient_start)(i / 6 % 4),
                                      .regularisation = ends ? TRANSIENT_MOST_REGULARISATION : 1e-4,
                                      .tolerance = ends ? TRANSIENT_LEAST_TOLERANCE : 1e-9,
                                      .max_periods = ends ? TRANSIENT_MOST_PERIODS : 20000};
      advice_for_transient(&how, (hc_status)failure, text);
      check(text, "law=exact", how.law == TRANSIENT_LAW_EXACT, failure);
      check(text, "law=regularised", how.law == TRANSIENT_LAW_REGULARISED, failure);
      check(text, "steady_state=march", how.steady == TRANSIENT_STEADY_MARCH, failure);
      check(text, "start=hbm", how.start == TRANSIENT_START_HBM, failure);
      check(text, "transient.regularisation", ends || how.law == TRANSIENT_LAW_EXACT, failure);
      check(text, "transient.tolerance", ends, failure);
      check(text, "transient.max_periods", ends, failure);
    }
}

static void advice_is_a_sentence(CHECK_STATE)
{
  char text[ADVICE_TEXT];
  hbm_settings hbm = {.continuation = HBM_CONTINUATION_NATURAL, .force = HBM_FORCE_SAMPLED, .tolerance = 1e-10};
  assert_string_equal(advice_for_hbm(&hbm, HC_NOT_CONVERGED, text),
                      "try --set hbm.continuation=auto or --set hbm.force=exact");
  hbm.continuation = HBM_CONTINUATION_AUTO;
  assert_string_equal(advice_for_hbm(&hbm, HC_SINGULAR, text), "try --set hbm.force=exact");
  hbm.force = HBM_FORCE_EXACT;
  assert_string_equal(advice_for_hbm(&hbm, HC_NOT_CONVERGED, text), "try another number of --set hbm.harmonics=...");
  assert_string_equal(advice_for_hbm(&hbm, HC_BUG, text), "");
  assert_non_null(strstr(advice_on_size(0), "damping is 0"));
  assert_null(strstr(advice_on_size(0.4), "damping"));
  transient_settings tr = {.start = TRANSIENT_START_HBM, .max_periods = TRANSIENT_MOST_PERIODS};
  assert_string_equal(advice_for_transient(&tr, HC_NOT_SETTLED, text), "");
  tr.law = TRANSIENT_LAW_EXACT, tr.method = TRANSIENT_METHOD_CLOSED_FORM;
  assert_string_equal(advice_for_transient(&tr, HC_CHATTER, text),
                      "try --set transient.law=regularised --set transient.method=cvode, which count no transitions");
}

CHECK_TESTS("compare.advice", 60, hbm_is_never_advised_what_it_has, the_transient_is_never_advised_what_it_has,
            advice_is_a_sentence)
