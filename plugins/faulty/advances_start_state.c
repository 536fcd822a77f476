/*
 * Rule broken: the state at the start is constant.
 * The distance is advanced where it stands, too.
 */
#define LAW_NAME "advances-start-state"
#define AFTER_POINTS                                                                                        \
    for (int64_t i = 0; i < v->points; ++i) {                                                               \
        ((double *)(uintptr_t)v->state.ptr)[i * v->state.step] += fabs(VALUE_AT(v->slip, i));               \
    }
#include "sound_law.h"
