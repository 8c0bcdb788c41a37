/* random.h - the random numbers of the tests. The seed stands in the test. */
#pragma once

#include "numerics/random.h"
