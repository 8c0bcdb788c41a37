/* status.c - the words of status.h's list. */
#include "numerics/base/status.h"

const char *hc_status_text(hc_status status)
{
  switch (status) {
#define HC_STATUS_CASE(code, text)                                                                                     \
  case code: return text;
    HC_STATUS_LIST(HC_STATUS_CASE)
#undef HC_STATUS_CASE
  }
  return "unknown status";
}
