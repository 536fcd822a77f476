/*
 * Rule broken: the floating-point environment is left as it was found, also by loading.
 * Its constructor turns on flush-to-zero and denormals-are-zero, as linking with -ffast-math once did.
 */
#include "control_register.h"
#define LAW_NAME "flushes-at-load"
#define AT_LOAD flush_to_zero();
#include "sound_law.h"
