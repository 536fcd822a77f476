/*
 * Rule broken: claimed: pressure times f gives increment times f^d.
 * It is linear and claims the degree that its wear coefficient holds.
 */
#define LAW_NAME "claims-degree-of-constant"
#define LAW_DEGREE NAN
#define LAW_DEGREE_CONSTANT 0
#include "sound_law.h"
