/*
 * Rule broken: a law never looks at other points.
 * In batches of more than one point a faster formula is a little off.
 */
#define LAW_NAME "depends-on-batch-size"
#define AT_POINT a.increment *= v->points > 1 ? 1 + 1e-9 : 1;
#include "sound_law.h"
