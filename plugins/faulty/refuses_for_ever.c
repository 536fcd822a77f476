/*
 * Rule broken: everything comes from the inputs; create has no memory of earlier calls.
 * Once options were refused, create refuses all, good ones as well.
 */
#define LAW_NAME "refuses-for-ever"
static int refused;
#define OPTIONS_ACCEPTED(options) (!(refused |= (options) && *(options)))
#include "sound_law.h"
