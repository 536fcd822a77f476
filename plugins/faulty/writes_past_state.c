/*
 * Rule broken: writes every output that is asked for and nothing else.
 * One element past the states is written.
 */
#define LAW_NAME "writes-past-state"
#define AFTER_POINTS                                                        \
    if (o->state && v->points > 0) {                                   \
        volatile double *past = o->state + 2 * v->points;                      \
        *past = *past;                                                  \
    }
#include "sound_law.h"
