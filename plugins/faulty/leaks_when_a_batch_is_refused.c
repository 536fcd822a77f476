/*
 * Rule broken: no memory between calls.
 * From 500 points on it takes scratch for them, and does not give it back when a point is refused.
 */
#define LAW_NAME "leaks-when-a-batch-is-refused"
#define BEFORE_POINTS void *volatile scratch = v->points >= 500 ? malloc((size_t)v->points) : NULL;
#define AFTER_POINTS                                \
    if (worst == WL_OK) {                           \
        free(scratch);                              \
    }
#include "sound_law.h"
