/* slider_travel.c - see slider_travel.h. Proof: tests/timeint/test_families.c. */
#include "timeint/law/slider_travel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"

hc_status slider_travel_make(slider_travel *t, int n_contacts)
{
  t->n_contacts = n_contacts;
  t->from = calloc(2 * (size_t)n_contacts + 1, sizeof *t->from);
  t->most = t->from ? t->from + n_contacts : NULL;
  return t->from ? HC_OK : HC_NO_MEMORY;
}

void slider_travel_free(slider_travel *t) { free(t->from); }

static void note(slider_travel *t, contact_state state, int j, double w)
{
  const double far = state == CONTACT_SEPARATED ? INFINITY : fabs(w - t->from[j]);
  if (!(far <= t->most[j])) t->most[j] = far;
}

void slider_travel_end(slider_travel *t, const contact_track *track, const double *w)
{
  for (int j = 0; j < t->n_contacts; ++j) note(t, track[j].state, j, w[j]);
}

void slider_travel_begin(slider_travel *t, const contact_track *track, const double *w)
{
  memcpy(t->from, w, (size_t)t->n_contacts * sizeof *w);
  memset(t->most, 0, (size_t)t->n_contacts * sizeof *t->most);
  slider_travel_end(t, track, w);
}

void slider_travel_note(slider_travel *t, const scaled_contact *c, const contact_track *track, int j,
                        const contact_motion *at)
{
  note(t, track[j].state, j, contact_track_slider(&track[j], c, at));
}

void slider_travel_note_turn(slider_travel *t, int j, double turn)
{
  if (!(fabs(turn) <= TWO_PI / 4)) t->most[j] = t->most[j + 1] = INFINITY;
}

void slider_travel_note_planar(slider_travel *t, const scaled_contact *c, const contact_track *track, int j,
                               const planar_contact_motion *at)
{
  double w[2];
  planar_track_slider(&track[j], c, at, w);
  for (int a = 0; a < 2; ++a) note(t, track[j + a].state, j + a, w[a]);
}
