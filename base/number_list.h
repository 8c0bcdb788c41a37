/* number_list.h - a short list of numbers by value, as options and case files give them. */
#ifndef HC_NUMBER_LIST_H
#define HC_NUMBER_LIST_H

enum { NUMBER_LIST_MAX = 256 };

typedef struct number_list {
  int n;
  double v[NUMBER_LIST_MAX];
} number_list;

#endif
