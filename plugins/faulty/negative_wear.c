/*
 * Rule broken: claimed: the increment is never negative.
 * Metal grows at one slip of eight, by its last bits.
 */
#include "scrambled.h"
#define LAW_NAME "negative-wear"
#define LAW_CLAIMS WL_CLAIM_NON_NEGATIVE
#define SIGN (scrambled(s) % 8 == 3 ? -1 : 1)
#define INCREMENT (SIGN * (K / H * p * s))
#define SLOPE (SIGN * (K / H * s))
#include "sound_law.h"
