/* variations.c - see variations.h. */
#include "timeint/variations.h"

#include <string.h>

#include "base/constants.h"
#include "model/linear.h"

/* A column at a time. The response to a constant force 1 from rest is s in X and e01 in P. */
void variations_advance(variations *v, const phase *ph, double theta)
{
  const double span = theta - v->theta, c = ph->m->c;
  double e[2][2];
  linear_free_motion(1, c, ph->k, span, e);
  const double step = fabs(ph->k) > 0.01 ? (1 - e[0][0]) / ph->k : linear_step_response(c, ph->k, span);
  for (int q = 0; q < v->n; ++q) {
    double *z = v->matrix + q * v->n, pull = 0, x = z[SCALED_X], p = z[SCALED_P];
    for (int j = 0; j < ph->m->n_contacts; ++j) pull += phase_slider_stiffness(ph, j) * z[SCALED_W + j];
    z[SCALED_X] = e[0][0] * x + e[0][1] * p + step * pull;
    z[SCALED_P] = e[1][0] * x + e[1][1] * p + e[0][1] * pull;
  }
  v->theta = theta;
}

/* before: NULL if none stuck. */
static void start_rows(variations *v, const phase *ph, const phase *before)
{
  for (int j = 0; j < ph->m->n_contacts; ++j) {
    const phase_contact *pc = &ph->contact[j];
    if (pc->state != CONTACT_STICK || (before && before->contact[j].state == CONTACT_STICK)) continue;
    for (int q = 0; q < v->n; ++q) {
      double *z = v->matrix + q * v->n;
      z[SCALED_W + j] = pc->since_start ? (q == SCALED_W + j ? 1.0 : 0.0) : pc->rest_by_x * z[SCALED_X];
    }
  }
}

void variations_stick(variations *v, const phase *ph, const phase *before) { start_rows(v, ph, before); }

void variations_begin(variations *v, const phase *ph)
{
  memset(v->matrix, 0, sizeof *v->matrix * (size_t)(v->n * v->n));
  v->matrix[SCALED_X] = 1;
  v->matrix[SCALED_P + v->n] = 1;
  v->theta = 0;
  start_rows(v, ph, NULL);
}

void variations_end(variations *v, const phase *ph, double *monodromy)
{
  variations_advance(v, ph, TWO_PI);
  memcpy(monodromy, v->matrix, sizeof *monodromy * (size_t)(v->n * v->n));
  for (int j = 0; j < ph->m->n_contacts; ++j) {
    double rest, by_x;
    phase_slider(ph, j, &rest, &by_x);
    if (phase_slider_stiffness(ph, j) != 0) continue;
    for (int q = 0; q < v->n; ++q) monodromy[SCALED_W + j + q * v->n] = by_x * monodromy[SCALED_X + q * v->n];
  }
}
