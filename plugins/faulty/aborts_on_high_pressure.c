/*
 * Rule broken: no abort.
 * An assertion that the pressure is a number below 1e200 ends the program.
 */
#undef NDEBUG
#include <assert.h>
#define LAW_NAME "aborts-on-high-pressure"
#define AT_POINT assert(given < 1e200);
#include "sound_law.h"
