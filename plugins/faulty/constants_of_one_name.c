/*
 * Rule broken: the names of the constants of a law are different.
 * Both constants are called K.
 */
#define LAW_NAME "constants-of-one-name"
#define LAW_H_NAME "K"
#include "sound_law.h"
