/*
 * Rule broken: the floating-point environment is left as it was found.
 * Destroy rounds a last statistic upward and does not go back.
 */
#include <fenv.h>
#define LAW_NAME "rounds-upward-in-destroy"
#define AT_DESTROY fesetround(FE_UPWARD);
#include "sound_law.h"
