/*
 * Rule broken: no output to the terminal.
 * Its constructor greets.
 */
#define LAW_NAME "prints-at-load"
#define AT_LOAD                                     \
    puts("wear law 1.0, all rights reserved");      \
    fflush(stdout);
#include "sound_law.h"
