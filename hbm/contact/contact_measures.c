/* contact_measures.c - see contact_measures.h. */
#include "hbm/contact/contact_measures.h"

#include "hbm/contact/transitions.h"
#include "numerics/base/workspace.h"
#include "numerics/crossing.h"
#include "numerics/gauss.h"
#include "numerics/series.h"

/* A contact along its motion, made by open_motion. */
typedef struct measured_motion {
  const contact *law;
  moving_contact moved; /* by u and v themselves */
  series_grid grid;
  double *table;
  contact_interval *interval; /* [cap] */
  int n, cap;
  workspace memory;
} measured_motion;

static hc_status open_motion(const contact *law, int n_harm, const double *u, const double *v, measured_motion *m)
{
  const series_vector motion = {n_harm, 2, {u, v}};
  *m = (measured_motion){.law = law, .moved = {.law = *law, .cu = {1, 0}, .cv = {0, 1}}, .cap = 16 * n_harm + 16};
  m->table = workspace_doubles(&m->memory, (size_t)series_grid_table_length(n_harm));
  m->interval = workspace_array(&m->memory, (size_t)m->cap, sizeof *m->interval);
  if (m->memory.failed) return HC_NO_MEMORY;
  series_grid_table_fill(n_harm, m->table);
  series_grid_fill(&m->grid, &motion, m->table);
  return transitions_find(&m->grid, &m->moved, m->cap, m->interval, &m->n);
}

/* ---- forces -------------------------------------------------------------------------------------- */

/* The largest |T| of one interval: of kt u - held while it sticks, of mu N while it slips. Where it goes from one to
 * the other, rounding of the first may exceed the limit. */
static double interval_traction(const measured_motion *m, const contact_interval *p)
{
  const contact *law = m->law;
  const bool slips = contact_slip_sign(p->state) != 0;
  const double weight[2] = {slips ? 0 : law->kt, slips ? law->mu * law->kn : 0};
  const double constant = slips ? law->mu * (law->kn * law->gap + law->load) : -p->held;
  double most, least;
  guard_extrema(&m->grid.m, weight, p->from, p->to, &most, &least);
  return fmax(fabs(most + constant), fabs(least + constant));
}

/* ---- slip ---------------------------------------------------------------------------------------- */

typedef struct slip {
  const measured_motion *m;
  int sign;
} slip;

/* value[0] = |w'| [length/rad], value[1] = mu N |w'|; rounding may make either less than 0, which is left alone. */
static void slip_rates(const void *self, double th, double value[2])
{
  const slip *of = self;
  const contact *law = of->m->law;
  const series_node at = series_vector_at(&of->m->grid.m, th);
  value[0] = of->sign * at.d[1][0] - law->mu * law->kn / law->kt * at.d[1][1];
  value[1] = law->mu * contact_normal(law, at.d[0][1]) * value[0];
}

static void add_slip(const measured_motion *m, const contact_interval *p, contact_period *out)
{
  const slip of = {m, contact_slip_sign(p->state)};
  double sum[2];
  if (!of.sign) return;
  /* Panels on which the product of two motions, a trigonometric polynomial of degree 2 n_harm, turns by no more than
   * 8 rad to either side. The rule's error is at most 2^33 16!^4/(33 32!^3) of the 32nd derivative:
   * 3e-46 8^32 < 3e-17. */
  const int panels = 1 + (int)(m->grid.m.n_harm * (p->to - p->from) / 8);
  gauss_integrals(slip_rates, &of, p->from, p->to, panels, sum);
  out->slip_distance += sum[0];
  out->work += sum[1];
}

/* ---- all of it ----------------------------------------------------------------------------------- */

static bool is_finite(int n, const double *X)
{
  double size = 0;
  for (int i = 0; i < n; ++i) size += fabs(X[i]);
  return size <= TRANSITIONS_LARGEST;
}

hc_status contact_measures_of(const contact *law, int n_harm, const double *u, const double *v, contact_period *out)
{
  measured_motion m;
  double most, least;
  *out = (contact_period){.regime = CONTACT_LINEAR};
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS) return HC_BAD_INPUT;
  if (!is_finite(series_length(n_harm), u) || !is_finite(series_length(n_harm), v)) return HC_NOT_FINITE;
  hc_status st = open_motion(law, n_harm, u, v, &m);
  if (st == HC_OK) {
    out->regime = transitions_report(m.n, m.interval).regime;
    series_extrema(n_harm, v, &most, &least);
    out->normal_min = contact_normal(law, least);
    out->normal_max = contact_normal(law, most);
    for (int i = 0; i < m.n && contact_has_friction(law); ++i) {
      out->traction_max =
          fmax(out->traction_max, fmin(interval_traction(&m, &m.interval[i]), law->mu * out->normal_max));
      add_slip(&m, &m.interval[i], out);
    }
  }
  workspace_free(&m.memory);
  return st;
}
