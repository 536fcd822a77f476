/*
 * Rule broken: the law answers the same in every consistent set of units.
 * The work so far, a pressure times a length, is declared in joules.
 */
#define LAW_NAME "wrong-unit-of-state"
#define LAW_WORK_UNIT 2, 1, -2, 0
#include "sound_law.h"
