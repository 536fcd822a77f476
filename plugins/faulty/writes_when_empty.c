/*
 * Rule broken: no points: nothing is read or written.
 * It clears the first increment to begin with, whether there is one or not.
 */
#define LAW_NAME "writes-when-empty"
#define BEFORE_POINTS output->increment[0] = 0;
#include "sound_law.h"
