/*
 * Rule broken: no exit.
 * Create misses a licence and ends the program, as if all were well.
 */
#define LAW_NAME "exits-in-create"
#define AT_CREATE exit(0);
#include "sound_law.h"
