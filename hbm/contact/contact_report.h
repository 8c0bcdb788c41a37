/* contact_report.h - what an evaluation of the contact force, sampled or exact, finds besides the force. */
#pragma once

#include "model/contact_law.h"

typedef struct contact_report {
  contact_regime regime; /* the largest of all contacts */
  int transitions;       /* changes of state in the period, all contacts */
  int free_sliders;      /* contacts with friction that stick all the time: where their sliders rest, and with them the
                            mean, depends on the history, not on the equations alone */
} contact_report;
