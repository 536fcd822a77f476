/*
 * Rule broken: destroy frees what create has taken.
 * A table of 4 KiB is made with every instance and never freed.
 */
#define LAW_NAME "leaks-instances"
static void *volatile lost;
#define AT_CREATE                                   \
    lost = malloc(4096);                            \
    memset(lost, 1, 4096);
#include "sound_law.h"
