/*
 * Rule broken: touch min(struct_size, sizeof) of a struct that the other side allocated.
 * Written for a longer view, it reads the column that an older host does not have.
 */
#define LAW_NAME "reads-past-short-view"
#define BEFORE_POINTS                                                                                            \
    if (((volatile const unsigned char *)(view + 1))[0] == 1) { /* a column of 1.1 */                            \
        own->unused = 1;                                                                                         \
    }
#include "sound_law.h"
