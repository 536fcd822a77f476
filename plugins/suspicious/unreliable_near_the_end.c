/* Allowed: answers to be used with a warning beyond half of the hardness, and none beyond twice of it. */
#define LAW_NAME "unreliable-near-the-end"
#define AT_POINT                                                                                                       \
    if (status == WL_OK && p > H / 2) {                                                                                \
        status = p > 2 * H ? WL_OUT_OF_DOMAIN : WL_UNRELIABLE;                                                         \
    }
#include "../faulty/sound_law.h"
