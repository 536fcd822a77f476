/*
 * Rule broken: touch min(struct_size, sizeof) of a struct that the other side allocated.
 * Written for a longer table, it writes the member that an older host does not have.
 */
#define LAW_NAME "overruns-short-law"
#define COPY_LAW(to, from)                                                                                       \
    do {                                                                                                         \
        volatile unsigned char *behind = (volatile unsigned char *)((to) + 1);                                   \
        memcpy(to, from, sizeof *(from));                                                                        \
        behind[0] = behind[0]; /* a member of 1.1 */                                                             \
    } while (0)
#define COPY_QUANTITY(to, from) memcpy(to, from, sizeof *(from))
#include "sound_law.h"
