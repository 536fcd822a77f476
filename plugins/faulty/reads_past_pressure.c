/*
 * Rule broken: reads only what it is given.
 * The pressure behind the last one is read, for a look ahead.
 */
#define LAW_NAME "reads-past-pressure"
#define AFTER_POINTS                                                                        \
    if (v->points > 0) {                                                                    \
        (void)*(volatile const double *)(v->pressure.ptr + (v->points - 1) * v->pressure.step + 1); \
    }
#include "sound_law.h"
