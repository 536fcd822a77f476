/*
 * Rule broken: reads only what it declares.
 * The temperature is read and not declared, so that the pointer is NULL.
 */
#define LAW_NAME "reads-undeclared-field"
#define BEFORE_POINTS                                                               \
    if (v->points > 0 && *(volatile const double *)v->temperature.ptr < 0) {        \
        return WL_OUT_OF_DOMAIN;                                                    \
    }
#include "sound_law.h"
