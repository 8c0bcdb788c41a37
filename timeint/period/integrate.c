/* integrate.c - see integrate.h: passes each call to the integrator of the law and method. */
#include <math.h>
#include <stddef.h>

#include "timeint/law/contact_track.h"
#include "timeint/period/integrate_private.h"

void integrate_free(integrator *in)
{
  if (in) in->does->free(in);
}

const hc_monitor *integrate_hear(integrator *in, const hc_monitor *monitor)
{
  const hc_monitor *before = in->monitor;
  in->monitor = monitor;
  return before;
}

hc_status integrate_tolerance(integrator *in, double tolerance)
{
  return in->does->tolerance ? in->does->tolerance(in, tolerance) : HC_OK;
}

hc_status integrate_period(integrator *in, const scaled_model *m, double *y, integrate_watch *watch, void *self)
{
  ++in->periods;
  in->unheard = 0;
  return in->does->period(in, m, y, NULL, watch, self);
}

static hc_status with_matrix(integrator *in, const scaled_model *m, bool coarse, double *y, double *monodromy)
{
  ++in->periods;
  in->unheard = 0;
  in->coarse = coarse;
  return in->does->period(in, m, y, monodromy, NULL, NULL);
}

hc_status integrate_monodromy(integrator *in, const scaled_model *m, double *y, double *monodromy)
{
  return with_matrix(in, m, false, y, monodromy);
}

hc_status integrate_coarse_monodromy(integrator *in, const scaled_model *m, double *y, double *monodromy)
{
  return with_matrix(in, m, in->has_coarse, y, monodromy);
}

bool integrate_has_coarse(const integrator *in) { return in->has_coarse; }

hc_status integrate_dense(const integrator *in, double theta, int order, double *y)
{
  return in->does->dense(in, theta, order, y);
}

hc_status integrate_samples(const integrator *in, int r, double theta, double step, int count, double *x)
{
  return in->does->samples(in, r, theta, step, count, x);
}

bool integrate_fourier(const integrator *in, int r, double out[3]) { return in->does->fourier(in, r, out); }

bool integrate_extremes(const integrator *in, int r, double *max, double *min)
{
  return in->does->extremes && in->does->extremes(in, r, max, min);
}

contact_state integrate_contact(const integrator *in, int j, const double *y)
{
  return in->track ? in->track[j].state : in->does->state(in, j, y);
}

void integrate_at_end(const integrator *in, const scaled_model *m, double theta, const double *y, double *rate,
                      contact_state *states)
{
  if (in->does->at_end) {
    in->does->at_end(in, theta, y, rate, states);
    return;
  }
  scaled_rhs(m, theta, y, rate);
  for (int j = 0; j < m->n_contacts; ++j) states[j] = integrate_contact(in, j, y);
}

double integrate_travel(const integrator *in, int j) { return in->track ? in->track[j].most : INFINITY; }

double integrate_scatter(const integrator *in) { return in->scatter; }
long integrate_periods(const integrator *in) { return in->periods; }
long integrate_steps(const integrator *in) { return in->steps; }
long integrate_rhs(const integrator *in) { return in->rhs; }
long integrate_transitions(const integrator *in) { return in->transitions; }
int integrate_flag(const integrator *in) { return in->flag; }

void integrate_sliders(const contact_track *track, const scaled_model *m, int order, integrate_turn *turn,
                       const void *self, double *y)
{
  double *w = y + 2 * m->n;
  for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
    const scaled_contact *c = &m->contact[j];
    contact_track t[2] = {track[j], track[j + c->kind->directions - 1]};
    contact_motion at;
    scaled_contact_motion(m, j, y, at.u, &at.v);
    if (turn && t->turns) turn(self, j, t);
    (order == 0 ? contact_track_slider : contact_track_slider_rate)(t, c, &at, w + j);
  }
}
