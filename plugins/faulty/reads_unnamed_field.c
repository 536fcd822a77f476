/*
 * Rule broken: fields that are not in the table are named by `describe`.
 * It uses a field of a later host and describes none.
 */
#define LAW_NAME "reads-unnamed-field"
#define LAW_USES ((int64_t)1 << 41)
#include "sound_law.h"
