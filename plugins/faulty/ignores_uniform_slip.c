/*
 * Rule broken: a column with step 0 holds one value for all points.
 * A slip that is given once counts for the first point only.
 */
#define LAW_NAME "ignores-uniform-slip"
#define AT_POINT a.increment *= v->slip.step == 0 && i > 0 ? 0 : 1;
#include "sound_law.h"
