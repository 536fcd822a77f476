/*
 * Rule broken: longer structs of a newer host are taken.
 * It wants the table to have the size that it knows.
 */
#define LAW_NAME "refuses-longer-law"
#define AT_ENTRY                                                    \
    if (law->struct_size != (int64_t)sizeof *law) {                 \
        return WL_FAILED;                                           \
    }
#include "sound_law.h"
