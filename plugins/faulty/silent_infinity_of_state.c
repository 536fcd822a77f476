/*
 * Rule broken: never a silent NaN or infinity.
 * Where the distance or the work so far overflows, it is infinite at the end and no status says so.
 */
#define LAW_NAME "silent-infinity-of-state"
#define AT_POINT                                                                                                       \
    if ((ACCEPTED) && !STRANGE(a.increment) && !STRANGE(a.slope) && !STRANGE(normal[0] + normal[1] + normal[2]) &&     \
        !isnan(start[0] + start[1])) {                                                                                 \
        status = WL_OK;                                                                                                \
    }
#include "sound_law.h"
