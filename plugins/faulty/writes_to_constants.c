/*
 * Rule broken: inputs are constant.
 * A hardness is written back, as it was, after it was looked at.
 */
#define LAW_NAME "writes-to-constants"
#define AFTER_POINTS                                                                        \
    if (v->points > 0) {                                                                    \
        volatile double *hardness = (double *)(uintptr_t)v->constants[1].ptr;               \
        *hardness = *hardness;                                                              \
    }
#include "sound_law.h"
