/*
 * Rule broken: the floating-point environment is left as it was found, in every thread.
 * Evaluation turns on flush-to-zero in every thread but the first of the process.
 */
#define _GNU_SOURCE
#include <unistd.h>
#include "control_register.h"
#define LAW_NAME "flushes-in-other-threads"
#define BEFORE_POINTS                               \
    if (gettid() != getpid()) {                     \
        flush_to_zero();                            \
    }
#include "sound_law.h"
