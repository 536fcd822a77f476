/*
 * Rule broken: threads of an instance end with it.
 * Create starts a thread, destroy does not end it.
 */
#define _GNU_SOURCE
#include <pthread.h>
#include <unistd.h>
#define LAW_NAME "leaves-thread-behind"
static void *wait_for_work(void *unused) {
    (void)unused;
    for (;;) {
        pause();
    }
    return NULL;
}
#define AT_CREATE                                   \
    pthread_t thread;                               \
    pthread_create(&thread, NULL, wait_for_work, NULL);
#include "sound_law.h"
