/*
 * Rule broken: claimed: turning the frame leaves the increment.
 * A surface that looks along the third axis wears more.
 */
#define LAW_NAME "wears-more-on-top"
#define INCREMENT (K / H * p * s * (1 + 0.5 * normal[2] * normal[2]))
#define SLOPE (K / H * s * (1 + 0.5 * normal[2] * normal[2]))
#include "sound_law.h"
