/*
 * Rule broken: asking for statuses leaves the values as they are.
 * With a status array a slower formula is a little off.
 */
#define LAW_NAME "status-array-changes-values"
#define AT_POINT a.increment *= o->status ? 1 + 1e-9 : 1;
#include "sound_law.h"
