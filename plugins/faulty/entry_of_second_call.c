/*
 * Rule broken: the entry says the same when asked again.
 * Asked again for its first law it has a second one besides.
 */
#define LAW_NAME "entry-of-second-call"
static int asked;
#define AT_ENTRY                                    \
    if (index == 1 && asked++ > 0) {                \
        index = 0;                                  \
    }
#include "sound_law.h"
