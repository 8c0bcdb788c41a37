/* contact_force.c - see hbmcheck.h: the forces of one contact under a motion that is given. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/forces/given_motion.h"
#include "interfaces/library/inside.h"

static bool has_contact(const hbmcheck_case *c, int j) { return j >= 0 && j < hbmcheck_case_contacts(c); }

int hbmcheck_case_contact_tangents(const hbmcheck_case *c, int j)
{
  model *of;
  if (!has_contact(c, j) || scene_model(&c->sc, &of) != HC_OK) return 0;
  const int tangents = of->contacts[scene_model_contact(&c->sc, j)].pair != CONTACT_FIRST ? 1 : 2;
  model_free(of);
  return tangents;
}

/* One of u, u2, v, and where the contact moves in its direction; that is NULL without such a direction. */
typedef struct moved {
  const double *series, *direction;
} moved;

static bool is_motion(const moved *m, int n_dof, int length)
{
  bool along = false;
  if (!m->series) return true;
  for (int i = 0; i < n_dof && m->direction; ++i) along |= m->direction[i] != 0;
  for (int i = 0; i < length; ++i)
    if (!isfinite(m->series[i])) return false;
  return along;
}

/* The motions of all directions one after another into X[n][length]; false: one of them is none. */
static bool pack(const moved *from, int n, int n_dof, int length, double *X)
{
  for (int d = 0; d < n; ++d) {
    if (!is_motion(&from[d], n_dof, length)) return false;
    for (int i = 0; i < length; ++i) X[d * length + i] = from[d].series ? from[d].series[i] : 0;
  }
  return true;
}

hbmcheck_status hbmcheck_contact_force(const hbmcheck_case *c, int j, int harmonics, const double *u, const double *u2,
                                       const double *v, int samples, double *T, double *T2, double *N)
{
  model *of;
  moving_contact place;
  double X[GIVEN_MOST_DOF * GIVEN_MOST_COEF], F[GIVEN_MOST_DOF * GIVEN_MOST_COEF];
  if (!has_contact(c, j) || scene_contact_is_composed(scene_contact_at(&c->sc, j)) || harmonics < 1 ||
      harmonics > HBM_MAX_HARMONICS || samples < 0 || !T || !N)
    return HBMCHECK_BAD_INPUT;
  if (scene_model(&c->sc, &of) != HC_OK) return HBMCHECK_NO_MEMORY;
  const int at = scene_model_contact(&c->sc, j), length = 2 * harmonics + 1;
  const model_contact *one = &of->contacts[at];
  given_motion m = given_motion_of_contact(of, at, &place);
  const moved alone[] = {{u, one->tangent}, {v, one->normal}};
  const moved two[] = {{u, one->tangent}, {u2, m.pair ? one[1].tangent : NULL}, {v, one->normal}};
  m.n_harm = harmonics;
  m.X = X;
  hc_status st = !m.pair == !T2 && (m.pair || !u2) && pack(m.pair ? two : alone, m.n_dof, of->n, length, X)
                     ? given_motion_force(&m, c->sc.hbm.restart, samples, F)
                     : HC_BAD_INPUT;
  if (st == HC_OK) {
    const size_t size = (size_t)length * sizeof *F;
    const double *normal = F + (m.n_dof - 1) * length;
    memcpy(T, F, size);
    if (T2) memcpy(T2, F + length, size);
    memcpy(N, normal, size);
    N[0] += given_motion_preload(&m);
  }
  model_free(of);
  return public_status(st);
}
