/*
 * Rule broken: d_pressure is the derivative of the increment with respect to the pressure.
 * At one point of 40, by the last bits of its slip, the derivative is a tenth off.
 */
#include "scrambled.h"
#define LAW_NAME "slope-mostly-right"
#define AT_POINT a.slope *= scrambled(s) % 40 == 7 ? 1.1 : 1;
#include "sound_law.h"
