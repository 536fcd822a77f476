/*
 * Rule broken: d_pressure is the derivative of the increment with respect to the pressure.
 * The derivative is declared and always zero.
 */
#define LAW_NAME "slope-of-zero"
#define AT_POINT a.slope = 0;
#include "sound_law.h"
