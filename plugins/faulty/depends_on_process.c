/*
 * Rule broken: pure: everything comes from the inputs.
 * The number of the process finds its way into the answer.
 */
#include <unistd.h>
#define LAW_NAME "depends-on-process"
#define AT_POINT a.increment *= 1 + 1e-13 * (double)(getpid() % 1021);
#include "sound_law.h"
