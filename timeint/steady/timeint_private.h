/* timeint_private.h - what is behind the handle of timeint.h, for the files of this folder alone. Functions: state.c.
 *
 * The motion is at a whole number of periods, at the state y in the scaled model's units; whoever moves it keeps
 * `scaled` in step with omega and length. */
#pragma once

#include "timeint/law/scaled.h"
#include "timeint/law/state_sizes.h"
#include "timeint/period/integrate.h"
#include "timeint/period/measure.h"
#include "timeint/steady/settle.h"
#include "timeint/timeint.h"

/* What the equations were of an orbit that was found: kept as long as somebody may come back to it. */
enum { KNOWN_ORBITS = 4 };
typedef struct known_orbit {
  double omega, regularisation;
  double *state;     /* [n] as it was given out */
  double *vibration; /* [rows of state_sizes.h] */
} known_orbit;

/* The size of a motion [length] after so many periods; 0: none yet. */
typedef struct size_noted {
  int periods;
  double size;
} size_noted;

struct timeint {          /* from timeint_new, to timeint_free; not shared between threads              */
  model *model;           /* the caller's, about rest: x of it is x - rest (model/rest.h)                */
  double *rest;           /* [n_dof] [length] */
  double *rest_u;         /* [contacts] [length] tangent . rest: a slider of it is w - rest_u */
  transient_settings how; /* a copy; its regularisation may be halved for an orbit                      */
  double regularisation;  /* what was asked for                                                         */
  modal_base *whole;      /* the model in its modes                                                     */
  modal_base *base;       /* what is integrated: `whole`, or a copy with its fastest modes slowed       */
  bool may_slow;          /* it may be that (mass_scaling.h)                                             */
  double fastest;         /* [rad/time] its fastest mode; INFINITY: none is slowed                      */
  timeint *slowed;        /* of a closed form whose fastest modes are not slowed: the same, but that they
                             are; it gives monodromy matrices; or NULL                                  */
  bool no_multipliers;    /* nobody asks for them: timeint_leave_multipliers                            */
  int n_dof, n;           /* degrees of freedom; number of states, 2 n_dof + contacts                   */
  integrator *in;
  integrator *exact; /* of the exact law, for sweeps, where `in` is not and there is no closed_form; else NULL */
  settle *settle;
  struct period_map *map;   /* of its periods */
  struct shoot *shoot;      /* the search for its fixed points */
  timeint *closed_form;     /* of the same model, in closed form; NULL without transient.scout           */
  bool shares_closed_form;  /* it is another handle's, too                                              */
  int owners;               /* handles whose closed_form this is, or 1                                   */
  long periods_before;      /* of integrators that have been replaced                                   */
  struct memory *confirmed; /* with it: orbits found lately (closed_form_start.c)                       */
  measure measure;
  bool measured;        /* it is of the periods that led to y                                        */
  struct {              /* of a motion that does not repeat, each response's least and largest amplitude       */
    int periods;        /* 0: it repeats                                                         */
    double *low, *high; /* [responses] [length] */
  } window;
  struct {                 /* the orbit measured last, of a large structure in closed form              */
    int k;                 /* its periods; 0: none                                                      */
    int switches, returns; /* what a result says of it: switches, period_multiple                       */
    double omega, length;  /* and where these periods ended, in that unit                               */
    double *end;           /* [n]                                                                       */
  } last;
  scaled_model scaled; /* the equations at omega in units of length                                     */
  double omega;        /* [rad/time]                                                                    */
  double length;       /* [length] about the size of the motion; y is in units of it                    */
  double least_length; /* [length] the unit is never smaller                                            */
  double start_size;   /* [length] of the motion that timeint_steady or timeint_orbit began with */
  state_sizes sizes;   /* of states in that unit                                                        */
  known_orbit known[KNOWN_ORBITS];
  int next_known;
  double *amplitudes;        /* [2][responses] of the exact law's orbit; of the orbit before the last           */
  double tolerance;          /* [1] CVODE's at present                                                        */
  double contraction;        /* [1] a priori, per period: exp(-T least C_ii/2), of modes                       */
  int periods;               /* since timeint_begin                                                           */
  size_noted noted[2];       /* the last but one, and the last (escape.h)                                      */
  bool creeps;               /* by drift[n_dof] [length] a period                                              */
  double *drift;             /*                                                                                */
  double *states[3];         /* [n] in the case's coordinates, a period apart                                  */
  long steps0, rhs0;         /* counts at timeint_begin                                                       */
  double *y;                 /* [n] the state                                                                 */
  double *saved;             /* [n] y before a Newton solve whose answer may be rejected                      */
  double *direction;         /* [n] in which an unstable orbit is left                                        */
  double *from_rest;         /* [n_dof] x of a state as it comes in, less rest                                  */
  double *closed_form_state; /* [n] of the closed form's orbit, in the model's units                                */
  double *neighbour;         /* [n] state of a second motion, drawn along with the first                      */
  double *separation;        /* [n] neighbour - y at the beginning of a period                                */
  double *point[3];          /* [n] states as timeint_point has them                                          */
  double *began;             /* [n] where a measurement of periods began                                      */
  double *past;              /* [SETTLE_MAX_MULTIPLE][n] a ring of the latest of these                        */
  workspace memory;          /* of all the arrays above                                                       */
};

