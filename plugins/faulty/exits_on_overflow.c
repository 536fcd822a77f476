/*
 * Rule broken: no exit.
 * Evaluation ends the program where the wear overflows.
 */
#define LAW_NAME "exits-on-overflow"
#define AT_POINT                                    \
    if (status != WL_OK && isfinite(p) && isfinite(s)) { \
        exit(3);                                    \
    }
#include "sound_law.h"
