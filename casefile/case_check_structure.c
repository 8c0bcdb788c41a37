/* case_check_structure.c - rules across the parts of a structure, once all of it is known. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "casefile/structure_check.h"
#include "casefile/structure_model.h"
#include "casefile/yaml_structure.h"

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
    message_add(case_blame(r, s->damping.place), "structure.damping becomes too large to be held, expected less of it");
    return HC_BAD_INPUT;
  }
  if (st == HC_OK) return st;
  if (st == HC_NO_MEMORY) return case_out_of_memory(r);
  message_add(
      case_blame(r, s->damping.place),
      st == HC_BAD_INPUT
          ? "a mode of structure.mass and structure.stiffness has a negative stiffness and no frequency, expected "
            "other than modal damping"
          : "the modes of structure.mass and structure.stiffness cannot be computed, expected other than modal "
            "damping");
  return HC_BAD_INPUT;
}

/* ---- loads and contacts ---- */

static hc_status check_loads(case_reader *r)
{
  const scene_structure *s = r->sc.structure;
  double sum = 0; /* of the largest entries: what any entry of a load of the model can become */
  for (int i = 0; i < s->n_loads; ++i) {
    double most = 0;
    for (int k = 0; k < s->n; ++k) most = fmax(most, fabs(s->loads[i].amplitude * s->loads[i].direction[k]));
    if (!isfinite(sum += most)) {
      message_add(case_blame(r, s->loads[i].place), "forcing[%d] is too large to be held, expected less", i);
      return HC_BAD_INPUT;
    }
    if (r->sc.hbm.harmonics != HBM_AUTO && s->loads[i].harmonic > r->sc.hbm.harmonics) {
      message_add(
          case_blame(r, s->loads[i].place),
          "forcing[%d] has harmonic %d and hbm.harmonics is %d, expected at least as many harmonics as loads have", i,
          s->loads[i].harmonic, r->sc.hbm.harmonics);
      return HC_BAD_INPUT;
    }
    if (s->loads[i].harmonic > 0 || s->loads[i].phase_deg == 0) continue;
    message_add(case_blame(r, s->loads[i].place),
                "forcing[%d] is a static load (harmonic 0) with a phase, expected none", i);
    return HC_BAD_INPUT;
  }
  return HC_OK;
}

static bool is_zero(const double *direction, int n)
{
  for (int i = 0; i < n; ++i)
    if (direction[i] != 0) return false;
  return true;
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
  const bool tangent = c->by_angle || !is_zero(c->tangent, s->n), normal = c->by_angle || !is_zero(c->normal, s->n);
  const int first = structure_contact_named(s, c->given.name, strlen(c->given.name));
  message *m = case_blame(r, c->place);
  const size_t before = m->used;
  if (!tangent && (law->kt != 0 || law->mu != 0))
    message_add(m, "contacts[%d] has %s, but no tangent to act along, expected `tangent`, or none", j,
                law->kt != 0 ? "a tangential_stiffness" : "friction");
  else if (!normal && (law->kn != 0 || law->gap != 0))
    message_add(m, "contacts[%d] has a %s, but no normal to act along, expected `normal`, or `preload` alone", j,
                law->kn != 0 ? "normal_stiffness" : "gap");
  else if (!is_zero(c->tangent_2, s->n) && is_parallel(c->tangent, c->tangent_2, s->n))
    message_add(m, "contacts[%d] has tangent_2 along its tangent, expected a direction across it", j);
  else if (!isfinite(2 * law->mu)) message_add(m, "contacts[%d] has too large a friction to be held, expected less", j);
  else if (!isfinite(structure_contact_law(c).gap))
    message_add(m, "contacts[%d] has a preload/normal_stiffness too large to be held, expected a finite gap", j);
  else if (*c->given.name && !is_good_name(c->given.name))
    message_add(
        m, "contacts[%d] is named `%s`, expected a name that is no number, without blanks, points or any of []=", j,
        c->given.name);
  else if (*c->given.name && first != j)
    message_add(m, "contacts[%d] is named `%s` like contacts[%d], expected different names", j, c->given.name, first);
  if (m->used > before) return HC_BAD_INPUT;
  message_start(m, m->text, m->size);
  return HC_OK;
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

hc_status case_check_structure(case_reader *r)
{
  hc_status st = case_own_structure(r);
  if (st == HC_OK) st = check_damping(r);
  if (st == HC_OK) st = check_loads(r);
  for (int j = 0; j < r->sc.structure->n_contacts && st == HC_OK; ++j) st = check_contact(r, j);
  return st == HC_OK ? check_held(r) : st;
}
