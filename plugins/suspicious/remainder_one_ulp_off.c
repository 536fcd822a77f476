/* Allowed: the remainder of a vectorised loop rounds otherwise, by a unit in the last place: it is not claimed that bits
 * are the same in every batch. */
#define LAW_NAME "remainder-one-ulp-off"
#define LAW_CLAIMS (WL_CLAIMS_KNOWN & ~WL_CLAIM_DETERMINISTIC)
#define AT_POINT                                                                                                       \
    if (i >= v->points / 8 * 8 && status == WL_OK && isfinite(K * p * s)) {                                            \
        a.increment = K * p * s / H; /* in another order than in groups of eight */                                    \
    }
#include "../faulty/sound_law.h"
