/* case_check.c - rules across several fields. The message is about the field of them that was given last. */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "model/casefile/case_reader.h"
#include "numerics/base/number.h"
#include "numerics/norm.h"

/* Assignments come after the file, later ones after earlier ones; within the file, and for defaults, a goes first. */
static case_place last_given(const case_reader *r, const char *section, const char *a, const char *b)
{
  const case_place pa = r->at[field_index(field_named(section, a))], pb = r->at[field_index(field_named(section, b))];
  return pa.line == 0 || pb.set > pa.set ? pb : pa;
}

static hc_status check_sweep(case_reader *r)
{
  if (r->sc.omega_from != r->sc.omega_to) return HC_OK;
  return case_refuse(
      r, last_given(r, "sweep", "omega", "frequency"),
      "the sweep ends where it starts, expected FROM and TO to differ (single frequencies: compare.omega, or --at)");
}

static hc_status check_samples(case_reader *r)
{
  const hbm_settings *h = &r->sc.hbm;
  if (h->force != HBM_FORCE_SAMPLED || h->samples == HBM_AUTO || h->harmonics == HBM_AUTO ||
      h->samples >= 2 * h->harmonics + 1)
    return HC_OK;
  return case_refuse(r, last_given(r, "hbm", "samples", "harmonics"),
                     "%d samples cannot tell %d harmonics apart, expected hbm.samples >= %d", h->samples, h->harmonics,
                     2 * h->harmonics + 1);
}

/* What adapts along the curve drops points and goes back, which fixed steps do not. */
static hc_status check_fixed_step(case_reader *r)
{
  const hbm_settings *h = &r->sc.hbm;
  bool samples = h->force == HBM_FORCE_SAMPLED && h->samples == HBM_AUTO, harmonics = h->harmonics == HBM_AUTO;
  if (h->continuation != HBM_CONTINUATION_FIXED_STEP || !(samples || harmonics)) return HC_OK;
  const char *name = harmonics ? "harmonics" : "samples";
  return case_refuse(r, last_given(r, "hbm", "continuation", name),
                     "hbm.%s: auto adapts the step, too, expected a number of %s with hbm.continuation: fixed_step",
                     name, name);
}

/* Neither the regularised law nor a smooth one has a closed form. */
static hc_status check_method(case_reader *r)
{
  const transient_settings *t = &r->sc.transient;
  for (int j = 0; j < scene_contact_count(&r->sc) && t->method == TRANSIENT_METHOD_CLOSED_FORM; ++j) {
    const contact law = scene_contact_law(scene_contact_at(&r->sc, j));
    if (law.smooth == CONTACT_KINKED) continue;
    return case_refuse(r, r->at[field_index(field_named("transient", "method"))],
                       "contacts[%d] follows a smooth law, which has no closed form, expected transient.method: cvode",
                       j);
  }
  if (t->method != TRANSIENT_METHOD_CLOSED_FORM || t->law == TRANSIENT_LAW_EXACT) return HC_OK;
  return case_refuse(
      r, last_given(r, "transient", "method", "law"),
      "only the exact law has a closed form, expected transient.law: exact with transient.method: closed_form");
}

/* Ranges are pairs FROM <= TO; each list of limits has one for every range; there are no ranges without limits. */
static hc_status check_gate_ranges(case_reader *r)
{
  static const char *const limits[] = {"range_amplitude", "range_harmonic_1", "range_mean", "range_waveform"};
  const case_place at = r->at[field_index(field_named("gate", "ranges"))];
  const number_list *ends = &r->sc.gate.ranges.ends;
  int longest = 0;
  for (int i = 0; i < ends->n; i += 2) {
    if (i + 1 == ends->n)
      return case_refuse(r, at, "gate.ranges ends in a single %.10g, expected FROM, TO, FROM, TO, ...", ends->v[i]);
    if (!(ends->v[i] <= ends->v[i + 1]))
      return case_refuse(r, at, "gate.ranges has a range from %.10g to %.10g, expected FROM <= TO", ends->v[i],
                         ends->v[i + 1]);
  }
  for (size_t k = 0; k < sizeof limits / sizeof *limits; ++k) {
    const int n = ((const number_list *)field_look(field_named("gate", limits[k]), &r->sc))->n;
    if (n > longest) longest = n;
    if (n == 0 || n == ends->n / 2) continue;
    return case_refuse(r, last_given(r, "gate", limits[k], "ranges"),
                       "gate.%s has %d limit%s for %d range%s in gate.ranges, expected one for each", limits[k], n,
                       n == 1 ? "" : "s", ends->n / 2, ends->n == 2 ? "" : "s");
  }
  if (ends->n == 0 || longest > 0) return HC_OK;
  return case_refuse(r, at, "gate.ranges without limits, expected gate.range_amplitude or another gate.range_... too");
}

