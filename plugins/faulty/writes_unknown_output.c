/*
 * Rule broken: outputs written are those of the table.
 * It says that it writes an output that there is not.
 */
#define LAW_NAME "writes-unknown-output"
#define LAW_WRITES (WL_OUTS_KNOWN | 1024)
#include "sound_law.h"
