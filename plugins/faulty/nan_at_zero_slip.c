/*
 * Rule broken: zero slip gives a finite value or a status.
 * Zero over zero at no slip.
 */
#define LAW_NAME "nan-at-zero-slip"
#define LAW_CLAIMS (WL_CLAIMS_KNOWN & ~WL_CLAIM_ZERO_WITHOUT_SLIP)
#define AT_POINT                                    \
    if (s == 0 && v->dt > 0) {                      \
        a.increment = NAN;                          \
    }
#include "sound_law.h"
