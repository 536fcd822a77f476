/*
 * Rule broken: no call ends in a signal, whatever the input.
 * A table of powers of ten of the slip is read beyond its end for slips above 1e100.
 */
#define LAW_NAME "crashes-on-large-slip"
#define AT_POINT                                                    \
    if (s > 1e100) {                                                \
        a.increment += *(volatile double *)((size_t)log10(s) % 8);  \
    }
#include "sound_law.h"
