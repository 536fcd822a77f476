/*
 * Rule broken: outputs that are not asked for are not written.
 * The derivative is written whether its pointer is given or not.
 */
#define LAW_NAME "writes-unwanted-slope"
#define AT_POINT                                            \
    if (!o->d_pressure && i == 0) {                         \
        *(volatile double *)(uintptr_t)o->d_pressure = a.slope; \
    }
#include "sound_law.h"