/* By --set a contact may have got another law. */
static hc_status check_laws(case_reader *r)
{
  for (int j = 0; j < scene_contact_count(&r->sc); ++j) {
    const case_place at = r->sc.structure->contacts[j].place;
    const hc_status st = case_check_law_given(r, j, scene_contact_at(&r->sc, j), at);
    if (st != HC_OK) return st;
    if (!isfinite(scene_contact_law(scene_contact_at(&r->sc, j)).gap))
      return case_refuse(r, at,
                         "contacts[%d] has a preload/normal_stiffness too large to be held, expected a finite gap", j);
  }
  return HC_OK;
}

/* The rules of an oscillator: a contact appended by --set must have got every required field; contacts of the file were
 * checked when read. */
static hc_status check_oscillator(case_reader *r)
{
  for (int j = 0; j < r->sc.structure->n_contacts; ++j)
    for (int i = 0; i < field_count(); ++i) {
      const structure_contact *c = &r->sc.structure->contacts[j];
      const field *f = field_at(i);
      if (!case_contact_needs(&c->given, r->contact_has[j], f)) continue;
      message *m = case_blame(r, c->place);
      message_add(m, "this appends a contact without `%s`, expected contacts[%d].%s=VALUE too: ", f->name, j, f->name);
      field_expected(f, m);
      return HC_BAD_INPUT;
    }
  return HC_OK;
}

/* ---- damping ---- */

static hc_status check_damping(case_reader *r)
{
  scene_structure *s = r->sc.structure;
  int i, j;
  const bool modal = s->how == STRUCTURE_DAMPING_MODAL || s->how == STRUCTURE_DAMPING_MODES;
  if (modal && structure_unsymmetric(s->n, s->stiffness.v, &i, &j)) {
    message_add(
        yaml_matrix_blame(r, &s->stiffness, i, j),
        "structure.stiffness is not symmetric, as modal damping needs it: entries (%d, %d) and (%d, %d) differ, "
        "expected a symmetric matrix, or other damping",
        i + 1, j + 1, j + 1, i + 1);
    return HC_BAD_INPUT;
  }
  const hc_status st = structure_resolve_damping(s);
  const size_t square = (size_t)s->n * (size_t)s->n;
  for (size_t k = 0; k < square && st == HC_OK; ++k) {
    if (isfinite(s->damping.v[k])) continue;
    return case_refuse(r, s->damping.place, "structure.damping becomes too large to be held, expected less of it");
  }
  if (st == HC_OK) return st;
  if (st == HC_NO_MEMORY) return case_out_of_memory(r);
  return case_refuse(
      r, s->damping.place,
      st == HC_BAD_INPUT
          ? "a mode of structure.mass and structure.stiffness has a negative stiffness and no frequency, expected "
            "other than modal damping"
          : "the modes of structure.mass and structure.stiffness cannot be computed, expected other than modal "
            "damping");
}

/* ---- loads and contacts ---- */

/* A moving base is the one load with omega. A structure says which DOFs it moves; an oscillator has a way of the base
 * while that moves. */
static hc_status check_base(case_reader *r)
{
  scene_structure *s = r->sc.structure;
  const case_place at = last_given(r, "base", "amplitude", "acceleration");
  const field *direction = field_named("base", "direction");
  if (s->is_oscillator && !scene_base_moves(&r->sc)) {
    free(s->base);
    s->base = NULL;
  }
  if (!scene_base_moves(&r->sc) && !s->base) return HC_OK;
  if (s->is_oscillator && s->loads->amplitude != 0)
    return case_refuse(r, at, "both the base and forcing.amplitude act with omega, expected one of them");
  for (int i = 0; i < s->n_loads && !s->is_oscillator; ++i)
    if (s->loads[i].harmonic == 1)
      return case_refuse(r, s->loads[i].place, "both the base and forcing[%d] act with omega, expected one of them", i);
  if (s->base) return HC_OK;
  if (s->n > 1)
    return case_refuse(r, at, "the base moves, but base.direction does not say which DOFs, expected %s",
                       direction->expects);
  if (!(s->base = malloc(sizeof *s->base))) return case_out_of_memory(r);
  *s->base = 1;
  return HC_OK;
}

static hc_status check_loads(case_reader *r)
{
  const scene_structure *s = r->sc.structure;
  double sum = 0; /* of the largest entries: what any entry of a load of the model can become */
  for (int i = 0; i < s->n_loads; ++i) {
    double most = 0;
    for (int k = 0; k < s->n; ++k) most = fmax(most, fabs(s->loads[i].amplitude * s->loads[i].direction[k]));
    if (!isfinite(sum += most))
      return case_refuse(r, s->loads[i].place, "forcing[%d] is too large to be held, expected less", i);
    if (r->sc.hbm.harmonics != HBM_AUTO && s->loads[i].harmonic > r->sc.hbm.harmonics)
      return case_refuse(
          r, s->loads[i].place,
          "forcing[%d] has harmonic %d and hbm.harmonics is %d, expected at least as many harmonics as loads have", i,
          s->loads[i].harmonic, r->sc.hbm.harmonics);
    if (s->loads[i].harmonic > 0 || s->loads[i].phase_deg == 0) continue;
    return case_refuse(r, s->loads[i].place, "forcing[%d] is a static load (harmonic 0) with a phase, expected none",
                       i);
  }
  return HC_OK;
}

