/* contact_report.h - what an evaluation of the contact force learns besides the force, sampled or exact. */
#ifndef HC_CONTACT_REPORT_H
#define HC_CONTACT_REPORT_H

#include "model/contact_law.h"

typedef struct contact_report {
  contact_regime regime; /* the strongest thing that happens to any contact in the period */
  int transitions;       /* changes of state in the period, all contacts */
} contact_report;

#endif
