/*
 * Rule broken: the law answers everywhere within the bounds that it declares.
 * A wear coefficient of zero, its lower bound, gives no number.
 */
#define LAW_NAME "nan-at-bound"
#define AT_POINT                                    \
    if (K == 0) {                                   \
        a.increment = NAN;                          \
    }
#include "sound_law.h"
