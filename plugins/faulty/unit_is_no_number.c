/*
 * Rule broken: SI exponents are finite numbers.
 * One exponent is not a number.
 */
#define LAW_NAME "unit-is-no-number"
#define LAW_H_UNIT NAN, 1, -2, 0
#include "sound_law.h"
