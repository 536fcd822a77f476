/*
 * Rule broken: no change of environment variables.
 * Create sets the number of threads for a library that it uses.
 */
#define LAW_NAME "changes-environment"
#define AT_CREATE setenv("OMP_NUM_THREADS", "1", 1);
#include "sound_law.h"
