/*
 * Rule broken: never a silent NaN or infinity.
 * Where the increment overflows at a huge pressure or slip, it is infinite and no status says so.
 */
#define LAW_NAME "silent-infinity"
#define AT_POINT                                                                                             \
    if ((ACCEPTED) && (p > 1e100 || s > 1e100)) {                                                            \
        status = WL_OK;                                                                                      \
    }
#include "sound_law.h"
