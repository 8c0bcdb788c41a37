/* advice.h - what to change in a case after a solver failed. About a discrepancy: remedy.h. */
#pragma once

#include "hbm/hbm_settings.h"
#include "numerics/base/status.h"
#include "timeint/transient_settings.h"

enum { ADVICE_TEXT = 320 };

/* "try --set hbm.continuation=auto or --set hbm.force=exact", what may mend this failure of harmonic balance (of time
 * integration); "" where no setting does, or all that might are in force. Returns text. */
const char *advice_for_hbm(const hbm_settings *how, hc_status failure, char text[ADVICE_TEXT]);
const char *advice_for_transient(const transient_settings *how, hc_status failure, char text[ADVICE_TEXT]);

#define ADVICE_ON_CREEP "try a spring or a stop that holds it, or a load that friction holds all the time"

/* After HC_NOT_FINITE of either side, from the scene's damping. A constant string. */
const char *advice_on_size(double damping);
#define ADVICE_ON_STRUCTURE /* the same of a structure, whose damping is a matrix */                                   \
  "numbers became too large or too small: does the motion grow without bound (a mode without damping, a stiffness "    \
  "that is not symmetric)? are units right?"
