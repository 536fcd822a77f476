/*
 * Rule broken: writes every output that is asked for and nothing else.
 * One element past the increments is written.
 */
#define LAW_NAME "writes-past-increment"
#define AFTER_POINTS                                                        \
    if (o->increment && v->points > 0) {                                   \
        volatile double *past = o->increment + v->points;                      \
        *past = *past;                                                  \
    }
#include "sound_law.h"
