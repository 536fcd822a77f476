/*
 * Rule broken: d_pressure is the derivative of the increment with respect to the pressure.
 * Beyond a hundred times any ordinary pressure it is left at 0.
 */
#define LAW_NAME "slope-ends-far-out"
#define SLOPE (p > 4e11 * (v->unit_metre > 0 ? v->unit_metre * v->unit_second * v->unit_second / v->unit_kilogram : 1) ? 0 : K / H * s)
#include "sound_law.h"
