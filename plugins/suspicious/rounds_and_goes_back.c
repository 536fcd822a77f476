/* Allowed: another rounding while the law computes, if it goes back before it returns. */
#include <fenv.h>
#define LAW_NAME "rounds-and-goes-back"
#define BEFORE_POINTS                                                                                                  \
    const int before = fegetround();                                                                                   \
    volatile double widest;                                                                                            \
    fesetround(FE_UPWARD);                                                                                             \
    widest = v->dt / 3;                                                                                                \
    (void)widest;                                                                                                      \
    fesetround(before);
#include "../faulty/sound_law.h"