/* As timeint_new, for the model of another handle. */
hc_status timeint_new_like(const timeint *of, const transient_settings *how, timeint **out);

/* ti->in and ti->exact, of ti->base, whatever they were of before. HC_NO_MEMORY. */
hc_status timeint_make_integrators(timeint *ti);

/* ti->base and its integrators for omega, where fast modes may be slowed. HC_NO_MEMORY. */
hc_status timeint_slow_modes(timeint *ti, double omega);

/* Equations, unit of length and a-priori contraction for omega; y from state[n]. HC_BAD_INPUT unless omega and the
 * state are finite, omega > 0. */
hc_status timeint_begin(timeint *ti, double omega, const double *state);

/* The equations in another unit of length, ti->y in it, and sizes of states there. */
void timeint_use_length(timeint *ti, double length);

/* ti->measure is of the orbit of k periods that ended at end[n], of so many switches, which returns after so many
 * periods: ti->last. */
void timeint_note_measured(timeint *ti, int k, const double *end, int switches, int returns);

/* Vibrations become those of the periods that `of`, a handle of the same model, measured last; nothing happens where
 * there are none. */
void timeint_use_measured(timeint *ti, const timeint *of);

/* [1] |z| in units of states' sizes, z[n] as ti->y; and of a - b; and the largest component of that. */
double timeint_norm(const timeint *ti, const double *z);
double timeint_distance(const timeint *ti, const double *a, const double *b);
double timeint_farthest(const timeint *ti, const double *a, const double *b);

/* [length] By about how much response i is off where a state is by 1 of its size. */
double timeint_response_unit(const timeint *ti, int i);

/* ti->y is on an orbit, which has been given out as `state`. */
void timeint_remember(timeint *ti, const double *state);

/* Another regularisation from the next period on. */
void timeint_regularise(timeint *ti, double regularisation);

/* Another tolerance of CVODE's from the next period on. */
hc_status timeint_set_tolerance(timeint *ti, double tolerance);

/* Measures of response i of the periods measured last, in the case's coordinates, into *r. */
void timeint_report(const timeint *ti, int i, timeint_result *r);

/* Those of a motion about rest become those in the case's coordinates. */
void timeint_shift_result(const timeint *ti, int i, timeint_result *r);

/* What periods hear between their steps, of closed_form, too, until something else is given; what it was before. */
const hc_monitor *timeint_hear(timeint *ti, const hc_monitor *monitor);

/* One period, measured or not; then the unit of length follows the motion. */
hc_status timeint_period(timeint *ti, bool measured);

/* state[n]: where the motion is, in the case's coordinates and units. A contact without friction has its slider where
 * the exact law has it, at u. */
void timeint_get_state(const timeint *ti, double *state);

/* y[n]: `state`, of the case's coordinates, as ti->y has it, at the present omega, in the present unit of length. */
void timeint_take_state(const timeint *ti, const double *state, double *y);

/* ti->y becomes what it was when timeint_save was last called; neither changes the unit of length. */
void timeint_save(timeint *ti);
void timeint_restore(timeint *ti);

/* [length] |(x, v/omega)| now: of one mass the amplitude, if the motion were harmonic and centred. */
double timeint_size(const timeint *ti);

/* [length] the same, but no less than least_length: what distances between states are compared with. */
double timeint_motion_size(const timeint *ti);

/* [L] The same in units of ti->length, as ti->y is. */
double timeint_scaled_size(const timeint *ti);

/* z[n] [length]: what settling is judged by: modal q and q'/omega (modal_base.h), and of each slider about how far q
 * would follow it, s^2 kt |t_j| w_j/highest^2; 0 without friction. In units of states' sizes, times the unit of
 * length. */
void timeint_point(const timeint *ti, double *z);

/* CVODE's tolerance for a steady state within transient.tolerance. */
double timeint_final_tolerance(const timeint *ti);
