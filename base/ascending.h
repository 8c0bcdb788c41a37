/* ascending.h - the order in which qsort puts doubles. */
#ifndef HC_ASCENDING_H
#define HC_ASCENDING_H

/* a, b: const double *. Not for NaN, which is no part of any order. */
static inline int ascending(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

#endif
