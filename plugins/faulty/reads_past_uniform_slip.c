/*
 * Rule broken: the law reads and writes within the arrays only.
 * It loads the slip in pairs, also where one value stands for all points.
 */
#define LAW_NAME "reads-past-uniform-slip"
static volatile double second;
#define BEFORE_POINTS                               \
    if (v->points > 0 && v->slip.step == 0) {       \
        second = v->slip.ptr[1];                    \
    }
#include "sound_law.h"
