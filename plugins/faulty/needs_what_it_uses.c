/*
 * Rule broken: a field that a law only uses may be absent.
 * The temperature is read whether it is there or not.
 */
#define LAW_NAME "needs-what-it-uses"
#define LAW_USES WL_FIELD_TEMPERATURE
#define AT_POINT                                                                    \
    if (!isfinite(*(volatile const double *)&VALUE_AT(v->temperature, i))) {        \
        status = WL_OUT_OF_DOMAIN;                                                  \
    }
#include "sound_law.h"
