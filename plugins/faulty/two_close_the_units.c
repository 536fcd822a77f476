/*
 * Rule broken: at most one constant closes the units.
 * Both constants do.
 */
#define LAW_NAME "two-close-the-units"
#define LAW_K_FLAGS WL_QUANTITY_CLOSES_UNITS
#define LAW_H_FLAGS (WL_QUANTITY_ABOVE_MINIMUM | WL_QUANTITY_CLOSES_UNITS)
#include "sound_law.h"
