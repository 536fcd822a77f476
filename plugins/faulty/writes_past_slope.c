/*
 * Rule broken: writes every output that is asked for and nothing else.
 * One element past the derivatives is written.
 */
#define LAW_NAME "writes-past-slope"
#define AFTER_POINTS                                                        \
    if (o->d_pressure && v->points > 0) {                                   \
        volatile double *past = o->d_pressure + v->points;                      \
        *past = *past;                                                  \
    }
#include "sound_law.h"
