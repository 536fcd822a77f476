/*
 * Rule broken: every item of every output that is asked for is written.
 * An increment is written only where there is slip.
 */
#define LAW_NAME "increment-only-with-slip"
#define WRITE_INCREMENT                             \
    if (s != 0) {                                   \
        o->increment[i] = a.increment;              \
    }
#include "sound_law.h"
