/*
 * Rule broken: every item of every output that is asked for is written.
 * Only bad statuses are written.
 */
#define LAW_NAME "status-only-if-bad"
#define WRITE_STATUS                                \
    if (status != WL_OK) {                          \
        o->status[i] = status;                      \
    }
#include "sound_law.h"
