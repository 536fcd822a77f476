/*
 * Rule broken: a library can be loaded and unloaded any number of times.
 * It keeps a page at a fixed address and never gives it back, so that the second load finds the address taken.
 */
#define _GNU_SOURCE
#include <sys/mman.h>
#define LAW_NAME "fails-at-second-load"
static int scratch_is_mine;
#define AT_LOAD                                                                                                \
    scratch_is_mine = mmap((void *)0x313000000000, 4096, PROT_READ | PROT_WRITE,                               \
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0) != MAP_FAILED;
#define AT_ENTRY                                    \
    if (!scratch_is_mine) {                         \
        return WL_FAILED;                           \
    }
#include "sound_law.h"
