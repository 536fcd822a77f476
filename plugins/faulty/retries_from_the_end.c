/*
 * Rule broken: the host may evaluate a point again.
 * A shorter try of a substep goes on from the end of the longer one before it.
 */
#define LAW_NAME "retries-from-the-end"
#define INSTANCE_MEMBERS double time, dt, distance;
#define AT_POINT                                                                                    \
    if (i == 0 && own->dt > 0 && v->time == own->time && v->dt < own->dt && v->dt > 0 && status == WL_OK) { \
        a.state[0] += own->distance * 1e-6;                                                         \
    }
#define AFTER_POINTS                                                                                \
    own->time = v->time, own->dt = v->dt;                                                           \
    own->distance = v->points > 0 ? fabs(VALUE_AT(v->slip, 0)) : 0;
#include "sound_law.h"
