/*
 * Rule broken: the wear direction is a unit vector.
 * It is a hundredth too short.
 */
#define LAW_NAME "direction-too-short"
#define AT_POINT a.direction[0] *= 0.99, a.direction[1] *= 0.99, a.direction[2] *= 0.99;
#include "sound_law.h"
