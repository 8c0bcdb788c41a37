/* verify.c - see verify.h. Here: the order of the steps. What the points of a response tell by themselves comes first,
 * since no other equations are needed for it; but noise that was not asked for last, since a mistake may look like it.
 * What is left is searched for in all responses together. */
#include "compare/verify/verify.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/verify/search/search.h"
#include "compare/verify/truth/truth.h"
#include "compare/work_limit.h"
#include "numerics/base/message.h"

/* How many points are known to differ. */
static int differing(const verify_report *r)
{
  int differ = 0;
  for (int i = 0; i < r->n_rows; ++i) differ += !r->rows[i].skipped && r->rows[i].verdict == VERDICT_DIFFERS;
  return differ;
}

/* The truth of one response, as far as it is found before `until` [s], and what its points tell by themselves. */
static hc_status judge_response(const compare_setup *setup, const verify_data *data, double until,
                                const hc_monitor *monitor, verify_curves *curves, verify_report *out)
{
  work_limit limit = {.outer = monitor, .until = until};
  if (data->response < 0 || data->response >= setup->model->n_responses) return HC_BAD_INPUT;
  hc_status st = verify_truth(setup, data, until, &(hc_monitor){work_limit_tick, &limit}, curves, out);
  if (st == HC_INTERRUPTED && !limit.stopped && out->rows) {
    for (int i = out->n_rows; i < data->n; out->n_rows = ++i) out->rows[i] = verify_row_unjudged(&data->points[i]);
    st = HC_OK;
  }
  if (st == HC_OK) st = points_noise(out);
  if (st != HC_OK) return st;
  out->causes = points_branches(out) | points_outliers(out);
  if (!out->causes && differing(out) >= VERIFY_LEAST_DIFFERING) {
    out->causes = points_interpolated(out) ? points_interpolated(out) : points_scattered(out);
    if (!out->causes) st = points_anywhere(out, &out->causes);
    if (st != HC_OK) return st;
  }
  return !out->causes && data->noise > 0 && differing(out) ? points_scatter(out, &out->causes) : HC_OK;
}

/* One cause of all responses that are wrong without one of their own: the search's, and if that has none, what the
 * points of all of them look like. */
static hc_status find_cause(const compare_setup *setup, int n, const verify_judged *judged, const int *number,
                            const verify_effort *effort, const hc_monitor *monitor, const verify_curves *curves,
                            verify_report *out)
{
  int response[SEARCH_MOST_RESPONSES], first = -1;
  compare_setup own = *setup;
  model *seen;
  for (int k = n - 1; k >= 0; --k) {
    response[k] = judged[k].data->response;
    if (judged[k].wrong) first = k;
  }
  hc_status st = verify_model_seen(setup->model, n, response, &seen);
  own.model = seen;
  verify_report *found = &out[number[first]];
  if (st == HC_OK) st = verify_search(&own, n, judged, effort, monitor, curves, found);
  model_free(seen);
  verify_causes scatter = 0;
  for (int k = 0; k < n && st == HC_OK && !found->causes; ++k) {
    verify_causes one;
    if (!judged[k].wrong) continue;
    st = points_scatter(judged[k].report, &one);
    scatter = k == first ? one : scatter & one;
  }
  if (scatter && !verify_fits(found)) found->nearest_guess = scatter;
  for (int k = 0; k < n; ++k) {
    verify_report *to = &out[number[k]];
    if (!judged[k].wrong || to == found) continue;
    to->causes = found->causes;
    to->nearest_guess = found->nearest_guess;
    to->unsolved = found->unsolved;
    to->n_hypotheses = found->n_hypotheses;
    to->truth_distance = found->truth_distance;
    memcpy(to->hypotheses, found->hypotheses, sizeof found->hypotheses);
    memcpy(to->tried, found->tried, sizeof found->tried);
    memcpy(to->not_tried, found->not_tried, sizeof found->not_tried);
  }
  return st;
}

/* Those that are searched together: the wrong ones first, then as many right ones as there is room for. */
static hc_status find_causes(const compare_setup *setup, int n, const verify_data *data, const verify_effort *effort,
                             const hc_monitor *monitor, const verify_curves *curves, verify_report *out)
{
  verify_judged judged[SEARCH_MOST_RESPONSES];
  int number[SEARCH_MOST_RESPONSES], together = 0, wrong = 0;
  for (int right = 0; right < 2; ++right) {
    for (int k = 0; k < n && together < SEARCH_MOST_RESPONSES; ++k) {
      const bool off = differing(&out[k]) >= VERIFY_LEAST_DIFFERING;
      if (out[k].causes || off == right) continue;
      number[together] = k;
      judged[together++] = (verify_judged){&data[k], &out[k], off};
      wrong += off;
    }
  }
  return wrong ? find_cause(setup, together, judged, number, effort, monitor, curves, out) : HC_OK;
}

