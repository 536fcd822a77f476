/*
 * Rule broken: an instance leaves nothing behind, a process neither.
 * Create forks a child that leads a session of its own and waits for ever.
 */
#define _GNU_SOURCE
#include <unistd.h>
#define LAW_NAME "forks-a-session"
#define AT_CREATE                                   \
    if (fork() == 0) {                              \
        setsid();                                   \
        for (;;) {                                  \
            pause();                                \
        }                                           \
    }
#include "sound_law.h"
