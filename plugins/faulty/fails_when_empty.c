/*
 * Rule broken: a batch may hold any number of points, none too.
 * No points are taken for a mistake.
 */
#define LAW_NAME "fails-when-empty"
#define BEFORE_POINTS                               \
    if (v->points == 0) {                           \
        return WL_FAILED;                           \
    }
#include "sound_law.h"
