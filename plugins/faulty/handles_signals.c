/*
 * Rule broken: no signal handler.
 * Its constructor has floating-point exceptions ignored.
 */
#include <signal.h>
#define LAW_NAME "handles-signals"
#define AT_LOAD signal(SIGFPE, SIG_IGN);
#include "sound_law.h"
