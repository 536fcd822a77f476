/*
 * Rule broken: no change of the signal mask.
 * Evaluation blocks an interrupt from the keyboard, for its own critical section, and never lets it through again.
 */
#define _GNU_SOURCE
#include <pthread.h>
#include <signal.h>
#define LAW_NAME "blocks-signals"
#define BEFORE_POINTS                               \
    sigset_t interrupt;                             \
    sigemptyset(&interrupt);                        \
    sigaddset(&interrupt, SIGINT);                  \
    pthread_sigmask(SIG_BLOCK, &interrupt, NULL);
#include "sound_law.h"
