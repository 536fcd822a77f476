/*
 * Rule broken: every state variable at the end is written.
 * The work is written only where there is pressure.
 */
#define LAW_NAME "state-only-with-pressure"
#define WRITE_STATE                                 \
    o->state[2 * i] = a.state[0];                   \
    if (given > 0) {                                \
        o->state[2 * i + 1] = a.state[1];           \
    }
#include "sound_law.h"
