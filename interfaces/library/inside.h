/* inside.h - what the parts of the C API share: a case, and how arguments and statuses come in and go out. */
#pragma once

#include <math.h>
#include <stdbool.h>

#include "interfaces/library/hbmcheck.h"
#include "model/casefile/scene.h"
#include "model/contact_period.h"
#include "numerics/base/status.h"

struct hbmcheck_case {
  scene sc;
  bool watch_contacts; /* what each does, too, in runs that integrate */
};

/* The public statuses have the values of the inner ones (hbmcheck.c). */
static inline hbmcheck_status public_status(hc_status st) { return (hbmcheck_status)st; }

/* Is there a result to hand over after st? If not, *out stays NULL. */
static inline bool has_result(hc_status st) { return st != HC_BAD_INPUT && st != HC_NO_MEMORY; }

static inline bool is_omega(double omega) { return isfinite(omega) && omega > 0; }

/* *m, which may be NULL, must live as long as the answer. */
hc_monitor library_monitor(const hbmcheck_monitor *m);

/* The scene of c with omega[n] for its compare.omega; n = 0: as it is. false: that is not a list of omegas. */
bool library_scene(const hbmcheck_case *c, int n, const double *omega, scene *out);

/* text into message[size], cut to size; message may be NULL. */
void library_say(char *message, size_t size, const char *text);

/* What is to be compared of sc, the scene of c or one made of it. Clear with scene_setup_clear in any case. */
hc_status library_setup(const hbmcheck_case *c, const scene *sc, compare_setup *out);

hbmcheck_contact_period library_period(const contact_period *p);

/* The first of the n values `from`, as many as there is room for. */
void library_copy(int n, const double *from, int cap, double *to);
