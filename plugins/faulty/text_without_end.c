/*
 * Rule broken: a text takes at most text_size bytes with its closing NUL.
 * In a buffer that is too short its reason has no closing NUL.
 */
#define LAW_NAME "text-without-end"
#define SAY(to, size, what) ((to) ? (void)strncpy(to, what, (size_t)(size)) : (void)0)
#include "sound_law.h"
