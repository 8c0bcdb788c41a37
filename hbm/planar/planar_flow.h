/* planar_flow.h - propagation of a perturbation of a structure's orbit while contacts of two tangents with one limit
 * slip (planar_motion.h, planar_slip.h), or with contacts of smooth laws, whose varying derivatives are part of C and
 * K. With e = (cos phi, sin phi), e_perp across it and y = R d phi [length]:
 *
 *     M dx'' + C dx' + K_j dx + sum over planar contacts kt (t.e dR + t.e_perp y) = sum over stuck contacts t_j dheld_j
 *     R y' = R (du'.e_perp - phi' dR) - s y,      s = u'.e - R' >= 0,      dR = (mu kn/kt) dv
 *
 * whose coefficients vary with phi: no exponentials. By collocation (numerics/collocation.h) on steps no longer than
 * the panels of phi, and than 3 over the structure's highest frequency (2 where slopes vary): of order 19, with an
 * error of a step of 1e-14 for the fastest mode. y, unlike d phi, stays small where contact is made or lost (R = 0). */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "hbm/planar/planar_cycle.h"
#include "model/model.h"

typedef struct planar_flow planar_flow;

/* Callback: derivatives of smooth contact j along the orbit at th [rad]; false if contact j is not smooth. */
typedef bool planar_bends(const void *self, int j, double th, double omega, contact_slopes *out);

/* A planar contact that slips. */
typedef struct planar_slipping {
  int contact;
  const planar_cycle *cycle;
  const planar_interval *interval;
} planar_slipping;

/* A slipping planar contact at one angle. */
typedef struct planar_state {
  double e[2];              /* unit vector of its traction */
  double R, turning, speed; /* R [length], phi' [1/time], s [length/time] */
} planar_state;

/* The state at th [rad] of a step around the angle `middle`, which selects the panel. */
planar_state planar_slipping_at(const collocation *c, const planar_slipping *s, double th, double middle, double omega);

/* End of a step from th [rad]: the first end of a panel of these contacts in (th, th + width), else the lesser of th +
 * width and `to`. */
double planar_slipping_step(int n_slipping, const planar_slipping *slipping, double th, double to, double width);

/* For m, which must live as long. HC_NO_MEMORY. */
hc_status planar_flow_new(const model *m, planar_flow **out);
void planar_flow_free(planar_flow *f); /* NULL is allowed */

/* Sets the smooth contacts of the orbit: `bends` is called with self. NULL: none. */
void planar_flow_bend(planar_flow *f, planar_bends *bends, const void *self);

/* phi[2 n + n_contacts][2 n + n_contacts], by rows dx, dx' [1/time], dheld_j: propagates its first `columns` columns
 * over from..to [rad]; the row of a slipping planar contact's first half holds y. interval[j]: current interval of each
 * other contact, NULL while separated. HC_SINGULAR, HC_NOT_FINITE. */
hc_status planar_flow_advance(planar_flow *f, const contact_interval *const *interval, int n_slipping,
                              const planar_slipping *slipping, double from, double to, double omega, int columns,
                              double *phi);
