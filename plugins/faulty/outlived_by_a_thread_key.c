/*
 * Rule broken: a library can be loaded and unloaded any number of times.
 * A thread key whose destructor lies in the library is never deleted: the next thread that ends calls what is gone.
 */
#include <pthread.h>
#define LAW_NAME "outlived-by-a-thread-key"
static pthread_key_t key;
static void forget(void *value) { (void)value; }
#define AT_LOAD                                     \
    pthread_key_create(&key, forget);               \
    pthread_setspecific(key, &key);
#define BEFORE_POINTS pthread_setspecific(key, &key);
#include "sound_law.h"
