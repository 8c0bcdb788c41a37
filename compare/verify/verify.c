/* verify.c - see verify.h. Here: the order of the steps. What the points tell by themselves comes first, since no other
 * equations are needed for it; but noise last, since a mistake may look like it. */
#include "compare/verify/verify.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "compare/verify/search/search.h"
#include "compare/verify/truth/truth.h"

static int differing(const verify_report *r)
{
  int n = 0;
  for (int i = 0; i < r->n_rows; ++i) n += verify_row_differs(&r->rows[i]);
  return n;
}

/* The causes that the rows show, and those that the search finds where many differ. */
static hc_status find_causes(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor,
                             verify_report *out)
{
  out->causes = points_branches(out) | points_outliers(out);
  if (out->causes || differing(out) < VERIFY_LEAST_DIFFERING) return HC_OK;
  hc_status st = points_scatter(out, &out->causes);
  return st == HC_OK && !out->causes ? verify_search(setup, data, monitor, out) : st;
}

/* *setup with a model, the caller's, of which the response asked for is the only one. */
static hc_status setup_of_response(const compare_setup *setup, int response, compare_setup *own, model **one)
{
  const model *m = setup->model;
  *one = NULL;
  if (response < 0 || response >= m->n_responses) return HC_BAD_INPUT;
  hc_status st = model_copy_sized(m, m->n_contacts, 1, one);
  if (st != HC_OK) return st;
  const size_t n = (size_t)m->n;
  memcpy((*one)->responses, m->responses + (size_t)response * n, n * sizeof *m->responses);
  *own = *setup;
  own->model = *one;
  return HC_OK;
}

hc_status verify_run(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor, verify_report *out)
{
  model *one;
  compare_setup own;
  *out = (verify_report){.truth_distance = NAN,
                         .noise = NAN,
                         .noise_said = data->noise,
                         .left_out = data->left_out,
                         .reversals = points_reversals(data)};
  hc_status st = setup_of_response(setup, data->response, &own, &one);
  if (st == HC_OK) st = verify_truth(&own, data, monitor, out);
  if (st == HC_OK) st = points_noise(out);
  if (st == HC_OK) st = find_causes(&own, data, monitor, out);
  model_free(one);
  for (int i = 0; i < out->n_rows; ++i) ++*(out->rows[i].skipped ? &out->skipped : &out->count[out->rows[i].verdict]);
  return out->status = st;
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
  return r->checked > 0 && r->checked_error <= r->gate ? 0 : 3;
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

static const char *slider_words(int restart)
{
  switch (restart) {
  case HBM_RESTART_SAMPLE: return ", hbm.slider_restart: sample";
  case HBM_RESTART_ZEROED: return ", w = 0 after a separation";
  case HBM_RESTART_KEPT: return ", w kept over a separation";
  case HBM_RESTART_ONE_PASS:
  case HBM_RESTART_ONE_PASS_SAMPLE: return ", one period from w = 0";
  default: return "";
  }
}

/* "kt of contact 1 times 2", "the force at DOF 3", "M, C and K exchanged in DOFs 1 and 2": DOFs from 1, contacts from 0
 * as elsewhere. */
static void add_change(message *m, const verify_equations *e)
{
  message_add(m, "%s", verify_changes[e->change].words);
  if (e->which > 0) switch (verify_changes[e->change].part) {
    case PART_CONTACT:
    case PART_ONE_CONTACT: message_add(m, " of contact %d", e->which - 1); break;
    case PART_DOF: message_add(m, " DOF %d", e->which); break;
    case PART_PAIR: message_add(m, " DOFs %d and %d", (e->which - 1) / e->n + 1, (e->which - 1) % e->n + 1); break;
    case PART_ALL: break;
    }
  if (verify_changes[e->change].factor) message_add(m, " times %.4g", e->factor);
}

static void add_equations(message *m, const verify_equations *e)
{
  if (e->change != CHANGE_NONE) add_change(m, e);
  if (e->change == CHANGE_NO_CONTACT || e->change == CHANGE_STUCK) return;
  if (e->change != CHANGE_NONE) message_add(m, ", ");
  if (e->odd_only) message_add(m, "odd harmonics alone, ");
  else if (!e->keep_mean) message_add(m, "hbm.static: false, ");
  message_add(m, "H = %d", e->harmonics);
  if (e->samples) message_add(m, ", N = %d%s", e->samples, slider_words(e->restart));
}

static void add_causes(message *m, verify_causes bits)
{
  const verify_causes no_traction = VERIFY_BIT(CAUSE_NO_FRICTION) | VERIFY_BIT(CAUSE_NO_KT);
  const char *before = "";
  if ((bits & no_traction) == no_traction) {
    message_add(m, "there is no tangential force: no friction, or no tangential stiffness");
    bits &= ~no_traction;
    before = ", and ";
  }
  for (int i = 0; i < VERIFY_CAUSES; ++i)
    if (bits & VERIFY_BIT(i)) {
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
  } else if (off == 0) {
    message_add(m, "%d points could not be judged", r->count[VERDICT_SOLVER_FAILED]);
  } else if (r->n_hypotheses == 0) {
    message_add(m, "%d point%s, too few to tell why", off, off == 1 ? " differs" : "s differ");
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
      if (r->causes & VERIFY_BIT(i)) message_add(&m, "; %s", verify_cause_remedy(i));
  }
  return text;
}
