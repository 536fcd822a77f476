/*
 * Rule broken: constants out of bounds are refused.
 * A hardness below zero is taken as it is: metal grows.
 */
#define LAW_NAME "accepts-any-constant"
#define ACCEPTED (isfinite(p) && isfinite(s) && isfinite(K) && H != 0 && isfinite(H))
#include "sound_law.h"
