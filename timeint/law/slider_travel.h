/* slider_travel.h - how far the sliders of a structure's contacts have been, in one period, from where it began: from
 * their places at their changes of state. Between two of these that of one tangent is monotonic; a circle's may come
 * back to where it was, its direction having turned: its places in between are to be noted, or that it turned. libm
 * only. */
#ifndef HC_TIMEINT_SLIDER_TRAVEL_H
#define HC_TIMEINT_SLIDER_TRAVEL_H

#include "timeint/law/planar_track.h"

typedef struct slider_travel {
  int n_contacts;
  double *from; /* [n_contacts] W where the period began */
  double *most; /* [n_contacts] the largest |W - from| since; INFINITY once separated */
} slider_travel;

hc_status slider_travel_make(slider_travel *t, int n_contacts); /* HC_NO_MEMORY */
void slider_travel_free(slider_travel *t);

/* The period begins with these states, the sliders at w[n_contacts]; it is over, they are there. */
void slider_travel_begin(slider_travel *t, const contact_track *track, const double *w);
void slider_travel_end(slider_travel *t, const contact_track *track, const double *w);

/* Contact j, of one tangent or of two (its first), is in its state at that motion. */
void slider_travel_note(slider_travel *t, const scaled_contact *c, const contact_track *track, int j,
                        const contact_motion *at);
void slider_travel_note_planar(slider_travel *t, const scaled_contact *c, const contact_track *track, int j,
                               const planar_contact_motion *at);

/* The direction in which that circle slips has turned by so much since it began to [rad]: up to a quarter, W is
 * farther from where it was the longer it slips. */
void slider_travel_note_turn(slider_travel *t, int j, double turn);

#endif
