/*
 * Rule broken: no call ends in a signal, whatever the input.
 * It raises SIGSEGV unless the pressure is a number below 1e200; a handler that swallows the first one would hide
 * it.
 */
#define _GNU_SOURCE
#include <signal.h>
#define LAW_NAME "raises-once"
#define AT_POINT                                    \
    if (!(given < 1e200)) {                         \
        raise(SIGSEGV);                             \
    }
#include "sound_law.h"
