/*
 * Rule broken: a batch may hold any number of points.
 * What is left over from groups of eight is a little off.
 */
#define LAW_NAME "wrong-in-remainder"
#define AT_POINT a.increment *= v->points > 8 && i >= v->points / 8 * 8 ? 1 + 1e-9 : 1;
#include "sound_law.h"
