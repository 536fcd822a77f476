/*
 * Rule broken: no call overflows the stack, whatever the input.
 * The hardnesses that the pressure holds are counted down by a recursion; there is no end to it if there are too
 * many.
 */
#define LAW_NAME "recurses-without-end"
static double whole(double parts, const volatile char *above) {
    volatile char room[512];
    room[0] = above[0];
    return parts < 1 ? room[0] : 1 + whole(parts - 1, room) + room[0];
}
#define AT_POINT                                    \
    volatile char first[1] = {0};                   \
    own->unused = whole(given / H, first);
#include "sound_law.h"
