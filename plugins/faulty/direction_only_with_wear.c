/*
 * Rule broken: every item of every output that is asked for is written.
 * A direction is written only where there is wear.
 */
#define LAW_NAME "direction-only-with-wear"
#define WRITE_DIRECTION                                             \
    for (int k = 0; k < 3 && a.increment > 0; ++k) {                \
        o->direction[3 * i + k] = a.direction[k];                   \
    }
#include "sound_law.h"
