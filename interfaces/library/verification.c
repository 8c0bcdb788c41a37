/* verification.c - see hbmcheck.h: another program's curve, and the likely cause of what is off. */
#include <stdio.h>
#include <stdlib.h>

#include "compare/verify/verify.h"
#include "interfaces/library/inside.h"

struct hbmcheck_verification {
  verify_data data;
  verify_report report;
  char cause[VERIFY_TEXT], guess[VERIFY_TEXT], sentence[VERIFY_TEXT];
};

/* What curve says; words[VERIFY_TEXT]: what is wrong with it. */
static hc_status read_curve(const hbmcheck_case *c, const hbmcheck_foreign *curve, verify_data *out, char *words)
{
  const int responses = hbmcheck_case_responses(c);
  hc_status st = verify_data_of(curve->quantity, curve->noise, curve->n, curve->omega, curve->value, out, words);
  if (st != HC_OK) return st;
  const char *refused = !scene_is_oscillator(&c->sc) ? verify_quantity_refused_of_structure(&out->quantity) : NULL;
  out->response = curve->response;
  if (curve->response < 0 || curve->response >= responses)
    snprintf(words, VERIFY_TEXT, "response %d: there is none, expected 0 to %d", curve->response, responses - 1);
  else if (refused) snprintf(words, VERIFY_TEXT, "%s", refused);
  return *words ? HC_BAD_INPUT : HC_OK;
}

static hc_status judge(const hbmcheck_case *c, const hbmcheck_monitor *monitor, hbmcheck_verification *v)
{
  const hc_monitor inner = library_monitor(monitor);
  compare_setup setup;
  hc_status st = scene_setup(&c->sc, &setup);
  if (st == HC_OK) st = verify_run(&setup, 1, &v->data, NULL, &inner, &v->report);
  scene_setup_clear(&setup);
  if (!has_result(st)) return st;
  verify_word(&v->report, v->cause);
  verify_cause_words(v->report.nearest_guess, v->guess);
  verify_sentence(&v->report, v->sentence);
  return st;
}

hbmcheck_status hbmcheck_verification_run(const hbmcheck_case *c, const hbmcheck_foreign *curve,
                                          const hbmcheck_monitor *monitor, char *message, size_t size,
                                          hbmcheck_verification **out)
{
  char words[VERIFY_TEXT] = "";
  if (out) *out = NULL;
  library_say(message, size, hc_status_text(HC_BAD_INPUT));
  if (!c || !out || !curve || !curve->quantity || !curve->omega || !curve->value || curve->n < 0)
    return HBMCHECK_BAD_INPUT;
  library_say(message, size, hc_status_text(HC_NO_MEMORY));
  hbmcheck_verification *v = calloc(1, sizeof *v);
  if (!v) return HBMCHECK_NO_MEMORY;
  hc_status st = read_curve(c, curve, &v->data, words);
  library_say(message, size, words);
  if (st == HC_OK) st = judge(c, monitor, v);
  if (st == HC_NO_MEMORY || (st == HC_BAD_INPUT && !*words)) library_say(message, size, hc_status_text(st));
  if (has_result(st)) *out = v;
  else hbmcheck_verification_free(v);
  return public_status(st);
}

int hbmcheck_verification_count(const hbmcheck_verification *v) { return v ? v->report.n_rows : 0; }

hbmcheck_status hbmcheck_verification_get(const hbmcheck_verification *v, int k, hbmcheck_point *out)
{
  if (!v || !out || k < 0 || k >= v->report.n_rows) return HBMCHECK_BAD_INPUT;
  const verify_row *r = &v->report.rows[k];
  const verify_quantity *q = &v->data.quantity;
  *out = (hbmcheck_point){.omega = r->omega,
                          .value = verify_quantity_to_column(q, r->value),
                          .nearest = verify_quantity_to_column(q, r->nearest),
                          .error = r->error,
                          .verdict = (hbmcheck_verdict)r->verdict,
                          .index = (int)r->line - 1,
                          .branch = r->branch,
                          .stable = r->branch >= 0 ? r->stable : 0,
                          .skipped = r->skipped};
  return HBMCHECK_OK;
}

hbmcheck_status hbmcheck_verification_findings(const hbmcheck_verification *v, hbmcheck_findings *out)
{
  if (!v || !out) return HBMCHECK_BAD_INPUT;
  const verify_report *r = &v->report;
  *out = (hbmcheck_findings){.points = r->n_rows,
                             .match = r->count[VERDICT_MATCH],
                             .differs = r->count[VERDICT_DIFFERS],
                             .unstable = r->count[VERDICT_UNSTABLE],
                             .other_branch = r->count[VERDICT_OTHER_BRANCH],
                             .solver_failed = r->count[VERDICT_SOLVER_FAILED],
                             .skipped = r->skipped,
                             .left_out = r->left_out,
                             .reversals = r->reversals,
                             .harmonics = r->harmonics,
                             .checked = r->checked,
                             .unchecked = r->unchecked,
                             .exit_code = r->status == HC_OK ? verify_exit_code(r) : 3,
                             .gate = r->gate,
                             .checked_error = r->checked_error,
                             .truth_distance = r->truth_distance,
                             .noise = r->noise};
  return HBMCHECK_OK;
}

const char *hbmcheck_verification_cause(const hbmcheck_verification *v) { return v ? v->cause : ""; }

const char *hbmcheck_verification_guess(const hbmcheck_verification *v) { return v ? v->guess : ""; }

const char *hbmcheck_verification_sentence(const hbmcheck_verification *v) { return v ? v->sentence : ""; }

static const verify_hypothesis *hypothesis_at(const hbmcheck_verification *v, int k)
{
  return k >= 0 && k < hbmcheck_verification_hypotheses(v) ? &v->report.hypotheses[k] : NULL;
}

int hbmcheck_verification_hypotheses(const hbmcheck_verification *v) { return v ? v->report.n_hypotheses : 0; }

hbmcheck_status hbmcheck_verification_hypothesis(const hbmcheck_verification *v, int k, hbmcheck_hypothesis *out)
{
  const verify_hypothesis *h = hypothesis_at(v, k);
  if (!h || !out) return HBMCHECK_BAD_INPUT;
  const verify_equations *e = &h->equations;
  const bool linear = verify_equations_linear(e);
  *out = (hbmcheck_hypothesis){.distance = h->distance,
                               .omega_factor = h->omega_factor,
                               .value_factor = h->value_factor,
                               .harmonics = linear ? 0 : e->harmonics,
                               .keep_mean = !linear && e->keep_mean,
                               .samples = e->samples,
                               .slider_restart = e->samples && e->restart != HBM_RESTART_SAMPLE};
  return HBMCHECK_OK;
}

hbmcheck_status hbmcheck_verification_hypothesis_text(const hbmcheck_verification *v, int k, char *cause,
                                                      size_t cause_size, char *quantity, size_t quantity_size)
{
  char words[VERIFY_TEXT], name[VERIFY_QUANTITY_TEXT];
  const verify_hypothesis *h = hypothesis_at(v, k);
  if (!h) return HBMCHECK_BAD_INPUT;
  library_say(cause, cause_size, verify_cause_words(h->causes, words));
  library_say(quantity, quantity_size, verify_quantity_name(&h->quantity, name));
  return HBMCHECK_OK;
}

void hbmcheck_verification_free(hbmcheck_verification *v)
{
  if (!v) return;
  verify_clear(&v->report);
  verify_data_clear(&v->data);
  free(v);
}
