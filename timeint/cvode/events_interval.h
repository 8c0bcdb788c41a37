/* events_interval.h - private to integrate_events: its state, and what holds between two changes of contact state, an
 * interval: the equations that CVODE integrates and the root functions that end it.
 *
 * Root functions of a contact, six, so that a period allocates nothing: the guards of its state, which end it where
 * they fall through 0, and the rates of these, which end nothing. Without them a guard could fall and rise within one
 * step unseen: CVODE's search for the root of the rate between evaluates all functions there.
 * Functions that are not there are 1; none is ever exactly 0, which CVODE answers with an error. */
#ifndef HC_TIMEINT_EVENTS_INTERVAL_H
#define HC_TIMEINT_EVENTS_INTERVAL_H

#include "timeint/closed_form/fundamental_matrix.h"
#include "timeint/closed_form/motion_single.h"
#include "timeint/cvode/integrate_cvode.h"
#include "timeint/cvode/planar_angle.h"
#include "timeint/law/slider_travel.h"

enum { EVENTS_ROOTS = 2 * TRACK_GUARDS };

typedef struct events { /* from integrate_new_events, to integrate_free; not shared between threads */
  cvode_integrator base;
  int n, n_contacts;
  double tolerance;
  bool is_single;                  /* of motion_single.h: */
  double theta0, theta1, began[2]; /* the step under way, and where it began */
  contact_track *track;            /* [n_contacts] now */
  slider_travel travel;
  contact_forces_linear *law; /* [n_contacts] of these states */
  int *info;                  /* [n_contacts][EVENTS_ROOTS] what CVODE says of the root functions */
  double *rate;               /* [n_equations] dy where the guards' rates are wanted */
  int n_planar, n_equations;  /* 2 n, and an angle for each circle */
  planar_angle *angle;        /* [n_planar] */
  int *angle_of;              /* [n_contacts] that of a circle's first direction; else -1 */
  double *phi;                /* [n_planar] where sliders are wanted */
  int passed;                 /* events since the period began */
  bool varies;                /* the monodromy is asked for */
  fundamental_matrix variations;
  interval_modes *modes; /* for them */
} events;

/* The motion of the circle whose first direction is contact j, at y; with dy, the rate of y, its bend, too. */
planar_contact_motion events_planar_at(const events *in, int j, const double *y);
angle_motion events_angle_motion_at(const events *in, int j, double theta, const double *y, const double *dy);

/* Of a contact with one tangent; with dy its u'' and v'' in bend, too. */
void events_motion_at(const events *in, int j, const double *y, const double *dy, contact_motion *at, double bend[2]);

/* dy at y, in the states as they are. */
void events_rate(const events *in, double theta, const double *y, double *dy);

/* All guards of contact j at theta and y, where its rate is dy; none of a circle's second direction. How many. */
int events_guards(const events *in, int j, double theta, const double *y, const double *dy,
                  track_guard guard[TRACK_GUARDS]);

/* For CVODE, of which `self` is the events. */
int events_rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self);
int events_jacobian(sunrealtype theta, N_Vector y, N_Vector dy, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2,
                    N_Vector t3);
int events_roots(sunrealtype theta, N_Vector y, sunrealtype *g, void *self);

#endif
