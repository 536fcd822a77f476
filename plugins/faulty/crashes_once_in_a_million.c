/*
 * Rule broken: no call ends in a signal, whatever the input.
 * At one pressure of a million, by the last bits of its mantissa, it follows a null pointer.
 */
#include "scrambled.h"
#define LAW_NAME "crashes-once-in-a-million"
#define AT_POINT                                    \
    if (scrambled(given) >> 44 == 0xabcde) {        \
        int *volatile nowhere = NULL;               \
        *nowhere = 1;                               \
    }
#include "sound_law.h"
