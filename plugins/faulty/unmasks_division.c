/*
 * Rule broken: the exception masks are left as they were found.
 * Evaluation has divisions by zero trapped, to debug itself, and leaves it so.
 */
#define _GNU_SOURCE
#include <fenv.h>
#define LAW_NAME "unmasks-division"
#define AFTER_POINTS feenableexcept(FE_DIVBYZERO);
#include "sound_law.h"
