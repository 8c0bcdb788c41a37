/* random.h - the random numbers of the tests. The seed stands in the test. */
#ifndef HC_TESTS_RANDOM_H
#define HC_TESTS_RANDOM_H

#include "numerics/random.h"

#endif
