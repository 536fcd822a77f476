/*
 * Rule broken: writes every output that is asked for and nothing else.
 * One element past the statuses is written.
 */
#define LAW_NAME "writes-past-status"
#define AFTER_POINTS                                                        \
    if (o->status && v->points > 0) {                                   \
        volatile int32_t *past = o->status + v->points;                      \
        *past = *past;                                                  \
    }
#include "sound_law.h"
