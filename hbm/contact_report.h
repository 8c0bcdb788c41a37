/* contact_report.h - what an evaluation of the contact force, sampled or exact, finds besides the force. */
#ifndef HC_CONTACT_REPORT_H
#define HC_CONTACT_REPORT_H

#include "model/contact_law.h"

typedef struct contact_report {
  contact_regime regime; /* the largest of all contacts */
  int transitions;       /* changes of state in the period, all contacts */
} contact_report;

#endif
