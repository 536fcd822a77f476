/*
 * Rule broken: loading a library does nothing else.
 * Its constructor misses a licence file and aborts.
 */
#define LAW_NAME "aborts-at-load"
#define AT_LOAD                                                 \
    if (!getenv("WEAR_LICENCE_OF_NOBODY")) {                    \
        abort();                                                \
    }
#include "sound_law.h"
