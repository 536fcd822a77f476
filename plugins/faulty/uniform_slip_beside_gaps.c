/*
 * Rule broken: every column has a step of its own: 0, its width or more.
 * A slip that is given once counts half where the pressures lie with gaps.
 */
#define LAW_NAME "uniform-slip-beside-gaps"
#define AT_POINT a.increment *= v->slip.step == 0 && v->pressure.step > 1 ? 0.5 : 1;
#include "sound_law.h"
