/*
 * Rule broken: a field that a law only uses may be absent.
 * The temperature is read whether it is there or not.
 */
#define LAW_NAME "needs-what-it-uses"
#define LAW_USES WL_FIELD_TEMPERATURE
#define BEFORE_POINTS                                                               \
    if (v->points > 0 && isnan(*(volatile const double *)v->temperature.ptr)) {     \
        SAY(o->text, o->text_size, "the temperature is not a number");              \
        return WL_OUT_OF_DOMAIN;                                                    \
    }
#include "sound_law.h"
