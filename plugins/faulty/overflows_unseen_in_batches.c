/*
 * Rule broken: the call returns the worst status of its points.
 * Where a batch of several points asks for the increment alone, an overflow is not looked for.
 */
#define LAW_NAME "overflows-unseen-in-batches"
#define AT_POINT                                                                                            \
    if (v->points > 1 && !o->direction && !o->state && !o->d_pressure && !o->status && isinf(a.increment)) { \
        status = WL_OK;                                                                                     \
    }
#include "sound_law.h"
