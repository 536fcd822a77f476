/*
 * Rule broken: the law answers the same in every consistent set of units.
 * The hardness is declared in newtons per metre.
 */
#define LAW_NAME "wrong-unit"
#define LAW_H_UNIT 0, 1, -2, 0
#include "sound_law.h"
