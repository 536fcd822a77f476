/* Allowed: one scratch for all calls of an instance, if WL_FLAG_SERIAL asks the host to call it in turn. */
#define LAW_NAME "serial-scratch"
#define LAW_FLAGS WL_FLAG_SERIAL
#define INSTANCE_MEMBERS volatile double scratch;
#define AT_POINT                                                                                                       \
    own->scratch = a.increment;                                                                                        \
    for (volatile int wait = 0; wait < 20; ++wait) {                                                                   \
    }                                                                                                                  \
    a.increment = own->scratch;
#include "../faulty/sound_law.h"
