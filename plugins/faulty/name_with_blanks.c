/*
 * Rule broken: a name is letters, digits, `-` and `_`.
 * Its name is a sentence.
 */
#define LAW_NAME "a wear law"
#include "sound_law.h"
