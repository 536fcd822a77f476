/*
 * Rule broken: subnormal inputs give a finite value or a status.
 * The reciprocal of a subnormal pressure overflows, and the increment is not a number.
 */
#define LAW_NAME "nan-at-subnormal"
#define AT_POINT                                    \
    if (p > 0 && isinf(1 / p)) {                    \
        a.increment = K / H * (1 / p) * 0 * s;      \
    }
#include "sound_law.h"
