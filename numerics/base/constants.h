/* constants.h - numbers of mathematics, once, as macros: they stand in initialisers. */
#pragma once

#define PI     3.14159265358979323846
#define TWO_PI 6.28318530717958647693
