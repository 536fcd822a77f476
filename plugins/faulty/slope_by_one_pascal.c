/*
 * Rule broken: the law answers the same in every consistent set of units.
 * The derivative is a difference quotient over one unit of pressure, which is little only where that is a pascal.
 */
#define LAW_NAME "slope-by-one-pascal"
#define LAW_DEGREE 2
#define INCREMENT (K / H / H * p * p * s)
#define SLOPE (K / H / H * (2 * p + 1) * s)
#include "sound_law.h"
