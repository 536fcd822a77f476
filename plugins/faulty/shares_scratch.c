/*
 * Rule broken: one instance may be evaluated from several threads at once.
 * Slips pass through one static variable.
 */
#define LAW_NAME "shares-scratch"
static volatile double scratch;
#define AT_POINT                                    \
    scratch = s;                                    \
    for (volatile int wait = 0; wait < 20; ++wait) { \
    }                                               \
    if (status == WL_OK) {                          \
        a.increment = K / H * p * scratch;          \
    }
#include "sound_law.h"
