/*
 * Rule broken: a batch may hold any number of points.
 * It works in tiles of 4096 points; one point that is left over is a little off.
 */
#define LAW_NAME "wrong-at-a-tail-of-one"
#define AT_POINT a.increment *= i > 0 && i % 4096 == 0 && i + 1 == v->points ? 1 + 1e-9 : 1;
#include "sound_law.h"
