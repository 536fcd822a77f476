/*
 * Rule broken: any part of the points gives the same answers.
 * Arrays that do not begin at a multiple of 16 bytes go another way, which is a little off.
 */
#define LAW_NAME "depends-on-alignment"
#define AT_POINT a.increment *= ((uintptr_t)v->pressure.ptr & 15) != 0 ? 1 + 1e-9 : 1;
#include "sound_law.h"
