/*
 * Rule broken: the pressure degree is a number or the index of a constant.
 * It is said to be in the eighth of two constants.
 */
#define LAW_NAME "degree-of-no-constant"
#define LAW_DEGREE NAN
#define LAW_DEGREE_CONSTANT 7
#include "sound_law.h"