/* Are the two tangents along the same line? Beyond rounding of their entries they are not. */
static bool is_parallel(const double *a, const double *b, int n)
{
  double aa = 0, bb = 0, ab = 0;
  for (int i = 0; i < n; ++i) aa += a[i] * a[i], bb += b[i] * b[i], ab += a[i] * b[i];
  return fabs(ab) >= (1 - 1e-12) * sqrt(aa) * sqrt(bb);
}

/* A name that --set can tell from an index. */
static bool is_good_name(const char *name)
{
  int number;
  return !strpbrk(name, "[]=. ") && number_read_integer(name, strlen(name), &number) != NUMBER_FINE;
}

static hc_status check_contact(case_reader *r, int j)
{
  const scene_structure *s = r->sc.structure;
  const structure_contact *c = &s->contacts[j];
  const contact *law = &c->given.law;
  const bool tangent = c->by_angle || !is_zero(s->n, c->tangent), normal = c->by_angle || !is_zero(s->n, c->normal);
  const int first = structure_contact_named(s, c->given.name, strlen(c->given.name));
  if (!tangent && (law->kt != 0 || law->mu != 0))
    return case_refuse(r, c->place, "contacts[%d] has %s, but no tangent to act along, expected `tangent`, or none", j,
                       law->kt != 0 ? "a tangential_stiffness" : "friction");
  if (!normal && (law->kn != 0 || law->gap != 0))
    return case_refuse(r, c->place,
                       "contacts[%d] has a %s, but no normal to act along, expected `normal`, or `preload` alone", j,
                       law->kn != 0 ? "normal_stiffness" : "gap");
  if (!is_zero(s->n, c->tangent_2) && is_parallel(c->tangent, c->tangent_2, s->n))
    return case_refuse(r, c->place, "contacts[%d] has tangent_2 along its tangent, expected a direction across it", j);
  if (!isfinite(2 * law->mu))
    return case_refuse(r, c->place, "contacts[%d] has too large a friction to be held, expected less", j);
  if (*c->given.name && !is_good_name(c->given.name))
    return case_refuse(
        r, c->place,
        "contacts[%d] is named `%s`, expected a name that is no number, without blanks, points or any of []=", j,
        c->given.name);
  if (!*c->given.name || first == j) return HC_OK;
  return case_refuse(r, c->place, "contacts[%d] is named `%s` like contacts[%d], expected different names", j,
                     c->given.name, first);
}

/* ---- what nothing holds ---- */

static hc_status check_held(case_reader *r)
{
  const scene_structure *s = r->sc.structure;
  double *x = malloc((size_t)s->n * sizeof *x);
  bool is_free;
  if (!x || structure_free_motion(s, false, x, &is_free) != HC_OK) {
    free(x);
    return case_out_of_memory(r);
  }
  if (is_free) {
    message *m = case_blame(r, s->place);
    message_add(m, "nothing holds the motion {");
    structure_describe_motion(s, x, m);
    message_add(m, "}: neither structure.stiffness nor a contact, expected a spring or a contact against it");
  }
  free(x);
  return is_free ? HC_BAD_INPUT : HC_OK;
}

/* The rules of a structure, whose damping matrix is made here. */
static hc_status check_structure(case_reader *r)
{
  const bool kept = r->sc.structure->is_sparse; /* what comes of its reduction is checked */
  hc_status st = kept ? HC_OK : check_damping(r);
  if (st == HC_OK) st = check_loads(r);
  for (int j = 0; j < r->sc.structure->n_contacts && st == HC_OK; ++j) st = check_contact(r, j);
  return st == HC_OK && !kept ? check_held(r) : st;
}

/* ---- all of them ---- */

hc_status case_check(case_reader *r)
{
  r->sc.gate.ranges.in_cycles = r->sc.in_cycles;
  hc_status st = case_own_structure(r); /* damping and the way of the base are made here */
  if (st == HC_OK) st = check_laws(r);
  if (st == HC_OK) st = scene_is_oscillator(&r->sc) ? check_oscillator(r) : check_structure(r);
  if (st == HC_OK) st = check_base(r);
  if (st == HC_OK) st = check_sweep(r);
  if (st == HC_OK) st = check_samples(r);
  if (st == HC_OK) st = check_fixed_step(r);
  if (st == HC_OK) st = check_method(r);
  if (st == HC_OK) st = check_gate_ranges(r);
  return st;
}
