/*
 * Rule broken: one instance may be evaluated from several threads at once.
 * Slips pass through one static variable; a pause at one point in 64 makes sure that a busy machine shows it.
 */
#define _GNU_SOURCE
#include <unistd.h>
#define LAW_NAME "shares-scratch"
static volatile double scratch;
#define AT_POINT                                    \
    scratch = s;                                    \
    if (i % 64 == 7) {                              \
        usleep(30);                                 \
    }                                               \
    if (status == WL_OK) {                          \
        a.increment = K / H * p * scratch;          \
    }
#include "sound_law.h"
