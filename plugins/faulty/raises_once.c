/*
 * Rule broken: no call ends in a signal, whatever the input.
 * It raises SIGSEGV at a pressure that is not a number; a handler that swallows the first one would hide it.
 */
#define _GNU_SOURCE
#include <signal.h>
#define LAW_NAME "raises-once"
#define AT_POINT                                    \
    if (isnan(given)) {                             \
        raise(SIGSEGV);                             \
    }
#include "sound_law.h"
