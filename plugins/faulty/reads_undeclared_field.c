/*
 * Rule broken: reads only what it declares.
 * The temperature is read and not declared, so that the pointer is NULL.
 */
#define LAW_NAME "reads-undeclared-field"
#define AT_POINT                                                                    \
    if (*(volatile const double *)&VALUE_AT(v->temperature, i) < 0) {               \
        status = WL_OUT_OF_DOMAIN;                                                  \
    }
#include "sound_law.h"
