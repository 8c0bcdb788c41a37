/* case_check.c - rules across several fields. The message is about the field of them that was given last. */
#include <stdbool.h>
#include <string.h>

#include "casefile/case_reader.h"

static const field *field_named(const char *section, const char *name)
{
  return field_find(section, name, strlen(name));
}

/* Assignments come after the file, later ones after earlier ones; within the file, and for defaults, a goes first. */
static case_place last_given(const case_reader *r, const field *a, const field *b)
{
  case_place pa = r->at[field_index(a)], pb = r->at[field_index(b)];
  if (pa.line == 0) return pb;
  return pb.set > pa.set ? pb : pa;
}

static hc_status check_sweep(case_reader *r)
{
  if (r->sc.omega_from != r->sc.omega_to) return HC_OK;
  message_add(
      case_blame(r, last_given(r, field_named("sweep", "omega"), field_named("sweep", "frequency"))),
      "the sweep ends where it starts, expected FROM and TO to differ (single frequencies: compare.omega, or --at)");
  return HC_BAD_INPUT;
}

static hc_status check_samples(case_reader *r)
{
  const hbm_settings *h = &r->sc.hbm;
  if (h->force != HBM_FORCE_SAMPLED || h->samples == HBM_AUTO || h->harmonics == HBM_AUTO ||
      h->samples >= 2 * h->harmonics + 1)
    return HC_OK;
  message_add(case_blame(r, last_given(r, field_named("hbm", "samples"), field_named("hbm", "harmonics"))),
              "%d samples cannot tell %d harmonics apart, expected hbm.samples >= %d", h->samples, h->harmonics,
              2 * h->harmonics + 1);
  return HC_BAD_INPUT;
}

/* What adapts along the curve drops points and goes back, which fixed steps do not. */
static hc_status check_fixed_step(case_reader *r)
{
  const hbm_settings *h = &r->sc.hbm;
  bool samples = h->force == HBM_FORCE_SAMPLED && h->samples == HBM_AUTO, harmonics = h->harmonics == HBM_AUTO;
  if (h->continuation != HBM_CONTINUATION_FIXED_STEP || !(samples || harmonics)) return HC_OK;
  const char *name = harmonics ? "harmonics" : "samples";
  message_add(case_blame(r, last_given(r, field_named("hbm", "continuation"), field_named("hbm", name))),
              "hbm.%s: auto adapts the step, too, expected a number of %s with hbm.continuation: fixed_step", name,
              name);
  return HC_BAD_INPUT;
}

/* The regularised law has no closed form. */
static hc_status check_method(case_reader *r)
{
  const transient_settings *t = &r->sc.transient;
  if (t->method != TRANSIENT_METHOD_CLOSED_FORM || t->law == TRANSIENT_LAW_EXACT) return HC_OK;
  message_add(case_blame(r, last_given(r, field_named("transient", "method"), field_named("transient", "law"))),
              "only the exact law has a closed form, expected transient.law: exact with transient.method: closed_form");
  return HC_BAD_INPUT;
}

/* Ranges are pairs FROM <= TO; each list of limits has one for every range; there are no ranges without limits. */
static hc_status check_gate_ranges(case_reader *r)
{
  static const char *const limits[] = {"range_amplitude", "range_harmonic_1", "range_mean", "range_waveform"};
  const field *ranges = field_named("gate", "ranges");
  const number_list *ends = &r->sc.gate.ranges.ends;
  int longest = 0;
  for (int i = 0; i < ends->n; i += 2) {
    if (i + 1 < ends->n && ends->v[i] <= ends->v[i + 1]) continue;
    message *m = case_blame(r, r->at[field_index(ranges)]);
    if (i + 1 == ends->n)
      message_add(m, "gate.ranges ends in a single %.10g, expected FROM, TO, FROM, TO, ...", ends->v[i]);
    else message_add(m, "gate.ranges has a range from %.10g to %.10g, expected FROM <= TO", ends->v[i], ends->v[i + 1]);
    return HC_BAD_INPUT;
  }
  for (size_t k = 0; k < sizeof limits / sizeof *limits; ++k) {
    const field *f = field_named("gate", limits[k]);
    int n = ((const number_list *)field_look(f, &r->sc))->n;
    if (n > longest) longest = n;
    if (n == 0 || n == ends->n / 2) continue;
    message_add(case_blame(r, last_given(r, f, ranges)),
                "gate.%s has %d limit%s for %d range%s in gate.ranges, expected one for each", limits[k], n,
                n == 1 ? "" : "s", ends->n / 2, ends->n == 2 ? "" : "s");
    return HC_BAD_INPUT;
  }
  if (ends->n == 0 || longest > 0) return HC_OK;
  message_add(case_blame(r, r->at[field_index(ranges)]),
              "gate.ranges without limits, expected gate.range_amplitude or another gate.range_... too");
  return HC_BAD_INPUT;
}

/* A contact appended by --set must have got every required field; contacts of the file were checked when read. */
static hc_status check_contacts(case_reader *r)
{
  for (int j = 0; j < r->sc.n_contacts; ++j)
    for (int i = 0; i < field_count(); ++i) {
      const field *f = field_at(i);
      if (!(f->flags & FIELD_IN_CONTACT) || f->fallback || r->contact_has[j] & case_field_bit(f)) continue;
      message *m = case_blame(r, r->contact_at[j]);
      message_add(m, "this appends a contact without `%s`, expected contacts[%d].%s=VALUE too: ", f->name, j, f->name);
      field_expected(f, m);
      return HC_BAD_INPUT;
    }
  return HC_OK;
}

hc_status case_check(case_reader *r)
{
  r->sc.gate.ranges.in_cycles = r->sc.in_cycles;
  hc_status st = r->sc.structure ? case_check_structure(r) : check_contacts(r);
  if (st == HC_OK) st = check_sweep(r);
  if (st == HC_OK) st = check_samples(r);
  if (st == HC_OK) st = check_fixed_step(r);
  if (st == HC_OK) st = check_method(r);
  if (st == HC_OK) st = check_gate_ranges(r);
  return st;
}
