/*
 * Rule broken: loading starts no thread.
 * Its constructor starts a thread that waits for work for ever.
 */
#define _GNU_SOURCE
#include <pthread.h>
#include <unistd.h>
#define LAW_NAME "starts-thread-at-load"
static void *wait_for_work(void *unused) {
    (void)unused;
    for (;;) {
        pause();
    }
    return NULL;
}
#define AT_LOAD                                     \
    pthread_t thread;                               \
    pthread_create(&thread, NULL, wait_for_work, NULL);
#include "sound_law.h"
