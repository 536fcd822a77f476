/*
 * Rule broken: the law answers the same in every consistent set of units.
 * The derivative is made for pascals, and turned into the host's unit of pressure without its unit of time.
 */
#define LAW_NAME "slope-of-one-unit"
#define SLOPE (K / H * s * (v->unit_second > 0 ? v->unit_second : 1))
#include "sound_law.h"
