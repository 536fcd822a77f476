/*
 * Rule broken: d_pressure is the derivative of the increment with respect to the pressure.
 * It is a difference quotient over one unit of pressure, which is no small step where the pressure is of that size.
 */
#define LAW_NAME "slope-by-one-pascal"
#define LAW_DEGREE 2
#define INCREMENT (K / H / H * p * p * s)
#define SLOPE (K / H / H * (2 * p + 1) * s)
#include "sound_law.h"
