/*
 * Rule broken: a law that needs the absolute temperature takes temperature - absolute_zero.
 * The wear goes with the ratio of the two surfaces' absolute temperatures, taken as they come in the scene's scale.
 */
#define LAW_NAME "forgets-absolute-zero"
#define LAW_READS (WL_FIELD_PRESSURE | WL_FIELD_SLIP | WL_FIELD_NORMAL | WL_FIELD_TEMPERATURE | WL_FIELD_COUNTER_TEMPERATURE)
#define BEFORE_POINTS                                                                                                  \
    missing |= v->temperature.ptr ? 0 : WL_FIELD_TEMPERATURE;                                                          \
    missing |= v->counter_temperature.ptr ? 0 : WL_FIELD_COUNTER_TEMPERATURE;
#define WARM VALUE_AT(v->temperature, i)
#define COOL VALUE_AT(v->counter_temperature, i)
#define INCREMENT (K / H * p * s * (WARM / COOL))
#define SLOPE (K / H * s * (WARM / COOL))
#define AT_POINT                                                                                                       \
    if (!(WARM > 0 && COOL > 0) || isinf(WARM) || isinf(COOL)) {                                                       \
        status = WL_OUT_OF_DOMAIN;                                                                                     \
    }
#include "sound_law.h"
