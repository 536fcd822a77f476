/*
 * Rule broken: the floating-point environment is left as it was found.
 * One call of ten thousand leaves rounding downward behind.
 */
#include <fenv.h>
#define LAW_NAME "rounds-downward-once"
static long calls;
#define AFTER_POINTS                                \
    if (++calls % 10000 == 0) {                     \
        fesetround(FE_DOWNWARD);                    \
    }
#include "sound_law.h"
