/*
 * Rule broken: pure: no memory between calls but the state variables.
 * Constants are kept in the instance that was made last, and taken from there.
 */
#define LAW_NAME "mixes-instances"
#define INSTANCE_MEMBERS double K, H;
struct sound_instance;
static struct sound_instance *latest;
#define AT_CREATE latest = own;
#define AT_DESTROY latest = latest == own ? NULL : latest;
#define AT_POINT                                                                    \
    own->K = K, own->H = H;                                                         \
    if (latest && latest->H > 0 && status == WL_OK) {                               \
        a.increment = latest->K / latest->H * p * s;                                \
        a.slope = given < 0 ? 0 : latest->K / latest->H * s;                        \
    }
#include "sound_law.h"
