/*
 * Rule broken: no abort.
 * An assertion that the pressure is a number ends the program.
 */
#undef NDEBUG
#include <assert.h>
#define LAW_NAME "aborts-on-nan"
#define AT_POINT assert(!isnan(given));
#include "sound_law.h"
