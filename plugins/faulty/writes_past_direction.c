/*
 * Rule broken: writes every output that is asked for and nothing else.
 * One element past the directions is written.
 */
#define LAW_NAME "writes-past-direction"
#define AFTER_POINTS                                                        \
    if (o->direction && v->points > 0) {                                   \
        volatile double *past = o->direction + 3 * v->points;                      \
        *past = *past;                                                  \
    }
#include "sound_law.h"
