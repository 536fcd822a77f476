/*
 * Rule broken: describe answers WL_NO_MORE for every index that it does not have.
 * Any further constant is described as the last one.
 */
#define LAW_NAME "describes-without-end"
#define LAST_CONSTANT(kind, index) ((kind) == WL_KIND_CONSTANT && (index) > 1 ? 1 : (index))
#include "sound_law.h"
