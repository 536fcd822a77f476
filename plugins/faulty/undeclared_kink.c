/*
 * Rule broken: the derivative jumps only if the law says so by WL_FLAG_KINKS.
 * Above a hundredth of the hardness the increment grows twice as fast, and no flag says so.
 */
#define LAW_NAME "undeclared-kink"
#define LAW_DEGREE NAN
#define INCREMENT (K / H * (p + (p > 0.01 * H ? p - 0.01 * H : 0)) * s)
#define SLOPE (K / H * (p > 0.01 * H ? 2 : 1) * s)
#include "sound_law.h"
