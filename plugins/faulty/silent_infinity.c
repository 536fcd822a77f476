/*
 * Rule broken: never a silent NaN or infinity.
 * Where the increment overflows, it is infinite and no status says so.
 */
#define LAW_NAME "silent-infinity"
#define AT_POINT                                                                                             \
    if (isfinite(p) && isfinite(s) && isfinite(K) && K >= 0 && isfinite(H) && H > 0) {                       \
        status = WL_OK;                                                                                      \
    }
#include "sound_law.h"
