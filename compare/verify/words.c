/* words.c - causes as words for scripts and as a sentence for people. */
#include <math.h>
#include <stdio.h>

#include "base/message.h"
#include "compare/verify/points.h"
#include "compare/verify/search.h"

/* "42 %" or "2e-06". */
static void add_distance(message *m, double d)
{
  if (d >= 1e-3) message_add(m, "%.2g %%", 100 * d);
  else message_add(m, "%.1g", d);
}

/* "hbm.static: false, H = 10, N = 32; values = 2 x amplitude" */
static void add_settings(message *m, const verify_hypothesis *h)
{
  const verify_equations *e = &h->equations;
  if (e->contact == VERIFY_CONTACT_NONE) message_add(m, "K alone");
  else if (e->contact == VERIFY_CONTACT_STUCK) message_add(m, "K and the stuck contacts' stiffness");
  else message_add(m, "%sH = %d", e->keep_mean ? "" : "hbm.static: false, ", e->harmonics);
  if (e->samples)
    message_add(m, ", N = %d%s", e->samples, e->restart == HBM_RESTART_SAMPLE ? ", hbm.slider_restart: sample" : "");
  if (h->omega_factor != 1) message_add(m, "; true omega = %.6g x the file's", h->omega_factor);
  char name[VERIFY_QUANTITY_TEXT];
  if (h->value_factor != 1) message_add(m, "; values = %.6g x ", h->value_factor);
  else message_add(m, "; values = ");
  message_add(m, "%s", verify_quantity_name(&h->quantity, name));
}

static void add_causes(message *m, verify_causes bits)
{
  const char *before = "suspected cause: ";
  for (int i = 0; i < VERIFY_CAUSES; ++i)
    if (bits & VERIFY_BIT(i)) {
      message_add(m, "%s%s", before, verify_cause_meaning(i));
      before = ", and ";
    }
}

static void add_remedies(message *m, verify_causes bits)
{
  for (int i = 0; i < VERIFY_CAUSES; ++i)
    if (bits & VERIFY_BIT(i)) message_add(m, "; %s", verify_cause_remedy(i));
}

static void say_match(message *m, const verify_report *r)
{
  message_add(m, "no cause to suspect: every point lies on a solution, within the gate of %g", r->gate);
  if (r->count[VERDICT_UNSTABLE])
    message_add(m, "; %d of them on unstable ones, where no motion stays", r->count[VERDICT_UNSTABLE]);
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
  if (!r->causes && r->status == HC_OK && verify_exit_code(r) == 0) say_match(&m, r);
  else if (!r->causes) say_unexplained(&m, r);
  else {
    add_causes(&m, r->causes);
    points_say(&m, r);
    if (verify_fits(r)) {
      message_add(&m, " (");
      add_settings(&m, &r->hypotheses[0]);
      message_add(&m, " fits to ");
      add_distance(&m, r->hypotheses[0].distance);
      message_add(&m, ", the truth is ");
      add_distance(&m, r->truth_distance);
      message_add(&m, " off)");
    }
    add_remedies(&m, r->causes);
  }
  return text;
}
