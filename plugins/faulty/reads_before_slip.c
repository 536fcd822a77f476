/*
 * Rule broken: reads only what it is given.
 * The slip before the first one is read, for a difference.
 */
#define LAW_NAME "reads-before-slip"
#define AFTER_POINTS                                                \
    if (v->points > 0) {                                            \
        (void)*(volatile const double *)(v->slip.ptr - 1);          \
    }
#include "sound_law.h"
