/*
 * Rule broken: a batch may hold any number of points, in a thread with a usual stack.
 * Where statuses are asked for, it notes them in a local array of 16 bytes a point first.
 */
#define LAW_NAME "stack-for-statuses"
#define BEFORE_POINTS                                                            \
    if (o->status) {                                                             \
        volatile char noted[16 * v->points + 16];                                \
        for (int64_t at = 16 * v->points; at >= 0; at -= 16) {                   \
            noted[at] = 0;                                                       \
        }                                                                        \
    }
#include "sound_law.h"
