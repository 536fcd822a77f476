/*
 * Rule broken: the minimum is below the maximum.
 * The hardness is at least 3e9 and at most 1e9; it must be given.
 */
#define LAW_NAME "bounds-crossed"
#define LAW_H_MINIMUM 3e9
#define LAW_H_MAXIMUM 1e9
#define LAW_H_DEFAULT NAN
#include "sound_law.h"
