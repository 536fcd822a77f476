/*
 * Rule broken: a law never looks at other points.
 * Part of the neighbour before it in the batch flows in.
 */
#define LAW_NAME "looks-at-neighbour"
#define AT_POINT a.increment += i > 0 ? 1e-9 * K / H * fabs(VALUE_AT(v->pressure, i - 1)) * s : 0;
#include "sound_law.h"
