/* Allowed: a thread that lives with its instance: create starts it, destroy ends and joins it. */
#define _GNU_SOURCE
#include <pthread.h>
#define LAW_NAME "worker-of-instance"
#define INSTANCE_MEMBERS                                                                                               \
    pthread_t thread;                                                                                                  \
    pthread_mutex_t lock;                                                                                              \
    pthread_cond_t ended;                                                                                              \
    int over;
static void *keep(void *of);
#define AT_CREATE                                                                                                      \
    if (own && (!options || !*options)) {                                                                              \
        pthread_mutex_init(&own->lock, NULL);                                                                          \
        pthread_cond_init(&own->ended, NULL);                                                                          \
        pthread_create(&own->thread, NULL, keep, own);                                                                 \
    }
#define AT_DESTROY                                                                                                     \
    if (own) {                                                                                                         \
        pthread_mutex_lock(&own->lock);                                                                                \
        own->over = 1;                                                                                                 \
        pthread_cond_signal(&own->ended);                                                                              \
        pthread_mutex_unlock(&own->lock);                                                                              \
        pthread_join(own->thread, NULL);                                                                               \
        pthread_cond_destroy(&own->ended);                                                                             \
        pthread_mutex_destroy(&own->lock);                                                                             \
    }
#include "../faulty/sound_law.h"
static void *keep(void *of) {
    sound_instance *own = of;
    pthread_mutex_lock(&own->lock);
    while (!own->over) {
        pthread_cond_wait(&own->ended, &own->lock);
    }
    pthread_mutex_unlock(&own->lock);
    return NULL;
}
