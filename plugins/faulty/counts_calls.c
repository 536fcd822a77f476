/*
 * Rule broken: pure: no memory between calls but the state variables.
 * A static counter adds a little from call to call.
 */
#define LAW_NAME "counts-calls"
static long calls;
#define BEFORE_POINTS double grown = 1 + 1e-12 * (double)(++calls % 1000);
#define AT_POINT a.increment *= grown, a.slope *= grown;
#include "sound_law.h"
