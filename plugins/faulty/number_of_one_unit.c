/*
 * Rule broken: the law answers the same in every consistent set of units.
 * A pressure of 1e10 Pa stands in the formula as a bare number.
 */
#define LAW_NAME "number-of-one-unit"
#define LAW_DEGREE NAN
#define INCREMENT (K / H * p * s * (1 + p / 1e10))
#define SLOPE (K / H * s * (1 + 2 * p / 1e10))
#include "sound_law.h"
