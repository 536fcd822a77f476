/*
 * Rule broken: no memory between calls but the state variables.
 * The state variable holds the distance in single precision; what that loses is kept in the instance, for the next
 * substep.
 */
#define LAW_NAME "state-in-single-precision"
#define INSTANCE_MEMBERS int64_t substep; double rest[2][4096]; /* at the start and at the end of the last substep */
#define BEFORE_POINTS                                                                       \
    if (v->points > 0 && own->substep != v->substep) {                                      \
        if (own->substep + 1 == v->substep) {                                               \
            memcpy(own->rest[0], own->rest[1], sizeof own->rest[0]);                        \
        } else {                                                                            \
            memset(own->rest, 0, sizeof own->rest);                                         \
        }                                                                                   \
        own->substep = v->substep;                                                          \
    }
#define AT_POINT                                                                            \
    if (s > 0 && a.state[0] < 1e30) {                                                       \
        double exact = start[0] + s + (i < 4096 ? own->rest[0][i] : 0);                     \
        a.state[0] = (double)(float)exact;                                                  \
        if (i < 4096) {                                                                     \
            own->rest[1][i] = exact - a.state[0];                                           \
        }                                                                                   \
    }
#include "sound_law.h"
