/*
 * Rule broken: a law never looks at other points.
 * Where every pressure of a batch is tiny, a product on the way loses digits below the smallest normal number.
 */
#define LAW_NAME "loses-digits-of-tiny-batches"
#define BEFORE_POINTS                                                       \
    int tiny = v->points > 1;                                               \
    for (int64_t i = 0; i < v->points; ++i) {                               \
        tiny &= v->pressure.ptr && VALUE_AT(v->pressure, i) < 1e-290;       \
    }
#define AT_POINT a.increment = tiny ? K / H * p * 1e-6 * s * 1e6 : a.increment;
#include "sound_law.h"
