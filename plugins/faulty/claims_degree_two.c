/*
 * Rule broken: claimed: pressure times f gives increment times f^d.
 * It is linear and claims degree 2.
 */
#define LAW_NAME "claims-degree-two"
#define LAW_DEGREE 2
#include "sound_law.h"
