/*
 * Rule broken: every call comes back, whatever the input.
 * An infinite pressure is halved until it is small, with every signal blocked.
 */
#define _GNU_SOURCE
#include <signal.h>
#define LAW_NAME "loops-on-infinity"
#define AT_POINT                                    \
    if (isinf(given)) {                             \
        sigset_t all;                               \
        volatile double rest = given;               \
        sigfillset(&all);                           \
        sigprocmask(SIG_BLOCK, &all, NULL);         \
        while (rest > 1 || rest < -1) {             \
            rest /= 2;                              \
        }                                           \
    }
#include "sound_law.h"
