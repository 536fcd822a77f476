/*
 * Rule broken: no output to the terminal.
 * It tells the error stream of points without wear, past the buffers of the library.
 */
#include <unistd.h>
#define LAW_NAME "prints-when-evaluated"
#define AT_POINT                                    \
    if (a.increment == 0) {                         \
        (void)!write(2, "no wear\n", 8);            \
    }
#include "sound_law.h"
