/*
 * Rule broken: every input in bounds gives a finite value or a status.
 * At one pressure of 256, by the last bits of its mantissa, the increment is not a number, and no status says so.
 */
#include "scrambled.h"
#define LAW_NAME "nan-in-bounds"
#define AT_POINT                                    \
    if (p > 0 && scrambled(p) >> 56 == 0xab) {      \
        a.increment = NAN;                          \
    }
#include "sound_law.h"
