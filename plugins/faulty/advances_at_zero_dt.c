/*
 * Rule broken: a substep of no length leaves the state as it was.
 * The state counts a distance of rounding even if time stands still.
 */
#define LAW_NAME "advances-at-zero-dt"
#define AT_POINT                                    \
    if (v->dt == 0) {                               \
        a.state[0] = nextafter(a.state[0], INFINITY) + 1e-9; \
    }
#include "sound_law.h"
