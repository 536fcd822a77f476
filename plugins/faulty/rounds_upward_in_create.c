/*
 * Rule broken: the floating-point environment is left as it was found.
 * Create rounds its table upward and does not go back.
 */
#include <fenv.h>
#define LAW_NAME "rounds-upward-in-create"
#define AT_CREATE fesetround(FE_UPWARD);
#include "sound_law.h"
