/*
 * Rule broken: no memory between calls.
 * 64 bytes are allocated in every call and forgotten.
 */
#define LAW_NAME "leaks-each-call"
static void *volatile lost;
#define BEFORE_POINTS lost = malloc(64);
#include "sound_law.h"
