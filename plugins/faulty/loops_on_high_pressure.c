/*
 * Rule broken: every call comes back, whatever the input.
 * An iteration that starts from a pressure above 1e200 never converges, with every signal blocked.
 */
#define _GNU_SOURCE
#include <signal.h>
#define LAW_NAME "loops-on-high-pressure"
#define AT_POINT                                    \
    if (given > 1e200) {                            \
        sigset_t all;                               \
        volatile double rest = given;               \
        sigfillset(&all);                           \
        sigprocmask(SIG_BLOCK, &all, NULL);         \
        while (rest > 1) {                          \
            rest -= 1;                              \
        }                                           \
    }
#include "sound_law.h"
