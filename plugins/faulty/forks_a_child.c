/*
 * Rule broken: an instance leaves nothing behind, a process neither.
 * Create forks a child that waits for work for ever.
 */
#define _GNU_SOURCE
#include <unistd.h>
#define LAW_NAME "forks-a-child"
#define AT_CREATE                                   \
    if (fork() == 0) {                              \
        for (;;) {                                  \
            pause();                                \
        }                                           \
    }
#include "sound_law.h"
