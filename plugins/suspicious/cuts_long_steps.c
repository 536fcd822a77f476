/* Allowed: a substep that slips too far is sent back with a factor. */
#define LAW_NAME "cuts-long-steps"
#define AT_POINT                                                                                                       \
    if (status == WL_OK && K * p > 10 * H) {                                                                           \
        status = WL_CUT_STEP;                                                                                          \
    }
#define AFTER_POINTS                                                                                                   \
    if (worst == WL_CUT_STEP && REACHES(output, wl_output, dt_factor)) {                                               \
        output->dt_factor = 0.25;                                                                                      \
    }
#include "../faulty/sound_law.h"
