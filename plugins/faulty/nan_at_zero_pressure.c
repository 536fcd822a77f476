/*
 * Rule broken: zero pressure gives a finite value or a status.
 * Zero over zero at no pressure.
 */
#define LAW_NAME "nan-at-zero-pressure"
#define LAW_CLAIMS (WL_CLAIMS_KNOWN & ~WL_CLAIM_ZERO_WITHOUT_PRESSURE)
#define AT_POINT                                    \
    if (given == 0 && !signbit(given)) {            \
        a.increment = NAN;                          \
    }
#include "sound_law.h"
