/*
 * Rule broken: a text takes at most text_size bytes with its closing NUL.
 * It copies its reason whole.
 */
#define LAW_NAME "overruns-text"
#define SAY(to, size, what) ((to) && (size) > 0 ? (void)strcpy(to, what) : (void)0)
#include "sound_law.h"
