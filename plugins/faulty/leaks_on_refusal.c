/*
 * Rule broken: no memory between calls.
 * Every refused call allocates its text and forgets it.
 */
#define LAW_NAME "leaks-on-refusal"
static void *volatile lost;
#define AFTER_POINTS lost = worst != WL_OK ? strdup("out of domain") : NULL;
#include "sound_law.h"
