/*
 * Rule broken: the floating-point environment is left as it was found, also by create.
 * It turns on flush-to-zero while it reads its options, and does not turn it off where it refuses them.
 */
#include "control_register.h"
#define LAW_NAME "flushes-when-it-refuses"
#define OPTIONS_ACCEPTED(options) (!(options) || !*(options) || (flush_to_zero(), 0))
#include "sound_law.h"
