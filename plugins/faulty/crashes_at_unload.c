/*
 * Rule broken: a library can be loaded and unloaded any number of times.
 * Its destructor frees what was never allocated.
 */
#define LAW_NAME "crashes-at-unload"
#define AT_UNLOAD                                   \
    static char table[16];                          \
    void *volatile mine = table + 8;                \
    free(mine);
#include "sound_law.h"
