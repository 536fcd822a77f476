/*
 * Rule broken: touch min(struct_size, sizeof) of a struct that the other side allocated.
 * Written for a longer output, it writes the member that an older host does not have.
 */
#define LAW_NAME "overruns-short-output"
#define AFTER_POINTS                                                                                             \
    volatile unsigned char *behind = (volatile unsigned char *)(output + 1);                                     \
    behind[0] = behind[0]; /* a member of 1.1 */
#include "sound_law.h"
