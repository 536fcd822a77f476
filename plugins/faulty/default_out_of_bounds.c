/*
 * Rule broken: a default lies in the bounds.
 * The hardness is 2e9 by default and at least 5e9.
 */
#define LAW_NAME "default-out-of-bounds"
#define LAW_H_MINIMUM 5e9
#include "sound_law.h"
