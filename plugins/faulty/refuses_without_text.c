/*
 * Rule broken: an instance that cannot be made is refused with a status and a text.
 * Create refuses options without a word.
 */
#define LAW_NAME "refuses-without-text"
#define SAY_IN_CREATE(to, size, what) (void)(to)
#include "sound_law.h"
