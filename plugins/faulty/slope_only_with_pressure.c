/*
 * Rule broken: every item of every output that is asked for is written.
 * The derivative is written only under pressure.
 */
#define LAW_NAME "slope-only-with-pressure"
#define WRITE_D_PRESSURE                            \
    if (given > 0) {                                \
        o->d_pressure[i] = a.slope;                 \
    }
#include "sound_law.h"
