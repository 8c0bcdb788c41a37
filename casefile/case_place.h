/* case_place.h - where something was given, for messages. */
#ifndef HC_CASE_PLACE_H
#define HC_CASE_PLACE_H

#include <stddef.h>

/* The set-th assignment, counted from 1, or for set = 0 a line and column of the file. line = 0: nowhere. */
typedef struct case_place {
  int set;
  size_t line, column;
} case_place;

#endif
