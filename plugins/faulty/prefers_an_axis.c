/*
 * Rule broken: claimed: turning the frame turns the direction.
 * The direction leans towards the first axis of the frame, whatever the normal.
 */
#define LAW_NAME "prefers-an-axis"
#define AT_POINT                                                                                                 \
    double lean = a.direction[0] * 0.1, length = sqrt(1 + 2 * lean + 0.01);                                      \
    for (int k = 0; k < 3; ++k) {                                                                                \
        a.direction[k] = (a.direction[k] + (k == 0 ? 0.1 : 0)) / length;                                         \
    }
#include "sound_law.h"
