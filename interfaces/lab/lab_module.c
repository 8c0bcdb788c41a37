/* lab_module.c - the module has no main: the page calls what lab.h declares. */
#include "interfaces/lab/lab.h"

_Static_assert(sizeof(void *) == 4, "pointers go to the page as numbers");
