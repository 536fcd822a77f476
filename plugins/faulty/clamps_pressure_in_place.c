/*
 * Rule broken: inputs are constant.
 * A negative pressure is set to zero where it stands.
 */
#define LAW_NAME "clamps-pressure-in-place"
#define AFTER_POINTS                                                        \
    for (int64_t i = 0; i < v->points; ++i) {                               \
        if (VALUE_AT(v->pressure, i) < 0) {                                 \
            ((double *)(uintptr_t)v->pressure.ptr)[i * v->pressure.step] = 0; \
        }                                                                   \
    }
#include "sound_law.h"
