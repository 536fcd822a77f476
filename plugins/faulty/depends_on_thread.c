/*
 * Rule broken: pure: everything comes from the inputs.
 * In every thread but the first the answer is one unit in the last place off.
 */
#define _GNU_SOURCE
#include <unistd.h>
#define LAW_NAME "depends-on-thread"
#define AT_POINT                                                    \
    if (a.increment > 0 && gettid() != getpid()) {                  \
        a.increment = nextafter(a.increment, INFINITY);             \
    }
#include "sound_law.h"
