/* contact_kind.c - see contact_kind.h. */
#include "hbm/forces/contact_kind.h"

#include <stddef.h>

#include "hbm/contact/contact_measures.h"
#include "hbm/contact/exact_force.h"
#include "hbm/planar/planar_aft.h"
#include "hbm/planar/planar_force.h"
#include "hbm/planar/planar_measures.h"
#include "hbm/planar/planar_rest.h"
#include "numerics/norm.h"

static int largest_entry(int n, const double *direction)
{
  int largest = 0;
  for (int d = 1; d < n; ++d)
    if (fabs(direction[d]) > fabs(direction[largest])) largest = d;
  return largest;
}

/* True if the normal is exactly a multiple of the tangent, which is not 0; a nearly parallel one gets two
 * coordinates. */
static bool are_parallel(int n, const double *tangent, const double *normal)
{
  const int k = largest_entry(n, tangent);
  for (int d = 0; d < n; ++d)
    if (normal[d] * tangent[k] != normal[k] * tangent[d]) return false;
  return true;
}

/* u and v, or the one coordinate of which both are multiples, scaled to the largest entry of its direction. A contact
 * with zero directions stays at rest. */
static void line_coordinates(const placed_contact *c, int dim, contact_coordinates *out)
{
  const bool along = contact_rubs(&c->law) && !is_zero(dim, c->tangent);
  *out = (contact_coordinates){.n_dof = 1, .divisor = {1, 1}, .moved = {.law = c->law}};
  if (along && !are_parallel(dim, c->tangent, c->normal)) {
    out->n_dof = 2;
    out->direction[0] = c->tangent, out->direction[1] = c->normal;
    out->moved.cu[0] = out->moved.cv[1] = 1;
    return;
  }
  out->direction[0] = along ? c->tangent : c->normal;
  if (is_zero(dim, out->direction[0])) return;
  const int k = largest_entry(dim, out->direction[0]);
  out->divisor[0] = out->direction[0][k];
  out->moved.cu[0] = along ? c->tangent[k] : 0;
  out->moved.cv[0] = c->normal[k];
}

/* u_1, u_2 and, if the normal force varies with it, v. */
static void plane_coordinates(const placed_contact *c, int dim, contact_coordinates *out)
{
  const bool across = c->law.kn > 0 && !is_zero(dim, c->normal);
  *out = (contact_coordinates){.n_dof = across ? 3 : 2,
                               .direction = {c->tangent, c->tangent_2, c->normal},
                               .divisor = {1, 1, 1},
                               .moved = {.law = c->law}};
}

static hc_status line_measures(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,
                               contact_period *out)
{
  (void)u_2;
  return contact_measures_of(law, n_harm, u, v, out);
}

#define SMOOTH(code, name)                                                                                             \
  [code] = {1, line_coordinates, &name##_evaluator, &name##_sampled_evaluator, name##_measures_of, NULL},
static const contact_kind kinds[] = {
    CONTACT_SMOOTH_LIST(SMOOTH)[CONTACT_KINKED] = {1, line_coordinates, &exact_force_evaluator, &aft_evaluator,
                                                   line_measures, NULL},
    [CONTACT_LAWS] = {2, plane_coordinates, &planar_force_evaluator, &planar_aft_evaluator, planar_measures_of,
                      &planar_edges},
};

const contact_kind *contact_kind_of(const placed_contact *c)
{
  return &kinds[c->planar ? CONTACT_LAWS : c->law.smooth];
}

placed_contact placed_contact_of(const model *m, int j)
{
  const model_contact *c = &m->contacts[j];
  return (placed_contact){.law = c->law,
                          .planar = c->circle && c->pair == CONTACT_FIRST && contact_has_friction(&c->law)};
}

const slip_edges *contact_edges_of(const model *m)
{
  const slip_edges *edges = NULL;
  for (int j = 0; j < m->n_contacts && !edges; ++j) {
    const placed_contact c = placed_contact_of(m, j);
    edges = contact_kind_of(&c)->edges;
  }
  return edges;
}
