/*
 * Rule broken: never a silent NaN: an input that has no answer gives a status.
 * Compiled as -ffinite-math-only does it, the tests for finite numbers are gone: NaN comes in and goes out unsaid.
 */
#define LAW_NAME "silent-nan"
#define STRANGE(x) isinf(x)
#include "sound_law.h"
