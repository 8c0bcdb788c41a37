/* given_motion.c - see given_motion.h. */
#include "hbm/forces/given_motion.h"

#include "hbm/forces/contact_forces.h"

given_motion given_motion_of_contact(const model *of, int j, moving_contact *place)
{
  const model_contact *c = &of->contacts[j];
  const bool pair = c->pair == CONTACT_FIRST || c->pair == CONTACT_SECOND;
  *place = (moving_contact){.law = c->law, .cu = {1, 0}, .cv = {0, 1}};
  return (given_motion){
      .pair = pair, .circle = pair && c->circle, .n_dof = 2 + pair, .n_contacts = 1, .contacts = place};
}

bool given_motion_is_planar(const given_motion *m) { return m->circle && contact_has_friction(&m->contacts->law); }

int given_motion_planar_dof(const contact *law) { return law->kn > 0 ? 3 : 2; }

/* Directions of a pair: X holds u_1, u_2 and v themselves. */
static const double unit[GIVEN_MOST_DOF][GIVEN_MOST_DOF] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static void given_motion_place(const given_motion *m, placed_contact *out)
{
  for (int j = 0; j < m->n_contacts && !m->pair; ++j) {
    const moving_contact *c = &m->contacts[j];
    out[j] = (placed_contact){.law = c->law, .tangent = c->cu, .normal = c->cv};
  }
  for (int d = 0; d < 2 && m->pair; ++d)
    out[d] = (placed_contact){.law = m->contacts->law,
                              .planar = d == 0 && given_motion_is_planar(m),
                              .tangent = unit[d],
                              .tangent_2 = unit[1],
                              .normal = unit[2]};
}

hc_status given_motion_force(const given_motion *m, hbm_restart restart, int n_time, double *F)
{
  const int n = series_length(m->n_harm), contacts = m->pair ? 2 : m->n_contacts;
  const size_t size = (size_t)m->n_dof * (size_t)n;
  const evaluator_settings how = {.n_harm = m->n_harm, .n_time = n_time, .slider = {.restart = restart}};
  contact_forces *f = NULL;
  contact_report report;
  placed_contact *placed = calloc((size_t)contacts + 1, sizeof *placed);
  double *X = calloc(2 * size, sizeof *X), *force = X ? X + size : NULL; /* by coefficient, then by coordinate */
  hc_status st = placed && X ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) {
    given_motion_place(m, placed);
    const hbm_force by = n_time == GIVEN_EXACT ? HBM_FORCE_EXACT : HBM_FORCE_SAMPLED;
    st = contact_forces_new_of(m->n_dof, contacts, placed, by, &how, &f);
  }
  for (size_t i = 0; i < size && st == HC_OK; ++i) X[i % n * m->n_dof + i / n] = m->X[i];
  if (st == HC_OK) st = contact_forces_eval(f, X, force, false, &report);
  for (size_t i = 0; i < size && st == HC_OK; ++i) F[i] = force[i % n * m->n_dof + i / n];
  contact_forces_free(f);
  free(placed);
  free(X);
  return st;
}

double given_motion_preload(const given_motion *m)
{
  const contact *law = &m->contacts->law;
  const int halves = m->pair ? 2 : 1;
  return halves * (contact_preload(law) + law->load);
}