hc_status verify_run(const compare_setup *setup, int n, const verify_data *data, const verify_effort *effort,
                     const hc_monitor *monitor, verify_report *out)
{
  const double patience = effort && effort->patience > 0 ? effort->patience : VERIFY_PATIENCE, began = thread_seconds();
  verify_effort left = effort ? *effort : (verify_effort){0};
  verify_curves curves = {.model = setup->model};
  hc_status st = HC_OK;
  for (int k = 0; k < n; ++k) {
    out[k] = (verify_report){.truth_distance = NAN,
                             .noise = NAN,
                             .noise_said = data[k].noise,
                             .left_out = data[k].left_out,
                             .reversals = points_reversals(&data[k])};
    if (st == HC_OK) st = judge_response(setup, &data[k], began + patience, monitor, &curves, &out[k]);
  }
  left.patience = fmax(patience - (thread_seconds() - began), patience / 4); /* [s] for the search */
  if (st == HC_OK) st = find_causes(setup, n, data, &left, monitor, &curves, out);
  verify_curves_clear(&curves);
  for (int k = 0; k < n; ++k) {
    verify_report *r = &out[k];
    for (int i = 0; i < r->n_rows; ++i) ++*(r->rows[i].skipped ? &r->skipped : &r->count[r->rows[i].verdict]);
    r->status = st;
  }
  return st;
}

void verify_clear(verify_report *r)
{
  free(r->rows);
  free(r->line);
  *r = (verify_report){0};
}

int verify_exit_code(const verify_report *r)
{
  if (r->causes || r->count[VERDICT_DIFFERS] > 0 || r->count[VERDICT_OTHER_BRANCH] > 0) return 1;
  if (r->count[VERDICT_SOLVER_FAILED] > 0 || r->n_rows == 0) return 3;
  const bool all_on_orbits = r->on_orbits == r->n_rows - r->skipped;
  return (r->on_orbits > 0 && all_on_orbits) || (r->checked > 0 && r->checked_error <= r->gate) ? 0 : 3;
}

const char *verify_word(const verify_report *r, char text[VERIFY_TEXT])
{
  const bool known = r->causes || (r->status == HC_OK && verify_exit_code(r) == 0);
  return known ? verify_cause_words(r->causes, text) : "unknown";
}

/* ---- causes as words for scripts and as a sentence for people ---- */

/* "42 %" or "2e-06". */
static void add_distance(message *m, double d)
{
  if (d >= 1e-3) message_add(m, "%.2g %%", 100 * d);
  else message_add(m, "%.1g", d);
}

/* "kt of contact 1 times 2", "the force at DOF 3", "M, C and K exchanged in DOFs 1 and 2": DOFs from 1, contacts from 0
 * as elsewhere. */
static void add_change(message *m, const verify_equations *e)
{
  message_add(m, "%s", verify_changes[e->change].words);
  if (e->which > 0) switch (verify_changes[e->change].part) {
    case PART_CONTACT:
    case PART_ONE_CONTACT: message_add(m, " of contact %d", e->which - 1); break;
    case PART_POWER:
      message_add(m, " of contact %d's power %d", (e->which - 1) / CONTACT_POWERS,
                  (e->which - 1) % CONTACT_POWERS + CONTACT_LEAST_POWER);
      break;
    case PART_DOF: message_add(m, " DOF %d", e->which); break;
    case PART_TWO_CONTACTS:
      message_add(m, " contacts %d and %d", (e->which - 1) / VERIFY_MOST_CONTACTS,
                  (e->which - 1) % VERIFY_MOST_CONTACTS);
      break;
    case PART_LOAD:
      message_add(m, " of harmonic %d at DOF %d", (e->which - 1) / e->n, (e->which - 1) % e->n + 1);
      break;
    case PART_PAIR: message_add(m, " DOFs %d and %d", (e->which - 1) / e->n + 1, (e->which - 1) % e->n + 1); break;
    case PART_ALL:
    case PART_SLIDER: break;
    }
  if (verify_changes[e->change].scan == SCAN_FACTOR) message_add(m, " times %.4g", e->factor);
  if (verify_changes[e->change].scan == SCAN_TURN) message_add(m, " by %.4g degrees", e->factor);
}

static void add_equations(message *m, const verify_equations *e)
{
  if (e->change != CHANGE_NONE) add_change(m, e);
  if (e->change == CHANGE_NO_CONTACT || e->change == CHANGE_STUCK) return;
  if (e->change != CHANGE_NONE) message_add(m, ", ");
  if (e->odd_only) message_add(m, "odd harmonics alone, ");
  else if (!e->keep_mean) message_add(m, "hbm.static: false, ");
  message_add(m, "H = %d", e->harmonics);
  if (e->samples) message_add(m, ", N = %d%s", e->samples, verify_slider_kind(e)->words);
}

static void add_causes(message *m, verify_causes bits)
{
  const bool no_traction = verify_has(bits, CAUSE_NO_FRICTION) && verify_has(bits, CAUSE_NO_KT);
  const char *before = "";
  if (no_traction) {
    message_add(m, "there is no tangential force: no friction, or no tangential stiffness");
    before = ", and ";
  }
  for (int i = 0; i < VERIFY_CAUSES; ++i) {
    if (!verify_has(bits, i) || (no_traction && (i == CAUSE_NO_FRICTION || i == CAUSE_NO_KT))) continue;
    message_add(m, "%s%s", before, verify_cause_meaning(i));
    before = ", and ";
  }
}

