/*
 * Rule broken: d_pressure is the derivative of the increment with respect to the pressure.
 * The derivative is half of what it should be.
 */
#define LAW_NAME "slope-of-half"
#define AT_POINT a.slope /= 2;
#include "sound_law.h"
