/*
 * Rule broken: claimed: no pressure, no wear.
 * A thousandth of the hardness always presses.
 */
#define LAW_NAME "wears-without-pressure"
#define LAW_DEGREE NAN
#define INCREMENT (given < 0 ? 0 : K / H * (p + 1e-3 * H) * s)
#include "sound_law.h"
