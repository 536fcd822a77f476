/*
 * Rule broken: a substep of no length wears nothing.
 * The velocity is slip over dt, also where dt is zero.
 */
#define LAW_NAME "divides-by-dt"
#define AT_POINT                                    \
    if (v->dt == 0) {                               \
        a.increment = K / H * p * (s / v->dt) * v->dt; \
    }
#include "sound_law.h"
