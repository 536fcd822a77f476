/*
 * Rule broken: pure: no memory between calls but the state variables.
 * Once an instance has been destroyed, the next ones answer otherwise.
 */
#define LAW_NAME "depends-on-past-instances"
static int destroyed;
#define AT_DESTROY destroyed = 1;
#define AT_POINT a.increment *= 1 + 1e-10 * destroyed;
#include "sound_law.h"
