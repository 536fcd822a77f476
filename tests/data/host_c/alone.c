/* A law that says by its flag, or keeps silent about it, that it must be called by one thread at a time; it fails where it is called by two. */
#define LAW_NAME "alone"
#define LAW_VERSION "1.0.0"
#define LAW_SUMMARY "fails where two threads are in it at once"
#define LAW_READS(F) F(pressure)
#ifdef SERIAL
#define LAW_FLAGS WL_FLAG_SERIAL
#endif
#include "wearlaw_point.h"

static int inside;

WL_POINT {
    int alone = __atomic_add_fetch(&inside, 1, __ATOMIC_SEQ_CST) == 1;
    volatile int wait = 0;
    while (wait < 2000) wait = wait + 1;
    __atomic_sub_fetch(&inside, 1, __ATOMIC_SEQ_CST);
    out->increment = in->dt * in->pressure;
    return alone ? WL_OK : WL_FAILED;
}
