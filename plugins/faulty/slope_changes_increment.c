/*
 * Rule broken: asking for the derivative leaves the increment as it is.
 * With the derivative the increment is its product with the pressure, a little off.
 */
#define LAW_NAME "slope-changes-increment"
#define AT_POINT a.increment *= o->d_pressure ? 1 + 1e-9 : 1;
#include "sound_law.h"
