/*
 * Rule broken: writes every output that is asked for and nothing else.
 * A running sum begins one element before the increments.
 */
#define LAW_NAME "writes-before-increment"
#define AFTER_POINTS                                                \
    if (v->points > 0) {                                            \
        volatile double *before = o->increment - 1;                 \
        *before = *before;                                          \
    }
#include "sound_law.h"
