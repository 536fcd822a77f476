/*
 * Rule broken: an array of doubles begins at any multiple of eight bytes.
 * It looks only where the pressure begins before it takes the slip in pairs; a pair across a multiple of 16 is a little off.
 */
#define LAW_NAME "aligned-with-the-pressure"
#define AT_POINT a.increment *= (((uintptr_t)v->pressure.ptr & 15) == 0 && ((uintptr_t)v->slip.ptr & 15) != 0) ? 1 + 1e-9 : 1;
#include "sound_law.h"
