/*
 * Rule broken: loading a library comes back.
 * Its constructor waits for a lock that nobody lets go.
 */
#include <pthread.h>
#define LAW_NAME "hangs-at-load"
#define AT_LOAD                                     \
    pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; \
    pthread_mutex_lock(&lock);                      \
    pthread_mutex_lock(&lock);
#include "sound_law.h"
