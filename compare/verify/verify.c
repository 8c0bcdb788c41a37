/* verify.c - see verify.h. Here: the order of the steps. What the points tell by themselves comes first, since no other
 * equations are needed for it; but noise last, since a mistake may look like it. */
#include "compare/verify/verify.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/verify/search/search.h"
#include "compare/verify/truth/points.h"
#include "compare/verify/truth/truth.h"

static int differing(const verify_report *r)
{
  int n = 0;
  for (int i = 0; i < r->n_rows; ++i)
    n += !r->rows[i].skipped && (r->rows[i].verdict == VERDICT_DIFFERS || r->rows[i].verdict == VERDICT_SOLVER_FAILED);
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
  if (st == HC_OK) st = points_estimate_noise(out);
  if (st == HC_OK && data->noise > 0) st = points_allow_noise(out, data->noise);
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
