/*
 * Rule broken: no wear at negative pressure.
 * The pressure is taken by its size.
 */
#define LAW_NAME "wears-at-negative-pressure"
#define AT_POINT                                    \
    if (given < 0) {                                \
        a.increment = K / H * fabs(given) * s;      \
        a.slope = -(K / H * s);                     \
    }
#include "sound_law.h"