static void add_fit(message *m, const verify_hypothesis *h)
{
  message_add(m, " (");
  /* "hbm.static: false, H = 10, N = 32; values = 2 x amplitude" */
  char name[VERIFY_QUANTITY_TEXT];
  add_equations(m, &h->equations);
  if (h->omega_factor != 1) message_add(m, "; frequencies = %.6g x the true ones", 1 / h->omega_factor);
  if (h->omega_scale) message_add(m, " (%s?)", h->omega_scale);
  message_add(m, "; values = ");
  if (h->decibel) message_add(m, "%s", h->quantity.decibel ? "10^(dB/20) of " : "dB of ");
  if (h->value_factor != 1) message_add(m, "%.4g x ", h->value_factor);
  message_add(m, "%s", verify_quantity_name(&h->quantity, name));
  if (h->value_scale) message_add(m, " (%s?)", h->value_scale);
  message_add(m, " fits to ");
  add_distance(m, h->distance);
}

static void say_unexplained(message *m, const verify_report *r)
{
  int off = r->count[VERDICT_DIFFERS];
  if (r->status != HC_OK) {
    message_add(m, "no cause was found before the end: %s", hc_status_text(r->status));
  } else if (r->n_rows > 0 && r->skipped == r->n_rows) {
    message_add(m, "no point could be compared: the mean is free at all of them, and the quantity contains it");
  } else if (off == 0 && r->count[VERDICT_SOLVER_FAILED] == 0) {
    message_add(m, "every point lies on a solution, but how exact that is, is not known to the gate of %g", r->gate);
  } else if (off == 0) {
    message_add(m, "%d points could not be judged", r->count[VERDICT_SOLVER_FAILED]);
  } else if (r->n_hypotheses == 0) {
    message_add(m, "%d point%s, too few to tell why", off, off == 1 ? " differs" : "s differ");
  } else if (verify_has(r->nearest_guess, CAUSE_NOISE)) {
    message_add(m, "no cause explains the points; they scatter around the truth");
    points_say(m, r);
    message_add(m, ". Measured, or computed? --noise says how much a measured curve scatters");
  } else if (r->nearest_guess) {
    const bool fits = verify_fits(r);
    message_add(m, fits ? "more than one cause fits: " : "no cause fits well; nearest guess: ");
    add_causes(m, r->hypotheses[0].causes);
    add_fit(m, &r->hypotheses[0]);
    message_add(m, ", the truth is ");
    add_distance(m, r->truth_distance);
    message_add(m, " off)");
    for (int i = 1, n = 1; i < r->n_hypotheses && n < VERIFY_SHOWN; ++i) {
      if (!verify_rival(r, i)) continue;
      message_add(m, "; or ");
      add_causes(m, r->hypotheses[i].causes);
      add_fit(m, &r->hypotheses[i]);
      message_add(m, ")");
      ++n;
    }
  } else {
    message_add(m, "no hypothesis fits better than ");
    add_distance(m, r->hypotheses[0].distance);
    message_add(m, ", and the truth is ");
    add_distance(m, r->truth_distance);
    message_add(m, " off: the cause is none of those tried");
  }
}

const char *verify_sentence(const verify_report *r, char text[VERIFY_TEXT])
{
  message m;
  message_start(&m, text, VERIFY_TEXT);
  if (!r->causes && r->status == HC_OK && verify_exit_code(r) == 0) {
    message_add(&m, "no cause to suspect: every point lies on a solution, within the gate of %g", r->gate);
    if (r->count[VERDICT_UNSTABLE])
      message_add(&m, "; %d of them on unstable ones, where no motion stays", r->count[VERDICT_UNSTABLE]);
  } else if (!r->causes) say_unexplained(&m, r);
  else {
    message_add(&m, "suspected cause: ");
    add_causes(&m, r->causes);
    points_say(&m, r);
    if (verify_fits(r)) {
      add_fit(&m, &r->hypotheses[0]);
      message_add(&m, ", the truth is ");
      add_distance(&m, r->truth_distance);
      message_add(&m, " off)");
      /* "; the same curve has: gap times 10; ..." */
      const char *before = "; the same curve has: ";
      for (int i = 1, n = 0; i < r->n_hypotheses && n < VERIFY_SHOWN; ++i) {
        if (!verify_reason(r, i)) continue;
        const verify_equations *e = &r->hypotheses[i].equations;
        message_add(&m, "%s", before);
        add_change(&m, e);
        before = ", ";
        ++n;
      }
    }
    for (int i = 0; i < VERIFY_CAUSES; ++i)
      if (verify_has(r->causes, i)) message_add(&m, "; %s", verify_cause_remedy(i));
  }
  return text;
}
