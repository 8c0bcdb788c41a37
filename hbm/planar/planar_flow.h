/* planar_flow.h - how a perturbation of a structure's orbit moves while contacts of two tangents with one limit slip
 * (planar_motion.h, planar_slip.h), or where contacts follow smooth laws, whose slopes are in C and K as they vary.
 * With e = (cos phi, sin phi), e_perp across it and y = R d phi [length]:
 *
 *     M dx'' + C dx' + K_j dx + sum over planar contacts kt (t.e dR + t.e_perp y) = sum over stuck contacts t_j dheld_j
 *     R y' = R (du'.e_perp - phi' dR) - s y,      s = u'.e - R' >= 0,      dR = (mu kn/kt) dv
 *
 * whose coefficients vary with phi: no exponentials. By collocation (numerics/collocation.h) on steps no longer than
 * the panels of phi, and than 3 over the structure's highest frequency (2 where slopes vary): of order 19, the error of
 * a step is 1e-14 of what moves fastest. y, unlike d phi, stays small where contact is made or lost (R = 0). */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "hbm/planar/planar_cycle.h"
#include "model/model.h"

typedef struct planar_flow planar_flow;

/* The derivatives of smooth contacts along the orbit: those of contact j at th; false: it is none. */
typedef bool planar_bends(const void *self, int j, double th, double omega, contact_slopes *out);

/* A planar contact that slips: its first half, and its interval. */
typedef struct planar_slipping {
  int contact;
  const planar_cycle *cycle;
  const planar_interval *interval;
} planar_slipping;

/* A slipping planar contact at one angle. */
typedef struct planar_state {
  double e[2];              /* direction of its traction */
  double R, turning, speed; /* R [length], phi' [1/time], s [length/time] */
} planar_state;

/* At th [rad], of a step around `middle`. */
planar_state planar_slipping_at(const collocation *c, const planar_slipping *s, double th, double middle, double omega);

/* The end of the first of these contacts' panels that ends in (th, th + width), else th + width or `to` before it. */
double planar_slipping_step(int n_slipping, const planar_slipping *slipping, double th, double to, double width);

/* For m, which must live as long. HC_NO_MEMORY. */
hc_status planar_flow_new(const model *m, planar_flow **out);
void planar_flow_free(planar_flow *f); /* NULL is allowed */

/* The orbit that is followed from here on: `bends` is asked with self. */
void planar_flow_bend(planar_flow *f, planar_bends *bends, const void *self);

/* phi[2 n + n_contacts][2 n + n_contacts], by rows dx, dx' [1/time], dheld_j, its first `columns` columns, over the
 * interval from..to [rad]; y of a slipping planar contact is in the row of its first half. interval[j] of the other
 * contacts, NULL while separated. HC_SINGULAR, HC_NOT_FINITE. */
hc_status planar_flow_advance(planar_flow *f, const contact_interval *const *interval, int n_slipping,
                              const planar_slipping *slipping, double from, double to, double omega, int columns,
                              double *phi);
